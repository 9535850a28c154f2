// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Functions for CasADi beside an emitted C file: the interface of its external functions, which it finds by their
/// names (CasADi's user guide, "Using external functions"; casadi/core/external.cpp).
///
///     const SourceFile file = casadi_functions(program, {.language = CodeLanguage::c});
///     file.name;            // "crane_casadi.c"
///
/// casadi_crane_rhs maps (t, x, p) to the rate of the state x, casadi_crane_NAME the same and q'' to a function
/// for robots. Matrices are dense, column by column. If the program has been differentiated, fwd1_casadi_crane_rhs
/// and adj1_casadi_crane_rhs give directional derivatives and their adjoints: exact by state and parameters, by t
/// a difference of order 4; fwd1_adj1_casadi_crane_rhs those of the adjoint, of which Hessians are made.
/// Otherwise, and for robot functions, CasADi takes differences (its option `enable_fd`). The template is
/// templates/casadi.c.mustache.

#include "codegen/emit/emit.hpp"

namespace alembert {

/// The derivatives of both Jacobians along a direction, as further nodes of the program, for
/// EmitOptions::jacobian_tangent.
std::vector<int> casadi_second_derivatives(Program& program);

/// Throws ModelError for C++.
SourceFile casadi_functions(const Program& program, const EmitOptions& options);

}  // namespace alembert
