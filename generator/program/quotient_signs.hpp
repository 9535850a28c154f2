// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Signs that a scene writes as quotients: x/|x| and x/√(x²) become sign x, and every other √(x²) becomes |x|
/// then, so that a run holds the sign constant (switches.hpp) where the quotient would divide 0 by 0.
///
///     std::vector<int> signs;
///     program = with_quotient_signs(program, signs);      // signs: the x of the new program

#include <vector>

#include "program/program.hpp"

namespace alembert {

/// What depends on parameters only is not changed, and a program without such quotients neither.
Program with_quotient_signs(const Program& program, std::vector<int>& signs);

}  // namespace alembert
