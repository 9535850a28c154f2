// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// All equilibria and steady motions that Newton's method reaches from many starts.
///
///     SteadyProblem problem(mechanism, equations, start);
///     const SteadySearch found = search_steady(problem, mechanism, start, {});
///     found.roots[0].at.q
///
/// A coordinate is an angle if the equations have the period 2π in it: its starts fill one turn, and roots that
/// differ by whole turns are one. Starts of other coordinates lie within about ten times the scene's own lengths
/// (its parameters of the same unit, the initial value), most of them within twice these, and so do those of
/// first-order states that have a rate. The starts form a Halton sequence, which is the same in each run; the
/// first is the scene's own state. Then there is a start in each piece of a table between knots (at most 500). If
/// nothing is found, that is no proof that there is nothing.

#include <functional>

#include "stability/equilibrium/family.hpp"
#include "stability/linear/steady.hpp"

namespace alembert {

struct SearchOptions {
    int starts = 0;  ///< if 0, by the number of coordinates and the length of the equations
    std::function<void(double)> progress = {};
};

struct FoundRoot : SteadyRoot {
    std::optional<SteadyFamily> family = {};  ///< if it is not isolated: the continuum near it
};

struct SteadySearch {
    std::vector<FoundRoot> roots;  ///< ordered by coordinates; angles in (−π, π]
    std::vector<bool> is_angle;    ///< for each coordinate
    int starts = 0, converged = 0;
    Rates rates = Rates::given;  ///< free: no root has the given rates of cyclic coordinates
    /// Roots that belong to continua. Of each continuum `roots` has the one that was found first, and so the one
    /// that is reached from the scene's own state.
    int in_families = 0;
    /// If nothing was found, the state with the smallest unbalanced forces, and these forces by speed.
    Instant<long double> nearest;
    std::vector<long double> left_over;
    std::vector<bool> constant;  ///< whether the force along this speed is the same at each start and not zero
};

/// Whether all terms of the equations have the period 2π in each coordinate, found by comparison at random states.
std::vector<bool> find_angles(const SteadyProblem& problem);

/// Searches; also sets the problem's scales.
SteadySearch search_steady(SteadyProblem& problem, const Mechanism& mechanism, const Start& start,
                           const SearchOptions& options);

/// Moves angles by whole turns into (−π, π].
void wrap_angles(Instant<long double>& at, const std::vector<bool>& is_angle);

/// The largest difference of an essential coordinate in units of the scales, with angles modulo 2π.
long double distance(const SteadyProblem& problem, const std::vector<bool>& is_angle,
                     const Instant<long double>& a, const Instant<long double>& b);

}  // namespace alembert
