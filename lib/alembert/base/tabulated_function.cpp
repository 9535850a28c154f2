// SPDX-License-Identifier: MIT
// With h_i = x_(i+1) − x_i and Δ_i = (y_(i+1) − y_i)/h_i the slopes m of the cubic spline obey
//   h_i m_(i−1) + 2 (h_(i−1) + h_i) m_i + h_(i−1) m_(i+1) = 3 (h_i Δ_(i−1) + h_(i−1) Δ_i),
// with 2 m_0 + m_1 = 3 Δ_0 at an end where the second derivative vanishes (de Boor, ch. IV). Between two points
//   y = y_i + m_i u + (3Δ_i − 2 m_i − m_(i+1))/h_i u² + (m_i + m_(i+1) − 2Δ_i)/h_i² u³.
#include "alembert/base/tabulated_function.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>

namespace alembert {

namespace {

using List = std::vector<double>;

constexpr double no_number = 1e9;  // of an interval: shares of sides that do not exist are not finite, or large

double width(const List& x, std::size_t i) {
    return x[i + 1] - x[i];
}
double rise(const List& x, const List& y, std::size_t i) {
    return (y[i + 1] - y[i]) / width(x, i);
}

/// Of rows (below, middle, above) of a tridiagonal system, without pivots: it is dominated by its diagonal.
List solved(const List& below, List middle, const List& above, List right) {
    const std::size_t n = right.size();
    for (std::size_t i = 1; i < n; ++i) {
        const double factor = below[i] / middle[i - 1];
        middle[i] -= factor * above[i - 1];
        right[i] -= factor * right[i - 1];
    }
    for (std::size_t i = n; i-- > 0;) {
        if (i + 1 < n) right[i] -= above[i] * right[i + 1];
        right[i] /= middle[i];
    }
    return right;
}

List natural_slopes(const List& x, const List& y) {
    const std::size_t n = x.size();
    List below(n, 1), middle(n, 2), above(n, 1), right(n);
    right[0] = 3 * rise(x, y, 0);
    right[n - 1] = 3 * rise(x, y, n - 2);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double before = width(x, i - 1), after = width(x, i);
        below[i] = after, middle[i] = 2 * (before + after), above[i] = before;
        right[i] = 3 * (after * rise(x, y, i - 1) + before * rise(x, y, i));
    }
    return solved(below, middle, above, right);
}

/// Of the spline that closes: the row around is put right by a correction of rank one (Sherman & Morrison).
List periodic_slopes(const List& x, const List& y) {
    const std::size_t n = x.size() - 1;  // unknowns; the last slope is the first
    if (n < 3) {                         // both neighbours of a point are the same one
        const double first = width(x, 0), last = width(x, n - 1);
        return List(n + 1, (last * rise(x, y, 0) + first * rise(x, y, n - 1)) / (first + last));
    }
    List below(n), middle(n), above(n), right(n);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t back = i == 0 ? n - 1 : i - 1;
        const double before = width(x, back), after = width(x, i);
        below[i] = after, middle[i] = 2 * (before + after), above[i] = before;
        right[i] = 3 * (after * rise(x, y, back) + before * rise(x, y, i));
    }
    const double corner = below[0], other = above[n - 1], gamma = -middle[0];
    List changed = middle, u(n, 0);
    changed[0] -= gamma;
    changed[n - 1] -= corner * other / gamma;
    u[0] = gamma, u[n - 1] = other;
    List m = solved(below, changed, above, right);
    const List z = solved(below, changed, above, u);
    const double factor = (m[0] + corner * m[n - 1] / gamma) / (1 + z[0] + corner * z[n - 1] / gamma);
    for (std::size_t i = 0; i < n; ++i) m[i] -= factor * z[i];
    m.push_back(m[0]);
    return m;
}

/// Through three points, kept on the side to which the function rises.
double end_slope(double h, double next, double rise, double further) {
    const double slope = ((2 * h + next) * rise - h * further) / (h + next);
    if (slope * rise <= 0) return 0;
    return rise * further <= 0 && std::abs(slope) > 3 * std::abs(rise) ? 3 * rise : slope;
}

double monotone_slope(double before, double after, double rise, double further) {
    if (rise * further <= 0) return 0;
    const double a = 2 * after + before, b = after + 2 * before;
    return (a + b) / (a / rise + b / further);
}

List monotone_slopes(const List& x, const List& y, bool is_periodic) {
    const std::size_t n = x.size();
    List m(n);
    for (std::size_t i = 1; i + 1 < n; ++i)
        m[i] = monotone_slope(width(x, i - 1), width(x, i), rise(x, y, i - 1), rise(x, y, i));
    if (is_periodic) {
        m[0] = m[n - 1] = monotone_slope(width(x, n - 2), width(x, 0), rise(x, y, n - 2), rise(x, y, 0));
    } else if (n == 2) {
        m[0] = m[1] = rise(x, y, 0);
    } else {
        m[0] = end_slope(width(x, 0), width(x, 1), rise(x, y, 0), rise(x, y, 1));
        m[n - 1] = end_slope(width(x, n - 2), width(x, n - 3), rise(x, y, n - 2), rise(x, y, n - 3));
    }
    return m;
}

List slopes_of(TabulatedFunction::Interpolation how, const TableAxis& axis, const List& y) {
    if (how == TabulatedFunction::Interpolation::pchip) return monotone_slopes(axis.at, y, axis.period > 0);
    return axis.period > 0 ? periodic_slopes(axis.at, y) : natural_slopes(axis.at, y);
}

/// Of u^0 … u^3 on a piece of width h.
std::array<double, 4> cubic(double y, double next, double m, double m_next, double h) {
    const double rise = (next - y) / h;
    return {y, m, (3 * rise - 2 * m - m_next) / h, (m + m_next - 2 * rise) / (h * h)};
}

List of_one(const TableAxis& axis, const List& y, TabulatedFunction::Interpolation how) {
    List result;
    const bool is_linear = how == TabulatedFunction::Interpolation::linear;
    const List m = is_linear ? List() : slopes_of(how, axis, y);
    for (std::size_t i = 0; i + 1 < y.size(); ++i) {
        if (is_linear) {
            result.insert(result.end(), {y[i], rise(axis.at, y, i)});
            continue;
        }
        const auto c = cubic(y[i], y[i + 1], m[i], m[i + 1], width(axis.at, i));
        result.insert(result.end(), c.begin(), c.end());
    }
    return result;
}

/// The tensor product: the coefficients along the second axis are functions along the first one.
List of_two(const std::vector<TableAxis>& axes, const List& values, TabulatedFunction::Interpolation how) {
    const std::size_t rows = axes[0].at.size(), columns = axes[1].at.size(), cells = columns - 1;
    const std::size_t count = how == TabulatedFunction::Interpolation::linear ? 2 : 4;
    std::vector<List> along(rows);  // of each row, the coefficients of its pieces
    for (std::size_t i = 0; i < rows; ++i) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i * columns);
        along[i] = of_one(axes[1], List(begin, begin + static_cast<std::ptrdiff_t>(columns)), how);
    }
    List result((rows - 1) * cells * count * count);
    for (std::size_t k = 0; k < cells * count; ++k) {
        List column(rows);
        for (std::size_t i = 0; i < rows; ++i) column[i] = along[i][k];
        const List c = of_one(axes[0], column, how);
        for (std::size_t i = 0; i + 1 < rows; ++i)
            for (std::size_t j = 0; j < count; ++j)
                result[((i * cells + k / count) * count + j) * count + k % count] = c[i * count + j];
    }
    return result;
}

long floor_of(double x) {
    return static_cast<long>(std::floor(x));
}

}  // namespace

TabulatedFunction::TabulatedFunction(Points points)
    : axes_(std::move(points.axes)),
      interpolation_(points.interpolation),
      outside_(points.outside),
      degree_(points.interpolation == Interpolation::linear ? 1 : 3) {
    std::size_t size = 1;
    for (TableAxis& axis : axes_) {
        size *= axis.at.size();
        if (axis.at.size() < 2) throw std::invalid_argument("a table needs two points along each axis");
        axis.pieces_a_unit = static_cast<double>(axis.at.size() - 1) / (axis.at.back() - axis.at.front());
    }
    if (axes_.empty() || axes_.size() > 2 || size != points.values.size())
        throw std::invalid_argument("a table with another number of values than points");
    coefficients_ = axes_.size() == 1 ? of_one(axes_[0], points.values, interpolation_)
                                      : of_two(axes_, points.values, interpolation_);
    find_kinks();
}

/// A derivative jumps where the polynomials on both sides differ by more than rounding, at any place across.
void TabulatedFunction::find_kinks() {
    constexpr double rounded = 1e-11;
    const auto count = static_cast<std::size_t>(degree_) + 1, block = axes_.size() == 1 ? count : count * count;
    const std::size_t stride[2] = {axes_.size() == 1 ? 1 : axes_[1].at.size() - 1, 1};
    for (std::size_t k = 0; k < axes_.size(); ++k) {
        TableAxis& axis = axes_[k];
        const std::size_t pieces = axis.at.size() - 1, across = coefficients_.size() / block / pieces;
        // The derivative of order `times` along the axis at u, of one polynomial in this axis.
        const auto derivative = [&](std::size_t cell, std::size_t other, double u, int times) {
            double sum = 0;
            for (std::size_t j = static_cast<std::size_t>(times); j < count; ++j) {
                double factor = std::pow(u, static_cast<double>(j) - times);
                for (int t = 0; t < times; ++t) factor *= static_cast<double>(j) - t;
                const std::size_t place = axes_.size() == 1 ? j : k == 0 ? j * count + other : other * count + j;
                sum += factor * coefficients_[cell * block + place];
            }
            return sum;
        };
        const auto cell_of = [&](std::size_t piece, std::size_t row) {
            return axes_.size() == 1 ? piece : k == 0 ? piece * stride[0] + row : row * stride[0] + piece;
        };
        const auto jumps = [&](std::size_t before, std::size_t after, int most) {
            const double h = width(axis.at, before);
            for (std::size_t row = 0; row < across; ++row)
                for (std::size_t other = 0; other < (axes_.size() == 1 ? 1 : count); ++other)
                    for (int times = 1; times <= most; ++times) {
                        const double a = derivative(cell_of(before, row), other, h, times),
                                     b = derivative(cell_of(after, row), other, 0, times);
                        double size = 0;
                        for (int t = 0; t <= times; ++t)
                            size = std::max(size, std::abs(derivative(cell_of(before, row), other, 0, t)) /
                                                      std::pow(h, times - t));
                        if (std::abs(a - b) > rounded * size) return true;
                    }
            return false;
        };
        // A run holds the function and its derivatives in one interval: a constraint y = f(x) and its rate by f'
        // must go on beyond a knot by one polynomial. Methods need second derivatives of f', so the third counts.
        const int most = std::min(3, degree_);
        const bool has_ends = axis.period == 0 && outside_ != Outside::error;
        const bool bends = outside_ == Outside::hold || interpolation_ != Interpolation::linear;
        if ((axis.period > 0 && jumps(pieces - 1, 0, most)) || (has_ends && bends)) axis.kinks.push_back(0);
        for (std::size_t i = 1; i < pieces; ++i)
            if (jumps(i - 1, i, most)) axis.kinks.push_back(static_cast<int>(i));
        if (has_ends && bends) axis.kinks.push_back(static_cast<int>(pieces));
        for (std::size_t i = 0, before = 0; i < pieces; ++i) {
            if (before < axis.kinks.size() && axis.kinks[before] == static_cast<int>(i)) ++before;
            axis.intervals.push_back(static_cast<int>(before));
        }
    }
}

/// Whether a piece of the first period lies in the interval of this number.
bool TabulatedFunction::is_in(std::size_t piece, int order, double number) const {
    if (!(number >= 0 && number < no_number)) return true;
    const int own = axes_[0].intervals[piece], whole = static_cast<int>(number);
    if (static_cast<double>(whole) != number) return false;
    const auto around = static_cast<int>(cycle(0, {order, 0}));
    return own == whole || own + around == whole || (around == 2 && (own - whole) % 2 == 0);
}

double TabulatedFunction::value_of_one(int order, double x, double number) const {
    const std::vector<double>& at = axes_[0].at;
    const std::size_t pieces = at.size() - 1;
    if (order <= degree_ && x >= at[0] && x < at[pieces]) {
        std::size_t k = std::min(static_cast<std::size_t>((x - at[0]) * axes_[0].pieces_a_unit), pieces - 1);
        if (x < at[k])
            k -= k > 0 ? 1 : 0;
        else if (x >= at[k + 1] && k + 1 < pieces)
            ++k;
        if (x >= at[k] && x < at[k + 1] && is_in(k, order, number)) {
            const double u = x - at[k], *const c =
                                            coefficients_.data() + (static_cast<std::size_t>(degree_) + 1) * k;
            if (degree_ == 1) return order == 0 ? c[0] + u * c[1] : c[1];
            return order == 0   ? c[0] + u * (c[1] + u * (c[2] + u * c[3]))
                   : order == 1 ? c[1] + u * (2 * c[2] + u * (3 * c[3]))
                   : order == 2 ? 2 * c[2] + u * (6 * c[3])
                                : 6 * c[3];
        }
    }
    return value<double>({order, 0}, {&x, nullptr}, {number, free});
}

double TabulatedFunction::knot(const TableAxis& axis, long index) const {
    if (axis.period == 0) return axis.at[static_cast<std::size_t>(index)];
    const auto pieces = static_cast<long>(axis.at.size()) - 1;
    const long turns = floor_of(static_cast<double>(index) / static_cast<double>(pieces));
    return axis.at[static_cast<std::size_t>(index - turns * pieces)] + static_cast<double>(turns) * axis.period;
}

/// −1 before the first point, and as many as there are pieces behind the last one.
long TabulatedFunction::piece_at(const TableAxis& axis, double x) const {
    const auto pieces = static_cast<long>(axis.at.size()) - 1;
    long before = 0;
    if (axis.period > 0) {
        const double turns = std::floor((x - axis.at.front()) / axis.period);
        if (!(std::abs(turns) < 1e15)) return 0;  // no number either
        before = static_cast<long>(turns) * pieces;
        x -= turns * axis.period;
    } else if (!(x >= axis.at.front())) {
        return -1;
    } else if (x >= axis.at.back()) {
        return x > axis.at.back() ? pieces : pieces - 1;
    }
    long k = std::clamp(floor_of((x - axis.at.front()) * axis.pieces_a_unit), 0L, pieces - 1);
    const auto at = [&](long i) { return axis.at[static_cast<std::size_t>(i)]; };
    constexpr int near = 2;
    for (int tries = 0; tries < near && k > 0 && x < at(k); ++tries) --k;
    for (int tries = 0; tries < near && k + 1 < pieces && x >= at(k + 1); ++tries) ++k;
    if (x < at(k) || (k + 1 < pieces && x >= at(k + 1)))
        k = std::clamp(
            static_cast<long>(std::upper_bound(axis.at.begin(), axis.at.end(), x) - axis.at.begin()) - 1, 0L,
            pieces - 1);
    return before + k;
}

TabulatedFunction::Gap TabulatedFunction::gap_of(const TableAxis& axis, long piece) const {
    if (axis.kinks.empty()) return {};
    const auto pieces = static_cast<long>(axis.at.size()) - 1;
    const long turns = axis.period > 0 ? floor_of(static_cast<double>(piece) / static_cast<double>(pieces)) : 0;
    const long own = piece - turns * pieces;
    const long until =
        std::upper_bound(axis.kinks.begin(), axis.kinks.end(), own) - axis.kinks.begin();  // at or before it
    return gap_with(axis, turns * static_cast<long>(axis.kinks.size()) + until);
}

/// The interval with this number, which there is.
TabulatedFunction::Gap TabulatedFunction::gap_with(const TableAxis& axis, long number) const {
    const auto pieces = static_cast<long>(axis.at.size()) - 1, count = static_cast<long>(axis.kinks.size());
    Gap gap;
    gap.number = number;
    const auto kink = [&](long number) {  // of kinks counted through all periods
        const long round = floor_of(static_cast<double>(number) / static_cast<double>(count));
        return round * pieces + axis.kinks[static_cast<std::size_t>(number - round * count)];
    };
    if (axis.period > 0 || number > 0) {
        const long index = kink(gap.number - 1);
        gap.low = knot(axis, index);
        gap.before = index - 1;
    }
    if (axis.period > 0 || number < count) {
        const long index = kink(gap.number);
        gap.high = knot(axis, index);
        gap.after = index;
    }
    return gap;
}

bool TabulatedFunction::may_jump(const Orders& orders) const {
    const int smooth = interpolation_ == Interpolation::linear  ? 0
                       : interpolation_ == Interpolation::pchip ? 1
                                                                : 2;
    return orders[0] + orders[1] > (outside_ == Outside::hold ? 0 : smooth);
}

/// Mixtures of two intervals around a jump have numbers between both, which those modulo 2·count have not.
bool TabulatedFunction::tells_knots(std::size_t axis, const Orders& orders) const {
    return axes_[axis].kinks.size() <= most_told && !(axes_[axis].period > 0 && may_jump(orders));
}

long TabulatedFunction::cycle(std::size_t axis, const Orders& orders) const {
    const auto count = static_cast<long>(axes_[axis].kinks.size());
    if (!tells_knots(axis, orders)) return 2;
    return axes_[axis].period > 0 ? 2 * count : count + 1;
}

TabulatedFunction::Cell TabulatedFunction::cell(std::size_t k, double x, const Orders& orders,
                                                double number) const {
    const TableAxis& axis = axes_[k];
    const auto pieces = static_cast<long>(axis.at.size()) - 1;
    if (!has(k, x) || std::isnan(x)) return {.piece = 0, .from = 0, .has_value = false};
    long piece = piece_at(axis, x);
    if (number >= 0 && number < no_number && !axis.kinks.empty()) {
        const Gap gap = gap_of(axis, piece);
        const long around = cycle(k, orders), ahead = floor_of(number) - gap.number;
        long steps = ahead - floor_of(static_cast<double>(ahead) / static_cast<double>(around)) * around;
        if (around == 2)
            steps = steps != 0 && gap.low && (!gap.high || x - *gap.low < *gap.high - x) ? -1 : steps;
        else if (axis.period == 0)
            steps = ahead;
        else if (2 * steps > around)
            steps -= around;
        if (axis.period == 0)
            steps = std::clamp(steps, -gap.number, static_cast<long>(axis.kinks.size()) - gap.number);
        if (steps != 0) {
            const Gap meant = gap_with(axis, gap.number + steps);
            piece = steps < 0 ? meant.after - 1 : meant.before + 1;
        }
    }
    if (axis.period > 0) {
        const long turns = floor_of(static_cast<double>(piece) / static_cast<double>(pieces));
        return {.piece = static_cast<std::size_t>(piece - turns * pieces), .from = knot(axis, piece)};
    }
    const long inside = std::clamp(piece, 0L, pieces - 1);
    return {.piece = static_cast<std::size_t>(inside),
            .from = axis.at[static_cast<std::size_t>(inside)],
            .beyond = static_cast<int>(piece - inside)};
}

Interval TabulatedFunction::side_range(const TableAxis& axis, int order, const Interval& x) const {
    const auto at = [&](double place) { return side_value<double>(order, place); };
    const long first = piece_at(axis, x.low), last = piece_at(axis, x.high);
    const Gap low = gap_of(axis, first), high = gap_of(axis, last);
    const double begin = at(x.low), end = at(x.high);
    Interval result = widened(std::min(begin, end), std::max(begin, end));
    if (low.number == high.number) {
        if (order % 10 != 0 || !low.low || !low.high) return result;
        const double middle = (*low.low + *low.high) / 2;
        return x.has(middle) ? hull(result, widened(at(middle), at(middle))) : result;
    }
    // Beyond its zeros the function is at most a quarter of the longest interval, and its slope at most 1.
    if (order % 10 == 1) return {-1, 1};
    if (order % 10 > 1) return Interval::whole();
    const double reach = x.high - x.low;
    return hull(result, Interval{-reach, reach});
}

Bounds TabulatedFunction::side_bounds(int order, const Bounds& x) const {
    if (!(std::abs(x.value.low) < HUGE_VAL) || !(std::abs(x.value.high) < HUGE_VAL)) return whole_bounds();
    const TableAxis& axis = axes_[side_axis(order)];
    return through(x, side_range(axis, order, x.value), side_range(axis, order + 1, x.value),
                   side_range(axis, order + 2, x.value));
}

std::string TabulatedFunction::fingerprint() const {
    std::uint64_t h = 1469598103934665603ULL;
    const auto mix = [&h](double x) {
        h = (h ^ std::bit_cast<std::uint64_t>(x)) * 1099511628211ULL;
        h ^= h >> 31;
    };
    mix(static_cast<double>(interpolation_)), mix(static_cast<double>(outside_));
    for (const TableAxis& axis : axes_) {
        mix(axis.period);
        for (const double x : axis.at) mix(x);
    }
    for (const double c : coefficients_) mix(c);
    return std::to_string(h);
}

const TabulatedFunction::Call& TabulatedFunction::new_call(const Orders& orders, const Held& held,
                                                           std::size_t left) const {
    constexpr double not_asked = -2;  // yet; a call without a number for an argument is another one
    Held known = held;
    std::fill(known.begin() + static_cast<std::ptrdiff_t>(axes_.size() - left),
              known.begin() + static_cast<std::ptrdiff_t>(axes_.size()), not_asked);
    std::unique_ptr<Call>& made = calls_[{orders, known}];
    if (!made) made = std::make_unique<Call>(Call{.table = this, .orders = orders, .held = held});
    Call& result = *made;
    const std::size_t axis = axes_.size() - left;
    for (long number = static_cast<long>(result.with.size()); left > 0 && number <= cycle(axis, orders);
         ++number) {
        Held with = held;
        with[axis] = number == cycle(axis, orders) ? free : static_cast<double>(number);
        result.with.push_back(&new_call(orders, with, left - 1));
    }
    return result;
}

const TabulatedFunction::Call& TabulatedFunction::call(const Orders& orders, bool is_held) const {
    const std::lock_guard guard(lock_);
    return new_call(orders, {free, free}, is_held && axes_.size() > 1 ? axes_.size() : 0);
}

namespace {

const TabulatedFunction::Call& call_of(double bits) {
    return *reinterpret_cast<const TabulatedFunction::Call*>(
        static_cast<std::uintptr_t>(std::bit_cast<std::uint64_t>(bits)));
}

}  // namespace

double bits_for_code(const TabulatedFunction::Call& call) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(&call)));
}

double held_for_code(double call, double number) {
    const std::vector<const TabulatedFunction::Call*>& with = call_of(call).with;
    if (!(number >= 0 && number < no_number)) return bits_for_code(*with.back());
    const auto count = static_cast<double>(with.size() - 1), whole = std::floor(number + 0.5);
    return bits_for_code(*with[static_cast<std::size_t>(whole - count * std::floor(whole / count))]);
}

double value_for_code(double bits, double x) {
    const TabulatedFunction::Call& call = call_of(bits);
    return call.table->value_of_one(call.orders[0], x);
}

double held_value_for_code(double bits, double x, double number) {
    const TabulatedFunction::Call& call = call_of(bits);
    return call.table->value_of_one(call.orders[0], x, number);
}

double value_of_two_for_code(double bits, double x, double y) {
    const TabulatedFunction::Call& call = call_of(bits);
    return call.table->value<double>(call.orders, {&x, &y}, call.held);
}

}  // namespace alembert
