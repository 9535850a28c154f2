// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The equations of a functional mock-up unit, with the numbers at which it starts.
///
///     const UnitModel model = unit_model(read_scene("scenes/textbook/cart_pole.toml"), "");
///     model.program;                     // for emit, with its tangent
///     // Its last parameters are those of inputs, then signs.
///
/// Functions with kinks (abs, sign, min, max) have a sign that is held between events, as in program/switches.hpp.
/// Events whose impulses change the rates have these as roots of Group::event_impulse.

#include <optional>

#include "alembert/ode/input_time_scale.hpp"
#include "analysis/derive/derived.hpp"
#include "program/interpret.hpp"
#include "program/motion_system.hpp"
#include "program/named_function.hpp"
#include "simulate/fmu/clocks.hpp"
#include "simulate/fmu/free_inputs.hpp"

namespace alembert {

struct UnitModel : Derived {
    std::vector<FreeInput> inputs = {};
    std::string input_time = {};  ///< as in FreeInputs
    Program program = {};
    int contacts = 0;  ///< parameters that hold the force of a contact, before the signs
    std::vector<std::string> contact_forces = {};  ///< their names
    bool moves_contacts = false;                   ///< whether a gap depends on time too
    NamedFunction contact_function = {};           ///< contacts_at, whose nodes are in the program
    /// What events set: sets_at, whose nodes are in the program, and for each value the event and the component of
    /// the state.
    NamedFunction set_function = {};
    std::vector<std::pair<int, int>> setters = {};
    std::vector<bool> of_modes = {};   ///< for each event of the scene, whether only events change its value
    std::vector<bool> of_forces = {};  ///< and whether it looks at forces of constraints, which jump
    /// The masses and moments of bodies: inertias_at, with the numbers of masses_and_moments.
    NamedFunction inertia_function = {};
    int signs = 0;  ///< parameters that hold a sign, the last of the program
    std::vector<TimedZero> clocks = {};
    State<double> start = {};  ///< q, u, t, all parameters, and the direction of the tangent as unknowns
    /// q, u as the scene has them, before the constraints have moved guesses; and which of them are guesses.
    std::vector<double> given = {};
    std::vector<bool> is_guess = {};
    std::vector<bool> tied =
        {};  ///< of the first parameters, those that keep their values (analysis/state/left_out.hpp)
    double duration = 0, tolerance = 0, sample = 0;
    /// Until the end of the duration, for these values of the parameters; and which of the scene's own they
    /// follow.
    std::vector<InputTimeScale> quick_times = {};
    std::vector<bool> times_follow = {};

    std::size_t coordinates() const { return program.coordinates.size(); }
    /// Whether events make rates jump.
    bool has_jumps() const;
    std::size_t speeds() const { return speeds_of(program); }
    /// The place of a parameter in the program. The name must be one.
    std::size_t parameter(const std::string& name) const;
    /// Parameters of the scene itself, which come first.
    std::size_t own_parameters() const {
        return inputs.empty() ? program.parameters.size() - static_cast<std::size_t>(contacts + signs)
                              : parameter(inputs[0].is_set);
    }
};

/// Throws what `derived` throws; ModelError for what a unit cannot follow: dry friction, and contacts and impulses
/// of events where the equations are in generalized speeds or have no mass matrix; IntegrationError or ModelError
/// if the initial state cannot be made to obey the constraints.
UnitModel unit_model(Scene scene, const std::string& by);

}  // namespace alembert
