// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The variables of a functional mock-up unit, in the order of their value references.
///
///     const std::vector<UnitVariable> list = unit_variables(model);
///     list[1].name;                                   // "theta1"; list[0] is time
///
/// Names follow the structured convention of FMI: `theta1`, `der(theta1)`, `der(theta1,2)`, `energy.kinetic`.

#include <optional>
#include <string>
#include <vector>

#include "scene/units.hpp"
#include "simulate/fmu/unit_model.hpp"

namespace alembert {

struct UnitVariable {
    /// What the C of the unit makes of it (templates/fmu_model.c.mustache).
    enum class Kind { time, state, rate, input, parameter, tied_parameter, energy, output, multiplier, event };
    Kind kind = Kind::output;
    int place = 0;  ///< within its kind; of an input 3 times its number plus the order of the derivative
    std::string name = {}, about = {}, unit = {};
    UnitOfName shown = {};             ///< in which tools show it; a size of 1 where that is `unit`
    std::optional<double> start = {};  ///< of states, inputs and parameters
    bool is_output = false;            ///< whether it can be connected: states, outputs and energies
    bool jumps = false;                ///< for a state, whether an event may change it
    int derivative_of = -1;            ///< the variable whose rate this is
    /// The variables on which a state's rate or an output depends: time, states, inputs and parameters, ascending.
    std::vector<int> dependencies = {};

    bool is_parameter() const { return kind == Kind::parameter || kind == Kind::tied_parameter; }
    bool is_state() const { return kind == Kind::state; }
    /// Whether it is computed from others already at the start.
    bool is_calculated() const { return !start && kind != Kind::time; }
};

std::vector<UnitVariable> unit_variables(const UnitModel& model);

/// The variables that are the rates of the states, in the order of these.
std::vector<int> state_rates(const std::vector<UnitVariable>& variables);

}  // namespace alembert
