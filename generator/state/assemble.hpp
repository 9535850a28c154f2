// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// An initial state that obeys the constraints: guesses are moved, everything else is checked.
///
///     Start start = start_of(mechanism);
///     const std::vector<std::string> moved = assemble(start, mechanism, lower_constraints(mechanism), {});

#include <string>
#include <vector>

#include "lower/start.hpp"
#include "program/program.hpp"

namespace alembert {

/// Moves the coordinates that are guesses until all holonomic constraints hold, by Gauss-Newton steps of least
/// change, then the guessed rates until all rates obey them (where the scene gives speeds, all rates until these
/// hold too); gives a line for each value that moved. Names in `held` stay. Rates that need not obey the
/// constraints, because an impact is about to impose them, are left as they are where the guessed ones cannot
/// reach them, or follow from the speeds alone. The program is lower_constraints(mechanism). Throws
/// IntegrationError if guesses do not converge or the speeds lose rank at the start, ModelError if a constraint is
/// broken by more than 1e-9 of the sum of the sizes of its terms (and, where something moves, by more than
/// rounding) and nothing may move, or if the initial speeds cannot be had.
std::vector<std::string> assemble(Start& start, const Mechanism& mechanism, const Program& program,
                                  const Overrides& held, bool rates_must_obey = true);

/// Sum of the sizes of the terms of a node: what its value is to be measured by.
double size_of_terms(const Program& program, int node, const std::vector<double>& value);

}  // namespace alembert
