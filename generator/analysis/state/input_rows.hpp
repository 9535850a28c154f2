// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The rows of a file for an input: a time and a value in each line, with a comma between. The first line may name
/// the two columns; empty lines are left out.
///
///     t,u
///     0,1.5
///     0.1,-2e-3

#include <string>
#include <utility>
#include <vector>

namespace alembert {

using InputRow = std::pair<double, double>;

/// Throws SceneError as `text_of_file` does, and ModelError with the line, what was found and what was expected
/// for a line that is no two finite numbers, times that do not grow, no rows, or more than 500.
std::vector<InputRow> input_rows(const std::string& file);

}  // namespace alembert
