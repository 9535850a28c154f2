// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/sweep_reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "scene/lists.hpp"
#include "simulate/byte_text.hpp"

namespace alembert {

namespace {

Statistic statistic_of(const std::string& word, const std::string& list) {
    using Kind = Statistic::Kind;
    if (word == "min") return {Kind::least, word};
    if (word == "max") return {Kind::greatest, word};
    if (word == "mean") return {Kind::mean, word};
    if (word == "deviation") return {Kind::deviation, word};
    if (word == "median") return {Kind::quantile, "q0.5", 0.5};
    double q = 0;
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), q);
    if (word.empty() || failure != std::errc() || end != word.data() + word.size() || !(q >= 0 && q <= 1))
        throw ModelError(
            say("--reduce {}: '{}' is no statistic; expected min, max, mean, deviation, median, or a quantile "
                "from 0 to 1, "
                "with commas between, as in --reduce min,max,mean,0.05,0.95",
                list, word));
    return {Kind::quantile, fmt::format("q{}", q), q};
}

/// Differences of neighbours, most of which are small, and counts, most of which are 1.
void put_sketch(std::string& out, const QuantileSketch& sketch) {
    put_bytes(out, sketch.dropped());
    put_bytes(out, sketch.buckets().size());
    std::int64_t last = 0;
    for (const auto& [beginning, count] : sketch.buckets()) {
        if (last == 0)
            put_bytes(out, beginning);
        else
            put_short(out, static_cast<std::uint64_t>(beginning) - static_cast<std::uint64_t>(last));
        put_short(out, static_cast<std::uint64_t>(count));
        last = beginning;
    }
}

void take_sketch(ByteReader& in, QuantileSketch& sketch) {
    const int dropped = in.take<int>();
    std::vector<QuantileSketch::Bucket> buckets(in.take<std::size_t>());
    std::int64_t last = 0;
    for (auto& [beginning, count] : buckets) {
        beginning = last == 0 ? in.take<std::int64_t>()
                              : static_cast<std::int64_t>(static_cast<std::uint64_t>(last) + in.short_number());
        count = static_cast<std::int64_t>(in.short_number());
        last = beginning;
    }
    sketch.set(dropped, std::move(buckets));
}

}  // namespace

std::vector<Statistic> statistics_of(const std::string& list) {
    std::vector<Statistic> result;
    for (const std::string& word : at_commas(list)) {
        const Statistic one = statistic_of(word, list);
        for (const Statistic& other : result)
            if (other.name == one.name)
                throw ModelError(say("--reduce {}: '{}' stands there twice", list, one.name));
        result.push_back(one);
    }
    return result;
}

bool with_quantiles(const std::vector<Statistic>& statistics) {
    return std::any_of(statistics.begin(), statistics.end(),
                       [](const Statistic& s) { return s.kind == Statistic::Kind::quantile; });
}

SweepReduction::SweepReduction(const Sweep& sweep, std::vector<Statistic> statistics)
    : statistics_(std::move(statistics)),
      with_quantiles_(with_quantiles(statistics_)),
      varied_(sweep.grid.names()) {
    const std::vector<std::string> ends = end_columns(sweep);
    for (const std::string& end : ends) names_.push_back((end == ends.back() ? "" : "final_") + end);
    for (const std::string& name : along_columns(sweep)) names_.push_back(name);
    for (const char* const name : {"steps", "evaluations", "event_t"}) names_.emplace_back(name);
    columns_.resize(names_.size());
}

void SweepReduction::add(Column& column, double value) const {
    if (!std::isfinite(value)) return;
    ++column.count;
    column.least = std::min(column.least, value);
    column.greatest = std::max(column.greatest, value);
    column.sum.add(value);
    column.squares.add_square(value);
    if (with_quantiles_) column.sketch.add(value);
}

void SweepReduction::add(std::size_t first, const std::vector<SweptMotion>& motions) {
    for (std::size_t k = 0; k < motions.size(); ++k) {
        const SweptMotion& motion = motions[k];
        if (motion.failed && totals_.failed == 0) first_failed_ = first + k;
        totals_.add(motion, varied_);
        if (motion.failed) continue;
        auto column = columns_.begin();
        for (const std::vector<double>& part : {end_values(motion), motion.along})
            for (const double value : part) add(*column++, value);
        add(*column++, static_cast<double>(motion.steps));
        add(*column, static_cast<double>(motion.evaluations));
        if (motion.status == "stopped") add(columns_.back(), motion.time);
    }
}

void SweepReduction::add(const SweepReduction& other) {
    totals_.steps += other.totals_.steps;
    totals_.rejected += other.totals_.rejected;
    totals_.evaluations += other.totals_.evaluations;
    totals_.failed += other.totals_.failed;
    totals_.drift = std::max(totals_.drift, other.totals_.drift);
    if (other.first_failed_ < first_failed_) {
        first_failed_ = other.first_failed_;
        totals_.first_failure = other.totals_.first_failure;
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        Column& here = columns_[i];
        const Column& there = other.columns_[i];
        here.count += there.count;
        here.least = std::min(here.least, there.least);
        here.greatest = std::max(here.greatest, there.greatest);
        here.sum.add(there.sum);
        here.squares.add(there.squares);
        here.sketch.add(there.sketch);
    }
}

double SweepReduction::value_of(const Column& column, const Statistic& statistic) const {
    const auto n = static_cast<Quad>(column.count);
    switch (statistic.kind) {
        case Statistic::Kind::least:
            return column.least;
        case Statistic::Kind::greatest:
            return column.greatest;
        case Statistic::Kind::mean:
            return static_cast<double>(column.sum.value() / n);
        case Statistic::Kind::deviation: {
            const Quad sum = column.sum.value(), variance = (column.squares.value() - sum * sum / n) / (n - 1);
            return column.count > 1 ? std::sqrt(std::max(0.0, static_cast<double>(variance))) : std::nan("");
        }
        case Statistic::Kind::quantile:
            return column.sketch.quantile(statistic.q);
    }
    return 0;
}

std::vector<ReducedQuantity> SweepReduction::rows() const {
    std::vector<ReducedQuantity> result;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        const Column& column = columns_[i];
        ReducedQuantity row{.name = names_[i],
                            .motions = column.count,
                            .values = {},
                            .quantile_error = with_quantiles_ ? column.sketch.relative_error() : 0};
        for (const Statistic& statistic : statistics_)
            row.values.push_back(column.count > 0 ? value_of(column, statistic) : std::nan(""));
        result.push_back(std::move(row));
    }
    return result;
}

std::string SweepReduction::bytes() const {
    std::string out;
    for (const long count : {totals_.steps, totals_.rejected, totals_.evaluations, totals_.failed})
        put_bytes(out, count);
    put_bytes(out, totals_.drift);
    put_bytes(out, first_failed_);
    put_bytes(out, std::string_view(totals_.first_failure));
    for (const Column& column : columns_) {
        put_bytes(out, column.count);
        put_bytes(out, column.least);
        put_bytes(out, column.greatest);
        put_bytes(out, column.sum.normal());
        put_bytes(out, column.squares.normal());
        put_sketch(out, column.sketch);
    }
    return out;
}

void SweepReduction::set(std::string_view bytes) {
    ByteReader in(bytes);
    for (long* const count : {&totals_.steps, &totals_.rejected, &totals_.evaluations, &totals_.failed})
        *count = in.take<long>();
    totals_.drift = in.take<double>();
    first_failed_ = in.take<std::size_t>();
    totals_.first_failure = in.text();
    for (Column& column : columns_) {
        column.count = in.take<std::int64_t>();
        column.least = in.take<double>();
        column.greatest = in.take<double>();
        column.sum.set(in.take<std::array<std::int64_t, ExactSum::digits>>());
        column.squares.set(in.take<std::array<std::int64_t, ExactSum::digits>>());
        take_sketch(in, column.sketch);
    }
}

}  // namespace alembert
