// SPDX-License-Identifier: MIT
#pragma once

/// A function of one or two arguments through given points: a polynomial between neighbouring ones.
///
///     const TabulatedFunction f({.axes = {{.at = {0, 1, 3}}}, .values = {0, 2, 2}});      // linear between them
///     f.value<double>({0, 0}, {&x, nullptr});           // f(x)
///     f.value<double>({1, 0}, {&x, nullptr});           // f'(x)
///
/// `linear` connects the points (of two arguments: bilinear in each cell), `cubic` is the interpolating spline
/// with continuous second derivatives, which vanish at the ends (de Boor, A Practical Guide to Splines (2001), ch.
/// IV; of two arguments the tensor product, ch. XVII), `pchip` the cubic with continuous first derivatives that
/// rises and falls where the points do (Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5 (1984), with three points
/// at the ends). The polynomials' coefficients are doubles, and all that evaluates a table takes the same ones.
///
/// Knots at which a derivative jumps divide an axis into intervals; even ones have side 1, odd ones side −1. A run
/// holds the side, as it holds the sign of what |x| depends on (program/switches.hpp): a value with a given side
/// is that of the nearest interval of that side, whose polynomial goes on beyond its ends. The side function,
/// whose sign is the side and whose zeros are these knots, is (x − a)(b − x)/(b − a) with alternating sign, which
/// is continuous with its first derivative.
///
/// Outside of the points there is no value (NaN), or the function keeps its last value, or goes on along the line.

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "alembert/base/interval.hpp"

namespace alembert {

struct TableAxis {
    std::vector<double> at;  ///< ascending, two or more
    double period = 0;       ///< 0 if there is none
    /// Positions of the knots at which a derivative up to the third jumps, for the function and for its
    /// derivatives: the same ones.
    std::vector<int> kinks[2] = {};
    double step = 0;  ///< the mean distance
};

class TabulatedFunction {
public:
    enum class Interpolation : unsigned char { linear, cubic, pchip };
    enum class Outside : unsigned char { error, hold, line };
    struct Points {
        std::vector<TableAxis> axes;  ///< one or two; kinks and step follow
        std::vector<double> values;   ///< row by row: the last axis runs fastest
        Interpolation interpolation = Interpolation::linear;
        Outside outside = Outside::error;
    };
    using Orders = std::array<int, 2>;
    using Sides = std::array<int, 2>;  ///< 0 where none is held

    /// Orders from this on are those of a side function: `side_order` gives them.
    static constexpr int side_function = 100;

    /// Of a function with a period the last point is that of the first one, a period later.
    explicit TabulatedFunction(Points points);
    TabulatedFunction(const TabulatedFunction&) = delete;
    TabulatedFunction& operator=(const TabulatedFunction&) = delete;

    std::size_t arguments() const { return axes_.size(); }
    const std::vector<TableAxis>& axes() const { return axes_; }
    int degree() const { return degree_; }
    Outside outside() const { return outside_; }
    Interpolation interpolation() const { return interpolation_; }
    /// Of each cell those of (x − x_i)^j, or of (x − x_i)^j (y − y_k)^l with l running fastest.
    const std::vector<double>& coefficients() const { return coefficients_; }
    /// Equal for equal tables.
    std::string fingerprint() const;

    /// Whether there are knots along an axis that divide it for the derivative of these orders.
    bool has_kinks(std::size_t axis, const Orders& orders) const { return !kinks(axis, orders).empty(); }
    /// The order by which a call has the side function of these kinks; its derivatives have the next ones.
    static int side_order(std::size_t axis, const Orders& orders) {
        return side_function + 20 * (orders[0] + orders[1] > 0 ? 1 : 0) + 10 * static_cast<int>(axis);
    }

    /// The derivative of these orders. A derivative of a side function takes one argument and one order.
    template <typename Real>
    Real value(const Orders& orders, const std::array<const Real*, 2>& x, const Sides& sides = {0, 0}) const;

    /// Whether there is a value at x along this axis.
    bool has(std::size_t axis, double x) const {
        const TableAxis& a = axes_[axis];
        return outside_ != Outside::error || a.period > 0 || (x >= a.at.front() && x <= a.at.back());
    }

    /// Of a side function, from the bounds of its argument.
    Bounds side_bounds(int order, const Bounds& x) const;

    /// What code in memory is given in place of the table: `value_for_code(call, x)`. It lives as long as the
    /// table.
    struct Call {
        const TabulatedFunction* table;
        Orders orders;
        Sides sides;
        int held;                           ///< how many sides are still to be given
        std::array<const Call*, 2> with{};  ///< the call whose next side is −1, or 1
    };
    const Call& call(const Orders& orders, bool is_held) const;

private:
    struct Cell {
        std::size_t piece;
        double from;     ///< the knot at which it begins
        int beyond = 0;  ///< −1 before the first point, 1 behind the last one
        bool has_value = true;
    };
    const std::vector<int>& kinks(std::size_t axis, const Orders& orders) const {
        return axes_[axis].kinks[orders[0] + orders[1] > 0 ? 1 : 0];
    }
    struct Gap {
        std::optional<double> low, high;  ///< the kinks around
        long before = 0, after = 0;       ///< pieces on the other sides of them, counted through all periods
        long number = 0;                  ///< of kinks before
        int side() const { return number % 2 == 0 ? 1 : -1; }
    };
    long piece_at(const TableAxis& axis, double x) const;
    Gap gap_of(const TableAxis& axis, const std::vector<int>& kinks, long piece) const;
    double knot(const TableAxis& axis, long index) const;
    Cell cell(std::size_t axis, double x, const std::vector<int>& kinks, int side) const;
    Interval side_range(const TableAxis& axis, const std::vector<int>& kinks, int order, const Interval& x) const;
    const Call& new_call(const Orders& orders, const Sides& sides, int held) const;
    template <typename Real>
    Real side_value(int order, const Real& x) const;
    template <typename Real>
    void weights(std::array<Real, 4>& w, int order, const Real& x, const Cell& cell, const TableAxis& axis) const;

    void find_kinks();

    std::vector<TableAxis> axes_;
    Interpolation interpolation_;
    Outside outside_;
    int degree_;
    std::vector<double> coefficients_;
    mutable std::mutex lock_;
    mutable std::map<std::array<int, 5>, std::unique_ptr<Call>> calls_;
};

/// Where in a table a number lies. Numbers of other types have a function of this name beside them.
template <typename Real>
double place_of(const Real& x) requires requires {
    static_cast<double>(x);
}
{ return static_cast<double>(x); }

template <typename Real>
Real real_in(double x) {
    if constexpr (requires { Real::of_double(x); })
        return Real::of_double(x);
    else
        return static_cast<Real>(x);
}

/// The coefficients' factors: value = Σ w_j c_j, from u = x − x_i and the order of the derivative.
template <typename Real>
void TabulatedFunction::weights(std::array<Real, 4>& w, int order, const Real& x, const Cell& cell,
                                const TableAxis& axis) const {
    const bool is_beyond = cell.beyond != 0, holds = is_beyond && outside_ == Outside::hold;
    const double end = cell.beyond < 0 ? 0 : axis.at[cell.piece + 1] - axis.at[cell.piece];
    if (is_beyond && (order > 1 || (holds && order > 0))) {
        w.fill(Real(0));
        return;
    }
    const auto falling = [&](const Real& u, int times) {  // the derivative of u^j by u
        Real power(1);
        for (int j = 0; j < 4; ++j) {
            double factor = 1;
            for (int k = 0; k < times; ++k) factor *= j - k;
            if (j < times) {
                w[static_cast<std::size_t>(j)] = Real(0);
                continue;
            }
            w[static_cast<std::size_t>(j)] = factor == 1 ? power : real_in<Real>(factor) * power;
            if (j < degree_) power *= u;
        }
    };
    if (!is_beyond) {
        falling(x - real_in<Real>(cell.from), order);
    } else if (holds || order == 1) {
        falling(real_in<Real>(end), order);
    } else {  // along the line
        std::array<Real, 4> slope{};
        falling(real_in<Real>(end), 1);
        slope = w;
        falling(real_in<Real>(end), 0);
        const Real further = x - real_in<Real>(cell.from + end);
        for (std::size_t j = 1; j < 4; ++j) w[j] += slope[j] * further;
    }
}

template <typename Real>
Real TabulatedFunction::side_value(int order, const Real& x) const {
    const TableAxis& axis = axes_[static_cast<std::size_t>(order / 10 % 2)];
    const std::vector<int>& kinks = axis.kinks[(order - side_function) / 20];
    const Gap gap = gap_of(axis, kinks, piece_at(axis, place_of(x)));
    const int times = order % 10;
    const Real sign = real_in<Real>(gap.side());
    if (gap.low && gap.high) {
        const Real a = real_in<Real>(*gap.low), b = real_in<Real>(*gap.high),
                   width = real_in<Real>(*gap.high - *gap.low);
        if (times == 0) return sign * (x - a) * (b - x) / width;
        if (times == 1) return sign * ((b - x) + (a - x)) / width;
        return times == 2 ? real_in<Real>(-2) * sign / width : Real(0);
    }
    if (times > 1) return Real(0);
    if (gap.low) return times == 0 ? sign * (x - real_in<Real>(*gap.low)) : sign;
    if (gap.high) return times == 0 ? sign * (real_in<Real>(*gap.high) - x) : real_in<Real>(-1) * sign;
    return times == 0 ? Real(1) : Real(0);
}

template <typename Real>
Real TabulatedFunction::value(const Orders& orders, const std::array<const Real*, 2>& x,
                              const Sides& sides) const {
    if (orders[0] >= side_function) return side_value(orders[0], *x[0]);
    if (orders[0] > degree_ || orders[1] > degree_) return Real(0);
    const auto columns = static_cast<std::size_t>(degree_) + 1;
    std::array<std::array<Real, 4>, 2> w{};
    std::size_t at = 0;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
        const Cell c = cell(k, place_of(*x[k]), kinks(k, orders), sides[k]);
        if (!c.has_value) return real_in<Real>(std::numeric_limits<double>::quiet_NaN());
        weights(w[k], orders[k], *x[k], c, axes_[k]);
        at = k == 0 ? c.piece : at * (axes_[k].at.size() - 1) + c.piece;
    }
    const double* const c = coefficients_.data() + at * (axes_.size() == 1 ? columns : columns * columns);
    Real sum(0);
    for (std::size_t j = 0; j < columns; ++j) {
        if (axes_.size() == 1) {
            sum += w[0][j] * real_in<Real>(c[j]);
            continue;
        }
        Real row(0);
        for (std::size_t l = 0; l < columns; ++l) row += w[1][l] * real_in<Real>(c[columns * j + l]);
        sum += w[0][j] * row;
    }
    return sum;
}

/// For code in memory, which carries the address of a TabulatedFunction::Call in the bits of a double.
double bits_for_code(const TabulatedFunction::Call& call);
double held_for_code(double call, double side);
double value_for_code(double call, double x);
double value_of_two_for_code(double call, double x, double y);

}  // namespace alembert
