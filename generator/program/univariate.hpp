// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Polynomials in one unknown over any field: modulo a prime, of fractions.
///
///     const Univariate<Prime> f = interpolate(points, values);
///     univariate::divisor(f, univariate::derivative(f));       // the repeated roots
///     value_at(f, x), resultant(f, g)
///
/// Polynomials in several unknowns are others: sums of terms (algebra/symbolic/polynomial.hpp), truncated series
/// (stability/expansion.hpp).

#include <cstddef>
#include <utility>
#include <vector>

namespace alembert {

template <typename Number>
using Univariate = std::vector<Number>;  ///< in ascending powers, without leading zeros; empty for zero

namespace univariate {

template <typename Number>
bool vanishes(const Number& x) {
    if constexpr (requires { x.is_zero(); })
        return x.is_zero();
    else
        return zerop(x);
}

template <typename Number>
Number inverse(const Number& x) {
    if constexpr (requires { x.inverse(); })
        return x.inverse();
    else
        return Number(1) / x;
}

template <typename Number>
void trim(Univariate<Number>& f) {
    while (!f.empty() && vanishes(f.back())) f.pop_back();
}

/// Quotient and remainder; g is not zero.
template <typename Number>
std::pair<Univariate<Number>, Univariate<Number>> divided(Univariate<Number> f, const Univariate<Number>& g) {
    Univariate<Number> quotient(f.size() < g.size() ? 0 : f.size() - g.size() + 1);
    const Number lead = inverse(g.back());
    while (f.size() >= g.size()) {
        const Number factor = f.back() * lead;
        const std::size_t shift = f.size() - g.size();
        for (std::size_t k = 0; k + 1 < g.size(); ++k) f[shift + k] = f[shift + k] - factor * g[k];
        f.pop_back();
        trim(f);
        quotient[shift] = factor;
    }
    return {std::move(quotient), std::move(f)};
}

template <typename Number>
Univariate<Number> remainder(Univariate<Number> f, const Univariate<Number>& g) {
    return divided(std::move(f), g).second;
}

template <typename Number>
Univariate<Number> quotient(Univariate<Number> f, const Univariate<Number>& g) {
    return divided(std::move(f), g).first;
}

template <typename Number>
Univariate<Number> derivative(const Univariate<Number>& f) {
    Univariate<Number> result;
    for (std::size_t k = 1; k < f.size(); ++k) result.push_back(f[k] * Number(static_cast<int>(k)));
    trim(result);
    return result;
}

template <typename Number>
Univariate<Number> difference(Univariate<Number> f, const Univariate<Number>& g) {
    f.resize(f.size() > g.size() ? f.size() : g.size());
    for (std::size_t k = 0; k < g.size(); ++k) f[k] = f[k] - g[k];
    trim(f);
    return f;
}

template <typename Number>
void make_monic(Univariate<Number>& f) {
    if (f.empty()) return;
    const Number scale = inverse(f.back());
    for (Number& c : f) c = c * scale;
}

/// The greatest common divisor, monic.
template <typename Number>
Univariate<Number> divisor(Univariate<Number> f, Univariate<Number> g) {
    while (!g.empty()) {
        f = remainder(std::move(f), g);
        make_monic(f);
        std::swap(f, g);
    }
    make_monic(f);
    return f;
}

template <typename Number>
Number raised(const Number& base, std::size_t exponent) {
    Number result(1);
    for (std::size_t k = 0; k < exponent; ++k) result = result * base;
    return result;
}

/// The inverses of numbers of which none is zero, by one inverse of their product: an inverse modulo a prime takes
/// as long as 70 products (Montgomery 1987, §10.3.1).
template <typename Number>
void invert(std::vector<Number>& numbers) {
    std::vector<Number> before;  // the product of those before each
    Number product(1);
    for (const Number& x : numbers) {
        before.push_back(product);
        product = product * x;
    }
    Number rest = inverse(product);
    for (std::size_t k = numbers.size(); k-- > 0;) {
        const Number own = numbers[k];
        numbers[k] = rest * before[k];
        rest = rest * own;
    }
}

}  // namespace univariate

template <typename Number>
Number value_at(const Univariate<Number>& f, const Number& x) {
    Number result(0);
    for (std::size_t k = f.size(); k-- > 0;) result = result * x + f[k];
    return result;
}

/// Polynomials through values at points that are all different, by Newton's divided differences:
///
///     const Interpolation<Prime> through(x);
///     through(y)       // for several y
template <typename Number>
class Interpolation {
public:
    explicit Interpolation(std::vector<Number> x) : x_(std::move(x)) {
        for (std::size_t order = 1; order < x_.size(); ++order)
            for (std::size_t k = x_.size() - 1; k >= order; --k) over_.push_back(x_[k] - x_[k - order]);
        univariate::invert(over_);
    }

    Univariate<Number> operator()(std::vector<Number> y) const {
        auto over = over_.begin();
        for (std::size_t order = 1; order < x_.size(); ++order)
            for (std::size_t k = x_.size() - 1; k >= order; --k) y[k] = (y[k] - y[k - 1]) * *over++;
        Univariate<Number> result(x_.size(), Number(0));
        for (std::size_t k = x_.size(), length = 0; k-- > 0; ++length) {
            for (std::size_t i = length; i > 0; --i) result[i] = result[i - 1] - x_[k] * result[i];
            result[0] = y[k] - x_[k] * result[0];
        }
        univariate::trim(result);
        return result;
    }

private:
    std::vector<Number> x_;
    std::vector<Number> over_;  ///< inverses of differences, in the order in which they are needed
};

template <typename Number>
Univariate<Number> interpolate(const std::vector<Number>& x, std::vector<Number> y) {
    return Interpolation<Number>(x)(std::move(y));
}

/// Zero if and only if f and g have a common root, or one of them is zero (von zur Gathen & Gerhard, Modern
/// Computer Algebra, §6.3).
template <typename Number>
Number resultant(Univariate<Number> f, Univariate<Number> g) {
    Number result(1);
    while (true) {
        if (f.empty() || g.empty()) return Number(0);
        if (g.size() == 1) return result * univariate::raised(g[0], f.size() - 1);
        // Res(f, g) = (−1)^(deg f · deg g) lc(g)^(deg f − deg r) Res(g, r), r the remainder of f
        Univariate<Number> rest = univariate::remainder(f, g);
        if (rest.empty()) return Number(0);
        if ((f.size() - 1) % 2 == 1 && (g.size() - 1) % 2 == 1) result = -result;
        result = result * univariate::raised(g.back(), f.size() - rest.size());
        f = std::move(g);
        g = std::move(rest);
    }
}

}  // namespace alembert
