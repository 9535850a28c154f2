// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The number of an equation behind its formula: (6), (2.13), (5a), (iv), (*), and behind a dash (i) or (a) too. A
/// number in parentheses behind nothing but numbers, 2 (3), is a factor, and so is what stands without a blank.
///
///     before_equation_number(tokens, 0, tokens.size())    // m a = F — (1): the place of the dash

#include <cstddef>
#include <vector>

#include "check/written/tokens.hpp"

namespace alembert {

/// Where the formula of the tokens from `begin` to `end` ends before such a number; `end` if none is there.
std::size_t before_equation_number(const std::vector<WrittenToken>& tokens, std::size_t begin, std::size_t end);

bool is_long_dash(const WrittenToken& token);

}  // namespace alembert
