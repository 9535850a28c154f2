// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The cost of a right-hand side: its operations, and the longest chain of operations that wait for each other.
///
///     const Cost cost = cost_of(program);
///     cost.time();        // to compare programs with
///
/// Chains are counted in cycles (readiness.hpp). A processor overlaps part of a chain with the next call, so that
/// both count.

#include "program/processor.hpp"
#include "program/program.hpp"

namespace alembert {

struct Cost {
    int operations = 0, functions = 0, chain = 0;  ///< functions are among the operations
    double time() const { return processor::time_of(operations, functions, chain); }  ///< cycles
};

Cost cost_of(const Program& program);

}  // namespace alembert
