// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Rates that no inertia resists. Their equations contain no acceleration: they say that the forces along these
/// rates are in balance.
///
///     T = ½ m x'²,  V = ½ k (x − y)²:    along y' there is no inertia, and k (x − y) = 0
///
///     for (const Unresisted& u : unresisted_rates(mechanism, equations))
///         u.direction, u.balance;                      // (0, 1), k x − k y
///     const Balanced bound = with_force_balances(mechanism, formalism);
///     bound.mechanism, bound.equations;
///
/// A vector N(q) with M N = 0 and A N = 0 gives N·f = 0: a differential-algebraic system whose index falls when
/// N·f = 0 counts as a constraint; its multiplier is zero on every motion (Hairer & Wanner, Solving Ordinary
/// Differential Equations II (1996), §VII.1).

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/formalism/equations.hpp"
#include "scene/scene.hpp"

namespace alembert {

struct Unresisted {
    std::vector<GiNaC::ex> direction;  ///< one entry for each speed of the equations, without intermediate symbols
    GiNaC::ex balance;                 ///< the force along it, likewise
    bool is_balanced = false;          ///< whether the force is zero identically; the rate may then be anything
};

/// Empty if there are none, or if the equations have no matrix. What there is at special states alone, such as the
/// poses in which a linkage lies flat, does not count.
std::vector<Unresisted> unresisted_rates(const Mechanism& mechanism, const Equations& equations);

/// A warning for each, with the place of a coordinate in it.
std::vector<Diagnostic> warnings_of_unresisted(const Scene& scene, const Mechanism& mechanism,
                                               const Equations& equations);

/// A mechanism and its equations.
struct Balanced {
    Mechanism mechanism;
    Equations equations;
};

/// The mechanism with the balances as constraints as far as they are functions of the state linear in the rates;
/// their names are no identifiers, so that no claim can speak of their multipliers. `known`: its equations by the
/// formalism, where they are known already.
Balanced with_force_balances(Mechanism mechanism, const std::function<Equations(const Mechanism&)>& formalism,
                             std::optional<Equations> known = {});

}  // namespace alembert
