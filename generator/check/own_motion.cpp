// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/own_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analysis/state/assemble.hpp"
#include "model/energy.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int most_steps = 48, between_states = 8;
constexpr double longest_motion = 10;         // s
constexpr std::size_t most_work = 4'000'000;  // nodes that are evaluated

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

/// x + h·x', for coordinates with their rates and rates with their accelerations.
State<double> moved(const State<double>& from, const State<double>& slope, double h) {
    State<double> result = from;
    result.t += h;
    for (std::size_t i = 0; i < from.q.size(); ++i) {
        result.q[i] += h * slope.qdot[i];
        result.qdot[i] += h * slope.qddot[i];
    }
    return result;
}

/// The state with the accelerations and multipliers of the law.
State<double> forced(const Program& law, State<double> state) {
    const std::vector<double> at = interpret(law, state);
    state.qddot.clear(), state.unknown.clear();
    for (const int id : law.nodes_of(Group::acceleration)) state.qddot.push_back(at[id]);
    for (const int id : law.nodes_of(Group::multiplier)) state.unknown.push_back(at[id]);
    return state;
}

/// One step of the classical method of Runge and Kutta. Each state is one of the system, however long the steps
/// are.
State<double> stepped(const Program& law, const State<double>& from, double h) {
    const State<double> second = forced(law, moved(from, from, h / 2)),
                        third = forced(law, moved(from, second, h / 2)),
                        fourth = forced(law, moved(from, third, h));
    State<double> result = from;
    result.t += h;
    for (std::size_t i = 0; i < from.q.size(); ++i) {
        result.q[i] += h / 6 * (from.qdot[i] + 2 * second.qdot[i] + 2 * third.qdot[i] + fourth.qdot[i]);
        result.qdot[i] += h / 6 * (from.qddot[i] + 2 * second.qddot[i] + 2 * third.qddot[i] + fourth.qddot[i]);
    }
    return forced(law, result);
}

/// Whether nothing is too large or too small for double precision.
bool is_resolved(const Program& program, const std::vector<int>& roots, const std::vector<double>& value) {
    const std::vector<int> needed = program.needed(roots);
    return std::all_of(needed.begin(), needed.end(), [&](int id) {
        const double x = value[static_cast<std::size_t>(id)];
        return std::isfinite(x) && (x != 0 || program[id].op != Op::exp) &&
               (x == 0 || std::abs(x) > std::numeric_limits<double>::min());
    });
}

bool is_finite(const State<double>& state) {
    const auto finite = [](double x) { return std::isfinite(x) && std::abs(x) < 1e6; };
    return std::all_of(state.q.begin(), state.q.end(), finite) &&
           std::all_of(state.qdot.begin(), state.qdot.end(), finite) &&
           std::all_of(state.qddot.begin(), state.qddot.end(), finite);
}

}  // namespace

/// As claims have it: zeros for contacts that are open and for names that the claims leave open.
void OwnMotion::complete(State<double>& state) const {
    const Mechanism& m = claims_.mechanism();
    if (!state.unknown.empty())
        state.unknown.insert(state.unknown.begin() + static_cast<std::ptrdiff_t>(m.constraints.size()),
                             m.unilateral.size(), 0.0);
    state.unknown.resize(e_.lambda.size() + m.undetermined().size() + claims_.open().size());
}

void OwnMotion::make() {
    if (std::exchange(is_made_, true)) return;
    const Mechanism& m = claims_.mechanism();
    try {
        Start start = start_of(m);
        const Program constraints = lower_constraints(m);
        assemble(start, m, constraints, {});
        start_.push_back(start.state());
        if (e_.speeds_are_rates()) follow(start, constraints);
    } catch (const std::runtime_error&) {  // as far as it was found
    }
    for (auto* list : {&start_, &motion_})
        for (State<double>& state : *list) complete(state);
}

/// The motion from an assembled start, put back onto the constraints where a state of it is kept.
void OwnMotion::follow(Start start, const Program& constraints) {
    const Mechanism& m = claims_.mechanism();
    Energy no_energy;  // its derivatives would lengthen the table of the mechanism with each check
    no_energy.z = m.z;
    const Program law = lower(m, e_, no_energy, {.admissible = [&start] { return start; }});
    if (law.nodes_of(Group::acceleration).size() != start.q.size()) return;  // what no inertia resists has none
    motion_.push_back(forced(law, start.state()));
    const int steps = static_cast<int>(
        std::min<std::size_t>(most_steps, most_work / (4 * static_cast<std::size_t>(law.size()) + 1)));
    if (!m.unilateral.empty()) return;
    const double h = std::min(start.duration, longest_motion) / most_steps;
    State<double> now = motion_.back();
    for (int step = 1; step <= steps; ++step) {
        now = stepped(law, now, h);
        if (!is_finite(now)) return;
        if (step % between_states != 0 && steps >= between_states) continue;
        Start here = start;
        here.t = now.t, here.q = now.q, here.qdot = now.qdot;
        assemble(here, m, constraints, {});
        now = forced(law, here.state());
        motion_.push_back(now);
    }
}

const std::vector<State<double>>& OwnMotion::states_for(const std::vector<ex>& values) {
    make();
    const Mechanism& m = claims_.mechanism();
    std::vector<GiNaC::symbol> forces = m.qddot;
    for (const auto* list : {&m.constraints, &m.redundant})
        for (const Mechanism::Constraint& c : *list) forces.push_back(c.multiplier);
    const bool are_forced =
        std::any_of(values.begin(), values.end(), [&](const ex& value) { return m.z->depends(value, forces); });
    return are_forced || !motion_.empty() ? motion_ : start_;
}

std::optional<double> OwnMotion::at_start(const ex& value) {
    if (claims_.mechanism().z->depends(value, claims_.open_symbols())) return std::nullopt;
    const std::vector<State<double>>& states = states_for({value});
    if (states.empty()) return std::nullopt;
    try {
        Program program;
        const int root = claims_.lower(program, {value})[0];
        return interpret(program, states.front())[static_cast<std::size_t>(root)];
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

bool OwnMotion::is_positive_at_start(const ex& value) {
    return at_start(value).value_or(0) > 0;
}

bool OwnMotion::is_zero_at_start(const ex& value) {
    return std::abs(at_start(value).value_or(1)) < 1e-8;
}

std::optional<OwnMotion::Failure> OwnMotion::failure(const ex& residual, const std::vector<ex>& positive,
                                                     const std::vector<State<double>>& states) const {
    // Of the sizes of the terms, and of 1: positions are assembled to 1e-9 of theirs, and later the motion may
    // pass where accelerations are known to few digits.
    constexpr double surely = 1e-6, surely_later = 1e-3;
    const Mechanism& m = claims_.mechanism();
    if (m.z->depends(residual, claims_.open_symbols())) return std::nullopt;
    for (const Mechanism::Constraint* c : m.undetermined())
        if (m.z->depends(residual, {c->multiplier})) return std::nullopt;
    try {
        Program program;
        std::vector<ex> all{residual};
        all.insert(all.end(), positive.begin(), positive.end());
        const std::vector<int> roots = claims_.lower(program, all);
        for (const State<double>& state : states) {
            const std::vector<double> value = interpret(program, state);
            const double left = value[roots[0]], size = size_of_terms(program, roots[0], value);
            const bool is_meant =
                std::all_of(roots.begin() + 1, roots.end(), [&](int id) { return value[id] > 0; });
            const bool at_start = &state == &states.front();
            if (!is_meant || !is_resolved(program, roots, value) ||
                !(std::abs(left) > (at_start ? surely : surely_later) * std::max(size, 1.0)))
                continue;
            return Failure{.state = {.values = typed(m, state),
                                     .residual = fmt::format("{:.6g}", left),
                                     .residual_value = left},
                           .at_start = at_start};
        }
    } catch (const std::runtime_error&) {  // it has no value somewhere
    }
    return std::nullopt;
}

std::optional<OwnMotion::Failure> OwnMotion::fails(const ex& residual, const std::vector<ex>& positive) {
    std::vector<ex> all = positive;
    all.push_back(residual);
    return failure(residual, positive, states_for(all));
}

std::optional<Counterexample> OwnMotion::fails_at_rest(const ex& residual) {
    make();
    if (motion_.empty()) return std::nullopt;
    const State<double>& start = motion_.front();
    const auto moves = [](double rate) { return !(std::abs(rate) < 1e-9); };
    if (std::any_of(start.qdot.begin(), start.qdot.end(), moves) ||
        std::any_of(start.qddot.begin(), start.qddot.end(), moves))
        return std::nullopt;
    const auto found = failure(residual, {}, {start});
    return found ? std::optional(found->state) : std::nullopt;
}

}  // namespace alembert
