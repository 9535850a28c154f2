// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "alembert/compile.hpp"
#include "alembert/integrate.hpp"
#include "alembert/project.hpp"
#include "analysis/assemble.hpp"
#include "analysis/diagnose.hpp"
#include "commands/pipeline.hpp"
#include "commands/progress.hpp"
#include "emit/emit.hpp"

namespace alembert {

namespace {

/// How far E, E − W and h stray from their values at the start, over all accepted steps.
class Drift {
public:
    Drift(const Module& module, const std::vector<double>& par, bool with_work)
        : table_(module.table()), par_(par), with_work_(with_work) {}

    void operator()(double t, std::span<const double> state, std::span<const double> rate) {
        double energy[4], jacobi = 0;
        table_.energy(t, state.data(), rate.data(), par_.data(), energy, &jacobi);
        const double work = with_work_ ? state[table_.coordinates + table_.speeds] : 0;
        if (first_) {
            energy_start_ = energy[2];
            jacobi_start_ = jacobi;
            first_ = false;
        }
        largest_kinetic_ = std::max(largest_kinetic_, energy[0]);
        energy_ = std::max(energy_, std::abs(energy[2] - energy_start_));
        balance_ = std::max(balance_, std::abs(energy[2] - energy_start_ - work));
        jacobi_ = std::max(jacobi_, std::abs(jacobi - jacobi_start_));
    }

    double energy() const { return energy_ / scale(energy_start_); }
    double balance() const { return balance_ / scale(energy_start_); }
    double jacobi() const { return jacobi_ / scale(jacobi_start_); }

private:
    double scale(double start) const {
        const double size = std::max(std::abs(start), largest_kinetic_);
        return size > 0 ? size : 1;
    }

    const alembert_solver_table& table_;
    const std::vector<double>& par_;
    bool with_work_, first_ = true;
    double energy_start_ = 0, jacobi_start_ = 0, largest_kinetic_ = 0;
    double energy_ = 0, balance_ = 0, jacobi_ = 0;
};

std::string csv(const Trajectory& motion, const Program& program, const Module& module, const std::vector<double>& par,
                const Rhs& rhs) {
    const auto n = program.coordinates.size();
    std::vector<std::string> outputs;
    for (const Root& root : program.roots)
        if (root.group == "output") outputs.push_back(root.name);
    for (const Root& root : program.roots)
        if (root.group == "speed") outputs.push_back(root.name);
    std::string text = "t";
    for (const Quantity& q : program.coordinates) text += "," + q.name;
    for (const Quantity& q : program.coordinates) text += "," + q.name + "'";
    std::vector<double> lambda;
    for (const Root& root : program.roots)
        if (root.group == "multiplier") {
            text += "," + root.name;
            lambda.push_back(0);
        }
    text += ",energy";
    for (const std::string& name : outputs) text += "," + name;
    text += "\n";
    std::vector<double> rate(rhs.dimension), out(outputs.size());
    for (std::size_t row = 0; row < motion.rows(); ++row) {
        const double t = motion.times[row];
        const auto state = motion.state(row);
        rhs(t, state.data(), rate.data());
        double energy[4], jacobi = 0;
        module.table().energy(t, state.data(), rate.data(), par.data(), energy, &jacobi);
        module.table().outputs_at(t, state.data(), rate.data(), par.data(), out.data());
        text += fmt::format("{:.17g}", t);
        for (std::size_t i = 0; i < n; ++i) text += fmt::format(",{:.17g}", state[i]);
        for (std::size_t i = 0; i < n; ++i) text += fmt::format(",{:.17g}", rate[i]);
        module.table().multipliers_at(t, state.data(), par.data(), lambda.data());
        for (const double value : lambda) text += fmt::format(",{:.17g}", value);
        text += fmt::format(",{:.17g}", energy[2]);
        for (const double value : out) text += fmt::format(",{:.17g}", value);
        text += "\n";
    }
    return text;
}

/// The scene's wishes, those of the command line first.
Options options_of(const Request& request, const Mechanism& mechanism, const Start& start) {
    std::string method = request.method.empty() ? mechanism.run.method : request.method;
    if (method == "auto") method = start.step > 0 || request.step > 0 ? "rk4" : "dop853";
    const auto known = method_named(method);
    if (!known) throw ModelError(fmt::format("method '{}' is not supported yet; expected auto, euler, rk4, dopri5 or dop853", method));
    const auto wish = [](double asked, double scene) { return asked >= 0 ? asked : scene; };
    return {.method = *known,
            .start = start.t,
            .duration = wish(request.duration, start.duration),
            .tolerance = wish(request.tolerance, start.tolerance),
            .step = wish(request.step, start.step),
            .sample = wish(request.sample, start.sample),
            .budget = request.budget};
}

/// The state where the numbers failed.
State<double> state_at(State<double> state, const Failure& failure) {
    state.t = failure.time;
    const auto middle = failure.state.begin() + static_cast<std::ptrdiff_t>(state.q.size());
    state.q.assign(failure.state.begin(), middle);
    state.qdot.assign(middle, middle + static_cast<std::ptrdiff_t>(state.qdot.size()));
    return state;
}

}  // namespace

int simulate(const Request& request) {
    const Derived d = derived(request);
    if (!d.mechanism.unilateral.empty())
        throw ModelError(fmt::format("simulate does not follow [[unilateral]] '{}' yet", d.mechanism.unilateral[0].gap.name));
    if (!d.mechanism.impulses.empty())
        std::cerr << fmt::format("{}: the motion starts with the rates before the scene's impulses; 'alembert impact' gives those after\n",
                                 request.scene);
    double clock = process_seconds();
    const auto lap = [&clock] {
        const double before = clock;
        clock = process_seconds();
        return clock - before;
    };
    const Energy energy = energy_of(d.mechanism);
    const Program program = lowered(d, request).program;
    Start start = start_of(d.mechanism);
    const std::vector<std::string> moved = assemble(start, d.mechanism, lower_constraints(d.mechanism), {});
    const State<double> first = state_of(start, d.mechanism, d.equations);
    const Options wishes = options_of(request, d.mechanism, start);
    if (program.singular || massless_combination(program, first))
        throw IntegrationError(fmt::format("there are no finite accelerations at t = {:.6g}: {}", start.t,
                                           failure_at(d, first).value_or("the mass matrix is singular")),
                               start.t, start.q);
    const Source source = emit(program);
    const double emit_seconds = lap();
    const Compiled compiled = compile(source.text, program.name, {.compiler = {}, .extra_flags = {}, .fast_math = request.fast_math, .cache = {}});
    const Module module = load(compiled.object);
    const double compile_seconds = lap();

    const int n = d.mechanism.size();
    const bool balance = !energy.conserved;
    const Rhs rhs = make_rhs(module, start.parameters, balance ? Work::integrated : Work::left_out);
    const std::vector<double> par = prepared(module, start.parameters);
    std::vector<double> initial = start.q;
    initial.insert(initial.end(), first.qdot.begin(), first.qdot.end());
    if (balance) initial.push_back(0);
    Drift drift(module, par, balance);
    Options options = wishes;
    Projection projection(module, start.parameters);
    double constraint_drift = 0;
    if (!d.mechanism.constraints.empty()) {
        projection(start.t, initial.data());
        options.project = std::ref(projection);
    }
    Progress progress("integrating");
    options.on_step = [&](double t, std::span<const double> state, std::span<const double> rate) {
        drift(t, state, rate);
        if (options.project) constraint_drift = std::max(constraint_drift, projection.residual(t, state.data()));
        progress.at((t - options.start) / options.duration);
    };
    const Trajectory motion = integrate(rhs, initial, options, make_events(module, start.parameters, d.mechanism.event_stops));
    const double integrate_seconds = lap();

    if (!request.output.empty()) write_file(request.output, csv(motion, program, module, par, rhs));
    const auto end = motion.final_state();
    std::vector<double> end_rate(end.size());
    rhs(motion.times.back(), end.data(), end_rate.data());
    Json result;
    result["final"] = {{"time", motion.times.back()},
                       {"coordinates", by_coordinate(program, end.data())},
                       {"rates", by_coordinate(program, end_rate.data())}};
    for (std::size_t k = 0; k < program.speeds.size() && !d.mechanism.speeds.empty(); ++k)
        result["final"]["speeds"][program.speeds[k].name] = end[n + k];
    result["method"] = motion.statistics.method;
    result["formulation"] = source.formulation;
    result["steps"] = motion.statistics.steps;
    result["rejected"] = motion.statistics.rejected;
    result["evaluations"] = motion.statistics.evaluations;
    result["energy_drift"] = energy.conserved ? Json(drift.energy()) : Json(nullptr);
    if (balance) result["work_balance"] = drift.balance();
    if (balance && energy.jacobi_conserved) result["jacobi_drift"] = drift.jacobi();
    result["constraint_drift"] = constraint_drift;
    if (!moved.empty()) result["adjusted"] = moved;
    result["events"] = Json::array();
    for (const EventRecord& event : motion.events)
        result["events"].push_back({{"name", d.mechanism.events[event.index].label}, {"time", event.time}});
    result["seconds"] = {{"derive", d.seconds}, {"emit", emit_seconds}, {"compile", compile_seconds}, {"integrate", integrate_seconds}};
    result["completed"] = motion.ending != Ending::failed;
    if (request.json) {
        std::cout << result.dump(2) << "\n";
    } else {
        fmt::print("{} with {}: {} steps, {} rejected, {} evaluations of {} operations\n", source.formulation,
                   motion.statistics.method, motion.statistics.steps, motion.statistics.rejected,
                   motion.statistics.evaluations, source.operations.total());
        for (const auto& event : result["events"])
            fmt::print("event {} at t = {:.15g}\n", event["name"].get<std::string>(), event["time"].get<double>());
        fmt::print("\nat t = {:.15g}\n", motion.times.back());
        for (int i = 0; i < n; ++i)
            fmt::print("{:<16}{:>24.16g}   rate {:>24.16g}\n", program.coordinates[i].name, end[i], end_rate[i]);
        for (std::size_t k = 0; k < program.speeds.size() && !d.mechanism.speeds.empty(); ++k)
            fmt::print("{:<16}{:>24.16g}\n", program.speeds[k].name, end[n + k]);
        if (energy.conserved) fmt::print("\nenergy drift {:.2e}\n", drift.energy());
        if (balance) fmt::print("\nenergy is not conserved; work balance {:.2e}\n", drift.balance());
        if (balance && energy.jacobi_conserved) fmt::print("T2 - T0 + V is; its drift {:.2e}\n", drift.jacobi());
        if (options.project) fmt::print("constraint drift {:.2e}\n", constraint_drift);
        for (const std::string& line : moved) fmt::print("adjusted at the start: {}\n", line);
        fmt::print("seconds: derive {:.4f}, emit {:.4f}, compile {:.4f}{}, integrate {:.4f}\n", d.seconds, emit_seconds,
                   compile_seconds, compiled.from_cache ? " (cached)" : "", integrate_seconds);
        if (!request.output.empty()) fmt::print("wrote {}\n", request.output);
    }
    if (motion.failure) {
        const auto reason = failure_at(d, state_at(first, *motion.failure));
        throw IntegrationError(motion.failure->message + (reason ? "\n  there: " + *reason : ""), motion.failure->time,
                               motion.failure->state);
    }
    return 0;
}

}  // namespace alembert
