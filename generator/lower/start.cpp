// SPDX-License-Identifier: GPL-2.0-or-later
#include "lower/start.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lower/lower.hpp"

namespace alembert {

namespace {

double& place_of(const std::string& name, Start& start, const Mechanism& m) {
    if (name == "t") return start.t;
    std::vector<std::string> known{"t"};
    std::size_t position = 0;
    for (const Mechanism::Parameter& p : m.parameters) {
        if (p.symbol.get_name() == name) {
            if (p.independent) return start.parameters[position];
            throw ModelError(fmt::format("--at {}=…: '{}' is defined by other parameters; set those", name, name));
        }
        position += p.independent ? 1 : 0;
        known.push_back(p.symbol.get_name());
    }
    for (int i = 0; i < m.size(); ++i) {
        if (m.q[i].get_name() == name) return start.q[i];
        if (m.q[i].get_name() + "'" == name) {
            if (start.speeds.empty()) return start.qdot[i];
            throw ModelError(fmt::format("--at {}=…: the rates follow from the speeds here; set '{}'", name, m.speeds[0].u.get_name()));
        }
        known.push_back(m.q[i].get_name());
        known.push_back(m.q[i].get_name() + "'");
    }
    for (std::size_t k = 0; k < m.speeds.size(); ++k) {
        known.push_back(m.speeds[k].u.get_name());
        if (known.back() != name) continue;
        if (!start.speeds.empty()) return start.speeds[k];
        throw ModelError(fmt::format("--at {}=…: the scene gives rates, and '{}' follows from them; set those", name, name));
    }
    const std::string meant = nearest(name, known);
    throw ModelError(fmt::format("--at {}=…: '{}' is no coordinate, rate, parameter or t of the scene{}", name, name,
                                 meant.empty() ? "" : "; did you mean '" + meant + "'?"));
}

}  // namespace

Start start_of(const Mechanism& m, const Overrides& overrides) {
    Start start;
    start.q.resize(m.q.size());
    start.qdot.resize(m.q.size());
    if (!m.speeds.empty() && m.speeds[0].start) start.speeds.resize(m.speeds.size());
    for (const Mechanism::Parameter& p : m.parameters)
        if (p.independent) start.parameters.push_back(GiNaC::ex_to<GiNaC::numeric>(p.value).to_double());

    const auto replace = [&](bool parameters) {
        for (const auto& [name, value] : overrides) {
            if (!std::isfinite(value)) throw ModelError(fmt::format("--at {}={}: expected a finite number", name, value));
            double& place = place_of(name, start, m);
            const bool is_parameter = !start.parameters.empty() && &place >= start.parameters.data() &&
                                      &place < start.parameters.data() + start.parameters.size();
            if (is_parameter == parameters) place = value;
        }
    };
    replace(true);

    Program program;
    std::vector<std::pair<double*, int>> wanted;
    const auto want = [&](double& to, const GiNaC::ex& e) { wanted.emplace_back(&to, lower_expression(program, m, e)); };
    for (int i = 0; i < m.size(); ++i) {
        want(start.q[i], m.q_start[i]);
        want(start.qdot[i], m.qdot_start[i]);
    }
    for (std::size_t k = 0; k < start.speeds.size(); ++k) want(start.speeds[k], *m.speeds[k].start);
    if (m.run.start) want(start.t, *m.run.start);
    if (m.run.duration) want(start.duration, *m.run.duration);
    if (m.run.tolerance) want(start.tolerance, *m.run.tolerance);
    if (m.run.step) want(start.step, *m.run.step);
    if (m.run.sample) want(start.sample, *m.run.sample);
    const std::vector<double> values = interpret<double>(program, {.parameters = start.parameters, .q = {}, .qdot = {}, .qddot = {}});
    for (const auto& [to, node] : wanted) *to = values[node];
    replace(false);
    for (int i = 0; i < m.size(); ++i)
        if (!std::isfinite(start.q[i]) || !std::isfinite(start.qdot[i]))
            throw ModelError(fmt::format("the initial value of '{}' is not finite at these parameters", m.q[i].get_name()));
    for (std::size_t k = 0; k < start.speeds.size(); ++k)
        if (!std::isfinite(start.speeds[k]))
            throw ModelError(fmt::format("the initial value of '{}' is not finite at these parameters", m.speeds[k].u.get_name()));
    return start;
}

State<double> state_of(const Start& start, const Mechanism& m, const Equations& equations) {
    State<double> state = start.state();
    if (equations.h.empty()) return state;
    if (!start.speeds.empty()) {
        state.qdot = start.speeds;
        return state;
    }
    Program program;
    std::vector<int> nodes;
    for (const GiNaC::ex& form : equations.form) nodes.push_back(lower_expression(program, m, form));
    const std::vector<double> value = interpret(program, state);
    state.qdot.clear();
    for (const int id : nodes) state.qdot.push_back(value[id]);
    return state;
}

}  // namespace alembert
