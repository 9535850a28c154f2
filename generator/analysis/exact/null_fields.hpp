// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The vector fields that a system of one-forms annihilates.
///
///     x' − r·φ' = 0:    X₁ = r ∂/∂x + ∂/∂φ,   X₂ = ∂/∂t
///
/// Rows in echelon form, dz_p + Σ C_pf dz_f = 0 over the free variables f, have the null fields X_f = ∂_f − Σ C_pf
/// ∂_p.

#include "algebra/symbolic/intermediates.hpp"
#include "program/modular.hpp"

namespace alembert {

struct NullFields {
    std::vector<std::vector<GiNaC::ex>> fields;  ///< one for each free variable
    std::vector<std::size_t> pivots;             ///< one for each form; never the last variable
};

/// `forms` must be independent without their last entry; `values[point][form][variable]` are their values at
/// random points. Expressions that are zero at all points count as zero. If the points belong to a variety, the
/// fields are right on that variety. Nothing if a point is unusable.
std::optional<NullFields> null_fields(std::vector<std::vector<GiNaC::ex>> forms,
                                      std::vector<std::vector<std::vector<Prime>>> values, Intermediates& z);

}  // namespace alembert
