// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The loads that hold coordinates at zero while the others move.
///
///     const std::vector<int> loads = held_loads(program, mechanism, first);   // along q[first], q[first + 1] …
///
/// They follow from the general equation of dynamics for displacements along the held coordinates c only,
///     R = Σ m a·∂v/∂c' + (I α + ω × I ω)·∂ω/∂c' + ∂V/∂c − Q,
/// where everything is taken at c = c' = c'' = 0 (Zhang & Qin (1-44); Schiehlen, Technische Dynamik (1986), §4.2).
/// Velocities and accelerations are those of the moving mechanism, and one backward sweep through the velocities
/// gives all partial derivatives. The number of operations is linear in the number of bodies, and no mass matrix
/// is computed.

#include "model/mechanism.hpp"
#include "program/program.hpp"

namespace alembert {

/// The loads as functions of the other coordinates' q, q', q''; the shares of multipliers are left out. `given` is
/// as for lower_expressions and must contain the zeros of the held coordinates. Requires
/// masses_are_known(mechanism).
std::vector<int> held_loads(Program& program, const Mechanism& mechanism, int first,
                            const std::vector<std::pair<GiNaC::symbol, int>>& given);

}  // namespace alembert
