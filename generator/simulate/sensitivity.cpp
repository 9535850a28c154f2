// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "alembert/base/error.hpp"
#include "alembert/ode/integrate.hpp"
#include "analysis/state/start_derivatives.hpp"
#include "base/language/libraries.hpp"
#include "base/language/say.hpp"
#include "program/event_code.hpp"
#include "program/jump_watch.hpp"
#include "program/lower/quick_times.hpp"
#include "program/variation.hpp"

namespace alembert {

namespace {

void check_smooth_motion(const Mechanism& m) {
    if (!m.redundant.empty())
        throw ModelError(
            say("--sensitivity: constraint '{}' follows from the others at these values, and would not at others; "
                "leave "
                "it out",
                m.redundant[0].name));
    if (const std::string why = Saltation::obstacle(m); !why.empty())
        throw ModelError(say("--sensitivity: {}; leave these out", why));
}

/// Coordinates, then rates or speeds.
std::vector<std::string> names_of_state(const Program& program) {
    std::vector<std::string> names;
    for (const Quantity& q : program.coordinates) names.push_back(q.name);
    for (const Quantity& q : program.speeds.empty() ? program.coordinates : program.speeds)
        names.push_back(program.speeds.empty() ? q.name + "'" : q.name);
    return names;
}

std::optional<StartName> start_name(const Mechanism& m, const Program& program, const std::string& name) {
    const auto at = [&](const auto& list, const auto& name_of) -> std::optional<std::size_t> {
        for (std::size_t i = 0; i < list.size(); ++i)
            if (name_of(list[i]) == name) return i;
        return std::nullopt;
    };
    using Kind = StartName::Kind;
    if (const auto i = at(program.parameters, [](const Quantity& p) { return p.name; }))
        return StartName{name, Kind::parameter, *i};
    if (const auto i = at(m.q, [](const auto& q) { return q.get_name(); }))
        return StartName{name, Kind::coordinate, *i};
    if (const auto i = at(m.q, [](const auto& q) { return q.get_name() + "'"; }))
        return StartName{name, Kind::rate, *i};
    if (const auto i = at(m.speeds, [](const Mechanism::Speed& s) { return s.u.get_name(); }))
        return StartName{name, Kind::speed, *i};
    if (const auto i = at(m.states, [](const Mechanism::State& z) { return z.derivative[0].get_name(); }))
        return StartName{name, Kind::state, *i};
    return std::nullopt;
}

}  // namespace

Sensitivities::Sensitivities(const Derived& d, const Program& program, const Start& start,
                             const std::vector<std::string>& names, const std::vector<std::string>& of)
    : start_(start), names_(names) {
    const Mechanism& m = d.mechanism;
    const Starts known(m, names);  // refuses names that cannot be set
    check_smooth_motion(m);
    find_wanted(program, of);
    const State<double> state = state_of(start, m, d.equations);
    state_ = state.q;
    state_.insert(state_.end(), state.qdot.begin(), state.qdot.end());
    std::vector<StartName> found;
    for (const std::string& name : names) {
        const std::optional<StartName> one = start_name(m, program, name);
        if (!one)
            throw ModelError(
                say("--sensitivity: '{}' is neither a parameter nor a part of the state; expected some of: {}",
                    name, fmt::join(names_of_state(program), ", ")));
        found.push_back(*one);
        parameters_.push_back(one->kind == StartName::Kind::parameter ? static_cast<int>(one->index) : -1);
    }
    const bool outputs = std::any_of(components_.begin(), components_.end(), [](int k) { return k < 0; });
    const DerivativeWishes wishes{.parameters = true, .values = outputs};
    if (HybridVariation::is_needed(m, program, parameters_)) {
        hybrid_.emplace(d, program, parameters_, start, wishes);
        program_ = hybrid_->program();
    } else {
        auto derivatives = derivatives_of(d, program, wishes);
        if (!derivatives)
            throw ModelError(say("the equations of this scene are too large to be differentiated, or singular"));
        program_ = std::move(derivatives->program);
    }
    columns_ = start_derivatives(m, d.equations, start, found);
}

void Sensitivities::find_wanted(const Program& program, const std::vector<std::string>& of) {
    const std::vector<std::string> state = names_of_state(program);
    std::vector<std::string> outputs;
    for (const Root& root : program.roots)
        if (root.group == Group::output) outputs.push_back(root.name);
    of_ = of.empty() ? state : of;
    for (const std::string& name : of_) {
        const auto component = std::find(state.begin(), state.end(), name);
        const auto output = std::find(outputs.begin(), outputs.end(), name);
        if (component == state.end() && output == outputs.end()) {
            std::vector<std::string> known = state;
            known.insert(known.end(), outputs.begin(), outputs.end());
            throw ModelError(
                say("--sensitivity-of: '{}' is neither a part of the state nor an output; expected some of: {}",
                    name, fmt::join(known, ", ")));
        }
        components_.push_back(component != state.end() ? static_cast<int>(component - state.begin())
                                                       : ~static_cast<int>(output - outputs.begin()));
    }
}

// The rows of value_gradient are those of energies and power, then of outputs; their entries are those by the
// state, by u', and by parameters.
Sensitivities::AtEnd Sensitivities::at_end(double t, std::span<const double> state,
                                           const std::vector<double>& parameters) const {
    const std::size_t N = state_.size(), n = program_.coordinates.size(), s = N - n,
                      P = program_.parameters.size();
    AtEnd result;
    const std::vector<double> value =
        interpret<double>(program_, {.parameters = parameters,
                                     .t = t,
                                     .q = {state.begin(), state.begin() + static_cast<std::ptrdiff_t>(n)},
                                     .qdot = {state.begin() + static_cast<std::ptrdiff_t>(n), state.end()},
                                     .qddot = {}});
    const auto at = [&](const std::vector<int>& nodes, std::size_t k) {
        return value[static_cast<std::size_t>(nodes[k])];
    };
    const std::vector<int> gradient = program_.nodes_of(Group::value_gradient),
                           J = program_.nodes_of(Group::jacobian),
                           by_parameters = program_.nodes_of(Group::parameter_jacobian);
    std::size_t before = 0;
    for (const Group group : {Group::kinetic, Group::potential, Group::energy, Group::power})
        before += program_.nodes_of(group).size();
    for (const int component : components_) {
        std::vector<double> by_state(N, 0), by_name(names_.size(), 0);
        if (component >= 0) by_state[static_cast<std::size_t>(component)] = 1;
        const std::size_t row = component >= 0 ? 0 : (before + static_cast<std::size_t>(~component)) * (N + s + P);
        for (std::size_t k = 0; k < N && component < 0; ++k) {
            by_state[k] = at(gradient, row + k);
            for (std::size_t i = 0; i < s; ++i) by_state[k] += at(gradient, row + N + i) * at(J, (n + i) * N + k);
        }
        for (std::size_t c = 0; c < names_.size() && component < 0; ++c) {
            if (parameters_[c] < 0) continue;
            const auto p = static_cast<std::size_t>(parameters_[c]);
            by_name[c] = at(gradient, row + N + s + p);
            for (std::size_t i = 0; i < s; ++i)
                by_name[c] += at(gradient, row + N + i) * at(by_parameters, (n + i) * P + p);
        }
        result.by_state.push_back(std::move(by_state));
        result.by_name.push_back(std::move(by_name));
    }
    return result;
}

Sensitivity Sensitivities::at(double end, const SensitivityOptions& options) const {
    if (2 * of_.size() <= names_.size() && end > start_.t && options.sample == 0 && !hybrid_)
        if (auto found = backwards(end, options)) return *found;
    return hybrid_ ? through_instants(end, options) : forwards(end, options);
}

namespace {

/// Tells of the progress after each thousand evaluations.
class Teller {
public:
    Teller(const SensitivityOptions& options, double start, double duration)
        : options_(options), start_(start), duration_(duration) {}
    void tell(double t) {
        if (options_.progress && ++calls_ % 1000 == 0)
            options_.progress(say("the derivatives"), (t - start_) / duration_);
    }

private:
    const SensitivityOptions& options_;
    double start_, duration_;
    long calls_ = 0;
};

/// The system in the time `from` − t.
System reversed(const System& forwards, Rhs back, double from) {
    System result{.rhs = std::move(back), .quick_places = forwards.quick_places};
    for (auto q = forwards.quick_times.rbegin(); q != forwards.quick_times.rend(); ++q)
        result.quick_times.push_back({.from = from - q->to,
                                      .to = from - q->from,
                                      .enter = q->enter,
                                      .step = q->step,
                                      .is_switch = q->is_switch});
    return result;
}

}  // namespace

/// Forwards, with the state before all else in it.
System Sensitivities::watched(Rhs rhs, double end) const {
    return {.rhs = std::move(rhs),
            .quick_times = quick_times(program_, start_.parameters, start_.t, end),
            .quick_places = {quick_places_code(program_, Kinks::watched), start_.parameters}};
}

OnStep Sensitivities::for_jumps() const {
    auto watch = std::make_shared<JumpWatch>(program_, start_.parameters);
    return [watch](double t, std::span<const double> y, std::span<const double>) { (*watch)(t, y.data()); };
}

Trajectory Sensitivities::integrated(const System& system, const std::vector<double>& start,
                                     Options options) const {
    options.method = Method::dop853;
    options.longest_step = start_.max_step;
    options.when_stiff = Method::radau;
    Trajectory motion = integrate(system, start, options);
    if (motion.failure)
        throw IntegrationError(
            say("the derivatives of --sensitivity: {}", translated_from_library(motion.failure->message)),
            motion.failure->time, motion.failure->state);
    return motion;
}

std::vector<std::vector<double>> Sensitivities::values_at(double t, std::span<const double> y,
                                                          const std::vector<double>& parameters) const {
    const std::size_t N = state_.size();
    const AtEnd wanted = at_end(t, y.first(N), parameters);
    std::vector<std::vector<double>> values = wanted.by_name;
    for (std::size_t i = 0; i < of_.size(); ++i)
        for (std::size_t c = 0; c < columns_.size(); ++c)
            for (std::size_t k = 0; k < N; ++k) values[i][c] += wanted.by_state[i][k] * y[N + c * N + k];
    return values;
}

Sensitivity Sensitivities::forwards(double end, const SensitivityOptions& options) const {
    const std::size_t N = state_.size(), columns = columns_.size();
    const Variation<double> variation(program_, start_.parameters, parameters_);
    const double duration = end - start_.t;
    Teller teller(options, start_.t, duration);
    Rhs both = make_rhs(static_cast<int>(N * (1 + columns)), [&](double t, const double* y, double* rate) {
        teller.tell(t);
        variation(t, y, rate, columns);
    });
    both.names = names_of_all();
    const Trajectory motion = integrated(watched(both, end), at_start(),
                                         {.start = start_.t,
                                          .duration = duration,
                                          .tolerance = options.tolerance,
                                          .sample = options.sample > 0 ? options.sample : duration,
                                          .budget = options.budget,
                                          .on_step = for_jumps()});
    Sensitivity result{.time = end,
                       .of = of_,
                       .by = names_,
                       .values = values_at(end, motion.final_state(), start_.parameters),
                       .steps = motion.statistics.steps,
                       .evaluations = motion.statistics.evaluations};
    for (std::size_t k = 0; k < motion.rows() && options.sample > 0; ++k) {
        result.times.push_back(motion.times[k]);
        result.rows.push_back(values_at(motion.times[k], motion.state(k), start_.parameters));
    }
    return result;
}

Sensitivity Sensitivities::through_instants(double end, const SensitivityOptions& options) const {
    constexpr double at_once = 1e-10;  // of the run
    const double same = at_once * std::max({1.0, std::abs(start_.t), std::abs(end)});
    HybridVariation variation = *hybrid_;
    Teller teller(options, start_.t, end - start_.t);
    const HybridVariation::Wishes wishes{.tolerance = options.tolerance,
                                         .budget = options.budget,
                                         .longest_step = start_.max_step,
                                         .names = names_of_all(),
                                         .tell = [&](double t) { teller.tell(t); }};
    std::vector<double> y = at_start();
    variation.begin(options.instants, start_.t, y, wishes);
    for (const JumpInstant& one : variation.instants())
        if (end - one.time <= same)
            throw IntegrationError(
                say("--sensitivity: '{}' happens at the end, t = {:.6g}, where derivatives jump; "
                    "end the motion before or after it",
                    one.name, one.time),
                one.time, state_);
    Sensitivity result{.time = end, .of = of_, .by = names_, .values = {}};
    const auto row = [&](double t) {
        result.times.push_back(t);
        result.rows.push_back(values_at(t, y, variation.parameters()));
    };
    double now = start_.t;
    if (options.sample > 0) row(now);
    for (long k = 1; options.sample > 0; ++k) {
        const double next = start_.t + static_cast<double>(k) * options.sample;
        if (!(end - next > same)) break;
        variation.go(now, next, y, wishes);
        row(now = next);
    }
    variation.go(now, end, y, wishes);
    if (options.sample > 0) row(end);
    result.values = values_at(end, y, variation.parameters());
    result.steps = variation.steps();
    result.evaluations = variation.evaluations();
    return result;
}

/// The state, then the columns.
std::vector<double> Sensitivities::at_start() const {
    std::vector<double> y = state_;
    for (const std::vector<double>& column : columns_) y.insert(y.end(), column.begin(), column.end());
    return y;
}

std::vector<std::string> Sensitivities::names_of_all() const {
    const std::vector<std::string> state = names_of_state(program_);
    std::vector<std::string> names = state;
    for (const std::string& name : names_)
        for (const std::string& of : state) names.push_back(fmt::format("d({})/d({})", of, name));
    return names;
}

/// Nothing for a stiff motion, which cannot be run backwards.
std::optional<Sensitivity> Sensitivities::backwards(double end, const SensitivityOptions& wishes) const {
    constexpr long steps_between_rows = 8;
    const std::size_t N = state_.size(), columns = columns_.size(), rows = of_.size();
    const Variation<double> variation(program_, start_.parameters, parameters_);
    const double duration = end - start_.t;
    Teller teller(wishes, start_.t, 3 * duration);  // there twice, and back
    Rhs alone = make_rhs(static_cast<int>(N), [&](double t, const double* y, double* rate) {
        teller.tell(t);
        variation(t, y, rate, 0);
    });
    const std::vector<std::string> state = names_of_state(program_);
    alone.names = state;
    Options options{.start = start_.t,
                    .duration = duration,
                    .tolerance = wishes.tolerance,
                    .sample = duration,
                    .budget = wishes.budget,
                    .on_step = for_jumps()};
    const System forwards = watched(alone, end);
    const Statistics counted = integrated(forwards, state_, options).statistics;
    options.on_step = {};
    if (counted.switched) return std::nullopt;
    options.sample = duration / static_cast<double>(1 + counted.steps / steps_between_rows);
    const Trajectory motion = integrated(forwards, state_, options);
    const AtEnd wanted = at_end(end, motion.final_state(), start_.parameters);

    Sensitivity result{.time = end,
                       .of = of_,
                       .by = names_,
                       .values = wanted.by_name,
                       .adjoint = true,
                       .steps = counted.steps + motion.statistics.steps,
                       .evaluations = counted.evaluations + motion.statistics.evaluations};
    std::vector<double> y(N);
    for (const std::vector<double>& row : wanted.by_state) {
        y.insert(y.end(), row.begin(), row.end());
        y.insert(y.end(), columns, 0.0);
    }
    std::vector<std::string> names = state;
    for (const std::string& of : of_)
        for (const auto* by : {&state, &names_})
            for (const std::string& name : *by) names.push_back(fmt::format("d({})/d({})", of, name));
    for (std::size_t k = motion.rows() - 1; k > 0; --k) {
        const double from = motion.times[k];
        std::copy(motion.state(k).begin(), motion.state(k).end(), y.begin());
        Rhs back = make_rhs(static_cast<int>(y.size()), [&](double s, const double* now, double* rate) {
            teller.tell(end + 2 * (end - from));
            variation.backwards(from - s, now, rate, rows);
        });
        back.names = names;
        const double length = from - motion.times[k - 1];
        const Trajectory piece = integrated(reversed(forwards, back, from), y,
                                            {.duration = length,
                                             .tolerance = wishes.tolerance,
                                             .sample = length,
                                             .budget = std::max(1L, wishes.budget - result.evaluations)});
        y.assign(piece.final_state().begin(), piece.final_state().end());
        result.steps += piece.statistics.steps;
        result.evaluations += piece.statistics.evaluations;
    }
    for (std::size_t i = 0; i < rows; ++i) {
        const double* const w = y.data() + N + i * (N + columns);
        for (std::size_t c = 0; c < columns; ++c) {
            result.values[i][c] += w[N + c];
            for (std::size_t k = 0; k < N; ++k) result.values[i][c] += w[k] * columns_[c][k];
        }
    }
    return result;
}

}  // namespace alembert
