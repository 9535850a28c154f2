// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Checks the number of the scene's generalized speeds, and that they are independent.
///
///     if (const auto mistake = mistake_in_speeds(mechanism)) fail(scene, {*mistake});

#include <optional>

#include "model/mechanism.hpp"

namespace alembert {

/// A mistake in [speeds], with its place: too many or too few speeds (n, n − m with m all constraints, n − m with
/// m the nonholonomic ones), forms that depend on each other, forms that the constraints already fix. Ranks are
/// those at the start and at eight random states, in floating point. The mechanism must be without redundant
/// constraints.
std::optional<Diagnostic> mistake_in_speeds(const Mechanism& mechanism);

}  // namespace alembert
