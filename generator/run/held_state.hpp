// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Dry friction at one state, without a compiler: what sticks has the force that keeps it so.
///
///     const HeldState held = held_state(*switched(program), state);
///     interpret(held.program, held.state);

#include "program/interpret.hpp"
#include "program/switches.hpp"

namespace alembert {

struct HeldState {
    Program program;      ///< with held signs
    State<double> state;  ///< the signs are its last parameters
    /// Of each friction of the program: the sign of its sliding velocity, 0 where it sticks.
    std::vector<std::pair<std::string, int>> frictions;
};

/// Throws IntegrationError where no mode is consistent, or more than one is.
HeldState held_state(const Switched& s, State<double> state);

}  // namespace alembert
