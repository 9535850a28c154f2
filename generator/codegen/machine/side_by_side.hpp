// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Roots and quotients of one system that do not wait for each other, up to four of them in one instruction.
///
///     const Lines quick = side_by_side(lines_of(program, words, readiness, task));
///     // pair, pair, join, root of four, keep          for bodies that attract each other
///
/// A processor has one divider, which four numbers in one register occupy hardly longer than one or two of them
/// alone. The lines between, such as r³ = r²·r, stand side by side where all their values do. Results have the
/// same bits, because every lane rounds as one number does. Lines come back as they were where that takes no
/// longer (line_cycles.hpp), and so do those of packs.
///
/// Which lines fit together is found as in Larsen & Amarasinghe, Exploiting superword level parallelism with
/// multimedia instruction sets, PLDI 2000, 145, with roots and quotients in place of neighbours in memory.

#include "codegen/machine/lines.hpp"

namespace alembert::machine {

Lines side_by_side(const Lines& lines);

}  // namespace alembert::machine
