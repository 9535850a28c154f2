// SPDX-License-Identifier: MIT
#pragma once

/// Which sides functions that are on their zeros may go to (switching.hpp).

#include <vector>

#include "alembert/switching.hpp"

namespace alembert {

struct SideChoice {
    std::vector<int> sides;
    double margin;  ///< above 0: consistent
    bool jumps;     ///< f differs on the sides of those that are open
};

/// All choices of sides for those that are `open`, the others as in `sides`, the most consistent first: 3 to the
/// power of their number.
std::vector<SideChoice> side_choices(const Switching& system, std::vector<int> sides, const std::vector<int>& open,
                                     double t, const std::vector<double>& state);

}  // namespace alembert
