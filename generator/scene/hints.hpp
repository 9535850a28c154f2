// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Messages for places where an expression cannot go on: what is wrong, and what to write instead. Each function
/// throws Mistake.

#include <vector>

#include "scene/expression.hpp"
#include "scene/functions.hpp"
#include "scene/tokens.hpp"

namespace alembert {

[[noreturn]] void stop(int offset, std::string message);

/// For `sin^2(x)`; the name has been read.
[[noreturn]] void refuse_power_of_function(Words words, const Token& name);

/// `2x`, `2(x)`, `x y`, `)(`: a factor directly after the one that began at `begin`. Returns if there is none.
void refuse_neighbour(const Words& words, int begin);

/// `3 mpa`: a word that is neither a unit nor a name of the scene.
[[noreturn]] void refuse_unknown_unit(const Words& words, int begin);

/// `2 ft 3 in`: a number after a unit.
[[noreturn]] void refuse_second_number(const Words& words, int begin);

/// A number, name or parenthesis is missing.
[[noreturn]] void refuse_missing_operand(const Words& words);

/// A token that fits neither what comes before nor what comes after.
[[noreturn]] void refuse_word(const Words& words);

/// Returns if the number of arguments is right and, for points and frames, their kind.
void check_arguments(const Function& function, const std::vector<TreePtr>& args, int begin);

}  // namespace alembert
