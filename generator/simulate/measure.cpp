// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/measure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "alembert/base/process_time.hpp"
#include "model/formalism/routhian.hpp"
#include "model/formalism/with_states.hpp"
#include "program/interpret.hpp"
#include "program/lower/lower.hpp"
#include "simulate/method.hpp"

namespace alembert {

std::vector<double> coordinates_and_rates(const Rhs& rhs, double t, const double* state, std::size_t n) {
    std::vector<double> rate(static_cast<std::size_t>(rhs.dimension)), result(state, state + n);
    rhs(t, state, rate.data());
    result.insert(result.end(), rate.begin(), rate.begin() + static_cast<std::ptrdiff_t>(n));
    return result;
}

double error_against(const std::vector<double>& reference, const std::vector<double>& y) {
    double largest = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        const double error = std::abs(y[i] - reference[i]) / std::max(1.0, std::abs(reference[i]));
        if (!std::isfinite(error)) return HUGE_VAL;
        largest = std::max(largest, error);
    }
    return largest;
}

Workbench::Workbench(Parts parts)
    : parts_(std::move(parts)),
      par_(prepared(parts_.module, parts_.parameters)),
      rhs_(make_rhs(parts_.module, parts_.parameters)),
      with_work_(make_rhs(parts_.module, parts_.parameters, Work::integrated)),
      projection_(parts_.module, parts_.parameters) {
    if (parts_.series) rhs_.series = make_series(parts_.series, parts_.parameters);
    if (parts_.series_with_work) with_work_.series = make_series(parts_.series_with_work, parts_.parameters);
    rhs_.effort = with_work_.effort = parts_.effort;
    rhs_.slowness = with_work_.slowness = parts_.slowness;
    rhs_.canonical = with_work_.canonical = parts_.canonical;
    const Mechanism& m = parts_.derived.mechanism;
    if (!m.constraints.empty())
        for (Rhs* const rhs : {&rhs_, &with_work_}) *rhs = projection_.guarded(std::move(*rhs), parts_.parameters);
    if (!m.constraints.empty()) return;  // the forces of constraints change the momenta
    const std::vector<int> cyclic = cyclic_coordinates(m);
    if (cyclic.empty()) return;
    const std::vector<GiNaC::ex> p = m.z->pull_back({{m.lagrangian(), 1}}, m.qdot);
    std::vector<GiNaC::ex> wanted;
    for (const int i : cyclic) wanted.push_back(p[static_cast<std::size_t>(i)]);
    momentum_nodes_ = lower_expressions(momentum_program_, m, wanted);
}

std::vector<double> Workbench::momenta(double t, const double* state, const Rhs& rhs) {
    const std::size_t n = parts_.derived.mechanism.q.size();
    std::vector<double> now = coordinates_and_rates(rhs, t, state, n);
    const std::size_t all = parts_.initial.size();
    now.insert(now.end(), state + first_state(all, parts_.derived.mechanism), state + all);
    const auto middle = now.begin() + static_cast<std::ptrdiff_t>(n);
    const std::vector<double> values = interpret<double>(momentum_program_, {.parameters = parts_.parameters,
                                                                             .t = t,
                                                                             .q = {now.begin(), middle},
                                                                             .qdot = {middle, now.end()},
                                                                             .qddot = {}});
    std::vector<double> result;
    for (const int id : momentum_nodes_) result.push_back(values[static_cast<std::size_t>(id)]);
    return result;
}

System Workbench::able(const Rhs& rhs) {
    System result{.rhs = rhs, .quick_times = parts_.quick_times, .quick_places = parts_.quick_places};
    if (!parts_.derived.mechanism.constraints.empty()) result.project = projection_.after_steps();
    return result;
}

Measured Workbench::measure(Options options, const std::vector<Method>& rivals) {
    options.sample = options.duration > 0 ? options.duration : 1;
    const System alone = able(rhs_);
    const Options given = options;
    Measured result;
    (has_fixed_step(options.method) ? result.step : result.tolerance) =
        has_fixed_step(options.method) ? options.step : options.tolerance;
    std::vector<double> seconds;
    double sum = 0;
    Trajectory motion;
    do {
        const double before = thread_seconds();
        options = given;
        if (!rivals.empty()) choose(options, alone, rivals);
        const double tried = thread_seconds() - before;
        projection_.begin(options.start, parts_.initial.data());
        motion = integrate(alone, parts_.initial, options);
        seconds.push_back(tried + motion.statistics.seconds);
        sum += seconds.back();
    } while (seconds.size() < 200 && sum < 0.3 && (seconds.size() < 3 || sum < 0.02));
    std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2),
                     seconds.end());
    result.method = std::string(name(options.method));
    result.seconds = seconds[seconds.size() / 2];
    result.evaluations = motion.statistics.evaluations;
    result.steps = motion.statistics.steps;
    const Statistics& done = motion.statistics;
    if (done.switched)
        result.went_on = (done.later_switches.empty() ? *done.switched : done.later_switches.back()).method;
    if (motion.failure) {
        result.failure = motion.failure->message;
        result.budget_used_up = motion.failure->kind == FailureKind::budget_used_up;
        return result;
    }
    const std::size_t n = parts_.derived.mechanism.q.size();
    const double end = motion.times.back();
    if (!parts_.reference.empty())
        result.error =
            error_against(parts_.reference, coordinates_and_rates(rhs_, end, motion.final_state().data(), n));
    if (!momentum_nodes_.empty())
        result.momentum_error = error_against(momenta(options.start, parts_.initial.data(), rhs_),
                                              momenta(end, motion.final_state().data(), rhs_));
    kept(options, result);
    return result;
}

void Workbench::choose(Options& options, const System& system, const std::vector<Method>& rivals) {
    const auto trial = method_trial(system, parts_.initial, options, rivals,
                                    {.begin = [&] { projection_.begin(options.start, parts_.initial.data()); }});
    if (!trial || trial->fastest == options.method) return;
    const MethodChoice choice = after_trial({.method = options.method}, *trial);
    options.method = choice.method;
    options.when_stuck = choice.when_stuck;
    options.when_cheaper = choice.when_cheaper;
}

void Workbench::kept(const Options& given, Measured& result) {
    Options options = given;
    const bool work = !parts_.conserved, constrained = !parts_.derived.mechanism.constraints.empty();
    const alembert_solver_table& table = parts_.module.table();
    EnergyError energy_error(table.coordinates, table.speeds, work);
    double constraint = 0;
    options.on_step = [&](double t, std::span<const double> state, std::span<const double> rate) {
        energy_error(table, par_, t, state, rate);
        if (constrained) constraint = std::max(constraint, projection_.residual(t, state.data()));
    };
    std::vector<double> initial = parts_.initial;
    if (work) initial.push_back(0);
    projection_.begin(options.start, parts_.initial.data());
    if (integrate(able(work ? with_work_ : rhs_), initial, options).failure) return;
    result.energy_drift = work ? energy_error.balance() : energy_error.energy();
    result.work = work;
    if (constrained) result.constraint_error = constraint;
}

std::optional<std::vector<double>> Workbench::end_of(const Options& given) {
    Options options = given;
    options.sample = options.duration > 0 ? options.duration : 1;
    projection_.begin(options.start, parts_.initial.data());
    const Trajectory motion = integrate(able(rhs_), parts_.initial, options);
    if (motion.failure) return std::nullopt;
    return coordinates_and_rates(rhs_, motion.times.back(), motion.final_state().data(),
                                 parts_.derived.mechanism.q.size());
}

}  // namespace alembert
