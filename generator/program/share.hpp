// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Reduces the operations of a program by common subexpressions that hash-consing does not find.
///
///     a·b·c, a·b·d      one product a·b, used twice
///     a + b + c, a + b  one sum
///     a·b + a·c         a·(b + c), where the products serve nobody else
///     k·(k′·a)          (k·k′)·a, where k k′ is known before the run and k′·a serves nobody else
///
/// The method is greedy: the pair that occurs most often is taken first, and ties are broken by the canonical
/// order, so that the result is the same in every run (the idea is Breuer's, Generation of optimal code for
/// expressions via factorization, CACM 12 (1969)).

#include "program/program.hpp"

namespace alembert {

/// The same roots with at most as many operations in the accelerations as before.
Program shared(Program program);

}  // namespace alembert
