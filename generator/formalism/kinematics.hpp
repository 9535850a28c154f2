// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Generalized speeds: q' = h(q,u,t) = B u + b, with the nonholonomic constraints solved for where u leaves them
/// out.
///
///     const Kinematics k = kinematics(mechanism).value();     // sleigh with v, w: h = (v cos phi, v sin phi, w)
///
/// With [speeds] u = W q' + w: n of them, n − m with m all constraints, or n − m with m the nonholonomic ones.
/// Without, u = q'; under nonholonomic constraints, those rates that remain when each constraint has been solved
/// for one: for one whose coefficient is a number, then one in parameters alone, then the largest at the start.
/// Where that would fail at some pose and k constraints tie k + 1 rates, the one combination u1 = N·q' that they
/// leave free takes the place of these rates: for the sleigh's −x' sin phi + y' cos phi = 0 it is x' cos phi + y'
/// sin phi.

#include <vector>

#include "formalism/equations.hpp"
#include "formalism/obstacle.hpp"

namespace alembert {

struct Kinematics {
    std::vector<GiNaC::symbol> u, udot;
    std::vector<GiNaC::ex> form = {};   ///< u in q, q', t
    std::vector<GiNaC::ex> h = {};      ///< q' in q, u, t
    std::vector<int> eliminated = {};   ///< positions in Mechanism::constraints
    std::vector<GiNaC::ex> poles = {};  ///< where one of these vanishes u does not determine q'
};

/// An obstacle is a number of speeds that is none of the three, and speeds that do not determine the rates.
Possible<Kinematics> kinematics(const Mechanism& mechanism);
/// The same for a formalism that starts from the velocities of particles and bodies; `title` is that of its
/// equations.
Possible<Kinematics> kinematics_of_masses(const Mechanism& mechanism, const char* title);

/// u = q', whatever speeds and constraints there are.
Kinematics rates_as_speeds(const Mechanism& mechanism);

/// q'' in q, u, u', t: the time derivative of h.
std::vector<GiNaC::ex> accelerations(const Mechanism& mechanism, const Equations& equations);

/// The numbers of speeds that a scene may have, largest first.
std::vector<int> allowed_speeds(const Mechanism& mechanism);

/// x with S x = right, right having several columns: rows whose pivots are numbers are eliminated; what is left is
/// split into independent blocks and solved by minors, so that nothing is divided by but a block's determinant.
/// `message` is the obstacle if a determinant vanishes identically; `poles` are those that depend on the state.
struct Solution {
    GiNaC::matrix x;
    std::vector<GiNaC::ex> poles;
};
Possible<Solution> solve_exactly(const GiNaC::matrix& S, const GiNaC::matrix& right, const Mechanism& mechanism,
                                 const std::string& message);

}  // namespace alembert
