// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// All equilibria and steady motions that Newton's method reaches from many starts.
///
///     SteadyProblem problem(mechanism, equations, start);
///     const SteadySearch found = search_steady(problem, mechanism, start, {});
///     found.roots[0].at.q
///
/// A coordinate is an angle if the equations have the period 2π in it: its starts fill one turn, and roots that
/// differ by whole turns are one. Starts of other coordinates lie within some ten times the scene's own lengths
/// (its parameters of the same unit, the initial value), most of them within twice. The starts are a Halton
/// sequence, the same in each run; the first is the scene's own state. That nothing was found is no proof.

#include <functional>

#include "linear/steady.hpp"

namespace alembert {

struct SearchOptions {
    int starts = 0;  ///< 0: by the number of coordinates
    std::function<void(double)> progress = {};
};

struct SteadySearch {
    std::vector<SteadyRoot> roots;  ///< by coordinates, in order; angles in (−π, π]
    std::vector<bool> is_angle;     ///< of each coordinate
    int starts = 0, converged = 0;
    Rates rates = Rates::given;  ///< free: no root has the given rates of cyclic coordinates
    int in_families = 0;         ///< roots that belong to a continuum of which `roots` has one
    /// Where nothing was found: the state with the least forces left over, and these, by speed.
    Instant<long double> nearest;
    std::vector<long double> left_over;
    std::vector<bool> constant;  ///< the force along this speed is the same at each start, and is not zero
};

/// Whether all that the equations hold has the period 2π in each coordinate: compared at random states.
std::vector<bool> find_angles(const SteadyProblem& problem);

/// Sets the problem's scales.
SteadySearch search_steady(SteadyProblem& problem, const Mechanism& mechanism, const Start& start,
                           const SearchOptions& options);

/// Moves angles by whole turns into (−π, π].
void wrap_angles(Instant<long double>& at, const std::vector<bool>& is_angle);

/// The largest difference of an essential coordinate, by scale, angles modulo 2π.
long double distance(const SteadyProblem& problem, const std::vector<bool>& is_angle,
                     const Instant<long double>& a, const Instant<long double>& b);

}  // namespace alembert
