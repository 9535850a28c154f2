// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Dry friction and other signs at one state, without a compiler. A contact that sticks gets the force that keeps
/// it sticking.
///
///     const ConsistentMode held = consistent_mode(*switched(program), state);
///     interpret(held.program, held.state);

#include <optional>
#include <string>

#include "program/interpret.hpp"
#include "program/switches.hpp"

namespace alembert {

struct ConsistentMode {
    Program program;      ///< with constant signs
    State<double> state;  ///< the signs are its last parameters
    /// For each friction of the program the sign of its sliding velocity, 0 if it sticks.
    std::vector<std::pair<std::string, int>> frictions;
};

/// Throws IntegrationError if no mode is consistent, or more than one is.
ConsistentMode consistent_mode(const Switched& s, State<double> state);

/// The same for signs without friction: where functions are zero exactly, their signs are those with which the
/// motion goes on from there. Nothing if none is zero, or if the equations do not say how it goes on.
std::optional<ConsistentMode> standing_state(const Switched& s, State<double> state);

/// Says which friction makes its own normal force grow without bound at the state before which a motion ended, if
/// one does: there 1 − S D (program/lower/normal_forces.hpp) comes to zero.
std::optional<std::string> jamming_friction(const Switched& s, const State<double>& state);

/// The scene's parameters, followed by those that `program` has for friction in planes (model/friction.hpp) at
/// their values there.
std::vector<double> with_held_parameters(std::vector<double> of_scene, const Program& program);

}  // namespace alembert
