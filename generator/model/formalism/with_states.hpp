// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equations with the first-order states of the scene as further speeds: the state of a motion is then (q, u,
/// z).
///
///     const Equations all = with_states(equations, mechanism);
///     all.u;    // θ', z: M has a 1 on its diagonal for z, and f the rate z'
///
/// Programs of a scene with states are made from these. No coordinate has z for its rate, so that these speeds are
/// not the rates, and q' = h(q, u, t) has roots of its own.

#include "model/formalism/equations.hpp"

namespace alembert {

/// The same equations if the scene has no states, or they are among the speeds already.
Equations with_states(const Equations& equations, const Mechanism& mechanism);

/// Whether the states are among the speeds.
bool has_states(const Equations& equations, const Mechanism& mechanism);

/// Where the states begin among this many speeds, or components of a state: they are the last of them.
///
///     u[first_state(u.size(), mechanism) + k]      // state k
inline std::size_t first_state(std::size_t speeds, const Mechanism& mechanism) {
    return speeds - mechanism.states.size();
}

/// The value with what the scene gives for z' and z'' in their place.
GiNaC::ex without_state_rates(const GiNaC::ex& value, const Mechanism& mechanism);

}  // namespace alembert
