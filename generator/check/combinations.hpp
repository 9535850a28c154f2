// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Claims that are combinations of the equations and the constraints. They need no state that obeys the
/// constraints, which may be hard to find.

#include <map>

#include "check/comparison.hpp"

namespace alembert {

/// Those of these claims that are combinations, proved; where no state of rest exists, vacuous.
std::map<std::size_t, CheckedClaim> combinations_among(Comparison& now, const std::vector<std::size_t>& claims);

}  // namespace alembert
