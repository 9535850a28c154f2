// SPDX-License-Identifier: GPL-2.0-or-later
#include "linear/dependence.hpp"

#include <cmath>
#include <random>

namespace alembert {

using Index = Eigen::Index;

namespace {

constexpr long double nothing = 1e-9L;  // relative to the largest element; smaller derivatives count as zero
constexpr int random_states = 3;

}  // namespace

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
    for (int found = 0, tries = 0; found < random_states && tries < 8 * random_states; ++tries) {
        const long double size = 0.3L / (1 + tries);
        Instant<long double> other = at;
        for (const int i : split.q) other.q[i] = about(at.q[i], size);
        for (const int i : split.u) other.u[i] = about(at.u[i], size);
        other.t = about(at.t, size);
        if (settle(residuals, split, other) && note(tangent(residuals, split, other))) ++found;
    }
    return result;
}

std::vector<bool> essential_coordinates(const Dependences& depends, Index p) {
    const Index nr = depends.rows() - p;
    std::vector<bool> result(static_cast<std::size_t>(nr), false);
    for (bool again = true; again;) {
        again = false;
        for (Index j = 0; j < nr; ++j) {
            if (result[j]) continue;
            bool is_held = false;
            for (Index i = 0; i < p + nr; ++i) is_held = is_held || ((i < p || result[i - p]) && depends(i, j));
            if (is_held) result[j] = again = true;
        }
    }
    return result;
}

}  // namespace alembert
