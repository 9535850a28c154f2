// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Decides whether a scene can run in a time of its own (lib/alembert/ode/time_transformation.hpp), and in which
/// form.
///
///     options.regularization = regularization_of(wishes, derived, energy, choice, start);
///
/// The canonical form is for the systems of verlet and kahanli8 (separable.hpp), whose forces then come from V
/// alone, because energy is conserved; all others get the rescaled one.

#include "alembert/ode/integrate.hpp"
#include "analysis/derive/derived.hpp"
#include "model/energy.hpp"
#include "simulate/method.hpp"
#include "simulate/options.hpp"

namespace alembert {

/// Whether a regularized run was asked for, by the options or by the scene.
bool asks_regularization(const RunOptions& wishes, const Mechanism& mechanism);

/// Regularization::none if it was not asked for. Throws ModelError where it does not apply: constraints, contacts,
/// friction, impulses, an energy that is not conserved, a longest step, or a method that needs more than the
/// right-hand side.
Regularization regularization_of(const RunOptions& wishes, const Derived& derived, const Energy& energy,
                                 const MethodChoice& choice, const Start& start);

/// Throws ModelError if V is not negative at the start, or if `rhs` does not know V because it holds signs.
void need_depth(const Rhs& rhs, double t, const std::vector<double>& initial);

}  // namespace alembert
