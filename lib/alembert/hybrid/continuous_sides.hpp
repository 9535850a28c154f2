// SPDX-License-Identifier: MIT
#pragma once

/// The sides to which functions at their zeros go where the rates are the same on all their sides, as those of
/// tables are at knots, of |x| or of max(0, x).
///
///     if (const auto sides = continuous_sides(moment, {2, 3})) …      // nothing where the rates differ
///
/// There the equations leave the motion no choice (Picard and Lindelöf), and no rate of a function need tell where
/// it goes: a mass at rest at a knot, pushed by sin(3t), leaves it as t³. So a short trial of the motion is
/// followed until each function has left its zero. Those that do not leave it have the side 0.

#include <optional>
#include <vector>

#include "alembert/hybrid/switching_scales.hpp"

namespace alembert {

/// Whether the rates are the same on all sides of these functions, which are zero; never of those of friction.
bool rates_are_continuous(const SwitchingScales& moment, const std::vector<int>& open);

/// Nothing either where the trial cannot be followed so far that all is decided.
std::optional<FilippovMode> continuous_sides(const SwitchingScales& moment, const std::vector<int>& open);

}  // namespace alembert
