// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// T, V, E, the power and the generalized energy as roots of a program.
///
/// Where the scene's speeds are in the state, T = ½ uᵀM u if that is shorter and the same: the same value at
/// random points modulo a prime (program/modular.hpp). Then E is also the generalized energy if these two agree.

#include "formalism/equations.hpp"
#include "lower/lowering.hpp"
#include "model/energy.hpp"

namespace alembert {

/// `mass`: the lower triangle of M, perhaps with more behind it; empty where T is not to be made of it.
void add_energy_roots(Lowering& lowering, Program& program, const Mechanism& mechanism, const Equations& equations,
                      const Energy& energy, const std::vector<int>& mass);

}  // namespace alembert
