// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The first approximation along a motion that is no steady one.
///
///     const std::vector<Start> states = states_along(derived, start, {.duration = 2, .sample = 0.5});
///     const std::vector<Linearization> near = linearize_along(mechanism, equations, states);
///     near[3].A;       // δx' = A(t) δx + B(t) δinputs at t = start.t + 1.5

#include <functional>
#include <string_view>

#include "analysis/derive/derived.hpp"

namespace alembert {

struct AlongOptions {
    std::optional<double> duration = {}, tolerance = {}, sample = {};       ///< if missing, the scene's
    std::function<void(std::string_view what, double part)> progress = {};  ///< may be empty
};

/// The states of the motion from `start`, which obeys the constraints, at the rows that `simulate` gives. Throws
/// std::invalid_argument for numbers that these cannot be, ModelError for scenes with contacts, dry friction or
/// events with impulses, and IntegrationError where the motion fails.
std::vector<Start> states_along(const Derived& derived, const Start& start, const AlongOptions& options = {});

}  // namespace alembert
