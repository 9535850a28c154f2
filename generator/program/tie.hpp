// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Makes K = [M Aᵀ; A 0] regular where some rows of A depend on each other with factors that change with the pose,
/// such as the four rows of two wheels on one axle. Whichever of them were left out, the others would lose rank at
/// some poses. All of them stay, and their block of K becomes −κE, E being the orthogonal projection onto the
/// vectors ν with νᵀA = 0:
///
///     [M Aᵀ; A −κE] (u', −λ) = (f, γ)   gives A u' = γ, and of all λ with the same forces the least, νᵀλ = 0,
///
/// because νᵀγ = 0 for each such ν. E has no threshold in it and is as smooth as A, so that power series and
/// derivatives hold at every pose where the rank of all rows is what it usually is.

#include <vector>

#include "program/program.hpp"

namespace alembert {

/// The lower triangle of κE for rows of A whose rank is `rank` at almost every pose. `inertia` is the diagonal of
/// M; κ has the size of the eigenvalues of A M⁻¹Aᵀ.
std::vector<int> tie_of_rows(Program& program, const std::vector<std::vector<int>>& rows,
                             const std::vector<int>& inertia, int rank);

}  // namespace alembert
