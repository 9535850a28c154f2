// SPDX-License-Identifier: GPL-2.0-or-later
// M = L D Lᵀ:  d_k = M_kk,  l_ik = M_ik / d_k,  M_ij ← M_ij − l_ik M_jk;  then L y = f, z = D⁻¹ y, Lᵀ x = z
// (Golub & Van Loan, Matrix Computations, §4.1).
#include "program/solve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace alembert {

namespace {

constexpr double vanishing = 1e-7;  // of a pivot, relative to its column: far above what initial values may be off

class Elimination {
public:
    Elimination(Program& program, const std::vector<int>& lower, std::vector<std::vector<int>> sides,
                int preferred, const Witness& witness)
        : p_(program),
          witness_(witness),
          preferred_(preferred),
          n_(static_cast<int>(sides[0].size())),
          b_(std::move(sides)),
          rows_(n_, std::vector<int>(n_)),
          later_pivots_(n_ - preferred, -1) {
        for (int i = 0, k = 0; i < n_; ++i)
            for (int j = 0; j <= i; ++j, ++k) rows_[i][j] = rows_[j][i] = lower[k];
    }

    std::optional<std::vector<std::vector<int>>> solve() {
        std::vector<int> left(n_);
        for (int i = 0; i < n_; ++i) left[i] = i;
        while (!left.empty()) {
            const int place = next_pivot(left);
            if (place < 0) return with_exchanges(left);
            const int k = left[place];
            if (k >= preferred_)
                later_pivots_[k - preferred_] = p_.product(-1, {{rows_[k][k], 1}});
            else if (has_moving_value(rows_[k][k]))
                moving_pivots_.push_back(rows_[k][k]);
            left.erase(left.begin() + place);
            eliminate(k, left);
            order_.push_back(k);
        }
        return back_substituted({b_.size(), std::vector<int>(n_, -1)});
    }

    /// Valid after `solve`.
    const std::vector<int>& later_pivots() const { return later_pivots_; }
    /// Those of the preferred unknowns that depend on the state.
    const std::vector<int>& moving_pivots() const { return moving_pivots_; }

private:
    int times(int a, int b) { return p_.product(1, {{a, 1}, {b, 1}}); }
    int minus(int a, int b) { return p_.sum(0, {{1, a}, {-1, b}}); }
    bool zero(int i, int j) const { return p_.is_zero(rows_[i][j]); }
    bool has_moving_value(int node) const { return !p_[node].is_constant(); }

    /// The position in `left` of the regular pivot with the fewest neighbours; among equals the last one, so that
    /// a chain is eliminated from its tip.
    int next_pivot(const std::vector<int>& left) const {
        int best = -1, fewest = 0;
        const std::vector<double>& value = witness_.values(p_);
        for (std::size_t place = 0; place < left.size(); ++place) {
            const int k = left[place];
            if (zero(k, k) || vanishes(k, left, value)) continue;
            int neighbours = 0;
            for (const int i : left) neighbours += i != k && !zero(i, k) ? 1 : 0;
            const bool is_first = k < preferred_, best_is_first = best >= 0 && left[best] < preferred_;
            if (best >= 0 && best_is_first && !is_first) continue;
            if (best < 0 || neighbours <= fewest || (is_first && !best_is_first))
                best = static_cast<int>(place), fewest = neighbours;
        }
        return best;
    }

    /// Whether the diagonal entry vanishes at the witness beside the others of its column.
    bool vanishes(int k, const std::vector<int>& left, const std::vector<double>& value) const {
        if (value.empty()) return false;
        double largest = 0;
        for (const int i : left) largest = std::max(largest, std::abs(value[rows_[i][k]]));
        return std::abs(value[rows_[k][k]]) < vanishing * largest;
    }

    void eliminate(int k, const std::vector<int>& left) {
        const int inverse = p_.product(1, {{rows_[k][k], -1}});
        for (const int i : left) {
            if (zero(i, k)) continue;
            const int l = times(rows_[i][k], inverse);
            for (const int j : left)
                if (j <= i && !zero(j, k)) rows_[i][j] = rows_[j][i] = minus(rows_[i][j], times(l, rows_[j][k]));
            for (auto& b : b_) b[i] = minus(b[i], times(l, b[k]));
        }
        for (const int i : left)
            if (!zero(i, k)) rows_[k][i] = times(rows_[k][i], inverse);  // now Lᵀ
        for (auto& b : b_) b[k] = times(b[k], inverse);
    }

    /// Lᵀ x = z for the rows in `order_`, last first; `x` holds the components that are known already.
    std::vector<std::vector<int>> back_substituted(std::vector<std::vector<int>> solutions) {
        for (std::size_t side = 0; side < b_.size(); ++side)
            for (auto k = order_.rbegin(); k != order_.rend(); ++k) {
                std::vector<int>& x = solutions[side];
                std::vector<Program::Term> terms{{1, b_[side][*k]}};
                for (int i = 0; i < n_; ++i)
                    if (i != *k && x[i] >= 0 && !zero(*k, i)) terms.emplace_back(-1, times(rows_[*k][i], x[i]));
                x[*k] = p_.sum(0, terms);
            }
        return solutions;
    }

    /// The position from `first` on of the row for this column's pivot: the largest at the witness, or, without
    /// one, the first that is not zero. The number of rows if there is none.
    std::size_t exchange_row(const std::vector<int>& rows, std::size_t first, int column) const {
        const std::vector<double>& value = witness_.values(p_);
        std::size_t best = rows.size();
        for (std::size_t r = first; r < rows.size(); ++r) {
            if (zero(rows[r], column)) continue;
            const auto size = [&](std::size_t row) { return std::abs(value[rows_[rows[row]][column]]); };
            if (best == rows.size() || (!value.empty() && size(r) > size(best))) best = r;
        }
        return best;
    }

    /// Gaussian elimination with row exchanges on the rows and columns in `left`.
    std::optional<std::vector<std::vector<int>>> with_exchanges(const std::vector<int>& left) {
        std::vector<int> rows = left;
        for (std::size_t c = 0; c < left.size(); ++c) {
            const std::size_t r = exchange_row(rows, c, left[c]);
            if (r == rows.size()) return std::nullopt;
            std::swap(rows[c], rows[r]);
            const int inverse = p_.product(1, {{rows_[rows[c]][left[c]], -1}});
            for (std::size_t i = c + 1; i < rows.size(); ++i) {
                if (zero(rows[i], left[c])) continue;
                const int factor = times(rows_[rows[i]][left[c]], inverse);
                for (std::size_t j = c; j < left.size(); ++j)
                    rows_[rows[i]][left[j]] =
                        minus(rows_[rows[i]][left[j]], times(factor, rows_[rows[c]][left[j]]));
                for (auto& b : b_) b[rows[i]] = minus(b[rows[i]], times(factor, b[rows[c]]));
            }
        }
        std::vector<Program::Factor> squares;
        for (std::size_t c = 0; c < left.size(); ++c) squares.emplace_back(rows_[rows[c]][left[c]], 2);
        for (const int k : left)
            if (k >= preferred_) later_pivots_[k - preferred_] = p_.product(1, squares);
        std::vector<std::vector<int>> solutions(b_.size(), std::vector<int>(n_, -1));
        for (std::size_t side = 0; side < b_.size(); ++side)
            for (std::size_t c = left.size(); c-- > 0;) {
                std::vector<int>& x = solutions[side];
                std::vector<Program::Term> terms{{1, b_[side][rows[c]]}};
                for (std::size_t j = c + 1; j < left.size(); ++j)
                    terms.emplace_back(-1, times(rows_[rows[c]][left[j]], x[left[j]]));
                x[left[c]] = p_.product(1, {{p_.sum(0, terms), 1}, {rows_[rows[c]][left[c]], -1}});
            }
        return back_substituted(std::move(solutions));
    }

    Program& p_;
    const Witness& witness_;
    int preferred_;
    int n_;
    std::vector<std::vector<int>> b_;     // right-hand sides, one after the other
    std::vector<std::vector<int>> rows_;  // the matrix, symmetric; eliminated rows hold Lᵀ
    std::vector<int> order_;
    std::vector<int> later_pivots_;  // with the sign changed; −1 before the elimination
    std::vector<int> moving_pivots_;
};

}  // namespace

const std::vector<double>& Witness::values(const Program& program) const {
    if (!state_) return values_;
    std::vector<int> more;
    for (int id = static_cast<int>(values_.size()); id < program.size(); ++id) {
        if (program[id].op == Op::unspecified && program.table_of(program[id]) == nullptr) {
            values_.clear();
            return values_;
        }
        more.push_back(id);
    }
    values_.resize(static_cast<std::size_t>(program.size()));
    interpret_into(values_, program, *state_, more);
    return values_;
}

std::optional<std::vector<int>> solve_symmetric(Program& program, const std::vector<int>& lower,
                                                const std::vector<int>& f, int preferred, const Witness& witness) {
    auto solutions = Elimination(program, lower, {f}, preferred, witness).solve();
    if (!solutions) return std::nullopt;
    return std::move(solutions->front());
}

std::vector<int> later_pivots(Program& program, const std::vector<int>& lower, int size, int preferred,
                              const Witness& witness) {
    Elimination elimination(program, lower, {std::vector<int>(size, program.number(0))}, preferred, witness);
    elimination.solve();
    std::vector<int> pivots = elimination.later_pivots();
    if (std::count(pivots.begin(), pivots.end(), -1) > 0) pivots.clear();
    if (pivots.empty() || !witness.has_state()) return pivots;
    std::size_t place = 0;
    for (const int moving : elimination.moving_pivots()) {
        int& pivot = pivots[place++ % pivots.size()];
        pivot = program.product(1, {{pivot, 1}, {moving, 1}});
    }
    return pivots;
}

std::optional<std::vector<std::vector<int>>> solve_for_sides(Program& program, const std::vector<int>& lower,
                                                             const std::vector<std::vector<int>>& sides,
                                                             int preferred, const Witness& witness) {
    return Elimination(program, lower, sides, preferred, witness).solve();
}

}  // namespace alembert
