// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/sweep.hpp"

#include <algorithm>

#include "alembert/native/registers.hpp"
#include "base/language/say.hpp"
#include "present/report/page.hpp"

namespace alembert {

namespace {

const char* drift_name(const Sweep& s) {
    return s.conserved ? "energy_drift" : "work_balance";
}

/// A field of a CSV file (RFC 4180), on one line.
std::string quoted(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

/// At how many states the right-hand side, or the power series, was computed in each second of processor time.
double states_per_second(const Sweep& s) {
    return s.timings.integrate > 0 ? s.computed / s.timings.integrate : 0;
}

}  // namespace

Json as_json(const Sweep& s, const SweepTotals& sum) {
    Json result;
    result["members"] = s.grid.size();
    result["failed"] = sum.failed;
    for (const Axis& axis : s.grid.axes)
        result["vary"].push_back(
            {{"name", axis.name}, {"from", axis.from}, {"to", axis.to}, {"count", axis.count}});
    result["method"] = s.method;
    result["formulation"] = s.formulation;
    result["side_by_side"] = s.packed ? 8 : 1;
    result["instructions"] = name_of(registers());
    result["threads"] = s.threads;
    result["steps"] = sum.steps;
    result["rejected"] = sum.rejected;
    result["evaluations"] = sum.evaluations;
    result["states_per_second"] = states_per_second(s);
    result[drift_name(s)] = sum.drift;
    result["seconds"] = {{"derive", s.seconds},
                         {"compile", s.timings.compile},
                         {"start", s.timings.start},
                         {"integrate", s.timings.integrate}};
    return result;
}

Json rows_as_json(const Sweep& s, const std::vector<SweptMotion>& motions) {
    Json rows = Json::array();
    for (const SweptMotion& m : motions) {
        Json row;
        row["varied"] = by_name(s.grid.names(), m.varied);
        row["final"] = {{"time", m.time},
                        {"coordinates", by_name(s.coordinates, m.final_coordinates)},
                        {"rates", by_name(s.coordinates, m.final_rates)}};
        if (!s.speeds.empty()) row["final"]["speeds"] = by_name(s.speeds, m.final_speeds);
        if (!s.states.empty()) row["final"]["states"] = by_name(s.states, m.final_states);
        row[drift_name(s)] = m.drift;
        if (!s.along.empty()) row["along"] = by_name(along_columns(s), m.along);
        row["steps"] = m.steps;
        row["rejected"] = m.rejected;
        row["evaluations"] = m.evaluations;
        row["status"] = m.status;
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string csv_header(const Sweep& s) {
    std::string text;
    for (const Axis& axis : s.grid.axes) text += axis.name + ",";
    const std::vector<std::string> columns = end_columns(s);
    for (const std::string& column : columns) text += (column == columns.back() ? "" : "final_") + column + ",";
    for (const std::string& column : along_columns(s)) text += column + ",";
    return text + "steps,rejected,evaluations,status\n";
}

std::string csv_rows(const std::vector<SweptMotion>& motions) {
    std::string text;
    for (const SweptMotion& m : motions) {
        for (const std::vector<double>& part : {m.varied, end_values(m), m.along})
            for (const double x : part) put(text, "{:.17g},", x);
        put(text, "{},{},{},{}\n", m.steps, m.rejected, m.evaluations, quoted(m.status));
    }
    return text;
}

std::string as_text(const Sweep& s, const SweepTotals& sum) {
    std::string page;
    say_on(page,
           "{} with {}: {} motions{} on {} thread{}, {} steps, {} rejected, {} evaluations of {} operations, {} "
           "{:.2e} at the most\n",
           translated_parts(s.formulation), s.method, s.grid.size(), s.packed ? say(", eight side by side") : "",
           s.threads, s.threads == 1 ? "" : "s", sum.steps, sum.rejected, sum.evaluations, s.operations,
           s.conserved ? say("energy drift") : say("work balance"), sum.drift);
    say_on(page, "integrated in {:.3f} s of processor time: {:.3g} states a second\n", s.timings.integrate,
           states_per_second(s));
    return page;
}

Json as_json(const SweepReduction& reduction) {
    Json rows = Json::array();
    for (const ReducedQuantity& quantity : reduction.rows()) {
        Json row{{"name", quantity.name}, {"motions", quantity.motions}};
        for (std::size_t k = 0; k < quantity.values.size(); ++k)
            row[reduction.statistics()[k].name] = quantity.values[k];
        if (with_quantiles(reduction.statistics())) row["quantile_error"] = quantity.quantile_error;
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string as_csv(const SweepReduction& reduction) {
    std::string text = "quantity,motions";
    for (const Statistic& statistic : reduction.statistics()) text += "," + statistic.name;
    text += "\n";
    for (const ReducedQuantity& quantity : reduction.rows()) {
        put(text, "{},{}", quoted(quantity.name), quantity.motions);
        for (const double value : quantity.values) put(text, ",{:.17g}", value);
        text += "\n";
    }
    return text;
}

std::string quantile_error_as_text(const SweepReduction& reduction) {
    if (!with_quantiles(reduction.statistics())) return {};
    double worst = 0;
    for (const ReducedQuantity& quantity : reduction.rows()) worst = std::max(worst, quantity.quantile_error);
    return worst == 0 ? say("the quantiles are exact\n")
                      : say("the relative error of quantiles is at most {:.1e}\n", worst);
}

Json as_json(const SweepJob& job, const Json& points, const std::string& file) {
    Json result = as_json(job.sweep(), job.totals());
    if (job.is_shared()) result["ranks"] = job.processes();
    if (job.resumes()) result["resumed"] = job.resumed();
    result.update(points);
    if (job.is_reduced()) result["reduced"] = as_json(job.reduction());
    if (!file.empty()) result["file"] = file;
    return result;
}

std::string as_text(const SweepJob& job, const std::string& file) {
    std::string text = as_text(job.sweep(), job.totals());
    if (job.is_shared()) text += say("shared by {} processes\n", job.processes());
    if (job.resumed() > 0) text += say("{} motions were there from before\n", job.resumed());
    if (job.is_reduced()) text += quantile_error_as_text(job.reduction());
    return file.empty() ? text : text + say("wrote {}\n", file);
}

}  // namespace alembert
