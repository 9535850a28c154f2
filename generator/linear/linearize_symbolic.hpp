// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The matrices of `linearize` in the parameters, where they are short.
///
///     const auto near = symbolic_matrices(mechanism, equations, q0, u0);
///     near->K(0, 0);      // (m1 + m2)·g·l1
///
/// With R = M(q,t) q'' − f(q,q',t) near q = q0, q' = u0 (steady: q'' = 0),
///     M = M(q0),   D = −∂f/∂q' = C + G,   P = −∂f/∂q = K + N,
/// C and K symmetric, G and N skew. Of independent coordinates in their rates alone; q0 and u0 in parameters.

#include <optional>

#include "formalism/equations.hpp"

namespace alembert {

struct SymbolicMatrices {
    GiNaC::matrix M, C, G, K, N;
};

/// Nothing where there are constraints or other speeds, more than four coordinates, or an element of more than
/// twelve terms, nor where a function such as abs or sqrt is at 0, of which GiNaC has no derivative there (the
/// numbers of linearize.hpp may exist).
std::optional<SymbolicMatrices> symbolic_matrices(const Mechanism& mechanism, const Equations& equations,
                                                  const std::vector<GiNaC::ex>& q0,
                                                  const std::vector<GiNaC::ex>& u0);

}  // namespace alembert
