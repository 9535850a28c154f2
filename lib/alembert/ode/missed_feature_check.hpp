// SPDX-License-Identifier: MIT
#pragma once

/// What a long step of a straight motion, as free flight far from everything, may pass over: a narrow hill of the
/// potential lies between the stages of a method, whose estimated error is zero.
///
///     const int places = places_within(h, length_of_run);
///     if (places > 1 && !is_clear(stretch, places, rhs, tolerance, evaluations))
///         …                                                           // repeat the step with less length
///
/// A step counts as straight if the state moves by the mean of the rates at its ends. Then the rate has to go from
/// one end to the other in proportion to time, at places that are a 64th of the run apart: times the length of the
/// step it may differ by terms_left_out tolerances. A step that is not straight is clear; its estimated error has
/// seen how it bends. So is one in which nothing changes that the rates depend on.

#include <algorithm>
#include <cmath>

#include "alembert/ode/events.hpp"
#include "alembert/ode/rhs.hpp"

namespace alembert {

inline constexpr int places_in_run = 64;
inline constexpr double terms_left_out = 30;  ///< what may change the slope of a step, in tolerances
/// What it may differ by, in sizes of the state, where steps have a fixed length: their own error is told by a
/// second run.
inline constexpr double passed_by_fixed_step = 0.01;
inline constexpr double next_to_none = 0.01;  ///< an estimated error that says nothing, in tolerances

/// Whether nothing on which the rates depend (Rhs::needed_state) changes by more than `allowed` max(1, |y|),
/// `change` being what a component changes in the step: so it is in steady motion and under constant forces, and
/// then there is nothing within the step. False if it is not known what they depend on.
template <typename Change>
bool is_steady(const Rhs& rhs, const double* state, double allowed, const Change& change) {
    if (!rhs.needed_state) return false;
    return std::all_of(rhs.needed_state->begin(), rhs.needed_state->end(),
                       [&](int i) { return i >= 0 && change(i) <= allowed * std::max(1.0, std::abs(state[i])); });
}

/// Into how many parts a step is divided by the places at which it is looked at: 1 for short ones. Methods with an
/// estimated error look if it is next to none.
inline int places_within(double length, double length_of_run) {
    return static_cast<int>(std::ceil(std::min(1.0, length / length_of_run) * places_in_run));
}

/// The start of the step must be known; `evaluations` counts those that are made here.
bool is_clear(const StepView& step, int places, const Rhs& rhs, double tolerance, long& evaluations);

}  // namespace alembert
