// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <tuple>

#include "alembert/compile.hpp"
#include "analysis/assemble.hpp"
#include "analysis/diagnose.hpp"
#include "analysis/reference.hpp"
#include "commands/output.hpp"
#include "commands/bounces.hpp"
#include "commands/canonical.hpp"
#include "commands/measure.hpp"
#include "commands/modes.hpp"
#include "commands/peers.hpp"
#include "commands/progress.hpp"
#include "commands/separable.hpp"
#include "emit/emit.hpp"
#include "emit/taylor.hpp"
#include "report/work_precision.hpp"

namespace alembert {

namespace {

constexpr double most_seconds = 2;    // of one run; a method goes no further when a run has taken that
constexpr int first_decade = 3, last_decade = 14;
constexpr double floor_of_doubles = 1e-15;

/// The end in double precision by two methods, where there is no better one; the digits in which they agree.
struct Judge {
    std::vector<double> final;  ///< coordinates, then rates
    int digits = 0;
    std::string by;
};

std::optional<Judge> by_doubles(Workbench& bench, const Options& options) {
    // Stiff systems are for the second pair.
    for (const auto& [one, other, tolerance] : {std::tuple{Method::verner98, Method::dop853, 1e-14}, std::tuple{Method::radau13, Method::radau9, 1e-13}}) {
        Options strict = options;
        strict.tolerance = tolerance;
        strict.method = one;
        const auto first = bench.end_of(strict);
        strict.method = other;
        const auto second = first ? bench.end_of(strict) : std::nullopt;
        if (!second) continue;
        const double apart = std::max(error_against(*first, *second), 1e-16);
        return Judge{*first, std::max(0, static_cast<int>(std::floor(-std::log10(apart)))),
                     fmt::format("{} and {} at tolerance {:g}, doubles: no better reference in the time given", name(one), name(other), tolerance)};
    }
    return std::nullopt;
}

/// Runs of one method, from loose to strict, as long as it pays.
std::vector<Measured> ladder(Workbench& bench, Options options, double each, long guess, const std::function<void(double)>& progress) {
    std::vector<Measured> runs;
    const long budget = options.budget;
    options.budget = std::min(budget, static_cast<long>(most_seconds / each) + 1000);
    double best = HUGE_VAL;
    int worse = 0;
    for (int k = 0; k < 24; ++k) {
        progress(k / 24.0);
        if (has_fixed_step(options.method)) {
            options.step = options.duration / (static_cast<double>(guess) * std::ldexp(1.0, k));
        } else {
            if (k > last_decade - first_decade) break;
            options.tolerance = std::pow(10.0, -first_decade - k);
        }
        runs.push_back(bench.measure(options));
        const Measured& last = runs.back();
        if (!has_fixed_step(options.method)) {
            if (!last.failure.empty() || last.seconds > most_seconds / 2) break;
            continue;
        }
        if (last.failure.find("not enough") != std::string::npos || last.seconds > most_seconds / 4) break;
        if (!last.failure.empty() || !last.error) continue;
        if (*last.error < 1e-13) break;
        worse = *last.error > best / 1.5 && *last.error < 1e-6 ? worse + 1 : 0;  // rounding has the word
        if (worse > 1) break;
        best = std::min(best, *last.error);
    }
    return runs;
}

Json as_json(const Measured& run) {
    const auto optional = [](const std::optional<double>& value) { return value && std::isfinite(*value) ? Json(*value) : Json(nullptr); };
    Json one{{"who", run.who}, {"method", run.method}, {"tolerance", optional(run.tolerance)}};
    if (run.step) one["step"] = *run.step;
    one["error"] = optional(run.error);
    one["seconds"] = run.seconds;
    one["evaluations"] = run.evaluations;
    one["steps"] = run.steps;
    one["energy_drift"] = run.work ? Json(nullptr) : optional(run.energy_drift);
    if (run.work) one["work_balance"] = optional(run.energy_drift);
    one["constraint_error"] = optional(run.constraint_error);
    one["momentum_error"] = optional(run.momentum_error);
    if (!run.failure.empty()) one["failure"] = run.failure;
    return one;
}

std::string csv(const std::vector<Measured>& runs) {
    const auto cell = [](const std::optional<double>& value) { return value ? fmt::format("{:.6g}", *value) : std::string(); };
    std::string text = "who,method,tolerance,step,error,seconds,evaluations,steps,energy_drift,constraint_error,momentum_error\n";
    for (const Measured& run : runs)
        text += fmt::format("{},{},{},{},{},{:.6g},{},{},{},{},{}\n", run.who, run.method, cell(run.tolerance), cell(run.step), cell(run.error),
                            run.seconds, run.evaluations, run.steps, cell(run.energy_drift), cell(run.constraint_error), cell(run.momentum_error));
    return text;
}

std::vector<Curve> curves_of(const std::vector<Measured>& runs) {
    std::vector<Curve> list;
    for (const Measured& run : runs) {
        if (!run.error) continue;
        const bool peer = run.who != "alembert";
        const std::string name = peer ? run.who + " " + run.method : run.method;
        if (list.empty() || list.back().name != name) list.push_back({.name = name, .dashed = peer, .points = {}});
        list.back().points.emplace_back(std::max(*run.error, floor_of_doubles), run.seconds);
    }
    return list;
}

/// The fastest run of each party at each error.
void print_best(const std::vector<Measured>& runs) {
    fmt::print("\nfastest to an error of at most\n");
    for (int decade = 3; decade <= 13; ++decade) {
        std::map<bool, const Measured*> best;
        for (const Measured& run : runs) {
            if (!run.error || *run.error > std::pow(10.0, -decade)) continue;
            const Measured*& place = best[run.who == "alembert"];
            if (place == nullptr || run.seconds < place->seconds) place = &run;
        }
        if (best.empty()) continue;
        std::string line = fmt::format("  1e-{:<3}", decade);
        for (const bool ours : {true, false})
            if (best[ours] != nullptr)
                line += fmt::format("  {:>24} {:>11.1f} us", ours ? best[ours]->method : best[ours]->who + " " + best[ours]->method, 1e6 * best[ours]->seconds);
        if (best[true] != nullptr && best[false] != nullptr) line += fmt::format("   ratio {:.2f}", best[true]->seconds / best[false]->seconds);
        fmt::print("{}\n", line);
    }
}

void print(const std::vector<Measured>& runs) {
    fmt::print("{:<22}{:>11}{:>11}{:>13}{:>12}{:>9}{:>11}{:>11}{:>11}\n", "method", "tolerance", "error", "time us", "evaluations", "steps", "energy",
               "constraint", "momentum");
    const auto cell = [](const std::optional<double>& value) { return value ? fmt::format("{:.1e}", *value) : std::string("-"); };
    for (const Measured& run : runs) {
        const std::string name = run.who == "alembert" ? run.method : run.who + " " + run.method;
        const std::string given = run.step ? fmt::format("h {:.1e}", *run.step) : cell(run.tolerance);
        fmt::print("{:<22}{:>11}{:>11}{:>13.1f}{:>12}{:>9}{:>11}{:>11}{:>11}\n", name, given, run.failure.empty() ? cell(run.error) : "failed", 1e6 * run.seconds,
                   run.evaluations, run.steps, cell(run.energy_drift), cell(run.constraint_error), cell(run.momentum_error));
    }
}

Json reference_json(const std::optional<Reference>& exact, const Judge& judge, const Program& program, double end) {
    const std::size_t n = program.coordinates.size();
    Json result;
    result["final"] = {{"time", end}, {"coordinates", by_coordinate(program, judge.final.data())}, {"rates", by_coordinate(program, judge.final.data() + n)}};
    result["digits"] = judge.digits;
    result["by"] = judge.by;
    if (exact) {
        for (std::size_t i = 0; i < n; ++i) {
            result["text"]["coordinates"][program.coordinates[i].name] = text(exact->coordinates[i], 30);
            result["text"]["rates"][program.coordinates[i].name] = text(exact->rates[i], 30);
        }
        for (std::size_t i = 0; i < exact->speeds.size(); ++i) result["text"]["speeds"][program.speeds[i].name] = text(exact->speeds[i], 30);
    }
    return result;
}

/// What there is to show.
struct Findings {
    std::optional<Reference> exact;
    Judge judge;
    const Program& program;
    std::string formulation;
    int operations;
    double end;
    std::vector<Measured> runs;
};

void deliver(const Request& request, const Derived& d, const Findings& f) {
    if (!request.csv.empty()) write_file(request.csv, csv(f.runs), request);
    if (!request.svg.empty())
        write_file(request.svg, work_precision(curves_of(f.runs), fmt::format("{} until t = {:g}", d.mechanism.title.empty() ? d.mechanism.name : d.mechanism.title, f.end)),
                   request);
    if (request.json) {
        Json result;
        result["scene"] = d.mechanism.name;
        result["formulation"] = f.formulation;
        result["operations"] = f.operations;
        result["reference"] = reference_json(f.exact, f.judge, f.program, f.end);
        result["runs"] = Json::array();
        for (const Measured& run : f.runs) result["runs"].push_back(as_json(run));
        std::cout << as_text(result);
        return;
    }
    fmt::print("{}: {} operations a right-hand side; to t = {:g}\n", f.formulation, f.operations, f.end);
    fmt::print("reference: {} digits, by {}\n\n", f.judge.digits, f.judge.by);
    print(f.runs);
    print_best(f.runs);
}

/// Null where the motion has no power series, or its method is not asked for.
SeriesModule series_of(const Program& program, bool with_work, const Request& request) {
    if (!request.method.empty() && request.method != name(Method::taylor)) return nullptr;
    try {
        return load_series(
            compile(emit_taylor(program, with_work).text, program.name + "_taylor", {.compiler = {}, .extra_flags = {}, .fast_math = request.fast_math, .cache = {}})
                .object);
    } catch (const ModelError&) {
        return nullptr;
    }
}

/// Null where the scene has no such form, or no method that needs it is asked for.
std::shared_ptr<const Canonical> canonical_of(const Derived& d, const Module& module, const std::vector<double>& parameters, const Request& request) {
    const auto asked = method_named(request.method);
    if ((asked && !needs_canonical(*asked)) || not_canonical(d)) return nullptr;
    const Program form = canonical_form(d);
    const Compiled compiled = compile(emit(form).text, form.name, {.compiler = {}, .extra_flags = {}, .fast_math = request.fast_math, .cache = {}});
    return make_canonical(module, load(compiled.object), parameters);
}

}  // namespace

int bench(const Request& request) {
    for (const std::string& file : {request.csv, request.svg}) check_output(file, request);
    if (!request.method.empty() && !method_named(request.method))
        throw ModelError(fmt::format("method '{}' is none that bench measures; expected {} (those of SUNDIALS and others come with --peers)", request.method, method_names()));
    const Derived d = derived(request, Use::run);
    const Energy energy = energy_of(d.mechanism);
    const Program program = lowered(d, request).program;
    Start start = start_of(d.mechanism);
    assemble(start, d.mechanism, lower_constraints(d.mechanism), {});
    const State<double> first = state_of(start, d.mechanism, d.equations);
    if (program.singular || massless_combination(program, first))
        throw IntegrationError(fmt::format("there are no finite accelerations at t = {:.6g}: {}", start.t,
                                           failure_at(d, first).value_or("the mass matrix is singular")), start.t, start.q);
    const double duration = request.duration >= 0 ? request.duration : start.duration;
    if (has_jumps(d.mechanism)) {
        Bounces bounces = measured_bounces(request, d, start, first);
        if (request.peers) std::cerr << "no peers: none of them follows contacts or impulses\n";
        deliver(request, d, {.exact = {}, .judge = {std::move(bounces.final), bounces.digits, std::move(bounces.by)}, .program = program,
                             .formulation = program.formulation, .operations = program.count(program.right_hand_side()).total(),
                             .end = bounces.end, .runs = std::move(bounces.runs)});
        return 0;
    }
    const Source source = emit(with_jacobian(program, method_named(request.method).value_or(Method::radau), !energy.conserved));
    const Compiled compiled = compile(source.text, program.name, {.compiler = {}, .extra_flags = {}, .fast_math = request.fast_math, .cache = {}});
    const Module module = load(compiled.object);
    const SeriesModule series = series_of(program, false, request);
    const SeriesModule series_with_work = series && !energy.conserved ? series_of(program, true, request) : nullptr;
    const std::shared_ptr<const Canonical> canonical = canonical_of(d, module, start.parameters, request);
    std::vector<double> initial = start.q;
    initial.insert(initial.end(), first.qdot.begin(), first.qdot.end());
    Workbench workbench({.derived = d, .module = module, .series = series, .series_with_work = series_with_work, .canonical = canonical, .parameters = start.parameters, .initial = initial, .conserved = energy.conserved});

    const Options options{.start = start.t, .duration = duration, .budget = request.budget};
    std::optional<Reference> exact;
    {
        Progress progress("computing the reference");
        exact = reference(program, quad_start(d.mechanism, d.equations, start, request.duration >= 0 ? std::optional(duration) : std::nullopt),
                          {.seconds = request.reference_seconds, .progress = [&](double fraction) { progress.at(fraction); }});
    }
    Progress progress("measuring");
    std::optional<Judge> judge;
    if (exact) {
        judge = Judge{{}, exact->digits, exact->by};
        for (const auto* list : {&exact->coordinates, &exact->rates})
            for (const Quad& x : *list) judge->final.push_back(static_cast<double>(x));
    } else {
        judge = by_doubles(workbench, options);
    }
    if (!judge) {
        Options easy = options;
        easy.tolerance = 1e-9;
        const Measured trial = workbench.measure(easy);
        const std::optional<std::string> at_start = failure_at(d, first);
        throw IntegrationError(fmt::format("no method reaches the end at a strict tolerance: there is nothing to measure against; {} at tolerance 1e-9: {}{}; a shorter --duration "
                                           "ends before what stops it, --budget and --reference-seconds let it take longer",
                                           trial.method, trial.failure.empty() ? "it does" : trial.failure, at_start ? ", there: " + *at_start : ""),
                               start.t, start.q);
    }
    workbench.set_reference(judge->final);

    // One right-hand side, and how many steps a loose run takes: where fixed steps begin.
    Options loose = options;
    loose.tolerance = 1e-4;
    const Measured trial = workbench.measure(loose);
    const double each = std::max(trial.seconds / static_cast<double>(std::max(trial.evaluations, 1L)), 1e-9);
    const long guess = std::max(16L, trial.steps);
    const bool separable = !inseparable(d);

    std::vector<Measured> runs;
    const std::vector<Method> methods = all_methods();
    for (std::size_t k = 0; k < methods.size(); ++k) {
        if (needs_separable(methods[k]) && !separable) continue;
        if (needs_series(methods[k]) && !series) continue;
        if (needs_canonical(methods[k]) && !canonical) continue;
        if (!request.method.empty() && name(methods[k]) != request.method) continue;
        Options these = options;
        these.method = methods[k];
        const auto at = [&](double part) { progress.at_stage((static_cast<double>(k) + part) / static_cast<double>(methods.size())); };
        for (Measured& run : ladder(workbench, these, each, guess, at)) runs.push_back(std::move(run));
    }
    Peers peers;
    if (request.peers) {
        std::vector<double> tolerances;
        for (int decade = first_decade; decade <= last_decade; ++decade) tolerances.push_back(std::pow(10.0, -decade));
        peers = measure_peers({.object = compiled.object, .parameters = start.parameters, .initial = initial, .start = start.t, .duration = duration,
                               .tolerances = tolerances, .most_seconds = most_seconds},
                              [&](const std::vector<double>& state) {
                                  return error_against(judge->final, coordinates_and_rates(workbench.rhs(), start.t + duration, state.data(), start.q.size()));
                              });
        if (!peers.missing.empty()) std::cerr << "no peers: " << peers.missing << "\n";
        runs.insert(runs.end(), peers.runs.begin(), peers.runs.end());
    }

    deliver(request, d, {.exact = exact, .judge = *judge, .program = program, .formulation = source.formulation,
                         .operations = source.operations.total(), .end = start.t + duration, .runs = std::move(runs)});
    return 0;
}

}  // namespace alembert
