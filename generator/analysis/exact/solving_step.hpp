// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A condition and the variable for which it is solved, or two conditions that are solved together for two
/// variables.

#include <optional>

#include "program/program.hpp"

namespace alembert {

struct SolvedUnknown {
    int node = 0;  ///< the condition
    Variable variable{};
    bool turned = false;  ///< whether the variable is an angle in sines and cosines
};

/// One such pair, or two pairs that are solved together.
struct SolvingStep : SolvedUnknown {
    std::optional<SolvedUnknown> second = {};
};

}  // namespace alembert
