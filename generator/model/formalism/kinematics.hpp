// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Generalized speeds: q' = h(q,u,t) = B u + b, with the nonholonomic constraints solved if u eliminates them.
///
///     const Kinematics k = kinematics(mechanism).value();     // sleigh with v, w: h = (v cos phi, v sin phi, w)
///
/// If the scene has [speeds], u = W q' + w; there are n of them, or n − m, where m counts all constraints or only
/// the nonholonomic ones. If not, u = q'. With nonholonomic constraints these are the rates that remain after each
/// constraint has been solved for one rate: one whose coefficient is a number if there is one, else one whose
/// coefficient has parameters only, else the one with the largest coefficient at the start. If that would fail at
/// some pose and k constraints connect k + 1 rates, these rates are replaced by the one combination u1 = N·q' that
/// the constraints leave free: for the sleigh's −x' sin phi + y' cos phi = 0 it is x' cos phi + y' sin phi.

#include <vector>

#include "model/formalism/equations.hpp"
#include "model/formalism/obstacle.hpp"

namespace alembert {

struct Kinematics {
    std::vector<GiNaC::symbol> u, udot;
    std::vector<GiNaC::ex> form = {};   ///< u in q, q', t
    std::vector<GiNaC::ex> h = {};      ///< q' in q, u, t
    std::vector<int> eliminated = {};   ///< positions in Mechanism::constraints
    std::vector<GiNaC::ex> poles = {};  ///< u does not determine q' where one of these vanishes
};

/// There is an obstacle if the number of speeds is none of the three, or if the speeds do not determine the rates.
Possible<Kinematics> kinematics(const Mechanism& mechanism);
/// The same for a formalism that starts from the velocities of particles and bodies; `title` names its equations.
Possible<Kinematics> kinematics_of_masses(const Mechanism& mechanism, const std::string& title);

/// u = q', whatever speeds and constraints the scene has.
Kinematics rates_as_speeds(const Mechanism& mechanism);

/// q'' in q, u, u', t: the time derivative of h.
std::vector<GiNaC::ex> accelerations(const Mechanism& mechanism, const Equations& equations);

/// The numbers of speeds that a scene may have, largest first.
std::vector<int> allowed_speeds(const Mechanism& mechanism);

/// x with S x = right, where `right` has several columns. Rows whose pivots are numbers are eliminated first. The
/// rest is split into independent blocks and solved by minors, so that the only divisors are the determinants of
/// the blocks. `message` is the obstacle if a determinant vanishes identically; `poles` are the determinants that
/// depend on the state.
struct Solution {
    GiNaC::matrix x;
    std::vector<GiNaC::ex> poles;
};
Possible<Solution> solve_exactly(const GiNaC::matrix& S, const GiNaC::matrix& right, const Mechanism& mechanism,
                                 const std::string& message);

}  // namespace alembert
