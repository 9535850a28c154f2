// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Names and short expressions of a scene for places without MathML: labels of figures and plots.

#include <functional>
#include <string>

namespace alembert {

/// Escaped for XML; names become letters with indices, which `index` writes (`is_last` tells that nothing
/// follows).
std::string letters_of(const std::string& expression,
                       const std::function<std::string(const std::string& index, bool is_last)>& index);

}  // namespace alembert
