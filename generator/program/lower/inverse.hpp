// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Inverse dynamics: the loads τ along the coordinates that accelerations need, M q'' = f + Aᵀλ + τ.
///
///     const Program program = lower_inverse(mechanism);
///     program.nodes_of(Group::load);        // M q'' − f, one for each coordinate, in q, q', q'', t
///
/// The groups of roots are "load" and, for constraints with a multiplier, "row" (A, n each) and "gamma" (A q'' =
/// γ). For a tree of joints the loads follow from the recursive Newton-Euler algorithm, with a number of
/// operations linear in the number of bodies (Luh, Walker & Paul, J. Dynamic Systems, Measurement and Control 102
/// (1980) 69); for other systems from M and f of Lagrange's equations. The speeds are the rates, whatever [speeds]
/// the scene has. Contacts are open.

#include <optional>

#include "model/mechanism.hpp"
#include "program/program.hpp"

namespace alembert {

Program lower_inverse(const Mechanism& mechanism);

/// The "load" nodes only, in the caller's program; `given` is as for lower_expressions.
std::vector<int> inverse_loads(Program& program, const Mechanism& mechanism,
                               const std::vector<std::pair<GiNaC::symbol, int>>& given = {});

}  // namespace alembert
