// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/bench.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "alembert/native/registers.hpp"
#include "base/language/say.hpp"
#include "present/report/page.hpp"
#include "present/report/work_precision.hpp"

namespace alembert {

namespace {

constexpr double floor_of_doubles = 1e-15;

Json json_of(const Measured& run) {
    const auto optional = [](const std::optional<double>& value) {
        return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
    };
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
    if (!run.chosen.empty()) one["chosen"] = run.chosen;
    if (!run.went_on.empty()) one["went_on_with"] = run.went_on;
    if (!run.failure.empty()) one["failure"] = run.failure;
    return one;
}

std::string csv_of(const std::vector<Measured>& runs) {
    const auto cell = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.6g}", *value) : std::string();
    };
    std::string text =
        "who,method,tolerance,step,error,seconds,evaluations,steps,energy_drift,constraint_error,momentum_error\n";
    for (const Measured& run : runs)
        text += fmt::format("{},{},{},{},{},{:.6g},{},{},{},{},{}\n", run.who, run.method, cell(run.tolerance),
                            cell(run.step), cell(run.error), run.seconds, run.evaluations, run.steps,
                            cell(run.energy_drift), cell(run.constraint_error), cell(run.momentum_error));
    return text;
}

std::vector<Curve> curves_of(const std::vector<Measured>& runs) {
    std::vector<Curve> list;
    for (const Measured& run : runs) {
        if (!run.error || !run.chosen.empty()) continue;
        const bool peer = run.who != "alembert";
        const std::string name = peer ? run.who + " " + run.method : run.method;
        if (list.empty() || list.back().name != name) list.push_back({.name = name, .points = {}});
        list.back().points.emplace_back(std::max(*run.error, floor_of_doubles), run.seconds);
    }
    return list;
}

/// Adds the fastest run of each library at each error.
void add_best(std::string& page, const std::vector<Measured>& runs) {
    say_on(page, "\nfastest to an error of at most\n");
    for (int decade = 3; decade <= 13; ++decade) {
        std::map<bool, const Measured*> best;
        for (const Measured& run : runs) {
            if (!run.error || *run.error > std::pow(10.0, -decade) || !run.chosen.empty()) continue;
            const Measured*& place = best[run.who == "alembert"];
            if (place == nullptr || run.seconds < place->seconds) place = &run;
        }
        if (best.empty()) continue;
        std::string line = fmt::format("  1e-{:<3}", decade);
        for (const bool ours : {true, false})
            if (best[ours] != nullptr)
                line += fmt::format("  {:>24} {:>11.1f} us",
                                    ours ? best[ours]->method : best[ours]->who + " " + best[ours]->method,
                                    1e6 * best[ours]->seconds);
        if (best[true] != nullptr && best[false] != nullptr)
            line += say("   ratio {:.2f}", best[true]->seconds / best[false]->seconds);
        put(page, "{}\n", line);
    }
}

void add_runs(std::string& page, const std::vector<Measured>& runs) {
    put(page, "{:<22}{:>11}{:>11}{:>13}{:>12}{:>9}{:>11}{:>11}{:>11}\n", say("method"), say("tolerance"),
        say("error"), say("time us"), say("evaluations"), say("steps"), say("energy"), say("constraint"),
        say("momentum"));
    const auto cell = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.1e}", *value) : std::string("-");
    };
    for (const Measured& run : runs) {
        const std::string name = run.who != "alembert" ? run.who + " " + run.method
                                 : run.chosen.empty()  ? run.method
                                 : run.went_on.empty() ? run.method + ": " + run.chosen
                                                       : run.method + ": " + run.chosen + ", " + run.went_on;
        const std::string given = run.step ? fmt::format("h {:.1e}", *run.step) : cell(run.tolerance);
        put(page, "{:<22}{:>11}{:>11}{:>13.1f}{:>12}{:>9}{:>11}{:>11}{:>11}\n", name, given,
            run.failure.empty() ? cell(run.error) : say("failed"), 1e6 * run.seconds, run.evaluations, run.steps,
            cell(run.energy_drift), cell(run.constraint_error), cell(run.momentum_error));
    }
}

Json reference_of(const Bench& b) {
    const std::size_t n = b.coordinates.size();
    const std::vector<double>& final = b.reference.final;
    Json result;
    result["final"] = {{"time", b.end},
                       {"coordinates", by_name(b.coordinates, std::span(final).first(n))},
                       {"rates", by_name(b.coordinates, std::span(final).last(n))}};
    result["digits"] = b.reference.digits;
    result["by"] = b.reference.by;
    if (!b.exact) return result;
    for (std::size_t i = 0; i < n; ++i) {
        result["text"]["coordinates"][b.coordinates[i]] = text(b.exact->coordinates[i], 30);
        result["text"]["rates"][b.coordinates[i]] = text(b.exact->rates[i], 30);
    }
    for (std::size_t i = 0; i < b.exact->speeds.size(); ++i)
        result["text"]["speeds"][b.speeds[i]] = text(b.exact->speeds[i], 30);
    return result;
}

}  // namespace

Json as_json(const Bench& b) {
    Json result;
    result["scene"] = b.mechanism.name;
    result["formulation"] = b.formulation;
    result["operations"] = b.operations;
    result["instructions"] = name_of(registers());
    result["reference"] = reference_of(b);
    result["runs"] = Json::array();
    for (const Measured& run : b.runs) result["runs"].push_back(json_of(run));
    return result;
}

std::string as_text(const Bench& b) {
    std::string page;
    say_on(page, "{}: {} operations a right-hand side; to t = {:g}\n", translated_parts(b.formulation),
           b.operations, b.end);
    say_on(page, "reference: {} digits, by {}\n\n", b.reference.digits, b.reference.by);
    add_runs(page, b.runs);
    add_best(page, b.runs);
    return page;
}

std::string as_csv(const Bench& b) {
    return csv_of(b.runs);
}

std::string as_svg(const Bench& b) {
    const std::string& name = b.mechanism.title.empty() ? b.mechanism.name : b.mechanism.title;
    return work_precision(curves_of(b.runs), say("{} until t = {:g}", name, b.end));
}

}  // namespace alembert
