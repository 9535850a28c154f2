// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Whether a motion can begin: it needs accelerations at its first state.
///
///     need_accelerations(derived, program, first);

#include "derive/derived.hpp"
#include "program/program.hpp"

namespace alembert {

/// Throws IntegrationError if the mass matrix is singular at every state, or if it does not determine the
/// accelerations at `first`; the message says what has no mass, or which constraints contradict each other.
void need_accelerations(const Derived& derived, const Program& program, State<double> first);

}  // namespace alembert
