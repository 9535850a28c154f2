// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The loads that hold coordinates at zero, whatever the others do: inverse dynamics of what does not move.
///
///     const std::vector<int> loads = held_loads(program, mechanism, first);   // along q[first], q[first + 1] …
///
/// The general equation of dynamics for the displacements along the held coordinates c alone,
///     R = Σ m a·∂v/∂c' + (I α + ω × I ω)·∂ω/∂c' + ∂V/∂c − Q,
/// everything taken at c = c' = c'' = 0 (Zhang & Qin (1-44); Schiehlen, Technische Dynamik (1986), §4.2).
/// Velocities and accelerations are those of the mechanism that moves, and one sweep backwards through the
/// velocities gives all partial derivatives: the number of operations is linear in the bodies, and no mass matrix
/// is made.

#include "model/mechanism.hpp"
#include "program/program.hpp"

namespace alembert {

/// In the other coordinates' q, q', q''; multipliers' shares are left out. `given` as for lower_expressions, the
/// zeros of what is held among it. Needs masses_are_known(mechanism).
std::vector<int> held_loads(Program& program, const Mechanism& mechanism, int first,
                            const std::vector<std::pair<GiNaC::symbol, int>>& given);

}  // namespace alembert
