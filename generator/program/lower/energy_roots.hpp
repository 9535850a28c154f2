// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Adds T, V, E, the power and the generalized energy as roots of a program.
///
/// If the scene's speeds are in the state, T = ½ uᵀM u is used if it is shorter and has the same value at random
/// points modulo a prime (program/modular.hpp). If E and the generalized energy then agree, they become the same
/// root.

#include "model/energy.hpp"
#include "model/formalism/equations.hpp"
#include "program/lower/lowering.hpp"

namespace alembert {

/// `mass`: the lower triangle of M, perhaps followed by other nodes; empty if T is not to be computed from it.
void add_energy_roots(Lowering& lowering, Program& program, const Mechanism& mechanism, const Equations& equations,
                      const Energy& energy, const std::vector<int>& mass);

}  // namespace alembert
