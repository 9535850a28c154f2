// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "present/report/json.hpp"
#include "simulate/sweep_job.hpp"

namespace alembert {

/// Everything except the rows.
Json as_json(const Sweep& sweep, const SweepTotals& totals);
/// One row for each of the motions.
Json rows_as_json(const Sweep& sweep, const std::vector<SweptMotion>& motions);
std::string csv_header(const Sweep& sweep);
std::string csv_rows(const std::vector<SweptMotion>& motions);
/// A summary in a few lines.
std::string as_text(const Sweep& sweep, const SweepTotals& totals);

/// One row for each quantity: its name, how many motions have it, and the statistics.
Json as_json(const SweepReduction& reduction);
std::string as_csv(const SweepReduction& reduction);
/// The error of quantiles, in a line; empty if there are none.
std::string quantile_error_as_text(const SweepReduction& reduction);

/// What a job did, without its rows, which are in `file` (empty for none). `points` says how they were chosen.
Json as_json(const SweepJob& job, const Json& points, const std::string& file);
/// The same in a few lines.
std::string as_text(const SweepJob& job, const std::string& file);

}  // namespace alembert
