// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// States that obey the constraints, and constraints that no state obeys.
///
///     if (states_that_obey(mechanism, start, 1).empty())
///         // positions in Mechanism::constraints
///         for (const int k : contradictory_constraints(mechanism, start)) …
///
/// Found in numbers, from a fixed number of places around `start` with a fixed seed: that no state was found is no
/// proof that there is none.

#include "lower/start.hpp"

namespace alembert {

constexpr int places_tried = 24;

/// Up to `wanted` states at t = start.t, all coordinates and rates being free to move (assemble.hpp). The first is
/// the nearest to `start`.
std::vector<State<double>> states_that_obey(const Mechanism& mechanism, const Start& start, int wanted);

/// Constraints that no state was found to obey together, without one of which there is such a state. To be asked
/// where none obeys all.
std::vector<int> contradictory_constraints(const Mechanism& mechanism, const Start& start);

/// The mechanism with these constraints alone.
Mechanism with_constraints(const Mechanism& mechanism, const std::vector<int>& positions);

}  // namespace alembert
