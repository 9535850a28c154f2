// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The Jacobian of the right-hand side, ∂(q', u')/∂(q, u), as further roots of the same program.
///
///     const std::optional<Differentiated> d = differentiated(program, {.parameters = true});
///     d->program.nodes_of(Group::jacobian);            // (n + s)², row by row, zeros included
///
/// u' solves K x = b with x = (u', −λ), K = [M Aᵀ; A 0], b = (f, γ). Its derivative by y need not go through the
/// factorization: with R(y, x) = b − K x and x held,
///
///     K ∂x/∂y = ∂R/∂y |_x,
///
/// solved with the factors of K that the right-hand side has anyway. ∂R/∂y comes from partials.hpp. In M u' each
/// entry of M is differentiated; the same vector is ∂(∂T/∂u)/∂u · u', of as many operations as T, where numbers at
/// random states say that it is the same. Of these two, in several orders of elimination, and of the derivative
/// straight through the solved accelerations the one with the fewest operations is taken.
///
/// Where the right-hand side has a kink, the entries are those of the side on which the state lies; on the kink
/// itself abs, min and max have the mean of both sides (0 for abs, 1/2 for each argument of min and max), sign has
/// 0, and sqrt at 0 infinity.
///
/// Groups of roots: Group::jacobian, (n + s) × (n + s); with `parameters` Group::parameter_jacobian, (n + s) × p,
/// by the parameters that a caller sets, as they stand before `prepare`; with `power` Group::power_gradient, n +
/// s: of dE/dt as a function of the state.

#include <optional>
#include <string>

#include "program/program.hpp"

namespace alembert {

struct DerivativeWishes {
    bool parameters = false, power = false;
    long budget = 400000;  ///< products of labels, of which each order of elimination has as many
};

struct Differentiated {
    Program program;
    Operations operations;  ///< of the Jacobian by the state, with what it needs of the right-hand side
    std::string route;      ///< "implicit, least fill" and so on: which was the shortest
};

/// Nothing where the program is singular or has no M, or where its derivatives would be larger than the budget.
std::optional<Differentiated> differentiated(const Program& program, const DerivativeWishes& wishes = {});

}  // namespace alembert
