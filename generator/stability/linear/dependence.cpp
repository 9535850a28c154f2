// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear/dependence.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>

#include "stability/linear/borders.hpp"
#include "stability/linear/dense_long.hpp"

namespace alembert {

using Index = Eigen::Index;

namespace {

constexpr long double nothing = 1e-9L;  // relative to the largest element; smaller derivatives count as zero
constexpr int random_states = 3;

/// Coordinates and time that decide on sides, and between which points of a table the state lies: beyond a border
/// far from the state they count, though nothing near it changes with them (a dead zone, a switch at a time, a
/// detent).
void add_sides(const Residuals& r, const Split& split, Dependences& depends) {
    const auto p = static_cast<Index>(split.u.size()), nr = static_cast<Index>(split.q.size());
    std::vector<int> shared = r.mass;
    for (const auto* part : {&r.gamma, &r.row}) shared.insert(shared.end(), part->begin(), part->end());
    for (Index i = 0; i < p + nr; ++i) {
        std::vector<int> roots = i < p ? shared : std::vector<int>();
        roots.push_back(i < p ? r.forcing[split.u[i]] : r.rate[split.q[i - p]]);
        for (const Variable& v : Borders(r.program, roots).variables()) {
            if (v.kind == Variable::Kind::time) depends(i, nr + p) = true;
            const auto q = v.kind == Variable::Kind::coordinate
                               ? std::find(split.q.begin(), split.q.end(), v.index)
                               : split.q.end();
            if (q != split.q.end()) depends(i, q - split.q.begin()) = true;
        }
    }
}

}  // namespace

bool switches_in_time(const Program& program, int node) {
    const std::vector<Variable> all = Borders(program, std::vector{node}).variables();
    return std::any_of(all.begin(), all.end(), [](const Variable& v) { return v.kind == Variable::Kind::time; });
}

Dependences dependences(const Residuals& residuals, const Split& split, const Instant<long double>& at) {
    const Index p = static_cast<Index>(split.u.size()), nr = static_cast<Index>(split.q.size()),
                columns = nr + p + 1;
    Dependences result(p + nr, columns);
    result.setConstant(false);
    const auto note = [&](const Tangent<long double>& here) {
        MatrixOf<long double> all(p + nr, columns);
        all.topRows(p) = here.speed_rates_by.leftCols(columns);
        all.bottomRows(nr) = here.rates_by.leftCols(columns);
        if (all.size() == 0 || !all.allFinite()) return false;
        const long double scale = std::max(1.0L, all.cwiseAbs().maxCoeff());
        result = result.array() || (all.array().abs() > nothing * scale);
        return true;
    };
    note(tangent(residuals, split, at));
    std::mt19937_64 random(20260);
    const auto about = [&](long double x, long double size) {
        const long double unit = static_cast<long double>(random() >> 11) / 4503599627370496.0L - 1;
        return x + size * std::max(1.0L, std::abs(x)) * unit;
    };
    // Far away too: what has the slope of x²⁵ is nothing nearby.
    for (const long double reach : {0.3L, 3.0L})
        for (int found = 0, tries = 0; found < random_states && tries < 8 * random_states; ++tries) {
            const long double size = reach / (1 + tries);
            Instant<long double> other = at;
            for (const int i : split.q) other.q[i] = about(at.q[i], size);
            for (const int i : split.u) other.u[i] = about(at.u[i], size);
            other.t = about(at.t, size);
            if (settle(residuals, split, other) && note(tangent(residuals, split, other))) ++found;
        }
    add_sides(residuals, split, result);
    return result;
}

namespace {

/// With those on which the rates of the speeds, and of coordinates that are essential already, depend.
void close(std::vector<bool>& essential, const Dependences& depends, Index p) {
    const Index nr = depends.rows() - p;
    for (bool again = true; again;) {
        again = false;
        for (Index j = 0; j < nr; ++j) {
            if (essential[j]) continue;
            bool is_held = false;
            for (Index i = 0; i < p + nr; ++i) is_held = is_held || ((i < p || essential[i - p]) && depends(i, j));
            if (is_held) essential[j] = again = true;
        }
    }
}

/// What moves coordinates where the independent speeds w are zero: b of r' = S w + b.
class RateOffset {
public:
    RateOffset(const Residuals& residuals, const Split& split, const Instant<long double>& at)
        : residuals_(residuals), split_(split), at_(at), nr_(static_cast<Index>(split.q.size())) {
        for (const int i : split.u) at_.u[i] = 0;
    }

    /// Row i, column j: whether b_i depends on coordinate j, at one of a few states.
    Dependences by_coordinates() {
        Dependences result(nr_, nr_);
        result.setConstant(false);
        for (int k = 0; k < random_states; ++k)
            if (const auto here = moved(every()))
                result = result.array() || (here->rates_by.leftCols(nr_).array().abs() > nothing);
        return result;
    }

    /// Do speeds that are the same for all values of the coordinates `part` give their part of b?
    bool is_of_speeds(const std::vector<Index>& part) {
        const auto rows = static_cast<Index>(part.size()), p = static_cast<Index>(split_.u.size());
        MatrixOf<long double> S(0, p);
        VectorOf<long double> b(0);
        if (moved(every()).has_value()) at_.q = state_;  // about which these coordinates are varied
        for (int tries = 0; tries < 40 && S.rows() < p + 2 * rows; ++tries) {
            const auto here = moved(part);
            if (!here) continue;
            S.conservativeResize(S.rows() + rows, p);
            b.conservativeResize(b.size() + rows);
            S.bottomRows(rows) = here->rates_by.middleCols(nr_, p)(part, Eigen::all);
            b.tail(rows) = here->rates(part);
        }
        if (p == 0) return b.isZero(nothing);
        return (S * least_norm(S, b, nothing).x - b).norm() <= nothing * std::max(1.0L, b.norm());
    }

private:
    std::vector<Index> every() const {
        std::vector<Index> all(static_cast<std::size_t>(nr_));
        std::iota(all.begin(), all.end(), Index{0});
        return all;
    }

    /// Where these coordinates have other values; nothing if the constraints do not allow these.
    std::optional<Tangent<long double>> moved(const std::vector<Index>& coordinates) {
        Instant<long double> other = at_;
        for (const Index j : coordinates) {
            const long double x = at_.q[split_.q[j]];
            const long double unit = static_cast<long double>(random_() >> 11) / 4503599627370496.0L - 1;
            other.q[split_.q[j]] = x + 0.3L * std::max(1.0L, std::abs(x)) * unit;
        }
        if (!settle(residuals_, split_, other)) return std::nullopt;
        Tangent<long double> result = tangent(residuals_, split_, other);
        if (!result.rates.allFinite() || !result.rates_by.allFinite()) return std::nullopt;
        state_ = other.q;
        return result;
    }

    const Residuals& residuals_;
    const Split& split_;
    Instant<long double> at_;
    Index nr_;
    std::vector<long double> state_;
    std::mt19937_64 random_{31415};
};

/// The groups of coordinates outside `essential` each of which is moved by all of its group, one after the other.
std::vector<std::vector<Index>> circles(Dependences by, const std::vector<bool>& essential) {
    const Index n = by.rows();
    for (Index i = 0; i < n; ++i)
        if (essential[i]) {
            by.row(i).setConstant(false);
            by.col(i).setConstant(false);
        }
    for (Index k = 0; k < n; ++k)
        for (Index i = 0; i < n; ++i)
            if (by(i, k)) by.row(i) = by.row(i).array() || by.row(k).array();
    std::vector<std::vector<Index>> result;
    for (Index i = 0; i < n; ++i) {
        if (!by(i, i)) continue;
        std::vector<Index> group;
        for (Index j = 0; j < n; ++j)
            if (by(i, j) && by(j, i)) group.push_back(j);
        if (group.front() == i) result.push_back(std::move(group));
    }
    return result;
}

}  // namespace

std::vector<bool> essential_coordinates(const Dependences& depends, const Residuals& residuals, const Split& split,
                                        const Instant<long double>& at) {
    const auto p = static_cast<Index>(split.u.size());
    std::vector<bool> result(split.q.size(), false);
    close(result, depends, p);
    if (std::find(result.begin(), result.end(), false) == result.end()) return result;
    RateOffset offset(residuals, split, at);
    for (const std::vector<Index>& circle : circles(offset.by_coordinates(), result))
        if (!offset.is_of_speeds(circle))
            for (const Index j : circle) result[j] = true;
    close(result, depends, p);
    return result;
}

}  // namespace alembert
