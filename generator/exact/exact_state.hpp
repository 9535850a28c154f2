// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A state in exact arithmetic modulo a prime (exact/motions.hpp), with what a bound on the chance of an error
/// needs to know of it.

#include "program/modular.hpp"

namespace alembert {

struct ExactState {
    ModularPoint point;  ///< coordinates, rates, accelerations; `unknown` k is the multiplier of constraint k
    double degree = 1;   ///< of the accelerations in the random values, at most: for Schwartz's bound
    double branches =
        1;  ///< roots that the conditions have, each perhaps on a branch of its own: this one was drawn from them
    std::optional<ModularPoint> other_shares =
        {};                 ///< with other multipliers of the same forces, where there are any
    double conditions = 0;  ///< doublings of the chance of a failure (ModularValues)
    bool exact = true;      ///< no function was met whose identities are unknown
};

}  // namespace alembert
