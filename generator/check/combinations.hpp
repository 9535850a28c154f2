// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Claims that are combinations of the equations and the constraints. They need no state that obeys the
/// constraints, which may be hard to find.
///
///     const std::vector<std::size_t> left = without_combinations(now, {0, 1, 2}, Motions::At::motion);

#include "check/comparison.hpp"

namespace alembert {

/// Settles those of these claims that are combinations, and returns the others.
std::vector<std::size_t> without_combinations(Comparison& now, const std::vector<std::size_t>& claims,
                                              Motions::At at);

}  // namespace alembert
