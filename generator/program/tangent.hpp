// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The derivatives of the right-hand side and of the values along one direction of state and parameters, as
/// further roots of the same program. They take as many operations as a few right-hand sides, where a Jacobian
/// takes some for each column (differentiate.hpp).
///
///     const Program p = with_tangent(program);
///     p.nodes_of(Group::tangent);     // δ(q', u'), then of T, V, E, the power, the outputs and the speeds
///
/// The direction is δ(q, u), then δ of the parameters that a caller sets, as Variable::Kind::unknown from 0 on.
/// With K (u', −λ) = b
///
///     K δ(u', −λ) = δb − δK (u', −λ),
///
/// which is solved with the factors of K that the right-hand side has; or the solved accelerations are
/// differentiated, whichever takes fewer operations. Values that contain u' change with it.

#include "program/program.hpp"

namespace alembert {

/// The program must have accelerations and no unknowns of its own. At a kink the derivatives are those of
/// differentiate.hpp.
Program with_tangent(const Program& program);

/// The derivatives of these nodes along the same direction, as further nodes of the program: of a Jacobian those
/// that a Hessian times a vector needs.
std::vector<int> along_direction(Program& program, const std::vector<int>& nodes);

/// The number of the direction's entries.
std::size_t direction_size(const Program& program);

}  // namespace alembert
