// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Are the scene's generalized speeds as many as they must be, and independent?
///
///     if (const auto mistake = mistake_in_speeds(mechanism)) fail(scene, {*mistake});

#include <optional>

#include "model/mechanism.hpp"

namespace alembert {

/// What is wrong with [speeds], at its place: too many or too few of them (n, n − m with m all constraints, n − m
/// with m the nonholonomic ones), forms that depend on each other, forms that the constraints already fix. Ranks
/// are those at the start and at eight random states, in floating point. The mechanism must be without redundant
/// constraints.
std::optional<Diagnostic> mistake_in_speeds(const Mechanism& mechanism);

}  // namespace alembert
