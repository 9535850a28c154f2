// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Solves one condition for its variable, or two conditions for two variables, modulo the prime and at the random
/// values of a state.

#include "analysis/exact/exact_state.hpp"
#include "analysis/exact/own_point.hpp"
#include "analysis/exact/solving_order.hpp"

namespace alembert {

struct Solved {
    bool found = false;
    std::size_t degree = 0;  ///< degree of the polynomial
    std::size_t roots = 1;   ///< how many there are to draw from
};

/// Sets the variable in `state` to a root, which the state's seed draws if there are several. There is no solution
/// if the polynomial in the variable has no root modulo the prime, or if a condition cannot be evaluated. `own`:
/// only roots on the scene's own branch are taken. `after`: instead of the root that is drawn, the one that stands
/// so many places after it in their circle.
Solved solve_condition(const Program& program, const SolvingStep& step, ExactState& state,
                       const OwnRoot* own = nullptr, std::size_t after = 0);

}  // namespace alembert
