// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What is wrong where an expression cannot go on, and what to write instead. Each throws Mistake.

#include <vector>

#include "scene/expression.hpp"
#include "scene/functions.hpp"
#include "scene/tokens.hpp"

namespace alembert {

[[noreturn]] void stop(int offset, std::string message);

/// `l(x)` where l is no function; the name was read.
[[noreturn]] void refuse_function(const Words& words, const Token& name);

/// `sin^2(x)`; the name was read.
[[noreturn]] void refuse_power_of_function(Words words, const Token& name);

/// `2x`, `2(x)`, `x y`, `)(`: a factor right after the one that began at `begin`. Returns where there is none.
void refuse_neighbour(const Words& words, int begin);

/// No number, name or parenthesis where one must be.
[[noreturn]] void refuse_missing_operand(const Words& words);

/// A word that ends nothing and begins nothing.
[[noreturn]] void refuse_word(const Words& words);

/// Returns where the number of arguments and, for points and frames, their kind are right.
void check_arguments(const Function& function, const std::vector<TreePtr>& args, int begin);

}  // namespace alembert
