// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A sweep reduced to statistics of what its motions are at their ends, in memory that does not grow with their
/// number.
///
///     SweepReduction all(sweep, statistics_of("min,max,mean,0.05,0.5,0.95"));
///     all.add(0, motions);                            // or all.add(another), from another process
///     all.rows()[0].values;                           // of the quantity rows()[0].name
///
/// Motions that failed are counted and left out. Least and greatest value, mean and deviation are those of exact
/// sums (exact_sum.hpp), rounded once; quantiles have the error that quantile_sketch.hpp says. No bit of the
/// result depends on the order in which motions were added or reductions merged.

#include <string>
#include <vector>

#include "simulate/exact_sum.hpp"
#include "simulate/quantile_sketch.hpp"
#include "simulate/sweep.hpp"

namespace alembert {

struct Statistic {
    enum class Kind { least, greatest, mean, deviation, quantile };
    Kind kind;
    std::string name;  ///< min, max, mean, deviation, q0.05
    double q = 0;      ///< of a quantile
};

/// "min,max,mean,deviation,median,0.05": a number is a quantile. Throws ModelError for any other word, and for one
/// that stands there twice.
std::vector<Statistic> statistics_of(const std::string& list);

bool with_quantiles(const std::vector<Statistic>& statistics);

struct ReducedQuantity {
    std::string name;
    std::int64_t motions = 0;    ///< how many had a value
    std::vector<double> values;  ///< in the order of the statistics; not a number where no motion had one
    double quantile_error = 0;   ///< of quantiles, relative to their values, at the most
};

class SweepReduction {
public:
    SweepReduction(const Sweep& sweep, std::vector<Statistic> statistics);

    /// Motions from `first` on, which come after all that were added in this way.
    void add(std::size_t first, const std::vector<SweptMotion>& motions);
    void add(const SweepReduction& other);

    /// What `end_columns` and `along_columns` have, steps and evaluations, and event_t, the times of motions that
    /// an event ended.
    std::vector<ReducedQuantity> rows() const;
    const std::vector<Statistic>& statistics() const { return statistics_; }
    const SweepTotals& totals() const { return totals_; }

    /// Everything but the statistics that are asked for.
    std::string bytes() const;
    void set(std::string_view bytes);

private:
    struct Column {
        std::int64_t count = 0;
        double least = HUGE_VAL, greatest = -HUGE_VAL;
        ExactSum sum, squares;
        QuantileSketch sketch;
    };
    void add(Column& column, double value) const;
    double value_of(const Column& column, const Statistic& statistic) const;

    std::vector<Statistic> statistics_;
    bool with_quantiles_;
    std::vector<std::string> names_, varied_;
    std::vector<Column> columns_;
    SweepTotals totals_;
    std::size_t first_failed_ = static_cast<std::size_t>(-1);
};

}  // namespace alembert
