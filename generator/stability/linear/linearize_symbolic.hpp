// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The matrices of `linearize` in the parameters, if they are short.
///
///     const auto near = symbolic_matrices(mechanism, equations, q0, u0);
///     near->K(0, 0);      // (m1 + m2)·g·l1
///
/// With R = M(q,t) q'' − f(q,q',t) near q = q0, q' = u0 (steady: q'' = 0),
///     M = M(q0),   D = −∂f/∂q' = C + G,   P = −∂f/∂q = K + N,
/// where C and K are symmetric, G and N skew. Only for independent coordinates whose rates are the speeds; q0 and
/// u0 are in parameters.

#include <optional>

#include "model/formalism/equations.hpp"

namespace alembert {

struct SymbolicMatrices {
    GiNaC::matrix M, C, G, K, N;
    bool stays = false;  ///< f(q0, u0) = 0 is proved for all values of the parameters: the motion stays steady
};

/// Nothing if there are constraints or other speeds, more than four coordinates, or an element with more than
/// twelve terms, or if a function such as abs or sqrt is at 0, where GiNaC has no derivative of it (the numbers of
/// linearize.hpp may exist).
std::optional<SymbolicMatrices> symbolic_matrices(const Mechanism& mechanism, const Equations& equations,
                                                  const std::vector<GiNaC::ex>& q0,
                                                  const std::vector<GiNaC::ex>& u0);

/// S2 s² + S1 s + S0, whose determinant is the characteristic polynomial, in the parameters. With constraints they
/// have a row for each, φ_q δq = 0 or (A s + ∂ν/∂q) δq = 0 of ν = A q' + b, and a column for each multiplier; P
/// has the change of the reactions Aᵀ λ too.
struct SymbolicPencil {
    GiNaC::matrix S2, S1, S0;
    bool stays = false;  ///< proved for all values of the parameters: forces and reactions are in balance, and the
                         ///< constraints hold
};

/// As `symbolic_matrices`, with constraints or first-order states too, which are z0 there; nothing with unilateral
/// ones, or if more than eight rows come of them.
std::optional<SymbolicPencil> symbolic_pencil(const Mechanism& mechanism, const Equations& equations,
                                              const std::vector<GiNaC::ex>& q0, const std::vector<GiNaC::ex>& u0,
                                              const std::vector<GiNaC::ex>& z0);

}  // namespace alembert
