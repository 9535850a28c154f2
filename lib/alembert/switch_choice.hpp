// SPDX-License-Identifier: MIT
#pragma once

/// The sides to which functions at their zeros may move (switching.hpp).

#include <vector>

#include "alembert/switching.hpp"

namespace alembert {

struct SideChoice {
    std::vector<int> sides;
    double margin;  ///< the choice is consistent if this is positive
    bool jumps;     ///< whether f differs on the two sides of the open functions
};

/// All choices of sides for the `open` functions, the most consistent first; the other functions have their sides
/// as in `sides`. There are 3 to the power of the number of open functions.
std::vector<SideChoice> side_choices(const Switching& system, std::vector<int> sides, const std::vector<int>& open,
                                     double t, const std::vector<double>& state);

}  // namespace alembert
