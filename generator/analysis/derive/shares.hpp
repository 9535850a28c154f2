// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// If constraints depend on each other, their multipliers are not determined. The program takes those of least
/// norm that give the same forces. If row_r = Σ c_k row_k, these obey λ_r = Σ c_k λ_k, because (−c, 1), which
/// gives no force, must be orthogonal to them.
///
///     for (const LeastShare& share : least_shares_of(mechanism)) …   // cos(θ) λ_y = sin(θ) λ_x

#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

/// The relation left = right. Both sides are linear in multipliers, with factors in q and t.
struct LeastShare {
    GiNaC::ex left, right;
};

/// One relation for each of Mechanism::redundant whose factors are short enough to be written out. The rows of
/// which it is a combination, and the columns that determine its factors, are chosen in floating point at states
/// that obey the constraints.
std::vector<LeastShare> least_shares_of(const Mechanism& mechanism);

}  // namespace alembert
