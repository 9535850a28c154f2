// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Constraints that depend on each other leave their multipliers open. The program takes the least ones that give
/// the same forces: where row_r = Σ c_k row_k, they obey λ_r = Σ c_k λ_k, for (−c, 1) is orthogonal to all forces.
///
///     for (const LeastShare& share : least_shares_of(mechanism)) …   // cos(θ) λ_y = sin(θ) λ_x

#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

/// left = right; both linear in multipliers, with factors in q and t.
struct LeastShare {
    GiNaC::ex left, right;
};

/// One for each of Mechanism::redundant whose factors are short enough to be written out. Which rows it is made
/// of, and which columns tell its factors, is decided at states that obey the constraints, in floating point.
std::vector<LeastShare> least_shares_of(const Mechanism& mechanism);

}  // namespace alembert
