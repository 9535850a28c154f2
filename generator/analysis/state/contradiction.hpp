// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds states that obey the constraints, and constraints that no state obeys.
///
///     if (states_that_obey(mechanism, start, 1).empty())
///         // positions in Mechanism::constraints
///         for (const int k : contradictory_constraints(mechanism, start)) …
///
/// The search is numerical, from a fixed number of places around `start` with a fixed seed. If it finds no state,
/// that is no proof that there is none.

#include "program/lower/start.hpp"

namespace alembert {

constexpr int places_tried = 24;

/// Up to `wanted` states at t = start.t, where all coordinates and rates may move (assemble.hpp). The first is the
/// nearest to `start`.
std::vector<State<double>> states_that_obey(const Mechanism& mechanism, const Start& start, int wanted);

/// Constraints for which no state was found that obeys them together, while there is a state if any one of them is
/// dropped. To be called if no state obeys all constraints.
std::vector<int> contradictory_constraints(const Mechanism& mechanism, const Start& start);

/// The mechanism with these constraints only.
Mechanism with_constraints(const Mechanism& mechanism, const std::vector<int>& positions);

}  // namespace alembert
