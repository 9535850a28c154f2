// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The kinds of warnings, which `allow` of a scene silences and JSON gives (docs/scene-language.md, Errors and
/// warnings).

#include <array>
#include <string_view>

namespace alembert {

inline constexpr std::array<std::string_view, 19> warning_kinds{"unit_mismatch",
                                                                "unused",
                                                                "no_effect",
                                                                "no_length",
                                                                "initial_values",
                                                                "no_inertia",
                                                                "suspicious_number",
                                                                "redundant",
                                                                "added_equations",
                                                                "moving_place",
                                                                "quotient_of_size",
                                                                "before_impulses",
                                                                "poles",
                                                                "gimbal_lock",
                                                                "not_a_number",
                                                                "unknown_unit",
                                                                "nearly_redundant",
                                                                "joint_order",
                                                                "left_out"};

}  // namespace alembert
