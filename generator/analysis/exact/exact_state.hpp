// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A state in exact arithmetic modulo a prime (analysis/exact/motions.hpp), with the numbers that a bound on the
/// probability of an error needs.

#include "program/modular.hpp"

namespace alembert {

struct ExactState {
    ModularPoint point;  ///< coordinates, rates, accelerations; `unknown` k is the multiplier of constraint k
    double degree = 1;   ///< a bound on the degree of the accelerations in the random values, for Schwartz's bound
    double branches = 1;  ///< the number of roots of the conditions, each perhaps on a different branch, from
                          ///< which this one was drawn
    std::optional<ModularPoint> other_shares =
        {};                 ///< the same state with other multipliers of the same forces, if there are any
    double conditions = 0;  ///< how often the probability of an error is doubled (ModularValues)
    std::map<std::pair<Variable::Kind, int>, Prime> roots = {};  ///< of the conditions, as they were found
    double field = 61;  ///< log₂ of the number of values from which the variables are drawn
    bool exact = true;  ///< false if a function occurred whose identities are unknown
};

}  // namespace alembert
