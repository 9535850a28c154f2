// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Equations of motion without constraints in the form x' = f(x), where x consists of the coordinates on which
/// something depends, followed by all speeds.

#include "stability/local.hpp"

namespace alembert {

/// The series of x' if the states are the given series. Throws NotAnalytic.
std::vector<Expansion> field(const Local& local, const std::vector<Expansion>& x);

/// The value at the point of state k.
Certain state_value(const Local& local, std::size_t k);

}  // namespace alembert
