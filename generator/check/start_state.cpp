// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/start_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/state/assemble.hpp"
#include "model/energy.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// With the accelerations and multipliers only where `value` depends on them. Throws where there is no such state.
State<double> state_at_start(const ex& value, const Claims& claims, const Equations& equations) {
    const Mechanism& m = claims.mechanism();
    Start start = start_of(m);
    assemble(start, m, lower_constraints(m), {});
    State<double> state = start.state();
    std::vector<GiNaC::symbol> forced = m.qddot;
    for (const auto* list : {&m.constraints, &m.redundant})
        for (const Mechanism::Constraint& c : *list) forced.push_back(c.multiplier);
    if (m.z->depends(value, forced)) {
        const Program motion = lower(m, equations, energy_of(m), {.admissible = [&start] { return start; }});
        const std::vector<double> at = interpret(motion, state);
        for (const int id : motion.nodes_of(Group::acceleration)) state.qddot.push_back(at[id]);
        for (const int id : motion.nodes_of(Group::multiplier)) state.unknown.push_back(at[id]);
        state.unknown.insert(state.unknown.begin() + static_cast<std::ptrdiff_t>(m.constraints.size()),
                             m.unilateral.size(), 0.0);
    }
    state.unknown.resize(equations.lambda.size() + m.undetermined().size() + claims.open().size());
    return state;
}

/// What a person would type to see it.
std::vector<std::pair<std::string, std::string>> typed(const Mechanism& m, const State<double>& state) {
    std::vector<std::pair<std::string, std::string>> result;
    const auto add = [&](const std::string& name, double value) {
        result.emplace_back(name, fmt::format("{:.12g}", value));
    };
    std::size_t next = 0;
    for (const Mechanism::Parameter& p : m.parameters)
        if (p.independent) add(p.symbol.get_name(), state.parameters[next++]);
    add("t", state.t);
    for (std::size_t i = 0; i < m.q.size(); ++i) add(m.q[i].get_name(), state.q[i]);
    for (std::size_t i = 0; i < m.q.size(); ++i) add(m.qdot[i].get_name(), state.qdot[i]);
    for (std::size_t i = 0; i < state.qddot.size(); ++i) add(m.qddot[i].get_name(), state.qddot[i]);
    return result;
}

}  // namespace

bool is_positive_at_start(const ex& value, const Claims& claims, const Equations& equations) {
    if (claims.mechanism().z->depends(value, claims.open_symbols())) return false;
    try {
        Program program;
        const int root = claims.lower(program, {value})[0];
        return interpret(program, state_at_start(value, claims, equations))[root] > 0;
    } catch (const std::runtime_error&) {
        return false;
    }
}

std::optional<Counterexample> fails_at_start(const ex& residual, const Claims& claims, const Equations& equations,
                                             bool at_rest) {
    constexpr double surely =
        1e-6;  // of the sizes of the terms, and of 1; positions are assembled to 1e-9 of theirs
    const Mechanism& m = claims.mechanism();
    if (m.z->depends(residual, claims.open_symbols())) return std::nullopt;
    for (const Mechanism::Constraint* c : m.undetermined())
        if (m.z->depends(residual, {c->multiplier})) return std::nullopt;
    try {
        ex forced = residual;
        if (at_rest)
            for (const GiNaC::symbol& acceleration : m.qddot) forced += acceleration;
        const State<double> state = state_at_start(forced, claims, equations);
        const auto moves = [](double rate) { return !(std::abs(rate) < 1e-9); };
        if (at_rest && (std::any_of(state.qdot.begin(), state.qdot.end(), moves) ||
                        std::any_of(state.qddot.begin(), state.qddot.end(), moves)))
            return std::nullopt;
        Program program;
        const int root = claims.lower(program, {residual})[0];
        const std::vector<double> value = interpret(program, state);
        const double size = size_of_terms(program, root, value);
        if (!(std::abs(value[root]) > surely * std::max(size, 1.0))) return std::nullopt;
        return Counterexample{.values = typed(m, state),
                              .residual = fmt::format("{:.6g}", value[root]),
                              .residual_value = value[root]};
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

}  // namespace alembert
