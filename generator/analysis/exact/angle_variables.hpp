// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which variables of a program are angles.

#include <set>
#include <vector>

#include "analysis/exact/real_values.hpp"

namespace alembert {

/// Finds the variables inside sines, cosines and tangents, and those outside of them. A variable of which only
/// functions of [functions] hold more than angles is an angle too, because these functions take any value.
void find_variables(const Program& program, const std::vector<int>& roots, std::set<RealState::Key>& angles,
                    std::set<RealState::Key>& plain);

}  // namespace alembert
