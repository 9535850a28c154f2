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
    const StartNodes nodes = lower_start(program, m);
    const std::vector<Interval> values = intervals_of(program, {.parameters = start.parameters});
    const auto of = [&](const std::vector<int>& list) {
        std::vector<Interval> result;
        for (const int node : list) result.push_back(values[node]);
        return result;
    };
    const std::vector<Interval> q = of(nodes.q), u = of(nodes.qdot), states = of(nodes.states);
    start.t = values[nodes.t];
    const Rational given = duration ? cln::rationalize(cln::cl_F(cln::cl_DF(*duration))) : Rational(0);
    start.end = start.t + (duration ? interval_of(given) : values[nodes.duration]);

    const bool are_given = !doubles.speeds.empty();
    start.state = q;
    if (equations.speeds_are_rates()) {
        if (are_given)
            throw ModelError(say("--proof: the initial values are to be those of rates, not of speeds"));
        start.state.insert(start.state.end(), u.begin(), u.end());
    } else if (are_given) {
        const std::vector<Interval> speeds = of(nodes.speeds);
        start.state.insert(start.state.end(), speeds.begin(), speeds.end());
    } else {
        Program forms;
        std::vector<int> wanted;
        for (const GiNaC::ex& form : equations.form) wanted.push_back(lower_expression(forms, m, form));
        const std::vector<Interval> all =
            intervals_of(forms, {.parameters = start.parameters, .t = start.t, .q = q, .qdot = u});
        for (const int node : wanted) start.state.push_back(all[node]);
    }
    start.state.insert(start.state.end(), states.begin(), states.end());
    return start;
}

}  // namespace alembert
