// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/argument.hpp"
#include "base/language/libraries.hpp"
#include "base/language/say.hpp"
#include "model/formalism/with_states.hpp"
#include "program/lower/lower.hpp"
#include "scene/text.hpp"

namespace alembert {

Starts::Starts(const Mechanism& mechanism, const std::vector<std::string>& names) : m_(mechanism) {
    plain_.q.resize(m_.q.size());
    plain_.qdot.resize(m_.q.size());
    plain_.states.resize(m_.states.size());
    if (!m_.speeds.empty() && m_.speeds[0].start) plain_.speeds.resize(m_.speeds.size());
    for (const Mechanism::Parameter& p : m_.parameters)
        if (p.independent) plain_.parameters.push_back(p.number().to_double());
    for (const std::string& name : names) spots_.push_back(spot_of(name));

    const auto want = [&](const GiNaC::ex& e) { nodes_.push_back(lower_expression(program_, m_, e)); };
    for (int i = 0; i < m_.size(); ++i) want(m_.q_start[i]);
    for (int i = 0; i < m_.size(); ++i) want(m_.qdot_start[i]);
    for (std::size_t k = 0; k < plain_.speeds.size(); ++k) want(*m_.speeds[k].start);
    for (const Mechanism::State& state : m_.states) want(state.start);
    for (const auto* e :
         {&m_.run.start, &m_.run.duration, &m_.run.tolerance, &m_.run.step, &m_.run.max_step, &m_.run.sample})
        if (*e) want(**e);
}

StartNodes lower_start(Program& program, const Mechanism& m) {
    const auto node = [&](const GiNaC::ex& e) { return lower_expression(program, m, e); };
    StartNodes result;
    for (int i = 0; i < m.size(); ++i) result.q.push_back(node(m.q_start[i]));
    for (int i = 0; i < m.size(); ++i) result.qdot.push_back(node(m.qdot_start[i]));
    for (const Mechanism::Speed& speed : m.speeds) result.speeds.push_back(node(speed.start.value_or(0)));
    for (const Mechanism::State& state : m.states) result.states.push_back(node(state.start));
    result.t = node(m.run.start.value_or(0));
    result.duration = node(m.run.duration.value_or(10));
    return result;
}

Starts::Spot Starts::spot_of(const std::string& name) const {
    if (name == "t") return {name, Part::t, 0};
    std::vector<std::string> known{"t"};
    std::size_t position = 0;
    for (const Mechanism::Parameter& p : m_.parameters) {
        if (p.symbol.get_name() == name) {
            if (p.independent) return {name, Part::parameter, position};
            throw ModelError(say("{}=…: '{}' is defined by other parameters; set those", name, name));
        }
        position += p.independent ? 1 : 0;
        known.push_back(p.symbol.get_name());
    }
    for (std::size_t i = 0; i < m_.q.size(); ++i) {
        if (m_.q[i].get_name() == name) return {name, Part::q, i};
        if (m_.q[i].get_name() + "'" == name) {
            if (plain_.speeds.empty()) return {name, Part::qdot, i};
            throw ModelError(
                say("{}=…: the rates follow from the speeds here; set '{}'", name, m_.speeds[0].u.get_name()));
        }
        known.push_back(m_.q[i].get_name());
        known.push_back(m_.q[i].get_name() + "'");
    }
    for (std::size_t k = 0; k < m_.speeds.size(); ++k) {
        known.push_back(m_.speeds[k].u.get_name());
        if (known.back() != name) continue;
        if (!plain_.speeds.empty()) return {name, Part::speed, k};
        throw ModelError(say("{}=…: the scene gives rates, and '{}' follows from them; set those", name, name));
    }
    for (std::size_t k = 0; k < m_.states.size(); ++k) {
        known.push_back(m_.states[k].derivative[0].get_name());
        if (known.back() == name) return {name, Part::state, k};
    }
    const std::string meant = nearest(name, known);
    const std::string advice = meant.empty() ? "" : say("; did you mean '{}'?", meant);
    if (m_.states.empty())
        throw ModelError(
            say("{}=…: '{}' is no coordinate, rate, parameter or t of the scene{}", name, name, advice));
    for (const Mechanism::State& z : m_.states)
        if (z.derivative[1].get_name() == name || z.derivative[0].get_name() + "'" == name)
            throw ModelError(
                say("{}=…: the scene gives the rate of the state {}; set the state, or what its rate "
                    "depends on",
                    name, in_quotes(z.derivative[0].get_name())));
    throw ModelError(
        say("{}=…: '{}' is no coordinate, rate, state, parameter or t of the scene{}", name, name, advice));
}

double& Starts::place(const Spot& spot, Start& start) {
    switch (spot.part) {
        case Part::parameter:
            return start.parameters[spot.index];
        case Part::q:
            return start.q[spot.index];
        case Part::qdot:
            return start.qdot[spot.index];
        case Part::speed:
            return start.speeds[spot.index];
        case Part::state:
            return start.states[spot.index];
        default:
            return start.t;
    }
}

Possible<Start> Starts::possible(const std::vector<double>& values) const {
    for (std::size_t k = 0; k < spots_.size(); ++k)
        if (!std::isfinite(values[k]))
            return Obstacle{
                translated_from_library(argument::mistake(spots_[k].name, values[k], argument::finite))};
    Start start = plain_;
    const auto replace = [&](bool parameters) {
        for (std::size_t k = 0; k < spots_.size(); ++k)
            if ((spots_[k].part == Part::parameter) == parameters) place(spots_[k], start) = values[k];
    };
    replace(true);
    const std::vector<double> value =
        interpret<double>(program_, {.parameters = start.parameters, .q = {}, .qdot = {}, .qddot = {}});
    std::size_t next = 0;
    for (std::vector<double>* part : {&start.q, &start.qdot, &start.speeds, &start.states})
        for (double& x : *part) x = value[nodes_[next++]];
    if (m_.run.start) start.t = value[nodes_[next++]];
    if (m_.run.duration) start.duration = value[nodes_[next++]];
    if (m_.run.tolerance) start.tolerance = value[nodes_[next++]];
    if (m_.run.step) start.step = value[nodes_[next++]];
    if (m_.run.max_step) start.max_step = value[nodes_[next++]];
    if (m_.run.sample) start.sample = value[nodes_[next++]];
    replace(false);
    for (int i = 0; i < m_.size(); ++i)
        if (!std::isfinite(start.q[i]) || !std::isfinite(start.qdot[i]))
            return Obstacle{
                say("the initial value of '{}' is not finite at these parameters", m_.q[i].get_name())};
    for (std::size_t k = 0; k < start.speeds.size(); ++k)
        if (!std::isfinite(start.speeds[k]))
            return Obstacle{
                say("the initial value of '{}' is not finite at these parameters", m_.speeds[k].u.get_name())};
    for (std::size_t k = 0; k < start.states.size(); ++k)
        if (!std::isfinite(start.states[k]))
            return Obstacle{say("the initial value of '{}' is not finite at these parameters",
                                m_.states[k].derivative[0].get_name())};
    return start;
}

namespace {

/// Whether the mechanism was built with this number for an input (analysis/state/given_inputs.hpp).
bool has_input_given(const Mechanism& m, const std::string& name, double value) {
    return std::any_of(m.inputs.begin(), m.inputs.end(), [&](const Mechanism::Input& input) {
        if (input.derivative[0].get_name() != name) return false;
        const GiNaC::ex number = m.z->expand(input.value);
        return GiNaC::is_a<GiNaC::numeric>(number) && GiNaC::ex_to<GiNaC::numeric>(number).to_double() == value;
    });
}

}  // namespace

Start start_of(const Mechanism& m, const Overrides& overrides) {
    std::vector<std::string> names;
    std::vector<double> values;
    for (const auto& [name, value] : overrides) {
        if (has_input_given(m, name, value)) continue;
        names.push_back(name);
        values.push_back(value);
    }
    return Starts(m, names).at(values);
}

State<double> state_of(const Start& start, const Mechanism& m, const Equations& equations) {
    State<double> state = start.state();
    if (equations.speeds_are_rates()) return state;
    // Those of the scene, and not its rates with its states behind them.
    const bool has_own_speeds = !start.speeds.empty() && equations.u.front().is_equal(m.speeds.front().u);
    if (has_own_speeds) {
        state.qdot = start.speeds;
        state.qdot.insert(state.qdot.end(), start.states.begin(), start.states.end());
    } else {
        Program program;
        const std::vector<int> nodes = lower_expressions(program, in_terms_of(equations, m), equations.form);
        const std::vector<double> value = interpret(program, state);
        state.qdot.clear();
        for (const int id : nodes) state.qdot.push_back(value[id]);
        if (!has_states(equations, m))
            state.qdot.insert(state.qdot.end(), start.states.begin(), start.states.end());
    }
    return state;
}

}  // namespace alembert
