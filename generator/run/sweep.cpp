// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "alembert/compile.hpp"
#include "alembert/ensemble.hpp"
#include "alembert/process_time.hpp"
#include "emit/emit.hpp"
#include "language/say.hpp"
#include "lower/lower.hpp"
#include "lower/quick_times.hpp"
#include "run/method.hpp"
#include "run/rows.hpp"
#include "state/assemble.hpp"
#include "state/inertia_check.hpp"

namespace alembert {

namespace {

/// The initial states of the members of a sweep; for a member that cannot begin, the reason.
struct Beginnings {
    Ensemble ensemble;
    std::vector<std::string> refused;   ///< empty if the member runs
    std::vector<std::size_t> position;  ///< the position of a member in the ensemble
};

Beginnings beginnings(const RunOptions& wishes, const Derived& d, const Grid& grid, Module module) {
    const Starts starts(d.mechanism, grid.names());
    const Program constraints = lower_constraints(d.mechanism);
    const bool assembled = !d.mechanism.constraints.empty() || !d.mechanism.speeds.empty();
    Beginnings result{.ensemble = {.module = std::move(module)},
                      .refused = std::vector<std::string>(grid.size()),
                      .position = {}};
    Ensemble& e = result.ensemble;
    for (std::size_t k = 0; k < grid.size(); ++k) {
        const std::vector<double> values = grid.point(k);
        result.position.push_back(result.ensemble.durations.size());
        try {
            Start start = starts.at(values);
            if (assembled) {
                Overrides held;
                for (std::size_t i = 0; i < values.size(); ++i) held.emplace_back(grid.axes[i].name, values[i]);
                assemble(start, d.mechanism, constraints, held);
            }
            const State<double> first = state_of(start, d.mechanism, d.equations);
            e.states.insert(e.states.end(), first.q.begin(), first.q.end());
            e.states.insert(e.states.end(), first.qdot.begin(), first.qdot.end());
            e.parameters.insert(e.parameters.end(), start.parameters.begin(), start.parameters.end());
            e.starts.push_back(start.t);
            e.durations.push_back(wishes.duration >= 0 ? wishes.duration : start.duration);
        } catch (const ModelError& error) {
            result.refused[k] = error.what();
        } catch (const IntegrationError& error) {
            result.refused[k] = error.what();
        }
    }
    return result;
}

/// Throws SceneError for the first member with an impossible mass or moment; warns of broken triangle
/// inequalities, once for each body.
void check_bodies_along(Sweep& s) {
    const Mechanism& m = s.mechanism;
    const std::vector<std::string> names = s.grid.names();
    const auto is_varied = [&](const Mechanism::Parameter& p) {
        return std::find(names.begin(), names.end(), p.symbol.get_name()) != names.end();
    };
    if (m.masses.empty() || std::none_of(m.parameters.begin(), m.parameters.end(), is_varied)) return;
    const InertiaCheck check(s.scene, m);
    const Starts starts(m, names);
    std::set<Place> told;
    for (std::size_t k = 0; k < s.grid.size(); ++k) {
        const std::vector<double> values = s.grid.point(k);
        const Possible<Start> start = starts.possible(values);
        if (!start.exists()) continue;  // its row gives the reason
        for (Diagnostic& one : check.findings(start.value().state())) {
            for (std::size_t i = 0; i < values.size(); ++i)
                one.message += fmt::format("{}{} = {:.6g}", i == 0 ? say(", at ") : ", ", names[i], values[i]);
            if (one.severity == Severity::error) fail(s.scene, {one});
            if (told.insert(one.place).second) s.warn(describe(s.scene, {one}));
        }
    }
}

/// Finds the times at which the inputs of each member change fast. Members with the same parameters and times
/// share one search.
void find_quick_times(const Program& program, Ensemble& e, std::vector<std::string>& warnings) {
    constexpr std::size_t most_searches = 2000;  // take some seconds
    const std::size_t count = e.count(), p = count > 0 ? e.parameters.size() / count : 0;
    const std::vector<bool> used = parameters_of_inputs(program, p);
    std::map<std::vector<double>, std::vector<QuickTime>> known;
    bool any = false;
    std::vector<std::vector<QuickTime>> found;
    for (std::size_t k = 0; k < count; ++k) {
        const auto first = e.parameters.begin() + static_cast<std::ptrdiff_t>(k * p);
        const std::vector<double> parameters(first, first + static_cast<std::ptrdiff_t>(p));
        std::vector<double> key{e.starts[k], e.durations[k]};
        for (std::size_t i = 0; i < p; ++i)
            if (used[i]) key.push_back(parameters[i]);
        const auto [at, is_new] = known.try_emplace(std::move(key));
        if (is_new && known.size() == most_searches + 1)
            warnings.push_back(
                say("only {} variants of the inputs were searched for narrow pulses; a longest step "
                    "(max_step) bounds the steps of all\n",
                    most_searches));
        if (is_new && known.size() <= most_searches)
            at->second = quick_times(program, parameters, e.starts[k], e.starts[k] + e.durations[k]);
        any = any || !at->second.empty();
        found.push_back(at->second);
    }
    if (any) e.quick_times = std::move(found);
}

/// The rates at the end of a member, whose state may have speeds instead.
std::vector<double> rates_at(const Program& program, const Beginnings& begin, std::size_t at, double t,
                             std::span<const double> state) {
    const alembert_solver_table& table = begin.ensemble.module.table();
    if (program.speeds.empty()) return {state.begin() + table.coordinates, state.end()};
    const auto p = static_cast<std::size_t>(table.parameters);
    const auto first = begin.ensemble.parameters.begin() + static_cast<std::ptrdiff_t>(at * p);
    const std::vector<double> par =
        prepared(begin.ensemble.module, {first, first + static_cast<std::ptrdiff_t>(p)});
    std::vector<double> rate(state.size());
    table.rhs(t, state.data(), par.data(), rate.data());
    rate.resize(static_cast<std::size_t>(table.coordinates));
    return rate;
}

SweptMotion member_of(std::size_t k, const Sweep& s, const Program& program, const Beginnings& begin,
                      const Outcomes& ends) {
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    const std::size_t n = s.coordinates.size();
    SweptMotion m{.varied = s.grid.point(k),
                  .final_coordinates = {},
                  .final_rates = {},
                  .final_speeds = {},
                  .time = nothing,
                  .drift = nothing};
    if (!begin.refused[k].empty()) {
        m.final_coordinates = m.final_rates = std::vector<double>(n, nothing);
        m.final_speeds.assign(s.speeds.size(), nothing);
        m.status = begin.refused[k];
        m.failed = true;
        return m;
    }
    const std::size_t at = begin.position[k];
    const Outcome& outcome = ends.members[at];
    const std::span<const double> state = ends.state(at);
    m.final_coordinates.assign(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(n));
    m.final_rates = rates_at(program, begin, at, outcome.time, state);
    if (!s.speeds.empty()) m.final_speeds.assign(state.begin() + static_cast<std::ptrdiff_t>(n), state.end());
    m.time = outcome.time;
    m.drift = s.conserved ? outcome.energy_drift : outcome.work_balance;
    m.steps = outcome.steps;
    m.rejected = outcome.rejected;
    m.evaluations = outcome.evaluations;
    m.failed = !outcome.failure.empty();
    m.status = m.failed ? outcome.failure : outcome.stopped ? "stopped" : "done";
    return m;
}

void need_smooth_motion(const Mechanism& m) {
    if (!m.unilateral.empty())
        throw ModelError(
            say("sweep does not follow unilateral constraints; simulate does, for one state at a time"));
    if (!m.frictions.empty())
        throw ModelError(say("sweep does not follow dry friction; simulate does, for one state at a time"));
    if (m.has_kicks())
        throw ModelError(
            say("sweep does not follow events with impulses; simulate does, for one state at a time"));
}

Options options_for(const Sweep& s, const RunOptions& wishes) {
    const Start start = start_of(s.mechanism);
    const bool steps_given = wishes.step > 0 || start.step > 0;
    const Options options = options_of(
        wishes, {.method = given_method(wishes, s).value_or(steps_given ? Method::rk4 : Method::dop853)}, start);
    if (needs_series(options.method) || needs_canonical(options.method))
        throw ModelError(
            say("sweep does not run '{}', which needs more than the right-hand side; take dop853 or gauss",
                name(options.method)));
    return options;
}

}  // namespace

Sweep sweep(Scene scene, const Grid& grid, const RunOptions& wishes, int threads) {
    Sweep s{derived(std::move(scene), {.by = wishes.by, .use = Use::run})};
    s.grid = grid;
    const Mechanism& m = s.mechanism;
    need_smooth_motion(m);
    if (!m.impulses.empty())
        s.warn(
            say("{}: the motions start with the rates before the scene's impulses; 'alembert impact' "
                "gives those after\n",
                s.scene.file));
    check_bodies_along(s);
    const Energy energy = energy_of(m);
    s.conserved = energy.conserved;
    const Program program = lowered(s).program;
    if (program.singular) {
        const State<double> first = state_of(start_of(m), m, s.equations);
        throw IntegrationError(failure_at(s, first).value_or(say("the mass matrix is singular")), first.t,
                               first.q);
    }
    for (const Quantity& q : program.coordinates) s.coordinates.push_back(q.name);
    if (!m.speeds.empty())
        for (const Quantity& u : program.speeds) s.speeds.push_back(u.name);
    check_columns(end_columns(s), wishes.columns);
    const Options options = options_for(s, wishes);

    const Source source = emit(program, {.batch = true});
    s.formulation = source.formulation;
    s.operations = source.operations.total();
    const double compile_begin = process_seconds();
    const Compiled compiled =
        compile(source.text, program.name,
                {.compiler = {}, .extra_flags = {}, .fast_math = wishes.fast_math, .cache = {}});
    s.timings.compile = compiled.from_cache ? 0.0 : compiled.seconds;
    Beginnings begin = beginnings(wishes, s, grid, load(compiled.object));
    begin.ensemble.work = energy.conserved ? Work::left_out : Work::integrated;
    for (const Mechanism::EventAction& event : m.event_actions) {
        begin.ensemble.stops.push_back(event.stop);
        begin.ensemble.directions.push_back(event.direction);
    }
    begin.ensemble.threads = threads;
    if (!has_fixed_step(options.method)) find_quick_times(program, begin.ensemble, s.warnings);
    const double integrate_begin = process_seconds();
    s.timings.start = integrate_begin - compile_begin - s.timings.compile;
    if (wishes.progress) begin.ensemble.progress = [&](double part) { wishes.progress(say("sweeping"), part); };
    const Outcomes ends = integrate(begin.ensemble, options);
    s.timings.integrate = process_seconds() - integrate_begin;
    s.method = ends.method;
    s.packed = ends.packed;
    s.threads = ends.threads;
    for (std::size_t k = 0; k < grid.size(); ++k) s.members.push_back(member_of(k, s, program, begin, ends));
    return s;
}

std::vector<std::string> end_columns(const Sweep& s) {
    std::vector<std::string> columns{"t"};
    columns.insert(columns.end(), s.coordinates.begin(), s.coordinates.end());
    for (const std::string& q : s.coordinates) columns.push_back(q + "'");
    columns.insert(columns.end(), s.speeds.begin(), s.speeds.end());
    columns.emplace_back(s.conserved ? "energy_drift" : "work_balance");
    return columns;
}

std::vector<double> end_values(const SweptMotion& m) {
    std::vector<double> values{m.time};
    for (const auto* part : {&m.final_coordinates, &m.final_rates, &m.final_speeds})
        values.insert(values.end(), part->begin(), part->end());
    values.push_back(m.drift);
    return values;
}

SweepTotals totals_of(const Sweep& sweep) {
    SweepTotals sum;
    for (const SweptMotion& m : sweep.members) {
        sum.steps += m.steps;
        sum.rejected += m.rejected;
        sum.evaluations += m.evaluations;
        if (std::isfinite(m.drift)) sum.drift = std::max(sum.drift, m.drift);
        if (!m.failed || sum.failed++ > 0) continue;
        for (std::size_t i = 0; i < sweep.grid.axes.size(); ++i)
            sum.first_failure +=
                fmt::format("{}{} = {:.17g}", i > 0 ? ", " : "", sweep.grid.axes[i].name, m.varied[i]);
        sum.first_failure += ": " + m.status;
    }
    return sum;
}

}  // namespace alembert
