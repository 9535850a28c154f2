// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which method integrates a scene, and why.
///
///     const MethodChoice choice = method_for(request, derived, start);
///     choice.why;      // "the tolerance is 1e-09; if the system turns out stiff, radau goes on"
///
/// `auto` looks at the structure (is the energy separable?), the length of the run in steps, and the tolerance:
///
/// | asked for | chosen |
/// | --- | --- |
/// | a step, energy separable, 10 000 steps or more | kahanli8: its energy does not drift |
/// | a step | rk4 |
/// | a tolerance above 1e-5 | dopri5 |
/// | 1e-12 and above | dop853 |
/// | below | verner98 |
///
/// and the adaptive ones watch for stiffness while they run (stiffness.hpp), and give way to radau.

#include "alembert/integrate.hpp"
#include "commands/pipeline.hpp"

namespace alembert {

struct MethodChoice {
    Method method = Method::dop853;
    std::optional<Method> when_stiff = {};
    std::string why = {};  ///< empty where the method was given
};

/// Throws ModelError for a name that is none, and for a method that the scene does not allow.
MethodChoice method_for(const Request& request, const Derived& derived, const Start& start);

/// Why verlet and kahanli8 cannot be taken; nothing where they can. They take for granted that q' = u, and M and u' = M⁻¹f in which no
/// rate (and, for M, no coordinate) occurs. What occurs only to cancel counts as there.
std::optional<std::string> not_separable(const Derived& derived);

}  // namespace alembert
