// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Signs that a scene writes as quotients: x/|x| and x/√(x²) become sign x, and every other √(x²) becomes |x|
/// then, so that a run holds the sign constant (switches.hpp) where the quotient would divide 0 by 0.
///
///     std::vector<QuotientSign> signs;
///     program = with_quotient_signs(program, signs);

#include <set>
#include <vector>

#include "program/program.hpp"

namespace alembert {

/// A sign that replaced quotients: the node x of the new program, and the parts of the mechanism (indices into
/// Program::source_labels) from which they, and |x| or √(x²), come.
struct QuotientSign {
    int argument;
    std::set<int> sources;
};

/// What depends on parameters only is not changed, and a program without such quotients neither.
Program with_quotient_signs(const Program& program, std::vector<QuotientSign>& signs);

}  // namespace alembert
