// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Makes an initial state that obeys the constraints: guesses are adjusted, everything else is checked.
///
///     Start start = start_of(mechanism);
///     const std::vector<std::string> moved = assemble(start, mechanism, lower_constraints(mechanism), {});

#include <optional>
#include <string>
#include <vector>

#include "alembert/base/error.hpp"
#include "analysis/state/left_out.hpp"
#include "program/lower/start.hpp"
#include "program/program.hpp"

namespace alembert {

/// What `assemble` throws for a constraint that the given values break.
struct BrokenConstraint : ModelError {
    BrokenConstraint(const std::string& text, Place at) : ModelError(text), place(at) {}
    Place place;  ///< of the constraint
};

/// "b from -38 to -37.66 deg": a coordinate or rate that moved, in the unit of the tables that people see beside
/// it.
std::string moved_in_own_unit(const Mechanism& mechanism, const std::string& name, double from, double to);

/// Moves the coordinates that are guesses until all holonomic constraints hold, by Gauss-Newton steps of least
/// change, then the guessed rates until all rates obey them (if the scene gives speeds, all rates until these hold
/// too). Returns a line for each value that moved. Values with names in `held` are not changed. If an impact is
/// about to impose the constraints, rates need not obey them: they are then left as they are if the guessed ones
/// cannot reach the constraints, or follow from the speeds only. The program is lower_constraints(mechanism).
/// Throws IntegrationError if guesses do not converge or the speeds lose rank at the start, BrokenConstraint if a
/// constraint is broken by more than 1e-9 of the sum of the sizes of its terms (and, where something moves, by
/// more than rounding) and nothing may move, ModelError if the initial speeds are impossible, or if a constraint
/// that was left out does not hold with these values (left_out.hpp). Throws IntegrationError for a state in which
/// a joint that closes a loop is turned, though its rows hold.
std::vector<std::string> assemble(Start& start, const Mechanism& mechanism, const Program& program,
                                  const Overrides& held, bool rates_must_obey = true);

/// The same for many starts of one mechanism, with its LeftOut(mechanism).
std::vector<std::string> assemble(Start& start, const Mechanism& mechanism, const Program& program,
                                  const Overrides& held, const LeftOut& left_out, bool rates_must_obey = true);

/// What is told of a joint that closes a loop where the state obeys its rows turned by half a turn or a third of
/// one (Mechanism::Alignment); nothing if there is none. The program is lower_constraints(mechanism).
std::optional<std::string> turned_joint(const Mechanism& mechanism, const Program& program,
                                        const State<double>& state);

/// A state that obeys the constraints: the initial one with its guesses adjusted, and then, because that may be a
/// singular pose, a little further on along its rates. Where the given values break the constraints (a contact
/// that closes later), all others move too. If no state is found that obeys them, the initial values as they
/// stand.
Start admissible_start(const Mechanism& mechanism);

/// The sum of the sizes of the terms of a node as they are after what is within them has cancelled; constraints
/// are judged by those before (program/rounding.hpp).
double size_of_terms(const Program& program, int node, const std::vector<double>& value);

}  // namespace alembert
