// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Statements in an order that fits in a processor's registers.
///
///     const std::vector<int> order = register_order(statements);       // positions; each after those that it
///     needs
///
/// Where a program has far more operations than its longest chain waits for, what is urgent is soon computed by
/// the hundred, and a compiler stores it and loads it again: an arm of seven joints about oblique axes read a
/// value from memory in every instruction. Here what is urgent goes first as long as there are registers; then
/// what sets one free, or the next value that depth first would take. Elsewhere, or with too many statements, the
/// order stays as it is. (Goodman & Hsu, Code scheduling and register allocation in large basic blocks, ICS 1988,
/// 442.)

#include <vector>

namespace alembert {

struct Computation {
    std::vector<int> needs{};  ///< positions of earlier statements, each once
    int operations = 1;
    int latency = 4;  ///< cycles
};

std::vector<int> register_order(const std::vector<Computation>& statements);

}  // namespace alembert
