// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/interval_start.hpp"

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"
#include "proof/interval_of.hpp"

namespace alembert {

IntervalStart interval_start(const Mechanism& m, const Equations& equations, const Start& doubles,
                             std::optional<double> duration) {
    IntervalStart start;
    for (const Mechanism::Parameter& p : m.parameters)
        if (p.independent) start.parameters.push_back(interval_of(cln::the<cln::cl_RA>(p.number().to_cl_N())));
    Program program;
    std::vector<int> wanted;
    const auto value = [&](const GiNaC::ex& e) { wanted.push_back(lower_expression(program, m, e)); };
    for (int i = 0; i < m.size(); ++i) value(m.q_start[i]);
    for (int i = 0; i < m.size(); ++i) value(m.qdot_start[i]);
    for (const Mechanism::Speed& speed : m.speeds) value(speed.start.value_or(0));
    for (const Mechanism::State& z : m.states) value(z.start);
    value(m.run.start.value_or(0));
    value(m.run.duration.value_or(10));
    const std::vector<Interval> values = intervals_of(program, {.parameters = start.parameters});
    std::size_t next = 0;
    const auto take = [&](std::size_t count) {
        std::vector<Interval> result;
        for (std::size_t i = 0; i < count; ++i) result.push_back(values[wanted[next++]]);
        return result;
    };
    const auto n = static_cast<std::size_t>(m.size());
    const std::vector<Interval> q = take(n), u = take(n), speeds = take(m.speeds.size()),
                                states = take(m.states.size());
    start.t = take(1)[0];
    const Interval lasts = take(1)[0];
    const Rational given = duration ? cln::rationalize(cln::cl_F(cln::cl_DF(*duration))) : Rational(0);
    start.end = start.t + (duration ? interval_of(given) : lasts);

    const bool are_given = !doubles.speeds.empty();
    start.state = q;
    if (equations.speeds_are_rates()) {
        if (are_given)
            throw ModelError(say("--proof: the initial values are to be those of rates, not of speeds"));
        start.state.insert(start.state.end(), u.begin(), u.end());
    } else if (are_given) {
        start.state.insert(start.state.end(), speeds.begin(), speeds.end());
    } else {
        Program forms;
        std::vector<int> nodes;
        for (const GiNaC::ex& form : equations.form) nodes.push_back(lower_expression(forms, m, form));
        const std::vector<Interval> all =
            intervals_of(forms, {.parameters = start.parameters, .t = start.t, .q = q, .qdot = u});
        for (const int node : nodes) start.state.push_back(all[node]);
    }
    start.state.insert(start.state.end(), states.begin(), states.end());
    return start;
}

}  // namespace alembert
