// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/interval/point.hpp"

#include <algorithm>
#include <cmath>

#include "model/constant.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double near_enough = 1e-9;  // within this distance the program's state and an exact one are the same

std::optional<RealBall> exact_of(const ex& value) {
    if (!GiNaC::is_a<GiNaC::numeric>(value) || !GiNaC::ex_to<GiNaC::numeric>(value).is_rational()) return {};
    return RealBall(Rational(cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N())));
}

/// Of a constant such as √69 or π/4, with all that is known of it.
RealBall constant_of(const Mechanism& m, const ex& value) {
    Program program = begun(m);
    const int node = lower_expression(program, m, value);
    return interpret(program, State<Expansion>())[node].value();
}

std::optional<RealBall> typed(const Mechanism& m, const ExactOverrides& exact_at, const std::string& name) {
    for (const auto& [known, text] : exact_at)
        if (known == name) {
            const ex value = constant_value(text);
            const std::optional<RealBall> fraction = exact_of(value);
            return fraction ? fraction : constant_of(m, value);
        }
    return {};
}

}  // namespace

State<Expansion> state_of(const RealBallPoint& at) {
    State<Expansion> state;
    for (const auto& [from, to] : {std::pair{&at.parameters, &state.parameters},
                                   {&at.q, &state.q},
                                   {&at.u, &state.qdot},
                                   {&at.inputs, &state.unknown}})
        for (const RealBall& value : *from) to->emplace_back(value);
    state.t = Expansion(at.t);
    return state;
}

RealBall exact_or(const RealBall& exact, double in_use) {
    const double unit = near_enough * std::max(1.0, std::abs(in_use));
    if (std::abs(exact.number() - in_use) + exact.radius() < unit) return exact;
    return RealBall::about(static_cast<Quad>(in_use), unit);
}

RealBallVector exact_parameters(const Mechanism& m, const Start& start, const ExactOverrides& exact_at) {
    RealBallVector result;
    for (const Mechanism::Parameter& p : m.parameters) {
        if (!p.independent) continue;
        std::optional<RealBall> exact = typed(m, exact_at, p.symbol.get_name());
        if (!exact) exact = exact_of(p.value);
        if (!exact) exact = constant_of(m, p.value);
        const double in_use = start.parameters[result.size()];
        result.push_back(exact && std::abs(exact->number() - in_use) <= 4e-16 * std::abs(in_use)
                             ? *exact
                             : RealBall(Rational(cln::rational(cln::cl_DF(in_use)))));
    }
    return result;
}

ExactStart exact_start(const Mechanism& m, const Start& start, const ExactOverrides& exact_at) {
    ExactStart result{.parameters = exact_parameters(m, start, exact_at),
                      .t = Rational(cln::rational(cln::cl_DF(start.t))),
                      .q = {},
                      .qdot = {},
                      .speeds = {},
                      .states = {}};
    Program program = begun(m);
    std::vector<int> nodes;
    for (const ex& e : m.q_start) nodes.push_back(lower_expression(program, m, m.z->expand(e)));
    for (const ex& e : m.qdot_start) nodes.push_back(lower_expression(program, m, m.z->expand(e)));
    for (const Mechanism::Speed& s : m.speeds) nodes.push_back(lower_expression(program, m, s.start.value_or(0)));
    for (const Mechanism::State& z : m.states) nodes.push_back(lower_expression(program, m, z.start));
    nodes.push_back(lower_expression(program, m, m.run.start.value_or(0)));
    State<Expansion> state;
    for (const RealBall& p : result.parameters) state.parameters.emplace_back(p);
    const std::vector<Expansion> value = interpret(program, state);
    std::size_t next = 0;
    const auto take = [&](const std::string& name) {
        const RealBall own = value[nodes[next++]].value();
        return typed(m, exact_at, name).value_or(own);
    };
    for (int i = 0; i < m.size(); ++i) result.q.push_back(exact_or(take(m.q[i].get_name()), start.q[i]));
    for (int i = 0; i < m.size(); ++i)
        result.qdot.push_back(exact_or(take(m.q[i].get_name() + "'"), start.qdot[i]));
    for (const Mechanism::Speed& s : m.speeds) result.speeds.push_back(take(s.u.get_name()));
    for (std::size_t k = 0; k < m.states.size(); ++k)
        result.states.push_back(exact_or(take(m.states[k].derivative[0].get_name()), start.states[k]));
    if (const RealBall t = take("t"); std::abs(t.number() - start.t) < near_enough) result.t = t;
    return result;
}

}  // namespace alembert
