// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equations of motion without constraints as x' = f(x), x being the coordinates that something depends on,
/// then all speeds.

#include "stability/local.hpp"

namespace alembert {

/// x' as series where the states are these series. Throws NotAnalytic.
std::vector<Expansion> field(const Local& local, const std::vector<Expansion>& x);

/// The value at the point of state k.
Certain state_value(const Local& local, std::size_t k);

}  // namespace alembert
