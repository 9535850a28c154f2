// SPDX-License-Identifier: GPL-2.0-or-later
// Many motions of one scene: a grid over initial values, rates and parameters, one row of a table for each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <set>

#include "alembert/compile.hpp"
#include "alembert/ensemble.hpp"
#include "analysis/assemble.hpp"
#include "analysis/inertia_check.hpp"
#include "commands/grid.hpp"
#include "commands/progress.hpp"
#include "commands/run_options.hpp"
#include "emit/emit.hpp"

namespace alembert {

namespace {

/// Where the members of a sweep begin; one that cannot has its reason instead.
struct Beginnings {
    Ensemble ensemble;
    std::vector<std::string> refused;     ///< empty where the member runs
    std::vector<std::size_t> position;    ///< of a member in the ensemble
};

Beginnings beginnings(const Request& request, const Derived& d, const Grid& grid, Module module) {
    const Starts starts(d.mechanism, grid.names(), "--vary");
    const Program constraints = lower_constraints(d.mechanism);
    const bool assembled = !d.mechanism.constraints.empty() || !d.mechanism.speeds.empty();
    Beginnings result{.ensemble = {.module = std::move(module)}, .refused = std::vector<std::string>(grid.size()), .position = {}};
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
            e.durations.push_back(request.duration >= 0 ? request.duration : start.duration);
        } catch (const ModelError& error) {
            result.refused[k] = error.what();
        } catch (const IntegrationError& error) {
            result.refused[k] = error.what();
        }
    }
    return result;
}

/// Throws SceneError for the first member with a mass or a moment that no body has; warns of broken triangle inequalities, once for each body.
void check_bodies_along(const Derived& d, const Grid& grid) {
    const std::vector<std::string> names = grid.names();
    const auto is_varied = [&](const Mechanism::Parameter& p) { return std::find(names.begin(), names.end(), p.symbol.get_name()) != names.end(); };
    if (d.mechanism.masses.empty() || std::none_of(d.mechanism.parameters.begin(), d.mechanism.parameters.end(), is_varied)) return;
    const InertiaCheck check(d.scene, d.mechanism);
    const Starts starts(d.mechanism, names, "--vary");
    std::set<Place> told;
    for (std::size_t k = 0; k < grid.size(); ++k) {
        const std::vector<double> values = grid.point(k);
        std::vector<Diagnostic> found;
        try {
            found = check.findings(starts.at(values).state());
        } catch (const ModelError&) {
            continue;  // no start there, which its row tells
        }
        for (Diagnostic& one : found) {
            for (std::size_t i = 0; i < values.size(); ++i) one.message += fmt::format("{}{} = {:.6g}", i == 0 ? ", at " : ", ", names[i], values[i]);
            if (one.severity == Severity::error) fail(d.scene, {one});
            if (told.insert(one.place).second) std::cerr << describe(d.scene, {one});
        }
    }
}

/// A row of the table.
struct Row {
    std::vector<double> varied, coordinates, rates, speeds;  ///< the last: of scenes that have their own
    double time = std::nan(""), drift = std::nan("");
    long steps = 0, rejected = 0, evaluations = 0;
    std::string status = {};
    bool failed = false;
};

class Table {
public:
    Table(const Derived& d, const Program& program, const Grid& grid, const Beginnings& begin, const Outcomes& ends, bool conserved)
        : d_(d), program_(program), grid_(grid), begin_(begin), ends_(ends), conserved_(conserved) {}

    Row row(std::size_t k) const {
        const auto n = d_.mechanism.q.size();
        Row row{.varied = grid_.point(k), .coordinates = std::vector<double>(n, std::nan("")), .rates = std::vector<double>(n, std::nan("")), .speeds = {}};
        const bool own_speeds = !d_.mechanism.speeds.empty() && !program_.speeds.empty();
        if (own_speeds) row.speeds.assign(program_.speeds.size(), std::nan(""));
        if (!begin_.refused[k].empty()) {
            row.status = begin_.refused[k];
            row.failed = true;
            return row;
        }
        const std::size_t at = begin_.position[k];
        const Outcome& outcome = ends_.members[at];
        const std::span<const double> state = ends_.state(at);
        std::vector<double> rate(state.size());
        rhs_at(at, outcome.time, state, rate);
        row.coordinates.assign(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(n));
        row.rates.assign(rate.begin(), rate.begin() + static_cast<std::ptrdiff_t>(n));
        if (own_speeds) row.speeds.assign(state.begin() + static_cast<std::ptrdiff_t>(n), state.end());
        row.time = outcome.time;
        row.drift = conserved_ ? outcome.energy_drift : outcome.work_balance;
        row.steps = outcome.steps;
        row.rejected = outcome.rejected;
        row.evaluations = outcome.evaluations;
        row.failed = !outcome.failure.empty();
        row.status = row.failed ? outcome.failure : outcome.stopped ? "stopped" : "done";
        return row;
    }

    const char* drift_name() const { return conserved_ ? "energy_drift" : "work_balance"; }

    std::string csv() const {
        std::string text;
        for (const Axis& axis : grid_.axes) text += axis.name + ",";
        text += "final_t";
        for (const Quantity& q : program_.coordinates) text += ",final_" + q.name;
        for (const Quantity& q : program_.coordinates) text += ",final_" + q.name + "'";
        if (!d_.mechanism.speeds.empty())
            for (const Quantity& u : program_.speeds) text += ",final_" + u.name;
        text += fmt::format(",{},steps,rejected,evaluations,status\n", drift_name());
        for (std::size_t k = 0; k < grid_.size(); ++k) {
            const Row r = row(k);
            std::vector<double> numbers = r.varied;
            numbers.push_back(r.time);
            for (const std::vector<double>* part : {&r.coordinates, &r.rates, &r.speeds}) numbers.insert(numbers.end(), part->begin(), part->end());
            for (const double x : numbers) text += fmt::format("{:.17g},", x);
            text += fmt::format("{:.17g},{},{},{},{}\n", r.drift, r.steps, r.rejected, r.evaluations, quoted(r.status));
        }
        return text;
    }

    Json json(std::size_t k) const {
        const Row r = row(k);
        Json result;
        for (std::size_t i = 0; i < grid_.axes.size(); ++i) result["varied"][grid_.axes[i].name] = r.varied[i];
        result["final"] = {{"time", r.time},
                           {"coordinates", by_coordinate(program_, r.coordinates.data())},
                           {"rates", by_coordinate(program_, r.rates.data())}};
        for (std::size_t i = 0; i < r.speeds.size(); ++i) result["final"]["speeds"][program_.speeds[i].name] = r.speeds[i];
        result[drift_name()] = r.drift;
        result["steps"] = r.steps;
        result["rejected"] = r.rejected;
        result["evaluations"] = r.evaluations;
        result["status"] = r.status;
        return result;
    }

private:
    void rhs_at(std::size_t at, double t, std::span<const double> state, std::vector<double>& rate) const {
        const alembert_solver_table& table = begin_.ensemble.module.table();
        if (program_.speeds.empty()) {
            std::copy(state.begin() + table.coordinates, state.end(), rate.begin());
            return;
        }
        const auto p = static_cast<std::size_t>(table.parameters);
        const auto first = begin_.ensemble.parameters.begin() + static_cast<std::ptrdiff_t>(at * p);
        const std::vector<double> par = prepared(begin_.ensemble.module, {first, first + static_cast<std::ptrdiff_t>(p)});
        table.rhs(t, state.data(), par.data(), rate.data());
    }

    /// A field of a CSV file (RFC 4180), on one line.
    static std::string quoted(std::string text) {
        std::replace(text.begin(), text.end(), '\n', ' ');
        if (text.find_first_of(",\"") == std::string::npos) return text;
        std::string result = "\"";
        for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
        return result + "\"";
    }

    const Derived& d_;
    const Program& program_;
    const Grid& grid_;
    const Beginnings& begin_;
    const Outcomes& ends_;
    bool conserved_;
};

/// What the whole sweep took, and what came of it.
struct Sum {
    long steps = 0, rejected = 0, evaluations = 0, failed = 0;
    double drift = 0;
    std::string first_failure;
};

Sum sum_of(const Table& table, const Grid& grid) {
    Sum sum;
    for (std::size_t k = 0; k < grid.size(); ++k) {
        const Row row = table.row(k);
        sum.steps += row.steps;
        sum.rejected += row.rejected;
        sum.evaluations += row.evaluations;
        if (std::isfinite(row.drift)) sum.drift = std::max(sum.drift, row.drift);
        if (!row.failed) continue;
        if (sum.failed++ > 0) continue;
        for (std::size_t i = 0; i < grid.axes.size(); ++i)
            sum.first_failure += fmt::format("{}{} = {:.17g}", i > 0 ? ", " : "", grid.axes[i].name, row.varied[i]);
        sum.first_failure += ": " + row.status;
    }
    return sum;
}

}  // namespace

int sweep(const Request& request) {
    const Grid grid = grid_of(request.vary);
    const Derived d = derived(request, Use::run);
    if (!d.mechanism.unilateral.empty())
        throw ModelError("sweep does not follow unilateral constraints; simulate does, for one state at a time");
    if (d.mechanism.has_kicks())
        throw ModelError("sweep does not follow events with impulses; simulate does, for one state at a time");
    if (!d.mechanism.impulses.empty())
        std::cerr << fmt::format("{}: the motions start with the rates before the scene's impulses; 'alembert impact' gives those after\n",
                                 request.scene);
    check_bodies_along(d, grid);
    const Energy energy = energy_of(d.mechanism);
    const Program program = lowered(d, request).program;
    if (program.singular) {
        const State<double> first = state_of(start_of(d.mechanism), d.mechanism, d.equations);
        throw IntegrationError(failure_at(d, first).value_or("the mass matrix is singular"), first.t, first.q);
    }
    const Start first_start = start_of(d.mechanism);
    const bool steps_given = request.step > 0 || first_start.step > 0;
    const Options options =
        options_of(request, {.method = given_method(request, d).value_or(steps_given ? Method::rk4 : Method::dop853)}, first_start);
    if (needs_series(options.method) || needs_canonical(options.method))
        throw ModelError(fmt::format("sweep does not run '{}', which needs more than the right-hand side; take dop853 or gauss", name(options.method)));

    const Source source = emit(program, {.batch = true});
    const double compile_begin = process_seconds();
    const Compiled compiled =
        compile(source.text, program.name, {.compiler = {}, .extra_flags = {}, .fast_math = request.fast_math, .cache = {}});
    Beginnings begin = beginnings(request, d, grid, load(compiled.object));
    begin.ensemble.work = energy.conserved ? Work::left_out : Work::integrated;
    for (const Mechanism::Occasion& event : d.mechanism.occasions) {
        begin.ensemble.stops.push_back(event.stop);
        begin.ensemble.directions.push_back(event.direction);
    }
    begin.ensemble.threads = request.threads;
    const double integrate_begin = process_seconds();
    Outcomes ends;
    {
        Progress progress("sweeping");
        begin.ensemble.progress = [&](double fraction) { progress.at(fraction); };
        ends = integrate(begin.ensemble, options);
    }
    const double integrate_end = process_seconds();

    const Table table(d, program, grid, begin, ends, energy.conserved);
    const Sum sum = sum_of(table, grid);
    if (!request.output.empty()) write_file(request.output, table.csv());
    if (request.json) {
        Json result;
        result["members"] = grid.size();
        result["failed"] = sum.failed;
        for (const Axis& axis : grid.axes) result["vary"].push_back({{"name", axis.name}, {"from", axis.from}, {"to", axis.to}, {"count", axis.count}});
        result["method"] = ends.method;
        result["formulation"] = source.formulation;
        result["side_by_side"] = ends.packed ? 8 : 1;
        result["threads"] = ends.threads;
        result["steps"] = sum.steps;
        result["rejected"] = sum.rejected;
        result["evaluations"] = sum.evaluations;
        result[table.drift_name()] = sum.drift;
        result["seconds"] = {{"derive", d.seconds}, {"compile", compiled.from_cache ? 0.0 : compiled.seconds}, {"start", integrate_begin - compile_begin - (compiled.from_cache ? 0.0 : compiled.seconds)}, {"integrate", integrate_end - integrate_begin}};
        if (!request.output.empty())
            result["file"] = request.output;
        else
            for (std::size_t k = 0; k < grid.size(); ++k) result["rows"].push_back(table.json(k));
        std::cout << result.dump(2) << "\n";
    } else if (request.output.empty()) {
        std::cout << table.csv();
    } else {
        fmt::print("{} with {}: {} motions{} on {} thread{}, {} steps, {} rejected, {} evaluations of {} operations, {} {:.2e} at the most\n",
                   source.formulation, ends.method, grid.size(), ends.packed ? ", eight side by side" : "", ends.threads, ends.threads == 1 ? "" : "s",
                   sum.steps, sum.rejected, sum.evaluations, source.operations.total(), energy.conserved ? "energy drift" : "work balance", sum.drift);
        fmt::print("integrated in {:.3f} s of processor time\nwrote {}\n", integrate_end - integrate_begin, request.output);
    }
    if (sum.failed == 0) return 0;
    std::cout.flush();
    std::cerr << fmt::format("{}: {} of {} motions failed; the table's column 'status' says why, the first at {}\n", request.scene, sum.failed, grid.size(), sum.first_failure);
    return 4;
}

}  // namespace alembert
