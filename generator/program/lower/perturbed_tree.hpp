// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How the accelerations of a tree of joints change with the state and the parameters, as equations that are short
/// to differentiate.
///
///     differentiated(program, {.perturbed = perturbed_tree(program, mechanism, equations, false)});
///
/// The derivative of M⁻¹ (Q − n) need not pass through the recursion of articulated inertias: at the accelerations
/// A that the motion has, the change of the wrench F that link j and the links on it need is linear,
///
///     δF = Iᴬ δA + δp,    s·δF = δQ,
///
/// with the articulated inertia Iᴬ of the right-hand side (Carpentier & Mansard, Analytical derivatives of rigid
/// body dynamics algorithms (2018), write the same as −M⁻¹ times the derivatives of inverse dynamics). With the
/// change δβ of the acceleration at fixed accelerations of the parent and of the joint,
///
///     δp_i = δ(wrench of body i at fixed A) + Σ_j δT F_j + T (δp_j + (Iᴬ − U Uᵀ/D) δβ_j + U/D (δQ_j − s·δp_j)),
///     δw' = (δQ − s·δp)/D − U/D·(T δA_i + δβ).
///
/// Everything here that is not a change is a held value. Vertices are eliminated link by link from the tips, so
/// that a branch is known by what it exchanges with its parent.

#include "model/formalism/equations.hpp"
#include "model/formalism/link_axes.hpp"
#include "program/perturbed.hpp"

namespace alembert {

/// The equations along each kind of axes. None unless the scene is a tree without constraints but those of its
/// quaternions, whose joints' rates determine those of the coordinates. The arguments are those with which
/// `program` was lowered.
std::vector<Perturbed> perturbed_tree(const Program& program, const Mechanism& mechanism,
                                      const Equations& equations, bool fold);

}  // namespace alembert
