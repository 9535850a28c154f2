// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The numbers of a state as a person would write them.
///
///     as_written("x", "-21/20")               // x = -1.05
///     as_written("theta", "2*atan(2/3)")      // theta ≈ 67.38°
///
/// They come as `check` gives them, whole: fractions, decimals of double precision, and angles by the tangents of
/// their halves. Four digits are shown; "≈" says that there are more.

#include <string>
#include <utility>
#include <vector>

namespace alembert {

struct WrittenNumber {
    std::string text;
    bool is_exact = true;
};
/// `name` as that of a variable: the time is no angle.
WrittenNumber written_number(const std::string& name, const std::string& value);

std::string as_written(const std::string& name, const std::string& value);
/// "m = 3, theta ≈ 67.38°"
std::string text_of_state(const std::vector<std::pair<std::string, std::string>>& values);
/// A state at which a claim fails; of a claim in the scene's own speeds without the rates of coordinates, which
/// follow from them.
std::string text_of_state(std::vector<std::pair<std::string, std::string>> values, const std::string& claim);

}  // namespace alembert
