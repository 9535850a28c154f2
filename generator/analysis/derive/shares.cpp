// SPDX-License-Identifier: GPL-2.0-or-later
// row_r = Σ c_k row_k over the rows k of which it is a combination. For as many columns j, Σ_k c_k row_kj = row_rj
// is solved by Cramer's rule, multiplied by the determinant.
#include "analysis/derive/shares.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "alembert/base/dense.hpp"
#include "analysis/state/contradiction.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t most_rows = 4;   // the most rows of the determinants
constexpr double largest_entry = 300;  // the most nodes with intermediate symbols substituted
constexpr double negligible = 1e-7;
constexpr int places = 4;

class Shares {
public:
    explicit Shares(const Mechanism& m) : m_(m), kept_(static_cast<Eigen::Index>(m.constraints.size())) {
        std::vector<ex> rows;
        for (const auto* list : {&m.constraints, &m.redundant})
            for (const Mechanism::Constraint& c : *list) rows.insert(rows.end(), c.row.begin(), c.row.end());
        Program program;
        const std::vector<int> nodes = lower_expressions(program, m, rows);
        const auto n = static_cast<Eigen::Index>(m.size());
        for (const State<double>& state : states_that_obey(m, start_of(m), places)) {
            const std::vector<double> value = interpret(program, state);
            Eigen::MatrixXd A(static_cast<Eigen::Index>(nodes.size()) / n, n);
            for (Eigen::Index k = 0; k < A.rows(); ++k)
                for (Eigen::Index i = 0; i < n; ++i) A(k, i) = value[static_cast<std::size_t>(nodes[k * n + i])];
            if (A.allFinite()) at_.push_back(std::move(A));
        }
    }

    std::vector<LeastShare> all() const {
        std::vector<LeastShare> result;
        for (std::size_t r = 0; r < m_.redundant.size() && !at_.empty(); ++r)
            if (auto share = one(m_.redundant[r], kept_ + static_cast<Eigen::Index>(r))) result.push_back(*share);
        return result;
    }

private:
    std::vector<Eigen::Index> made_of(Eigen::Index r) const {
        std::vector<Eigen::Index> result;
        for (Eigen::Index k = 0; k < kept_; ++k)
            if (std::any_of(at_.begin(), at_.end(), [&](const Eigen::MatrixXd& A) {
                    const Eigen::VectorXd c = least_norm(A.topRows(kept_).transpose(), A.row(r).transpose()).x;
                    return std::abs(c[k]) * A.row(k).norm() > negligible * A.row(r).norm();
                }))
                result.push_back(k);
        return result;
    }

    /// Columns in which these rows are independent at every state; columns with few and short entries are
    /// preferred.
    std::vector<Eigen::Index> columns_of(const std::vector<Eigen::Index>& rows) const {
        std::vector<Eigen::Index> order, chosen;
        std::vector<double> size;
        for (int j = 0; j < m_.size(); ++j) {
            order.push_back(j);
            size.push_back(0);
            for (const Eigen::Index k : rows) size.back() += m_.z->tree_size(m_.constraints[k].row[j]);
        }
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return size[a] < size[b]; });
        for (const Eigen::Index j : order) {
            std::vector<Eigen::Index> trial = chosen;
            trial.push_back(j);
            const bool independent = std::all_of(at_.begin(), at_.end(), [&](const Eigen::MatrixXd& A) {
                const Eigen::MatrixXd part = A(rows, trial);
                const SingularValues values = singular_values(part);
                return values.values.minCoeff() > negligible * A(rows, Eigen::all).norm();
            });
            if (independent) chosen = trial;
            if (chosen.size() == rows.size()) break;
        }
        return chosen;
    }

    std::optional<LeastShare> one(const Mechanism::Constraint& redundant, Eigen::Index r) const {
        const std::vector<Eigen::Index> rows = made_of(r);
        if (rows.empty() || rows.size() > most_rows) return std::nullopt;
        const std::vector<Eigen::Index> columns = columns_of(rows);
        if (columns.size() < rows.size()) return std::nullopt;
        const auto n = static_cast<unsigned>(rows.size());
        GiNaC::matrix S(n, n), right(n, 1);
        for (unsigned a = 0; a < n; ++a) {  // one equation for column a
            for (unsigned b = 0; b < n; ++b) {
                const ex& e = m_.constraints[rows[b]].row[columns[a]];
                if (m_.z->tree_size(e) > largest_entry) return std::nullopt;
                S(a, b) = m_.z->expand(e);
            }
            if (m_.z->tree_size(redundant.row[columns[a]]) > largest_entry) return std::nullopt;
            right(a, 0) = m_.z->expand(redundant.row[columns[a]]);
        }
        LeastShare share{.left = S.determinant() * redundant.multiplier, .right = 0};
        for (unsigned b = 0; b < n; ++b) {
            GiNaC::matrix replaced = S;
            for (unsigned a = 0; a < n; ++a) replaced(a, b) = right(a, 0);
            share.right += replaced.determinant() * m_.constraints[rows[b]].multiplier;
        }
        return share;
    }

    const Mechanism& m_;
    Eigen::Index kept_;
    std::vector<Eigen::MatrixXd> at_;  // all rows at each state, kept ones first
};

}  // namespace

std::vector<LeastShare> least_shares_of(const Mechanism& mechanism) {
    if (mechanism.redundant.empty()) return {};
    return Shares(mechanism).all();
}

}  // namespace alembert
