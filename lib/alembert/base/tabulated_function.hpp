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
/// Knots at which a derivative jumps divide an axis into intervals, which are numbered from 0; through all
/// periods, where there is one. A run holds the number, as it holds the sign of what |x| depends on
/// (program/switches.hpp): the value is then that of the interval, whose polynomials go on beyond its ends. With
/// at most `most_told` such knots the number is held modulo `cycle`, of which a step cannot pass so many; with
/// more it is even or odd, and the nearest such interval is meant. The side function, which is positive in even
/// ones and negative in odd ones, is then (x − a)(b − x)/(b − a) with alternating sign, continuous with its first
/// derivative.
///
/// Between two numbers the value is the mixture of both, as where a motion slides along a jump.
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
    std::vector<double> at;           ///< ascending, two or more
    double period = 0;                ///< 0 if there is none
    std::vector<int> kinks = {};      ///< positions of the knots at which a derivative up to the third jumps
    std::vector<int> intervals = {};  ///< of each piece the number of such knots before it
    double pieces_a_unit = 0;         ///< on average
};

class TabulatedFunction {
public:
    enum class Interpolation : unsigned char { linear, cubic, pchip };
    enum class Outside : unsigned char { error, hold, line };
    struct Points {
        std::vector<TableAxis> axes;  ///< one or two; what follows from the places is found
        std::vector<double> values;   ///< row by row: the last axis runs fastest
        Interpolation interpolation = Interpolation::linear;
        Outside outside = Outside::error;
    };
    using Orders = std::array<int, 2>;
    /// The numbers of intervals, at least 0; `free`, or no number, where none is held. Of two arguments they are
    /// whole.
    using Held = std::array<double, 2>;
    static constexpr double free = -1;

    /// Orders from this on are those of a side function: `side_order` gives them.
    static constexpr int side_function = 100;
    static constexpr std::size_t most_told = 64;

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

    /// The order by which a call has the side function along this axis; its derivatives have the next ones.
    static int side_order(std::size_t axis) { return side_function + 10 * static_cast<int>(axis); }
    static std::size_t side_axis(int order) { return static_cast<std::size_t>(order / 10 % 2); }

    /// Whether a derivative of these orders jumps at knots; else it is continuous.
    bool may_jump(const Orders& orders) const;
    /// Whether a run sees each knot by itself.
    bool tells_knots(std::size_t axis, const Orders& orders) const;
    /// Modulo what the number of an interval is held.
    long cycle(std::size_t axis, const Orders& orders) const;

    /// The derivative of these orders. A derivative of a side function takes one argument and one order.
    template <typename Real>
    Real value(const Orders& orders, const std::array<const Real*, 2>& x, const Held& held = {free, free}) const;

    /// The same of one argument and one number, in less time.
    double value_of_one(int order, double x, double number = free) const;

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
        Held held;
        std::vector<const Call*> with{};  ///< of two: the calls whose next interval has these numbers, and is free
    };
    const Call& call(const Orders& orders, bool is_held) const;

private:
    struct Cell {
        std::size_t piece;
        double from;     ///< the knot at which it begins
        int beyond = 0;  ///< −1 before the first point, 1 behind the last one
        bool has_value = true;
    };
    struct Gap {
        std::optional<double> low, high;  ///< the kinks around
        long before = 0, after = 0;       ///< pieces on the other sides of them, counted through all periods
        long number = 0;                  ///< of kinks before
        int side() const { return number % 2 == 0 ? 1 : -1; }
    };
    long piece_at(const TableAxis& axis, double x) const;
    Gap gap_of(const TableAxis& axis, long piece) const;
    Gap gap_with(const TableAxis& axis, long number) const;
    double knot(const TableAxis& axis, long index) const;
    Cell cell(std::size_t axis, double x, const Orders& orders, double number) const;
    Interval side_range(const TableAxis& axis, int order, const Interval& x) const;
    const Call& new_call(const Orders& orders, const Held& held, std::size_t left) const;
    template <typename Real>
    Real side_value(int order, const Real& x) const;
    template <typename Real>
    void weights(std::array<Real, 4>& w, int order, const Real& x, const Cell& cell, const TableAxis& axis) const;

    void find_kinks();
    bool is_in(std::size_t piece, int order, double number) const;

    std::vector<TableAxis> axes_;
    Interpolation interpolation_;
    Outside outside_;
    int degree_;
    std::vector<double> coefficients_;
    mutable std::mutex lock_;
    mutable std::map<std::pair<Orders, Held>, std::unique_ptr<Call>> calls_;
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
    const TableAxis& axis = axes_[side_axis(order)];
    const Gap gap = gap_of(axis, piece_at(axis, place_of(x)));
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
Real TabulatedFunction::value(const Orders& orders, const std::array<const Real*, 2>& x, const Held& held) const {
    if (orders[0] >= side_function) return side_value(orders[0], *x[0]);
    if (orders[0] > degree_ || orders[1] > degree_) return Real(0);
    if (const double whole = std::floor(held[0]); held[0] > whole) {
        const double share = held[0] - whole;
        return real_in<Real>(1 - share) * value<Real>(orders, x, {whole, held[1]}) +
               real_in<Real>(share) * value<Real>(orders, x, {whole + 1, held[1]});
    }
    const auto columns = static_cast<std::size_t>(degree_) + 1;
    std::array<std::array<Real, 4>, 2> w{};
    std::size_t at = 0;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
        const Cell c = cell(k, place_of(*x[k]), orders, held[k]);
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
double value_for_code(double call, double x);
double held_value_for_code(double call, double x, double number);
double held_for_code(double call, double number);  ///< of two arguments: the call with the next number
double value_of_two_for_code(double call, double x, double y);

}  // namespace alembert
