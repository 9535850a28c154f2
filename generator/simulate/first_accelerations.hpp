// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Whether a motion can begin: it needs accelerations at its first state.
///
///     need_accelerations(derived, program, first);

#include "analysis/derive/derived.hpp"
#include "program/program.hpp"

namespace alembert {

/// Whether the motion may begin in a singular pose of its linkage, as runs that pass such poses do (project.hpp).
enum class FirstPose { must_be_regular, may_be_singular };

/// Throws IntegrationError if the mass matrix is singular at every state, or if it does not determine the
/// accelerations at `first`; the message says what has no mass, or which constraints contradict each other. Where
/// singular poses are passed, it has to determine them beside the pose, along the rates.
void need_accelerations(const Derived& derived, const Program& program, State<double> first,
                        FirstPose pose = FirstPose::must_be_regular);

}  // namespace alembert
