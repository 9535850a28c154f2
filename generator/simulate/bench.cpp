// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

#include "alembert/base/argument.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/ode/cost_model.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "codegen/emit/emit.hpp"
#include "program/event_code.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/quick_times.hpp"
#include "program/recurrence.hpp"
#include "program/switches.hpp"
#include "simulate/bounces.hpp"
#include "simulate/canonical.hpp"
#include "simulate/first_accelerations.hpp"
#include "simulate/loaded_modes.hpp"
#include "simulate/method.hpp"
#include "simulate/peers.hpp"
#include "simulate/run_contacts.hpp"
#include "simulate/separable.hpp"
#include "simulate/solver_code.hpp"
#include "simulate/step_times.hpp"

namespace alembert {

namespace {

constexpr int first_decade = 3, last_decade = 14;

/// The end in double precision by two methods, if there is no better reference, and the digits in which they
/// agree.
std::optional<Judgement> by_doubles(Workbench& bench, const Options& options) {
    // The second pair is for stiff systems.
    for (const auto& [one, other, tolerance] : {std::tuple{Method::verner98, Method::dop853, 1e-14},
                                                std::tuple{Method::radau13, Method::radau9, 1e-13}}) {
        Options strict = options;
        strict.tolerance = tolerance;
        strict.method = one;
        const auto first = bench.end_of(strict);
        strict.method = other;
        const auto second = first ? bench.end_of(strict) : std::nullopt;
        if (!second) continue;
        const double apart = std::max(error_against(*first, *second), 1e-16);
        return Judgement{*first, std::max(0, static_cast<int>(std::floor(-std::log10(apart)))),
                         say("{} and {} at tolerance {:g}, doubles: no better reference in the time given",
                             name(one), name(other), tolerance)};
    }
    return std::nullopt;
}

/// Runs of one method from loose to strict tolerances, as long as that is useful.
std::vector<Measured> ladder(Workbench& bench, Options options, double most_seconds, double each, long guess,
                             const std::function<void(double)>& progress) {
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
        if (last.budget_used_up || last.seconds > most_seconds / 4) break;
        if (!last.failure.empty() || !last.error) continue;
        if (*last.error < 1e-13) break;
        worse = *last.error > best / 1.5 && *last.error < 1e-6 ? worse + 1 : 0;  // rounding dominates
        if (worse > 1) break;
        best = std::min(best, *last.error);
    }
    return runs;
}

/// Whether code in memory was asked for; otherwise all is compiled.
bool in_memory(const RunOptions& wishes) {
    return wished_code(wishes) == "memory";
}

/// Null if the motion has no power series, or if the method that needs it is not measured.
SeriesModule series_of(const Program& program, bool with_work, const RunOptions& wishes) {
    if (!wishes.method.empty() && wishes.method != name(Method::taylor) && wishes.method != automatic_method)
        return nullptr;
    if (obstacle_to_recurrences(program, with_work)) return nullptr;
    return in_memory(wishes) ? series_code(program, with_work, wishes).module
                             : compiled_series(program, with_work, wishes);
}

/// Null if the scene has no such form, or if no method that needs it is measured.
std::shared_ptr<const HamiltonianSystem> canonical_of(const Derived& d, const Module& module,
                                                      const std::vector<double>& parameters,
                                                      const RunOptions& wishes) {
    const auto asked = method_named(wishes.method);
    if ((asked && !needs_canonical(*asked)) || not_canonical(d)) return nullptr;
    const Program form = canonical_form(d);
    const SolverCode code =
        in_memory(wishes) ? solver_code(form, form.name, wishes) : compiled_code(form, form.name, wishes);
    return make_canonical(module, code.module, parameters);
}

/// The solver of a scene with everything that the measured methods need.
struct Compilation {
    Source source;
    SolverCode code;
    SeriesModule series = {}, series_with_work = {};
    std::shared_ptr<const HamiltonianSystem> canonical = {};
};

Compilation compilation_of(const Derived& d, const Program& program, const Start& start, bool conserved,
                           const RunOptions& wishes) {
    const Program written =
        with_jacobian(program, method_named(wishes.method).value_or(Method::radau), !conserved);
    Source source = emit(written);
    SolverCode code = in_memory(wishes) ? solver_code(written, program.name, wishes)
                                        : compiled_text(written, source.text, program.name, wishes);
    Compilation c{
        .source = std::move(source), .code = std::move(code), .series = series_of(program, false, wishes)};
    if (c.series && !conserved) c.series_with_work = series_of(program, true, wishes);
    c.canonical = canonical_of(d, c.code.module, start.parameters, wishes);
    return c;
}

class Benchmark {
public:
    Benchmark(Bench& result, const BenchOptions& options)
        : result_(result), options_(options), wishes_(options.wishes) {}

    void run() {
        const Mechanism& m = result_.mechanism;
        const Energy energy = energy_of(m);
        const Program program = lowered(result_).program;
        name_everything(program);
        start_ = start_of(m);
        assemble(start_, m, lower_constraints(m), {});
        const State<double> first = state_of(start_, m, result_.equations);
        need_accelerations(result_, program, first, FirstPose::may_be_singular);
        const double duration = wishes_.duration.value_or(start_.duration);
        if (has_jumps(m) || !m.frictions.empty() || switched(program)) return measure_jumps(program, first);

        const Compilation c = compilation_of(result_, program, start_, energy.conserved, wishes_);
        result_.formulation = c.source.formulation;
        result_.operations = c.source.operations.total();
        result_.end = start_.t + duration;
        std::vector<double> initial = start_.q;
        initial.insert(initial.end(), first.qdot.begin(), first.qdot.end());
        Workbench workbench({.derived = result_,
                             .module = c.code.module,
                             .series = c.series,
                             .series_with_work = c.series_with_work,
                             .canonical = c.canonical,
                             .parameters = start_.parameters,
                             .initial = initial,
                             .quick_times = quick_times(program, start_.parameters, start_.t, start_.t + duration),
                             .quick_places = {quick_places_code(program, Kinks::watched), start_.parameters},
                             .effort = effort_of(program),
                             .slowness = wishes_.tuning ? slowness_here() : Slowness{},
                             .conserved = energy.conserved});
        const Options options{.start = start_.t,
                              .duration = duration,
                              .longest_step = longest_step(wishes_, start_),
                              .budget = wishes_.budget};
        find_reference(program, workbench, options, first);
        workbench.set_reference(result_.reference.final);
        measure(workbench, options, c, program);
        if (wishes_.method.empty() || wishes_.method == automatic_method)
            measure_automatic(workbench, options, program);
        if (options_.peers && in_memory(wishes_))
            result_.warnings.push_back(say("no peers: they take compiled code\n"));
        else if (options_.peers)
            measure_others(workbench, c, initial, duration);
    }

private:
    void tell(std::string_view what, double part) const {
        if (wishes_.progress) wishes_.progress(what, part);
    }

    void name_everything(const Program& program) {
        for (const Quantity& q : program.coordinates) result_.coordinates.push_back(q.name);
        for (const Quantity& u : program.speeds) result_.speeds.push_back(u.name);
    }

    void measure_jumps(const Program& program, const State<double>& first) {
        Bounces bounces = measured_bounces(wishes_, result_, start_, first);
        if (options_.peers)
            result_.warnings.emplace_back(say("no peers: none of them follows contacts or impulses\n"));
        result_.reference = {std::move(bounces.final), bounces.digits, std::move(bounces.by)};
        result_.formulation = program.formulation;
        result_.operations = program.count(program.right_hand_side()).total();
        result_.end = bounces.end;
        result_.runs = std::move(bounces.runs);
    }

    void find_reference(const Program& program, Workbench& workbench, const Options& options,
                        const State<double>& first) {
        const std::optional<double> duration = wishes_.duration ? std::optional(options.duration) : std::nullopt;
        result_.exact = reference(program, quad_start(result_.mechanism, result_.equations, start_, duration),
                                  {.seconds = options_.reference_seconds,
                                   .progress = [&](double part) { tell(say("computing the reference"), part); }});
        if (result_.exact) {
            result_.reference = {{}, result_.exact->digits, result_.exact->by};
            for (const auto* list : {&result_.exact->coordinates, &result_.exact->rates})
                for (const Quad& x : *list) result_.reference.final.push_back(static_cast<double>(x));
            return;
        }
        if (auto judged = by_doubles(workbench, options)) {
            result_.reference = *std::move(judged);
            return;
        }
        Options easy = options;
        easy.tolerance = 1e-9;
        const Measured trial = workbench.measure(easy);
        const std::optional<std::string> at_start = failure_at(result_, first);
        throw IntegrationError(say("no method reaches the end at a strict tolerance: there is nothing to "
                                   "measure against; {} at tolerance 1e-9: {}{}; a "
                                   "shorter duration ends before what stops it, a larger budget and more "
                                   "seconds for the reference let it take longer",
                                   trial.method, trial.failure.empty() ? say("it does") : trial.failure,
                                   at_start ? say(", there: {}", *at_start) : ""),
                               start_.t, start_.q);
    }

    void measure(Workbench& workbench, const Options& options, const Compilation& c, const Program& program) {
        // The cost of one right-hand side, and the number of steps of a loose run, from which fixed steps are
        // chosen.
        Options loose = options;
        loose.tolerance = 1e-4;
        const Measured trial = workbench.measure(loose);
        const double each = std::max(trial.seconds / static_cast<double>(std::max(trial.evaluations, 1L)), 1e-9);
        const long guess = std::max(16L, trial.steps);
        const bool separable = !inseparable(result_);
        const std::vector<Method> methods = all_methods();
        refuse_without_use(program, c);
        for (std::size_t k = 0; k < methods.size(); ++k) {
            if (needs_separable(methods[k]) && !separable) continue;
            if (needs_series(methods[k]) && !c.series) continue;
            if (needs_canonical(methods[k]) && !c.canonical) continue;
            if (!wishes_.method.empty() && name(methods[k]) != wishes_.method) continue;
            Options these = options;
            these.method = methods[k];
            const auto at = [&](double part) {
                tell(say("measuring"), (static_cast<double>(k) + part) / static_cast<double>(methods.size()));
            };
            for (Measured& run : ladder(workbench, these, options_.most_seconds, each, guess, at))
                result_.runs.push_back(std::move(run));
        }
    }

    /// Throws ModelError for a method that was named and cannot be measured here, and for a longest step that it
    /// does not take.
    void refuse_without_use(const Program& program, const Compilation& c) const {
        const std::optional<Method> asked = method_named(wishes_.method);
        if (!asked) return;
        if (needs_separable(*asked)) need_separable(result_, wishes_.method);
        if (needs_canonical(*asked)) need_canonical(result_, wishes_.method);
        if (needs_series(*asked) && !c.series)
            if (const auto why = obstacle_to_recurrences(program))
                throw ModelError(
                    say("method '{}' needs a motion that is a power series, but {}", wishes_.method, *why));
        if (has_fixed_step(*asked)) options_of(wishes_, {.method = *asked}, start_);
    }

    /// What `auto` chooses, at each tolerance.
    void measure_automatic(Workbench& workbench, Options options, const Program& program) {
        RunOptions wishes = wishes_;
        wishes.method = automatic_method;
        wishes.step = 0;  // none, whatever the scene says
        for (int decade = first_decade; decade <= last_decade; ++decade) {
            tell(say("measuring"), 1);
            options.tolerance = std::pow(10.0, -decade);
            wishes.tolerance = options.tolerance;
            const MethodChoice choice = method_for(wishes, result_, program, start_);
            options.method = choice.method;
            options.when_stiff = choice.when_stiff;
            options.when_stuck = choice.when_stuck;
            options.when_cheaper = choice.when_cheaper;
            Measured run = workbench.measure(options, choice.rivals);
            run.chosen = std::exchange(run.method, std::string(automatic_method));
            result_.runs.push_back(std::move(run));
            if (!result_.runs.back().failure.empty() || result_.runs.back().seconds > options_.most_seconds / 2)
                return;
        }
    }

    void measure_others(const Workbench& workbench, const Compilation& c, const std::vector<double>& initial,
                        double duration) {
        std::vector<double> tolerances;
        for (int decade = first_decade; decade <= last_decade; ++decade)
            tolerances.push_back(std::pow(10.0, -decade));
        const Peers peers = measure_peers(
            {.object = c.code.object,
             .parameters = start_.parameters,
             .initial = initial,
             .start = start_.t,
             .duration = duration,
             .tolerances = tolerances,
             .most_seconds = options_.most_seconds},
            [&](const std::vector<double>& state) {
                return error_against(
                    result_.reference.final,
                    coordinates_and_rates(workbench.rhs(), result_.end, state.data(), start_.q.size()));
            });
        if (!peers.missing.empty()) result_.warnings.push_back(say("no peers: {}\n", peers.missing));
        result_.runs.insert(result_.runs.end(), peers.runs.begin(), peers.runs.end());
    }

    Bench& result_;
    const BenchOptions& options_;
    const RunOptions& wishes_;
    Start start_;
};

}  // namespace

Bench bench(Scene scene, const BenchOptions& options) {
    check_numbers(options.wishes);
    argument::need_positive("most_seconds", options.most_seconds);
    argument::need_positive("reference_seconds", options.reference_seconds);
    const std::string& method = options.wishes.method;
    if (!method.empty() && method != automatic_method && !method_named(method))
        throw ModelError(
            say("method '{}' is none that bench measures; expected {} (those of SUNDIALS and others are "
                "measured as peers)",
                method, std::string(automatic_method) + ", " + method_names()));
    Bench result{derived(std::move(scene), {.by = options.wishes.by, .use = Use::run})};
    Benchmark(result, options).run();
    return result;
}

}  // namespace alembert
