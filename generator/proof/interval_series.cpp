// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/interval_series.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>
#include <cmath>

#include "proof/interval_matrix.hpp"
#include "proof/interval_of.hpp"

namespace alembert {

using Kind = SeriesNode::Kind;

namespace {

bool is_one(const Interval& x) {
    return x.low == 1 && x.high == 1;
}

/// The value of a function on the interval, and its slope there.
Bounds on(const Interval& x) {
    return {x, {1, 1}, {}};
}

}  // namespace

IntervalSeries::IntervalSeries(Recurrences recurrences, const std::vector<Interval>& parameters)
    : r_(std::move(recurrences)) {
    const std::vector<Interval> values = intervals_of(r_.program, {.parameters = parameters});
    for (const SeriesNode& node : r_.nodes) {
        Weights w;
        for (const Weight& constant : node.constants) w.constant = w.constant + weight(constant, values);
        for (const auto& term : node.linear) w.linear.push_back(weight(term.weight, values));
        for (const auto& term : node.bilinear) w.bilinear.push_back(weight(term.weight, values));
        for (const auto& term : node.implied) w.implied.push_back(weight(term.weight, values));
        if (node.kind == Kind::power) w.exponent = weight(node.exponent, values);
        weights_.push_back(std::move(w));
    }
    for (const SeriesEntry& entry : r_.matrix)
        constant_entries_.push_back(entry.node >= 0 ? Interval{} : weight(entry.constant, values));
    std::vector<int> coordinates(r_.program.coordinates.size()), speeds(r_.accelerations.size());
    for (int id = 0; id < static_cast<int>(r_.nodes.size()); ++id) {
        const SeriesNode& node = r_.nodes[id];
        if (node.kind == Kind::coordinate) coordinates[node.index] = id;
        if (node.kind == Kind::speed) speeds[node.index] = id;
    }
    rates_ =
        r_.coordinate_rates.empty()
            ? std::vector<int>(speeds.begin(), speeds.begin() + static_cast<std::ptrdiff_t>(coordinates.size()))
            : r_.coordinate_rates;
    rates_.insert(rates_.end(), r_.accelerations.begin(), r_.accelerations.end());
    state_ = std::move(coordinates);
    state_.insert(state_.end(), speeds.begin(), speeds.end());
}

Interval IntervalSeries::weight(const Weight& w, const std::vector<Interval>& values) const {
    const Interval number = interval_of(w.number);
    if (w.constant < 0) return number;
    return is_one(number) ? values[w.constant] : number * values[w.constant];
}

void IntervalSeries::from(const Interval& t, std::span<const Interval> box, const Extent& extent) {
    orders_ = extent.order + 1;
    width_ = extent.with_slopes ? 1 + size() : 1;
    coefficients_.assign(r_.nodes.size() * static_cast<std::size_t>(orders_) * width_, Interval{});
    at_order_zero(t, box);
    for (int k = 1; k < orders_; ++k) at_order(k);
}

void IntervalSeries::add(Interval* to, const Interval& factor, const Interval* a) const {
    for (std::size_t j = 0; j < width_; ++j) to[j] = to[j] + (is_one(factor) ? a[j] : factor * a[j]);
}

void IntervalSeries::add_product(Interval* to, const Interval& factor, const Interval* a,
                                 const Interval* b) const {
    const auto scaled = [&](const Interval& x) { return is_one(factor) ? x : factor * x; };
    to[0] = to[0] + scaled(a[0] * b[0]);
    for (std::size_t j = 1; j < width_; ++j) to[j] = to[j] + scaled(a[j] * b[0] + a[0] * b[j]);
}

void IntervalSeries::divide(Interval* to, const Interval* d, double factor) const {
    const Interval divisor = inverse(factor * d[0]);
    to[0] = to[0] * divisor;
    for (std::size_t j = 1; j < width_; ++j) to[j] = (to[j] - to[0] * (factor * d[j])) * divisor;
}

void IntervalSeries::sum(int id, int k, Interval* to) const {
    const SeriesNode& node = r_.nodes[id];
    const Weights& w = weights_[id];
    if (k == 0) to[0] = to[0] + w.constant;
    for (std::size_t i = 0; i < node.linear.size(); ++i) add(to, w.linear[i], at(node.linear[i].node, k));
    std::vector<Interval> product(width_);
    const auto add_products = [&](const SeriesNode::Bilinear& term, const Interval& factor, int first) {
        std::fill(product.begin(), product.end(), Interval{});
        for (int j = first; j <= k; ++j) add_product(product.data(), {1, 1}, at(term.a, j), at(term.b, k - j));
        add(to, factor, product.data());
    };
    for (std::size_t i = 0; i < node.bilinear.size(); ++i) add_products(node.bilinear[i], w.bilinear[i], 0);
    for (std::size_t i = 0; i < node.implied.size(); ++i) add_products(node.implied[i], w.implied[i], 1);
}

void IntervalSeries::at_order_zero(const Interval& t, std::span<const Interval> box) {
    const std::size_t n = r_.program.coordinates.size();
    for (int id = 0; id < static_cast<int>(r_.nodes.size()); ++id) {
        const SeriesNode& node = r_.nodes[id];
        if (node.kind == Kind::time) {
            at(id, 0)[0] = t;
        } else if (node.kind == Kind::coordinate || node.kind == Kind::speed) {
            const std::size_t component =
                static_cast<std::size_t>(node.index) + (node.kind == Kind::speed ? n : 0);
            at(id, 0)[0] = box[component];
            if (width_ > 1) at(id, 0)[1 + component] = {1, 1};
        } else if (node.kind == Kind::unknown && node.index == 0) {
            invert_matrix();
            solve(0);
        } else {
            value_at_zero(id);
        }
    }
}

void IntervalSeries::value_at_zero(int id) {
    const SeriesNode& node = r_.nodes[id];
    Interval* const to = at(id, 0);
    switch (node.kind) {
        case Kind::sum:
        case Kind::residual:
            return sum(id, 0, to);
        case Kind::quotient:
            sum(id, 0, to);
            return divide(to, at(node.w, 0));
        case Kind::unknown:
        case Kind::work:
            return;
        default:
            return function_at_zero(id);
    }
}

void IntervalSeries::function_at_zero(int id) {
    const SeriesNode& node = r_.nodes[id];
    const Interval* const a = at(node.a, 0);
    Interval* const to = at(id, 0);
    const auto through = [&](const Bounds& value) {
        to[0] = value.value;
        for (std::size_t j = 1; j < width_; ++j) to[j] = value.first * a[j];
    };
    switch (node.kind) {
        case Kind::root:
            return through(bounds_of(Op::sqrt, on(a[0])));
        case Kind::sine:
            return through(bounds_of(Op::sin, on(a[0])));
        case Kind::cosine:
            return through(bounds_of(Op::cos, on(a[0])));
        case Kind::hyperbolic_sine:
            return through(bounds_of(Op::sinh, on(a[0])));
        case Kind::hyperbolic_cosine:
            return through(bounds_of(Op::cosh, on(a[0])));
        case Kind::exponential:
            return through(bounds_of(Op::exp, on(a[0])));
        case Kind::power: {
            const Rational& exponent = node.exponent.number;
            const bool is_whole = node.exponent.constant < 0 && cln::denominator(exponent) == 1 &&
                                  cln::abs(exponent) < Rational(100);
            if (!is_whole) return through(bounds_of(Op::pow, on(a[0]), {weights_[id].exponent, {}, {}}));
            const int n = cln::cl_I_to_int(cln::numerator(exponent));
            return through(n >= 0 ? power(on(a[0]), n) : inverse(power(on(a[0]), -n)));
        }
        case Kind::area:
        case Kind::ratio:
            return through(bounds_of(node.op, on(a[0])));
        case Kind::turn: {
            const Interval* const b = at(node.b, 0);
            const Bounds by_a = bounds_of(Op::atan2, on(a[0]), {b[0], {}, {}}),
                         by_b = bounds_of(Op::atan2, {a[0], {}, {}}, on(b[0]));
            to[0] = by_a.value;
            for (std::size_t j = 1; j < width_; ++j) to[j] = by_a.first * a[j] + by_b.first * b[j];
            return;
        }
        default:
            to[0] = Interval::whole();
    }
}

void IntervalSeries::at_order(int k) {
    const std::size_t n = r_.program.coordinates.size();
    for (int id = 0; id < static_cast<int>(r_.nodes.size()); ++id) {
        const SeriesNode& node = r_.nodes[id];
        if (node.kind == Kind::coordinate || node.kind == Kind::speed) {
            const std::size_t component =
                static_cast<std::size_t>(node.index) + (node.kind == Kind::speed ? n : 0);
            const Interval* const rate = at(rates_[component], k - 1);
            const Interval part = inverse(Interval{static_cast<double>(k), static_cast<double>(k)});
            add(at(id, k), k == 1 ? Interval{1, 1} : part, rate);
        } else if (node.kind == Kind::time) {
            if (k == 1) at(id, k)[0] = {1, 1};
        } else if (node.kind == Kind::unknown) {
            if (node.index == 0) solve(k);
        } else {
            next(id, k);
        }
    }
}

void IntervalSeries::next(int id, int k) {
    const SeriesNode& node = r_.nodes[id];
    Interval* const to = at(id, k);
    switch (node.kind) {
        case Kind::sum:
        case Kind::residual:
            return sum(id, k, to);
        case Kind::work:
            return;
        case Kind::quotient:  // d⊗z = (numerator)
            sum(id, k, to);
            for (int j = 1; j <= k; ++j) add_product(to, {-1, -1}, at(node.w, j), at(id, k - j));
            return divide(to, at(node.w, 0));
        default:
            return next_of_function(id, k);
    }
}

void IntervalSeries::next_of_function(int id, int k) {
    const SeriesNode& node = r_.nodes[id];
    Interval* const to = at(id, k);
    if (!std::isfinite(at(id, 0)[0].size())) {  // no series where the function has no value, or jumps
        std::fill(to, to + width_, Interval::whole());
        return;
    }
    const Interval one{1, 1}, part = inverse(Interval{static_cast<double>(k), static_cast<double>(k)});
    const auto times = [](double j) { return Interval{j, j}; };
    const auto scale = [&](const Interval& factor) {
        for (std::size_t j = 0; j < width_; ++j) to[j] = to[j] * factor;
    };
    /// Σ_{j≥1} j x_j y_{k−j}
    const auto rate_times = [&](int x, int y, double sign) {
        for (int j = 1; j <= k; ++j) add_product(to, times(sign * j), at(x, j), at(y, k - j));
    };
    switch (node.kind) {
        case Kind::root:  // z⊗z = a
            add(to, one, at(node.a, k));
            for (int j = 1; j < k; ++j) add_product(to, {-1, -1}, at(id, j), at(id, k - j));
            return divide(to, at(id, 0), 2);
        case Kind::power:  // k a_0 z_k = Σ_{j<k} (α(k−j) − j) a_{k−j} z_j
            for (int j = 0; j < k; ++j)
                add_product(to, weights_[id].exponent * times(k - j) - times(j), at(node.a, k - j), at(id, j));
            return divide(to, at(node.a, 0), k);
        case Kind::exponential:
            rate_times(node.a, id, 1);
            return scale(part);
        case Kind::sine:
        case Kind::hyperbolic_sine:
        case Kind::hyperbolic_cosine:
        case Kind::area:
            rate_times(node.a, node.w, 1);
            return scale(part);
        case Kind::cosine:
            rate_times(node.a, node.w, -1);
            return scale(part);
        case Kind::ratio:  // w⊗z' = a'
            add(to, times(k), at(node.a, k));
            for (int j = 1; j < k; ++j) add_product(to, times(-j), at(id, j), at(node.w, k - j));
            return divide(to, at(node.w, 0), k);
        case Kind::turn:  // w⊗z' = x y' − y x'
            rate_times(node.a, node.b, 1);
            rate_times(node.b, node.a, -1);
            for (int j = 1; j < k; ++j) add_product(to, times(-j), at(id, j), at(node.w, k - j));
            return divide(to, at(node.w, 0), k);
        default:
            to[0] = Interval::whole();
    }
}

void IntervalSeries::invert_matrix() {
    const std::size_t n = r_.unknowns.size();
    std::vector<Interval> matrix(n * n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            const SeriesEntry& entry = r_.matrix[i * (i + 1) / 2 + j];
            matrix[i * n + j] = matrix[j * n + i] =
                entry.node >= 0 ? at(entry.node, 0)[0] : constant_entries_[i * (i + 1) / 2 + j];
        }
    inverse_ = inverse_of(matrix, n);
}

/// K_0 z_k = r_k, and by the state K_0 dz_k = dr_k − dK_0 z_k.
void IntervalSeries::solve(int k) {
    const std::size_t n = r_.unknowns.size();
    std::vector<Interval> right(n);
    const auto solved = [&](std::size_t i) {
        Interval result;
        for (std::size_t j = 0; j < n; ++j) result = result + inverse_[i * n + j] * right[j];
        return result;
    };
    for (std::size_t i = 0; i < n; ++i) right[i] = at(r_.residuals[i], k)[0];
    for (std::size_t i = 0; i < n; ++i) at(r_.unknowns[i], k)[0] = solved(i);
    for (std::size_t s = 1; s < width_; ++s) {
        for (std::size_t i = 0; i < n; ++i) {
            right[i] = at(r_.residuals[i], k)[s];
            for (std::size_t j = 0; j < n; ++j) {
                const SeriesEntry& entry = r_.matrix[std::max(i, j) * (std::max(i, j) + 1) / 2 + std::min(i, j)];
                if (entry.node >= 0) right[i] = right[i] - at(entry.node, 0)[s] * at(r_.unknowns[j], k)[0];
            }
        }
        for (std::size_t i = 0; i < n; ++i) at(r_.unknowns[i], k)[s] = solved(i);
    }
}

}  // namespace alembert
