// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Quantiles of any number of values in bounded memory.
///
///     QuantileSketch sketch;
///     for (double x : values) sketch.add(x);
///     sketch.quantile(0.5);          // the median
///     sketch.relative_error();       // 0 for up to 65536 different values
///
/// The values are counted by their first binary digits: all 53 of them at the beginning, and one digit less
/// whenever more than 65536 different beginnings would have to be kept. So the quantiles are exact for up to 65536
/// different values. Beyond that, each order statistic lies within 2^(−digits) of its true value, relative to it;
/// with values of one sign and one order of magnitude that is 1e-5 or better. How many digits are left depends on
/// the values alone: a set with more values never needs fewer. Neither the order of the values nor how they were
/// merged changes the result, not even in the last bit.
///
/// A quantile q is interpolated between the order statistics beside q (n − 1), as by NumPy and R (type 7 of
/// Hyndman & Fan, Am. Stat. 50 (1996) 361).

#include <cstdint>
#include <utility>
#include <vector>

namespace alembert {

class QuantileSketch {
public:
    static constexpr std::size_t most = 65536;

    /// A finite number.
    void add(double x);
    void add(const QuantileSketch& other);

    /// q from 0 to 1; not a number if there are no values.
    double quantile(double q) const;
    double relative_error() const;

    /// A beginning of binary digits, and how many values have it.
    using Bucket = std::pair<std::int64_t, std::int64_t>;
    /// Sorted; what `set` takes back, with the digits that were dropped.
    const std::vector<Bucket>& buckets() const;
    int dropped() const { return (settle(), dropped_); }
    void set(int dropped, std::vector<Bucket> buckets);

private:
    /// Sorts what was added since the last time into the buckets.
    void settle() const;
    double value_of(std::int64_t beginning) const;
    /// The order statistic with so many smaller ones.
    double at(std::int64_t rank) const;
    static void merge(std::vector<Bucket>& into, int& dropped, std::vector<Bucket> more);

    mutable std::vector<Bucket> buckets_;
    mutable std::vector<std::int64_t> added_;
    mutable int dropped_ = 0;
    std::int64_t count_ = 0;
};

}  // namespace alembert
