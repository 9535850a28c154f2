// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alembert/error.hpp"
#include "alembert/integrate.hpp"
#include "language/libraries.hpp"
#include "language/say.hpp"
#include "lower/lower.hpp"
#include "program/partials.hpp"
#include "program/variation.hpp"

namespace alembert {

namespace {

void check_smooth_motion(const Mechanism& m, const Program& program) {
    if (!m.constraints.empty() || !m.redundant.empty())
        throw ModelError(
            say("--sensitivity: the scene has constraints, so that its initial values do not vary one by one; "
                "write it "
                "in independent coordinates"));
    if (!m.unilateral.empty() || !m.frictions.empty() || m.has_kicks())
        throw ModelError(say(
            "--sensitivity: the scene has contacts, dry friction or events with impulses, at which derivatives "
            "jump; leave these out"));
    const std::vector<int> needed = program.needed(program.right_hand_side());
    if (std::any_of(needed.begin(), needed.end(), [&](int id) { return program[id].op == Op::sign; }))
        throw ModelError(
            say("--sensitivity: the accelerations jump where the argument of a 'sign' is zero, and derivatives "
                "with them; write a smooth function in its place"));
}

/// The derivatives of the state at the start by parameter k.
std::vector<double> start_by_parameter(const Mechanism& m, const Start& start, int k) {
    std::vector<GiNaC::ex> values = m.q_start;
    if (start.speeds.empty())
        values.insert(values.end(), m.qdot_start.begin(), m.qdot_start.end());
    else
        for (const Mechanism::Speed& speed : m.speeds) values.push_back(*speed.start);
    Program program;
    const std::vector<int> nodes = lower_expressions(program, m, values),
                           by{program.variable({Variable::Kind::parameter, k})};
    const auto parts = partials(program, nodes, by, EliminationOrder::reverse);
    const std::vector<double> value =
        interpret<double>(program, {.parameters = start.parameters, .q = {}, .qdot = {}, .qddot = {}});
    std::vector<double> column(values.size(), 0);
    for (const Partial& part : *parts)
        column[static_cast<std::size_t>(part.output)] = value[static_cast<std::size_t>(part.node)];
    return column;
}

std::vector<std::string> names_of_state(const Program& program) {
    std::vector<std::string> names;
    for (const Quantity& q : program.coordinates) names.push_back(q.name);
    for (const Quantity& q : program.speeds.empty() ? program.coordinates : program.speeds)
        names.push_back(program.speeds.empty() ? q.name + "'" : q.name);
    return names;
}

}  // namespace

Sensitivities::Sensitivities(const Derived& d, const Program& program, const Start& start,
                             const std::vector<std::string>& names)
    : start_(start), of_(names_of_state(program)), names_(names) {
    const Mechanism& m = d.mechanism;
    const Starts known(m, names);  // refuses names that cannot be set
    check_smooth_motion(m, program);
    if (!program.speeds.empty() && start.speeds.empty())
        throw ModelError(say(
            "--sensitivity: the state of these equations are speeds, and the scene gives rates at the start; give "
            "initial speeds, or choose the formalism 'lagrange'"));
    auto derivatives = derivatives_of(d, program, {.parameters = true});
    if (!derivatives)
        throw ModelError(say("the equations of this scene are too large to be differentiated, or singular"));
    program_ = std::move(derivatives->program);
    const State<double> state = state_of(start, m, d.equations);
    state_ = state.q;
    state_.insert(state_.end(), state.qdot.begin(), state.qdot.end());
    for (const std::string& name : names) {
        const auto component = std::find(of_.begin(), of_.end(), name);
        const auto parameter = std::find_if(program.parameters.begin(), program.parameters.end(),
                                            [&](const Quantity& p) { return p.name == name; });
        if (component == of_.end() && parameter == program.parameters.end())
            throw ModelError(
                say("--sensitivity: '{}' is neither a parameter nor a part of the state; expected some of: {}",
                    name, fmt::join(of_, ", ")));
        if (component != of_.end()) {
            parameters_.push_back(-1);
            columns_.emplace_back(state_.size(), 0.0);
            columns_.back()[static_cast<std::size_t>(component - of_.begin())] = 1;
        } else {
            parameters_.push_back(static_cast<int>(parameter - program.parameters.begin()));
            columns_.push_back(start_by_parameter(m, start, parameters_.back()));
        }
    }
}

Sensitivity Sensitivities::at(double end, double tolerance, long budget) const {
    const std::size_t N = state_.size(), columns = columns_.size();
    const Variation<double> variation(program_, start_.parameters, parameters_);
    const Rhs both = make_rhs(static_cast<int>(N * (1 + columns)),
                              [&](double t, const double* y, double* rate) { variation(t, y, rate, columns); });
    std::vector<double> y = state_;
    for (const std::vector<double>& column : columns_) y.insert(y.end(), column.begin(), column.end());
    const double duration = end - start_.t;
    const Trajectory motion = integrate(both, y,
                                        {.method = Method::dop853,
                                         .start = start_.t,
                                         .duration = duration,
                                         .tolerance = tolerance,
                                         .longest_step = start_.max_step,
                                         .sample = duration,
                                         .budget = budget,
                                         .when_stiff = Method::radau});
    if (motion.failure)
        throw IntegrationError(
            say("the derivatives of --sensitivity: {}", translated_from_library(motion.failure->message)),
            motion.failure->time, motion.failure->state);
    Sensitivity result{.time = end,
                       .of = of_,
                       .by = names_,
                       .values = {},
                       .steps = motion.statistics.steps,
                       .evaluations = motion.statistics.evaluations};
    const auto last = motion.final_state();
    for (std::size_t i = 0; i < N; ++i) {
        result.values.emplace_back();
        for (std::size_t c = 0; c < columns; ++c) result.values[i].push_back(last[N + c * N + i]);
    }
    return result;
}

}  // namespace alembert
