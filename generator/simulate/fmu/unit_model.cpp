// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/fmu/unit_model.hpp"

#include <algorithm>

#include "analysis/contact/contacts.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/inertia_check.hpp"
#include "base/language/say.hpp"
#include "model/event_actions.hpp"
#include "model/formalism/needs.hpp"
#include "model/formalism/with_states.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/quick_times.hpp"
#include "program/switches.hpp"
#include "program/tangent.hpp"
#include "simulate/corners.hpp"
#include "simulate/first_accelerations.hpp"
#include "simulate/fmu/event_bases.hpp"
#include "simulate/narrow_places.hpp"
#include "simulate/sides.hpp"

namespace alembert {

namespace {

void refuse_friction(const Mechanism& m) {
    if (!m.frictions.empty())
        throw ModelError(
            say("a functional mock-up unit follows no dry friction that sticks, because sticking changes the "
                "equations, and this scene has [[friction]]; use 'alembert simulate', or the library, or "
                "friction that is a smooth function of the velocity"));
}

/// Contacts become forces of given sizes, which the C of the unit finds, and their gaps events behind the scene's.
/// Returns the function that tells all of them. Throws ModelError for what such a unit cannot follow.
std::optional<FunctionProgram> free_contacts(UnitModel& model) {
    Mechanism& m = model.mechanism;
    if (m.unilateral.empty()) return std::nullopt;
    need_rates(model);
    if (std::any_of(m.constraints.begin(), m.constraints.end(), [](const auto& c) { return c.tie.has_value(); }))
        throw ModelError(say(
            "a functional mock-up unit follows no contacts where constraints depend on each other at some poses "
            "only; use 'alembert simulate', or the library"));
    for (const Mechanism::Unilateral& contact : m.unilateral) {
        model.contact_forces.push_back(contact.gap.multiplier.get_name());
        model.moves_contacts = model.moves_contacts || !contact.gap.offset.is_zero();
        for (const Mechanism::Definition& event : m.events)
            if (m.z->depends(event.value, {contact.gap.multiplier}))
                throw ModelError(say(
                    "event '{}' looks at the force '{}' of a contact, which a functional mock-up unit does not "
                    "watch; use 'alembert simulate', or the library",
                    event.name, contact.gap.multiplier.get_name()));
    }
    FunctionProgram function = contact_function(m);
    model.contacts = static_cast<int>(m.unilateral.size());
    m = with_contact_forces(with_contacts_watched(std::move(m), {}));
    for (std::size_t k = m.event_actions.size() - model.contact_forces.size(); k < m.event_actions.size(); ++k)
        m.event_actions[k] = {.stop = false, .direction = -1};
    Derived again = derived_again(model, m, model.by.empty() ? formalism_for(Need::multipliers).name : model.by);
    static_cast<Derived&>(model) = std::move(again);
    return function;
}

void need_mass_matrix(const Program& program) {
    if (program.nodes_of(Group::mass).empty())
        throw ModelError(say(
            "contacts and events with impulses can be exported only by a formalism that gives the mass matrix; "
            "name one, as in --by lagrange"));
}

/// Events that set a state on which a contact or constraint depends would open it, or make rates jump by
/// themselves.
void refuse_moved_constraints(const Mechanism& m) {
    for (std::size_t k = 0; k < m.events.size(); ++k) {
        const std::vector<GiNaC::symbol> set = states_set(m, m.event_actions[k]);
        if (set.empty()) continue;
        const auto check = [&](const Mechanism::Constraint& c) {
            const auto depends = [&](const GiNaC::ex& e) { return m.z->depends(e, set); };
            if (!std::any_of(c.row.begin(), c.row.end(), depends) && !depends(c.offset) &&
                !(c.position && depends(*c.position)))
                return;
            throw ModelError(
                say("event '{0}' sets a state that moves constraint '{1}', which a functional mock-up unit does "
                    "not follow; "
                    "use 'alembert simulate', or the library",
                    m.events[k].name, c.name));
        };
        for (const Mechanism::Constraint& c : m.constraints) check(c);
        for (const Mechanism::Unilateral& u : m.unilateral) check(u.gap);
    }
}

/// The nodes of expressions in the scene's coordinates, rates and states, where the program has speeds of its own.
std::vector<int> lowered_in_speeds(Program& program, const UnitModel& model, const std::vector<GiNaC::ex>& list) {
    const Mechanism& m = model.mechanism;
    const Equations e = with_states(model.equations, m);
    std::vector<std::pair<GiNaC::symbol, int>> given;
    for (int k = 0; k < e.size(); ++k) given.emplace_back(e.u[k], program.variable({Variable::Kind::rate, k}));
    const std::vector<int> rates = program.nodes_of(Group::rate);
    for (std::size_t i = 0; i < rates.size(); ++i) given.emplace_back(m.qdot[i], rates[i]);
    return lower_expressions(program, in_terms_of(e, m), list, given);
}

/// Adds what events set, by the states of the scene and the rates.
void add_sets(Program& program, UnitModel& model) {
    const Mechanism& m = model.mechanism;
    const int n = m.size(), first_of_states = n + static_cast<int>(first_state(speeds_of(program), m));
    std::vector<GiNaC::ex> list;
    for (std::size_t k = 0; k < m.events.size(); ++k) {
        const Mechanism::EventAction& action = m.event_actions[k];
        for (const auto& [state, value] : action.set) {
            model.setters.emplace_back(static_cast<int>(k), first_of_states + state);
            list.push_back(value);
        }
        for (const auto& [coordinate, value] : action.rates) {
            model.setters.emplace_back(static_cast<int>(k), n + coordinate);
            list.push_back(value);
        }
    }
    if (list.empty()) return;
    model.set_function = {.name = "sets_at",
                          .about = "What events set, of the state before them.",
                          .rows = static_cast<int>(list.size())};
    for (const int node : lowered_in_speeds(program, model, list))
        program.roots.push_back({Group::function, "", node});
}

/// Adds the masses and moments of bodies.
void add_inertias(Program& program, UnitModel& model) {
    const std::vector<GiNaC::ex> list = masses_and_moments(model.mechanism);
    if (list.empty()) return;
    model.inertia_function = {.name = "inertias_at",
                              .about = "Masses and moments of inertia, none of which may be negative.",
                              .rows = static_cast<int>(list.size())};
    for (const int node : lowered_in_speeds(program, model, list))
        program.roots.push_back({Group::function, "", node});
}

/// Adds n entries for each event that has impulses.
void add_impulses(Program& program, const UnitModel& model) {
    const Mechanism& m = model.mechanism;
    if (!model.has_jumps()) return;
    if (!m.speeds.empty())
        throw ModelError(say(
            "events that give impulses or set rates can be exported only where the speeds are the rates of the "
            "coordinates; leave [speeds] out, or what these events do"));
    need_mass_matrix(program);
    std::vector<GiNaC::ex> list;
    for (const Mechanism::EventAction& action : m.event_actions)
        list.insert(list.end(), action.impulse.begin(), action.impulse.end());
    for (const int node : lower_expressions(program, in_terms_of(model.equations, m), list))
        program.roots.push_back({Group::event_impulse, "", node});
}

/// What the scene gives of the start, before guesses are moved. Where speeds are not rates, they follow from what
/// the scene gives, and none of them is moved alone.
void note_given(UnitModel& model, const Start& start) {
    const Mechanism& m = model.mechanism;
    const State<double> given = state_of(start, m, model.equations);
    model.given = given.q;
    model.given.insert(model.given.end(), given.qdot.begin(), given.qdot.end());
    model.is_guess = m.q_is_guess;
    if (model.equations.speeds_are_rates())
        model.is_guess.insert(model.is_guess.end(), m.qdot_is_guess.begin(), m.qdot_is_guess.end());
    model.is_guess.resize(model.given.size(), false);
}

/// The program with its signs held, its clocks, and its derivatives.
void complete(UnitModel& model, Program program) {
    std::vector<Mechanism::EventAction>& actions = model.mechanism.event_actions;
    const std::vector<Mechanism::EventAction> of_contacts(actions.end() - model.contacts, actions.end());
    actions.resize(actions.size() - of_contacts.size());
    watch_bases(program, actions);
    actions.insert(actions.end(), of_contacts.begin(), of_contacts.end());
    if (const std::optional<Switched> held = switched(program)) {
        model.signs = static_cast<int>(held->frictions.size());
        program = held->program;
    }
    const int signs_begin = static_cast<int>(program.parameters.size()) - model.signs,
              watched = static_cast<int>(model.mechanism.events.size()) + model.signs;
    SetParameters set{signs_begin, signs_begin};
    if (!model.inputs.empty())
        set.first =
            static_cast<int>(std::find_if(program.parameters.begin(), program.parameters.end(),
                                          [&](const Quantity& p) { return p.name == model.inputs[0].is_set; }) -
                             program.parameters.begin());
    model.clocks = add_clocks(program, watched, set);
    model.program = with_tangent(program).canonical();
    const std::vector<int> values = model.program.nodes_of(Group::function);
    const auto inertias = values.end() - model.inertia_function.rows,
               setters = inertias - static_cast<std::ptrdiff_t>(model.setters.size());
    model.contact_function.nodes.assign(values.begin(), setters);
    model.set_function.nodes.assign(setters, inertias);
    model.inertia_function.nodes.assign(inertias, values.end());
}

}  // namespace

bool UnitModel::has_jumps() const {
    return std::any_of(mechanism.event_actions.begin(), mechanism.event_actions.end(),
                       [](const Mechanism::EventAction& a) { return !a.impulse.empty() || !a.rates.empty(); });
}

std::size_t UnitModel::parameter(const std::string& name) const {
    const auto found = std::find_if(program.parameters.begin(), program.parameters.end(),
                                    [&](const Quantity& p) { return p.name == name; });
    return static_cast<std::size_t>(found - program.parameters.begin());
}

UnitModel unit_model(Scene scene, const std::string& by) {
    FreeInputs free = with_free_inputs(std::move(scene));
    UnitModel model{derived(std::move(free.scene), {.by = by, .use = Use::run})};
    model.inputs = std::move(free.inputs);
    model.input_time = free.time;
    refuse_friction(model.mechanism);
    refuse_moved_constraints(model.mechanism);
    model.of_modes = events_of_modes(model.mechanism);
    model.of_forces = events_of_forces(model.mechanism);
    const std::optional<FunctionProgram> contacts = free_contacts(model);
    if (!model.mechanism.impulses.empty())
        model.warn(
            "before_impulses",
            say("{}: the motion starts with the rates before the scene's impulses; 'alembert eval --impact' "
                "gives those after\n",
                model.scene.file));
    for (const Mechanism::EventAction& action : model.mechanism.event_actions)
        if (!action.record.empty()) {
            model.warn("left_out", say("warning: what events record is told by runs; a unit has the outputs "
                                       "instead, and its importer records them\n"));
            break;
        }
    warn_of_corners(model);
    Program program = with_signs_told(model, lowered(model).program);
    Start start = start_of(model.mechanism);
    note_given(model, start);
    assemble(start, model.mechanism, lower_constraints(model.mechanism), {});
    model.start = state_of(start, model.mechanism, model.equations);
    model.tied = tied_parameters(model.mechanism, start);
    need_accelerations(model, program, model.start);
    tell_narrow_places(model, program, Kinks::followed, model.start, start.duration);
    model.quick_times =
        sudden_times(quick_times(program, model.start.parameters, start.t, start.t + start.duration));
    model.times_follow = parameters_of_inputs(program, program.parameters.size());
    add_impulses(program, model);
    if (contacts) {
        need_mass_matrix(program);
        model.contact_function = absorbed(program, *contacts);
    }
    add_sets(program, model);
    add_inertias(program, model);
    complete(model, std::move(program));
    model.start.parameters.resize(model.program.parameters.size(), 1);
    model.start.unknown.resize(direction_size(model.program), 0);
    model.duration = start.duration;
    model.tolerance = start.tolerance;
    model.sample = start.sample;
    return model;
}

}  // namespace alembert
