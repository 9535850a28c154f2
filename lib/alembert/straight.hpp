// SPDX-License-Identifier: MIT
#pragma once

/// What a long step of a straight motion, as free flight far from everything, may pass over: a narrow hill of the
/// potential lies between the stages of a method, whose estimated error is zero.
///
///     if (!is_clear(stretch, rhs, {state, rate}, tolerance, evaluations)) …    // repeat the step with less
///     length
///
/// A step counts as straight if the rate goes from one end to the other in proportion to time at two of its three
/// quarters. Then it has to do so at 63 places within the step: times the length of the step it may differ by
/// terms_left_out tolerances. A step that is not straight is clear; its estimated error has seen how it bends.

#include "alembert/events.hpp"
#include "alembert/rhs.hpp"

namespace alembert {

inline constexpr int places_within = 64;      ///< of a step, one more than are looked at
inline constexpr double terms_left_out = 30;  ///< what may change the slope of a step, in tolerances
inline constexpr double good_part = 0.01;     ///< of a run; only such steps are looked at

struct Beginning {
    const double *state, *rate;
};

/// `from` is the start of the step; `evaluations` counts those that are made here.
bool is_clear(const Stretch& step, const Rhs& rhs, const Beginning& from, double tolerance, long& evaluations);

}  // namespace alembert
