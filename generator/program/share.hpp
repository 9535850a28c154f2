// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Fewer operations from the same program: what hash-consing alone does not see.
///
///     a·b·c, a·b·d      one product a·b, used twice
///     a + b + c, a + b  one sum
///     a·b + a·c         a·(b + c), where the products serve nobody else
///     k·(k′·a)          (k·k′)·a, where k k′ is known before the run and k′·a serves nobody else
///
/// Greedy: the pair that occurs most often is taken first, ties by the canonical order, so the result is the same
/// in every run (the idea is Breuer's, Generation of optimal code for expressions via factorization, CACM 12
/// (1969)).

#include "program/program.hpp"

namespace alembert {

/// The same roots with at most as many operations in the accelerations as before.
Program shared(Program program);

}  // namespace alembert
