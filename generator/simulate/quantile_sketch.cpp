// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/quantile_sketch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace alembert {

namespace {

using Bucket = QuantileSketch::Bucket;

/// Integers in the order of the numbers; their first bits are the number's.
std::int64_t ordered(double x) {
    const auto bits = std::bit_cast<std::int64_t>(x);
    return bits >= 0 ? bits : std::numeric_limits<std::int64_t>::min() - bits;
}

double number(std::int64_t ordered) {
    return std::bit_cast<double>(ordered >= 0 ? ordered : std::numeric_limits<std::int64_t>::min() - ordered);
}

/// Neighbours with the same beginning become one.
void unite(std::vector<Bucket>& sorted) {
    std::size_t last = 0;
    for (std::size_t k = 1; k < sorted.size(); ++k) {
        if (sorted[k].first == sorted[last].first)
            sorted[last].second += sorted[k].second;
        else
            sorted[++last] = sorted[k];
    }
    if (!sorted.empty()) sorted.resize(last + 1);
}

void drop_digits(std::vector<Bucket>& buckets, int count) {
    if (count == 0) return;
    for (Bucket& bucket : buckets) bucket.first >>= count;
    unite(buckets);
}

}  // namespace

void QuantileSketch::add(double x) {
    added_.push_back(ordered(x));
    ++count_;
    if (added_.size() >= most) settle();
}

void QuantileSketch::add(const QuantileSketch& other) {
    settle();
    std::vector<Bucket> more = other.buckets();
    drop_digits(more, std::max(0, dropped_ - other.dropped_));
    drop_digits(buckets_, std::max(0, other.dropped_ - dropped_));
    dropped_ = std::max(dropped_, other.dropped_);
    merge(buckets_, dropped_, std::move(more));
    count_ += other.count_;
}

void QuantileSketch::merge(std::vector<Bucket>& into, int& dropped, std::vector<Bucket> more) {
    const auto middle = static_cast<std::ptrdiff_t>(into.size());
    into.insert(into.end(), more.begin(), more.end());
    std::inplace_merge(into.begin(), into.begin() + middle, into.end());
    unite(into);
    for (; into.size() > most; ++dropped) drop_digits(into, 1);
}

void QuantileSketch::settle() const {
    if (added_.empty()) return;
    std::sort(added_.begin(), added_.end());
    std::vector<Bucket> more;
    more.reserve(added_.size());
    for (const std::int64_t value : added_) more.emplace_back(value >> dropped_, 1);
    added_.clear();
    unite(more);
    merge(buckets_, dropped_, std::move(more));
}

const std::vector<Bucket>& QuantileSketch::buckets() const {
    settle();
    return buckets_;
}

void QuantileSketch::set(int dropped, std::vector<Bucket> buckets) {
    added_.clear();
    dropped_ = dropped;
    buckets_ = std::move(buckets);
    count_ = 0;
    for (const Bucket& bucket : buckets_) count_ += bucket.second;
}

double QuantileSketch::value_of(std::int64_t beginning) const {
    const std::int64_t least = beginning * (std::int64_t{1} << dropped_),
                       greatest = least + (std::int64_t{1} << dropped_) - 1;
    return least == greatest ? number(least) : number(least) / 2 + number(greatest) / 2;
}

double QuantileSketch::at(std::int64_t rank) const {
    for (const auto& [beginning, count] : buckets_) {
        if (rank < count) return value_of(beginning);
        rank -= count;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

double QuantileSketch::quantile(double q) const {
    settle();
    if (count_ == 0) return std::numeric_limits<double>::quiet_NaN();
    const double place = q * static_cast<double>(count_ - 1), low = std::floor(place);
    const auto rank = static_cast<std::int64_t>(low);
    const double below = at(rank), above = at(std::min(rank + 1, count_ - 1));
    return below + (place - low) * (above - below);
}

double QuantileSketch::relative_error() const {
    settle();
    return dropped_ == 0 ? 0 : std::ldexp(1.0, dropped_ - 53);
}

}  // namespace alembert
