// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Orders statements so that their values fit in a processor's registers.
///
///     register_order(statements)       // positions, each after those that it needs
///
/// If a program has far more operations than the longest chain has time for, a schedule by urgency soon has
/// hundreds of values waiting, and the compiler stores and reloads them: for an arm of seven joints with oblique
/// axes, every instruction read a value from memory. Here urgent statements come first as long as registers are
/// free. After that, a statement that frees a register comes next, or the next one in depth-first order. For other
/// programs, or with too many statements, the order is not changed. (Goodman & Hsu, Code scheduling and register
/// allocation in large basic blocks, ICS 1988, 442.)

#include <vector>

namespace alembert {

struct Computation {
    std::vector<int> needs{};  ///< positions of earlier statements, each once
    int operations = 1;
    int latency = 4;  ///< cycles
};

std::vector<int> register_order(const std::vector<Computation>& statements);

}  // namespace alembert
