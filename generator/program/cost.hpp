// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a right-hand side costs: its operations, and the longest chain of operations that wait for each other.
///
///     const Cost cost = cost_of(program);
///     cost.time();        // to compare programs with
///
/// Chains are counted in cycles (readiness.hpp). A processor overlaps part of a chain with the next call, so that both count.

#include "program/program.hpp"

namespace alembert {

struct Cost {
    int operations = 0, functions = 0, chain = 0;  ///< functions are among the operations
    double time() const { return 0.36 * operations + 3 * functions + 0.65 * chain; }  ///< cycles; fitted to tests/bench/rhs.sh
};

Cost cost_of(const Program& program);

}  // namespace alembert
