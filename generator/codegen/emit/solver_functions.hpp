// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The functions of a solver (lib/alembert/native/abi.hpp): the values that each computes, and the titles of its
/// sections.

#include "codegen/emit/function.hpp"
#include "program/named_function.hpp"

namespace alembert {

/// rate = (q', u'): kinematics, M, f, constraints, solution.
FunctionTask right_hand_side(const Program& program, const Vocabulary& words);
FunctionTask mass_forcing(const Program& program);
FunctionTask energy(const Program& program);
FunctionTask outputs_at(const Program& program);
FunctionTask events_at(const Program& program);
FunctionTask constraints_at(const Program& program);
/// The number of rows that constraints_at gives, and of multipliers: the constraints that the equations keep, then
/// those that follow from them.
std::size_t constraints_of(const Program& program);
FunctionTask multipliers_at(const Program& program);
/// One step of the projection to the constraints; it has no results if there is no such step.
FunctionTask project(const Program& program);
FunctionTask gamma_at(const Program& program);
/// Whether the solver has the table of the projection: there are constraints, and the program moves states to them
/// if any of them needs that.
bool has_projection(const Program& program);
/// The impulses of events; without results if no event of the program has one.
FunctionTask impulses_at(const Program& program);

/// A function of its own, out = its values.
FunctionTask named_function(const Program& program, const NamedFunction& function);

/// The entries of a Jacobian that are not zero.
struct SparseTask {
    FunctionTask task;
    std::vector<int> rows, columns;
};
SparseTask jacobian(const Program& program);
SparseTask parameter_jacobian(const Program& program);

/// The change of both Jacobians' entries along a direction, which these nodes are.
FunctionTask jacobian_tangent(const std::vector<int>& nodes);

/// The derivatives along a direction; without results unless the program has them (program/tangent.hpp).
FunctionTask tangent(const Program& program);

}  // namespace alembert
