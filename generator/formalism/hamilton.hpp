// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Hamilton's canonical equations.
///
///     const Canonical c = canonical(mechanism);      // c.H in q, p_<coordinate> and t
///     const Equations equations = hamilton(mechanism);
///
/// `hamilton` eliminates the momenta again by p = ∂L/∂q', so that the result compares with the other formalisms.

#include "formalism/equations.hpp"

namespace alembert {

struct Canonical {
    std::vector<GiNaC::symbol> p;     ///< p_<coordinate>
    std::vector<GiNaC::ex> momenta;   ///< ∂L/∂q' in q, q', t
    GiNaC::matrix M;                  ///< ∂p/∂q'
    GiNaC::ex H;
    std::vector<GiNaC::ex> qdot, pdot;  ///< ∂H/∂p, −∂H/∂q + Q in q, p, t
    std::vector<GiNaC::ex> force;     ///< −∂H/∂q alone
};

/// Throws ModelError for constraints, and where L is not of second degree in the rates or its matrix is singular.
Canonical canonical(const Mechanism& mechanism);
Equations hamilton(const Mechanism& mechanism);

/// X with M X = right, by symbolic elimination on a symmetric M; throws ModelError if a pivot is zero.
std::vector<GiNaC::ex> solve_named(const GiNaC::matrix& M, std::vector<GiNaC::ex> right, const Mechanism& mechanism);

}  // namespace alembert
