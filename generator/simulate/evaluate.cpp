// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/evaluate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "alembert/base/tolerances.hpp"
#include "analysis/contact/contacts.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/diagnose.hpp"
#include "base/language/say.hpp"
#include "model/formalism/needs.hpp"
#include "model/formalism/with_states.hpp"
#include "model/friction.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/robot_functions.hpp"
#include "program/without_rounding.hpp"
#include "scene/text.hpp"
#include "simulate/consistent_mode.hpp"
#include "simulate/sides.hpp"

namespace alembert {

namespace {

Evaluation::Named named_values(const Program& program, const std::vector<double>& value, Group group) {
    Evaluation::Named result;
    for (const Root& root : program.roots)
        if (root.group == group) result.emplace_back(root.name, value[root.node]);
    return result;
}

std::vector<double> values_of(const Program& program, const std::vector<double>& value, Group group) {
    std::vector<double> result;
    for (const int id : program.nodes_of(group)) result.push_back(value[id]);
    return result;
}

/// The accelerations at a state, or the reason why there are none.
std::vector<double> accelerations_at(const Derived& d, const Program& program, const State<double>& state) {
    std::vector<double> result = values_of(program, interpret(program, state), Group::acceleration);
    if ((!state.q.empty() && (massless_combination(program, state) ||
                              is_rank_rounding(program, state, d.equations.kept(d.mechanism)))) ||
        !std::all_of(result.begin(), result.end(), [](double a) { return std::isfinite(a); }))
        throw IntegrationError(no_accelerations_at(d, state), state.t, state.q);
    return result;
}

/// The contacts that are closed at the state and stay closed. In `d` the mechanism is replaced by the one with
/// these contacts.
std::vector<int> close_contacts(Derived& d, const State<double>& state) {
    need_rates(d);
    const ContactView view(d.mechanism);
    check_gaps(d.scene, d.mechanism, view, state, tolerance::closed_gap);
    const LastingContacts lasting = contacts_at_rest(view, state, tolerance::closed_gap);
    const std::vector<int>& closed = lasting.closed;
    if (lasting.resting.size() > closed.size()) {
        std::vector<std::string> names;
        for (const int k : lasting.resting) names.push_back("'" + d.mechanism.unilateral[k].gap.name + "'");
        d.warn("redundant",
               say("warning: how the contacts {} share the load is not determined, since some of them "
                   "would hold it alone; here as few as possible bear it\n",
                   fmt::join(names, ", ")));
    }
    if (!closed.empty())
        d = derived_again(d, with_closed(d.mechanism, closed), formalism_for(Need::multipliers).name);
    return closed;
}

/// `value` with 0 for values that are only rounding; accelerations are recomputed with more bits as well.
std::vector<double> reactions_without_rounding(const Program& program, const State<double>& state,
                                               const std::vector<double>& value) {
    State<long double> wide = in_long_double(state);
    const std::vector<long double> first = interpret(program, wide);
    wide.qddot.clear();
    for (const int id : program.nodes_of(Group::acceleration)) wide.qddot.push_back(first[id]);
    return without_rounding(value, interpret(program, wide));
}

/// A function n × n of robots at a state of coordinates and rates.
std::vector<std::vector<double>> matrix_at(const Mechanism& m, const char* name, const State<double>& state) {
    const FunctionProgram f = RobotFunctions(m, false).dynamics(name);
    const std::vector<double> value = interpret(f.program, state);
    std::vector<std::vector<double>> rows;
    for (const int node : f.program.nodes_of(Group::function)) {
        if (rows.empty() || static_cast<int>(rows.back().size()) == f.columns) rows.emplace_back();
        rows.back().push_back(value[static_cast<std::size_t>(node)]);
    }
    return rows;
}

/// T, V and E, with a warning where one of them is not a number.
void add_energies(Evaluation& e, const Program& program, const State<double>& state,
                  const std::vector<double>& value) {
    const auto single = [&](Group group) { return value[program.nodes_of(group)[0]]; };
    e.kinetic = single(Group::kinetic);
    e.potential = single(Group::potential);
    e.energy = single(Group::energy);
    if (std::isfinite(e.kinetic) && std::isfinite(e.potential) && std::isfinite(e.energy)) return;
    std::optional<NotFinite> what;
    for (const Group group : {Group::kinetic, Group::potential, Group::energy})
        if (!what) what = not_finite(program, state, group);
    e.warn("not_a_number", say("warning: the energy is not a number here, because of {}\n",
                               what ? what->text : say("numbers that overflow")));
}

/// What the scene itself asks for.
void warn_of_outputs(Evaluation& e) {
    for (const auto& [name, value] : e.outputs) {
        if (std::isfinite(value)) continue;
        for (const Output& output : e.scene.outputs)
            if (output.name.text == name)
                e.warn({{output.value.place(),
                         say("{} is not a finite number here: it divides by zero, an argument is outside its "
                             "function's domain, or it is beyond the range of double precision",
                             in_quotes(name)),
                         Severity::warning, "not_a_number", name}});
    }
}

/// Conditions of joints that close loops and follow from others take a load that no motion shows.
void warn_of_shared_loads(Evaluation& e) {
    std::vector<std::string> names = e.mechanism.identities;
    for (const Mechanism::Constraint& c : e.mechanism.redundant)
        if (c.joint) names.push_back(c.name);
    if (!names.empty())
        e.warn("redundant", say("warning: the loads of joints in closed loops are not determined where conditions "
                                "follow from others ({}): they are those for which the multipliers of the closing "
                                "joints are the least\n",
                                fmt::join(names, ", ")));
}

/// The reactions as outputs, of joints and of bodies that roll.
void add_reactions(Evaluation& e, const Program& program, const State<double>& state,
                   const std::vector<double>& value) {
    const std::vector<double> plain = reactions_without_rounding(program, state, value);
    for (const ReactionOutput& r : e.reaction_outputs) {
        e.outputs[r.output].second = plain[program.nodes_of(Group::output)[r.output]];
        e.reactions.push_back({r.constraint, r.coordinate, e.outputs[r.output].second});
    }
    if (!has_reactions(e.mechanism)) return;
    const JointReactions reactions = joint_reactions(e.scene, e.mechanism);
    if (!e.mechanism.joints.empty()) {
        e.joint_loads = reactions.without_rounding(program, state);
        warn_of_shared_loads(e);
    }
    const std::vector<double> normals = reactions.normals_without_rounding(program, state);
    for (std::size_t k = 0; k < normals.size(); ++k)
        e.normal_reactions.emplace_back(reactions.normals[k], normals[k]);
}

}  // namespace

Evaluation evaluate(Scene scene, const EvaluateOptions& options) {
    const Overrides& at = options.at;
    Evaluation e{derived(std::move(scene), {.by = options.by,
                                            .use = Use::asked,
                                            .reactions = options.reactions,
                                            .at = at,
                                            .coordinates = Coordinates::optional})};
    Start start = start_of(e.mechanism, at);
    e.adjusted = assemble(start, e.mechanism, lower_constraints(e.mechanism), at);
    State<double> state = state_of(start, e.mechanism, e.equations);
    const Mechanism& m = e.mechanism;
    std::vector<int> closed;
    if (!m.unilateral.empty()) {
        e.closed.emplace();
        closed = close_contacts(e, state);
        for (const int k : closed) e.closed->push_back(m.unilateral[k].gap.name);
    }
    if (const std::vector<int> planes = frictions_in_planes(m, closed); !planes.empty())
        static_cast<Derived&>(e) = derived_again(e, with_directions_held(m, planes),
                                                 closed.empty() ? e.by : formalism_for(Need::multipliers).name);
    Program program = with_signs_told(e, lowered(e).program);
    if (const auto jumps = switched(program, SecondRates::wanted)) {
        std::optional<ConsistentMode> held =
            jumps->has_frictions() ? consistent_mode(*jumps, state) : standing_state(*jumps, state);
        if (held) {
            program = std::move(held->program);
            state = std::move(held->state);
            e.frictions = std::move(held->frictions);
        }
    }
    state.qddot = accelerations_at(e, program, state);
    const std::vector<double> value = interpret(program, state);  // outputs may contain accelerations
    e.time = state.t;
    e.q = state.q;
    for (const Quantity& q : program.coordinates) e.coordinates.push_back(q.name);
    const bool own_speeds = !program.speeds.empty();
    for (std::size_t k = 0; k < m.states.size(); ++k) {
        const std::size_t place = first_state(state.qdot.size(), m) + k;
        const std::string name = m.states[k].derivative[0].get_name();
        e.states.emplace_back(name, state.qdot[place]);
        e.state_rates.emplace_back(name, state.qddot[place]);
    }
    e.rates = own_speeds ? values_of(program, value, Group::rate) : state.qdot;
    e.accelerations = own_speeds ? values_of(program, value, Group::second_rate) : state.qddot;
    e.speeds = named_values(program, value, Group::speed);
    e.speed_rates = named_values(program, value, Group::speed_rate);
    e.multipliers = named_values(program, value, Group::multiplier);
    for (const Mechanism::Unilateral& contact : m.unilateral) {
        const std::string name = contact.gap.multiplier.get_name();
        if (std::none_of(e.multipliers.begin(), e.multipliers.end(),
                         [&](const auto& known) { return known.first == name; }))
            e.multipliers.emplace_back(name, 0.0);  // the contact is open
    }
    add_energies(e, program, state, value);
    const std::vector<double> position = values_of(program, value, Group::position),
                              velocity = values_of(program, value, Group::velocity);
    for (std::size_t k = 0; k < position.size(); ++k)
        e.residuals.push_back({m.constraints[k].name, {position[k], velocity[k]}});
    e.outputs = named_values(program, value, Group::output);
    warn_of_outputs(e);
    if (options.matrices) {
        e.mass = matrix_at(m, "mass", start.state());
        const auto norm = std::find_if(m.constraints.begin(), m.constraints.end(),
                                       [](const Mechanism::Constraint& c) { return c.norm; });
        if (norm == m.constraints.end())
            e.coriolis = matrix_at(m, "coriolis", start.state());
        else
            e.no_coriolis =
                say("there is no matrix C of its own: the quaternion of '{}' has four coordinates for "
                    "three degrees of freedom",
                    norm->name);
    }
    if (options.reactions) add_reactions(e, program, state, value);
    return e;
}

}  // namespace alembert
