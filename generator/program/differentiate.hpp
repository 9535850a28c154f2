// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The Jacobian of the right-hand side, ∂(q', u')/∂(q, u), as further roots of the same program.
///
///     const std::optional<Differentiated> d = differentiated(program, {.parameters = true});
///     d->program.nodes_of(Group::jacobian);            // (n + s)², row by row, zeros included
///
/// u' solves K x = b with x = (u', −λ), K = [M Aᵀ; A 0], b = (f, γ). Its derivative with respect to y need not
/// pass through the factorization: with R(y, x) = b − K x and x constant,
///
///     K ∂x/∂y = ∂R/∂y |_x,
///
/// which is solved with the factors of K that the right-hand side has anyway. ∂R/∂y comes from partials.hpp. There
/// are four routes. The first differentiates each entry of M in M u'. The second uses that the same vector is
/// ∂(∂T/∂u)/∂u · u', with as many operations as T, if numbers at random states confirm this. The third
/// differentiates the solved accelerations directly. Each is tried with several orders of elimination, and the one
/// with the fewest operations is taken. A fourth route takes the equations that a caller has for it, those of a
/// tree of joints (program/lower/perturbed_tree.hpp); for long programs it is the only one that is tried.
///
/// If the right-hand side has a kink, the entries are those of the side on which the state lies. On the kink
/// itself abs, min and max have the mean of both sides (0 for abs, 1/2 for each argument of min and max), sign has
/// 0, and sqrt at 0 infinity.
///
/// Groups of roots: Group::jacobian, (n + s) × (n + s); with `parameters` Group::parameter_jacobian, (n + s) × p,
/// with respect to the parameters that a caller sets, before `prepare`; with `power` Group::power_gradient, n + s,
/// the gradient of dE/dt as a function of the state, and a further row of Group::parameter_jacobian, its gradient
/// by the parameters; with `values` Group::value_gradient, the derivatives of T, V, E, the power, the outputs and
/// the speeds, in this order, (n + s + s + p) entries each: by the state, by u' and by the parameters. u' depends
/// on state and parameters itself, which the entries by u' leave to the caller.

#include <optional>
#include <string>

#include "program/perturbed.hpp"

namespace alembert {

struct DerivativeWishes {
    bool parameters = false, power = false, values = false;
    long budget = 400000;                   ///< the most products of labels in each order of elimination
    std::vector<Perturbed> perturbed = {};  ///< equations for a route of their own, if there are some
};

struct Differentiated {
    Program program;
    Operations
        operations;  ///< of the Jacobian with respect to the state, including what it needs of the right-hand side
    std::string route;  ///< the shortest route: "implicit, least fill" and so on
};

/// Nothing if the program is singular, if it has neither M nor equations for the fourth route, or if its
/// derivatives would exceed the budget.
std::optional<Differentiated> differentiated(const Program& program, const DerivativeWishes& wishes = {});

}  // namespace alembert
