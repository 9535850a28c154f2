// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equations of motion in the form x' = f(x), where x consists of the independent coordinates on which
/// something depends, followed by the independent speeds. Other coordinates and speeds follow from the
/// constraints; coordinates on which nothing depends keep their values.

#include "stability/local.hpp"

namespace alembert {

/// The whole state, up to terms of this degree, if x is given as series. Throws NotAnalytic.
State<Expansion> state_of_series(const Local& local, const std::vector<Expansion>& x, int degree);

/// The series of x', likewise.
std::vector<Expansion> field(const Local& local, const std::vector<Expansion>& x, int degree);

/// The value at the point of state k.
RealBall state_value(const Local& local, std::size_t k);

}  // namespace alembert
