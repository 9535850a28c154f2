// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// s_1, c_2, s_{12}, as books on robots and on pendulums write sines and cosines, where both stand so and no line
/// says what they are. Two indices mean the sum of the angles where each counts from the one before, and their
/// difference where all count from one line: c_{12} = cos(θ_1 + θ_2) or cos(θ_1 − θ_2).
///
///     for (const auto& [letter, value] : sines_by_index(written, letters, scene))      // s_{12}, "sin(q1+q2)"

#include <string>
#include <utility>
#include <vector>

#include "check/derivation/letters.hpp"

namespace alembert {

/// The letters with what they are in claims; none where a coordinate of an index is a length.
std::vector<std::pair<Letter, std::string>> sines_by_index(const Written& written, const Letters& letters,
                                                           const Scene& scene);

}  // namespace alembert
