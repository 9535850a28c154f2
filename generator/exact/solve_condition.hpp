// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One condition solved for its variable, or two for two, modulo the prime and at the random values of a state.

#include "exact/exact_state.hpp"
#include "exact/solving_order.hpp"

namespace alembert {

struct Solved {
    bool found = false;
    std::size_t degree = 0;  ///< of the polynomial
};

/// Puts a root into `state`, one drawn by its seed where there are several. Not found where the polynomial in the
/// variable has no root modulo the prime, or where a condition cannot be evaluated.
Solved solve_condition(const Program& program, const SolvingStep& step, ExactState& state);

}  // namespace alembert
