// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene near an equilibrium or a steady motion, in numbers with bounds: the algebra of
/// stability/linear/tangent.hpp, exact if the scene's numbers and their functions are exact.
///
///     const Local local(near, exact_at);              // of linearize(scene, {.at = …})
///     local.A                                         // over local.states
///
/// The state is taken from the scene's own expressions (pi/2, acos(g/(R*Omega^2))) and from typed values. Values
/// that the program had to find, and a state that is not exactly an equilibrium, are improved by Newton's method
/// until the residual is 10⁻²⁸; their radius is then 10⁻²⁶, and it is tried to prove that the state lies within.

#include "stability/interval/disc.hpp"
#include "stability/interval/expansion.hpp"
#include "stability/interval/matrix.hpp"
#include "stability/interval/point.hpp"
#include "stability/linear/about.hpp"
#include "stability/linear/tangent.hpp"

namespace alembert {

/// M δw' + D δw + P δr = 0, δr' = H (δr, δw); the columns of `along` are the changes of (q, u) with (r, w).
struct RealBallTangent {
    RealBallMatrix mass, damping, stiffness, rates, along;
    RealBallVector speed_rates, coordinate_rates, position, velocity;  ///< residuals at the point
    RealBallVector to_position, to_velocity;  ///< Newton's step of the dependent coordinates and speeds
};

class Local {
public:
    /// Throws NotAnalytic if the equations have no series at the point, or if a pivot is not certain.
    Local(const LinearizedScene& near, const ExactOverrides& exact_at);

    const LinearizedScene& near;
    const Mechanism& mechanism;
    const Equations& equations;
    Residuals residuals;
    Split split;
    RealBallPoint point;
    StateKnown known = StateKnown::exactly;
    RealBallTangent tangent;
    std::vector<std::string> states;  ///< essential coordinates, then speeds
    std::vector<int> essential;       ///< positions in split.q of coordinates on which something depends
    std::vector<int>
        cyclic_momenta;  ///< positions in split.u of speeds whose momentum is conserved and which are eliminated
    RealBallMatrix A;    ///< over the states, with constant momenta

    RealBallTangent tangent_at(const RealBallPoint& at) const;
    /// The program's values as series; `variables` gives for each of q, then u, the variable of the monomials that
    /// it is.
    State<Expansion> state_at(const RealBallPoint& at, const Monomials* monomials,
                              const std::vector<int>& variables) const;
    /// Expressions in q, q', t, written in the speeds of the equations.
    std::vector<GiNaC::ex> in_speeds(const std::vector<GiNaC::ex>& of) const;
    /// Expressions in q, q', t as series about the point.
    std::vector<Expansion> series(const std::vector<GiNaC::ex>& of, const Monomials& monomials,
                                  const std::vector<int>& variables) const;
    /// The same in a state of series.
    std::vector<Expansion> series(const std::vector<GiNaC::ex>& of, const State<Expansion>& state) const;
    bool is_essential(int coordinate) const;  ///< position in q
    std::vector<int> cyclic() const;          ///< positions in split.q of coordinates on which nothing depends

private:
    void find_essential();
    bool is_left_out_of_equations(int coordinate) const;
    std::vector<std::vector<int>> ties() const;
    void find_point(const ExactOverrides& exact_at);
    void settle();
    void find_momenta();
    void prove_state();
    void reduce();
};

}  // namespace alembert
