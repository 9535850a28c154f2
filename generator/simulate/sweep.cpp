// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulate/sweep_job.hpp"

namespace alembert {

Sweep sweep(Scene scene, const Grid& grid, const RunOptions& wishes, int threads) {
    SweepJob job({.scene = std::move(scene), .grid = grid, .wishes = wishes, .threads = threads});
    job.prepare();
    job.run();
    return std::move(job.collected());
}

std::vector<std::string> end_columns(const Sweep& s) {
    std::vector<std::string> columns{"t"};
    columns.insert(columns.end(), s.coordinates.begin(), s.coordinates.end());
    for (const std::string& q : s.coordinates) columns.push_back(q + "'");
    columns.insert(columns.end(), s.speeds.begin(), s.speeds.end());
    columns.insert(columns.end(), s.states.begin(), s.states.end());
    columns.emplace_back(s.conserved ? "energy_drift" : "work_balance");
    return columns;
}

std::vector<double> end_values(const SweptMotion& m) {
    std::vector<double> values{m.time};
    for (const auto* part : {&m.final_coordinates, &m.final_rates, &m.final_speeds, &m.final_states})
        values.insert(values.end(), part->begin(), part->end());
    values.push_back(m.drift);
    return values;
}

std::vector<std::string> along_columns(const Sweep& s) {
    std::vector<std::string> columns;
    for (const std::string& statistic : s.along) {
        for (const std::string& q : s.coordinates) columns.push_back(statistic + "_" + q);
        if (s.speeds.empty())
            for (const std::string& q : s.coordinates) columns.push_back(statistic + "_" + q + "'");
        for (const std::string& u : s.speeds) columns.push_back(statistic + "_" + u);
        for (const std::string& z : s.states) columns.push_back(statistic + "_" + z);
    }
    return columns;
}

void SweepTotals::add(const SweptMotion& m, const std::vector<std::string>& names) {
    steps += m.steps;
    rejected += m.rejected;
    evaluations += m.evaluations;
    if (std::isfinite(m.drift)) drift = std::max(drift, m.drift);
    if (!m.failed || failed++ > 0) return;
    for (std::size_t i = 0; i < names.size(); ++i)
        first_failure += fmt::format("{}{} = {:.17g}", i > 0 ? ", " : "", names[i], m.varied[i]);
    first_failure += ": " + m.status;
}

SweepTotals totals_of(const Sweep& sweep) {
    SweepTotals sum;
    for (const SweptMotion& m : sweep.members) sum.add(m, sweep.grid.names());
    return sum;
}

}  // namespace alembert
