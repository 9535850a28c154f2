// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Inverse dynamics: the loads τ along the coordinates that accelerations need, M q'' = f + Aᵀλ + τ.
///
///     const Program program = lower_inverse(mechanism);
///     program.nodes_of(Group::load);        // M q'' − f, one for each coordinate, in q, q', q'', t
///
/// Groups of roots: "load"; of constraints "row" (A, n each) and "gamma" (A q'' = γ), of those with a multiplier.
/// Along a tree of joints by Newton-Euler outwards and inwards, in a number of operations linear in the bodies
/// (Luh, Walker & Paul, J. Dynamic Systems, Measurement and Control 102 (1980) 69); of what is no such tree by M
/// and f of Lagrange's equations. In rates, whatever [speeds] the scene has. Contacts are open.

#include <optional>

#include "model/mechanism.hpp"
#include "program/program.hpp"

namespace alembert {

Program lower_inverse(const Mechanism& mechanism);

/// The "load" nodes alone, in a program of one's own; `given` as for lower_expressions.
std::vector<int> inverse_loads(Program& program, const Mechanism& mechanism,
                               const std::vector<std::pair<GiNaC::symbol, int>>& given = {});

}  // namespace alembert
