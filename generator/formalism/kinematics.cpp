// SPDX-License-Identifier: GPL-2.0-or-later
// [W; A] q̇ = (u − w, −b)  (Kane & Levinson, Dynamics (1985), §2.12 and §2.13), A being the constraints that u leaves out.
// x_c = Σ_r (−1)^(r+c) minor_rc right_r / det  (Cramer's rule).
#include "formalism/kinematics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "formalism/elements.hpp"
#include "model/energy.hpp"
#include "model/parameter_values.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::matrix;

namespace {

constexpr std::size_t largest_block = 10;  // minors of a block of k rows: k 2^k

bool is_number(const ex& e) { return GiNaC::is_a<GiNaC::numeric>(e); }

class Elimination {
public:
    Elimination(matrix S, matrix right, const Mechanism& m, std::string message)
        : m_(m), z_(*m.z), S_(std::move(S)), right_(std::move(right)), message_(std::move(message)), n_(S_.rows()), x_(n_, right_.cols()) {}

    std::vector<ex> poles;

    matrix solve() {
        for (unsigned i = 0; i < n_; ++i) {
            for (unsigned j = 0; j < n_; ++j) S_(i, j) = tidy(S_(i, j));
            rows_.push_back(i);
            columns_.push_back(i);
        }
        while (eliminate_number()) {}
        while (!rows_.empty()) solve_block();
        for (auto pivot = pivots_.rbegin(); pivot != pivots_.rend(); ++pivot) {
            const auto [p, c] = *pivot;
            for (unsigned k = 0; k < right_.cols(); ++k) {
                GiNaC::exvector terms{right_(p, k)};
                for (unsigned j = 0; j < n_; ++j)
                    if (j != c) terms.push_back(-S_(p, j) * x_(j, k));
                x_(c, k) = tidy(GiNaC::add(std::move(terms)) / S_(p, c));
            }
        }
        return x_;
    }

private:
    ex tidy(const ex& e) const { return short_form(z_.name(e), m_); }

    int entries(unsigned row) const {
        return static_cast<int>(std::count_if(columns_.begin(), columns_.end(), [&](unsigned c) { return !S_(row, c).is_zero(); }));
    }

    /// The pivot that is a number in the row with the fewest entries.
    bool eliminate_number() {
        std::optional<std::pair<unsigned, unsigned>> best;
        for (const unsigned r : rows_)
            for (const unsigned c : columns_)
                if (is_number(S_(r, c)) && !S_(r, c).is_zero() && (!best || entries(r) < entries(best->first))) best = {r, c};
        if (!best) return false;
        const auto [p, c] = *best;
        std::erase(rows_, p);
        std::erase(columns_, c);
        pivots_.push_back(*best);
        for (const unsigned r : rows_) {
            if (S_(r, c).is_zero()) continue;
            const ex factor = S_(r, c) / S_(p, c);
            for (const unsigned j : columns_) S_(r, j) = tidy(S_(r, j) - factor * S_(p, j));
            for (unsigned k = 0; k < right_.cols(); ++k) right_(r, k) = tidy(right_(r, k) - factor * right_(p, k));
            S_(r, c) = 0;
        }
        return true;
    }

    /// The rows and columns that are tied to the first row.
    void solve_block() {
        std::vector<unsigned> block{rows_.front()}, columns;
        for (std::size_t i = 0; i < block.size(); ++i)
            for (const unsigned c : columns_) {
                if (S_(block[i], c).is_zero() || std::find(columns.begin(), columns.end(), c) != columns.end()) continue;
                columns.push_back(c);
                for (const unsigned r : rows_)
                    if (!S_(r, c).is_zero() && std::find(block.begin(), block.end(), r) == block.end()) block.push_back(r);
            }
        std::sort(block.begin(), block.end());
        std::sort(columns.begin(), columns.end());
        if (block.size() > largest_block) throw ModelError(message_ + ", in symbols: too many of them are tied to each other");
        minors_.clear();
        const ex det = block.size() == columns.size() ? minor(block, columns) : ex(0);
        if (det.is_zero() || is_identically_zero(det, m_)) throw ModelError(message_);
        if (z_.depends(det, m_.moving())) poles.push_back(moving_factors(det));
        for (std::size_t c = 0; c < columns.size(); ++c)
            for (std::size_t r = 0; r < block.size(); ++r) {
                std::vector<unsigned> other_rows = block, other_columns = columns;
                other_rows.erase(other_rows.begin() + static_cast<std::ptrdiff_t>(r));
                other_columns.erase(other_columns.begin() + static_cast<std::ptrdiff_t>(c));
                const ex inverse = tidy(((r + c) % 2 == 0 ? 1 : -1) * minor(other_rows, other_columns) / det);
                for (unsigned k = 0; k < right_.cols(); ++k) x_(columns[c], k) += inverse * right_(block[r], k);
            }
        for (const unsigned c : columns)
            for (unsigned k = 0; k < right_.cols(); ++k) x_(c, k) = tidy(x_(c, k));
        for (const unsigned r : block) std::erase(rows_, r);
        for (const unsigned c : columns) std::erase(columns_, c);
    }

    /// 2 l cos²φ vanishes where cos φ does.
    ex moving_factors(const ex& det) const {
        const ex plain = z_.tree_size(det) < 300 ? z_.expand(det) : det;
        if (!GiNaC::is_a<GiNaC::mul>(plain) && !GiNaC::is_a<GiNaC::power>(plain)) return det;
        ex result = 1;
        const auto take = [&](const ex& factor) {
            const bool is_power = GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::posint);
            if (z_.depends(factor, m_.moving())) result *= is_power ? factor.op(0) : factor;
        };
        if (GiNaC::is_a<GiNaC::mul>(plain))
            for (const ex& factor : plain) take(factor);
        else
            take(plain);
        return z_.name(result);
    }

    ex minor(const std::vector<unsigned>& rows, const std::vector<unsigned>& columns) {
        if (rows.empty()) return 1;
        if (const auto found = minors_.find({rows, columns}); found != minors_.end()) return found->second;
        const std::vector<unsigned> below(rows.begin() + 1, rows.end());
        GiNaC::exvector terms;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const ex entry = S_(rows[0], columns[c]);
            if (entry.is_zero()) continue;
            std::vector<unsigned> others = columns;
            others.erase(others.begin() + static_cast<std::ptrdiff_t>(c));
            terms.push_back((c % 2 == 0 ? 1 : -1) * entry * minor(below, others));
        }
        const ex value = tidy(GiNaC::add(std::move(terms)));
        minors_.emplace(std::pair(rows, columns), value);
        return value;
    }

    const Mechanism& m_;
    Intermediates& z_;
    matrix S_, right_;
    std::string message_;
    unsigned n_;
    matrix x_;
    std::vector<unsigned> rows_, columns_;                    // not yet solved for
    std::vector<std::pair<unsigned, unsigned>> pivots_;
    std::map<std::pair<std::vector<unsigned>, std::vector<unsigned>>, ex> minors_;
};

std::vector<int> nonholonomic(const Mechanism& m) {
    std::vector<int> result;
    for (std::size_t k = 0; k < m.constraints.size(); ++k)
        if (!m.constraints[k].holonomic) result.push_back(static_cast<int>(k));
    return result;
}

/// h for u as the speeds: S (q') = (u − w, −b), columns of the right side for each u and for 1.
void solve_for_rates(const Mechanism& m, const matrix& S, const matrix& right, const std::string& message, Kinematics& k) {
    const matrix x = solve_exactly(S, right, m, message, &k.poles);
    for (int i = 0; i < m.size(); ++i) {
        GiNaC::exvector terms{x(i, right.cols() - 1)};
        for (std::size_t r = 0; r < k.u.size(); ++r) terms.push_back(x(i, r) * k.u[r]);
        k.h.push_back(m.z->name(GiNaC::add(std::move(terms))));
    }
}

Kinematics with_given_speeds(const Mechanism& m) {
    const int n = m.size(), count = static_cast<int>(m.speeds.size());
    Kinematics k;
    if (count != n) k.eliminated = nonholonomic(m);
    if (count + static_cast<int>(k.eliminated.size()) != n) {
        k.eliminated.clear();
        for (std::size_t c = 0; c < m.constraints.size(); ++c) k.eliminated.push_back(static_cast<int>(c));
    }
    if (count + static_cast<int>(k.eliminated.size()) != n && count != n) {
        std::string numbers;
        for (const int allowed : allowed_speeds(m)) numbers += (numbers.empty() ? "" : " or ") + std::to_string(allowed);
        throw ModelError(fmt::format("the scene has {} generalized speed{}; expected {}", count, count == 1 ? "" : "s", numbers));
    }
    if (count == n) k.eliminated.clear();
    matrix S(n, n), right(n, count + 1);
    for (int r = 0; r < count; ++r) {
        const Mechanism::Speed& speed = m.speeds[r];
        k.u.push_back(speed.u);
        k.udot.push_back(speed.udot);
        k.form.push_back(speed.form);
        for (int i = 0; i < n; ++i) S(r, i) = speed.row[i];
        right(r, r) = 1;
        right(r, count) = -speed.drift;
    }
    for (int r = count; r < n; ++r) {
        const Mechanism::Constraint& constraint = m.constraints[k.eliminated[r - count]];
        for (int i = 0; i < n; ++i) S(r, i) = constraint.row[i];
        right(r, count) = -constraint.drift;
    }
    solve_for_rates(m, S, right, "the speeds, with the constraints, do not determine the rates of the coordinates", k);
    return k;
}

/// The rate that each constraint is solved for: rows are reduced in floating point at the start, pivots as the header says.
std::vector<int> dependent_rates(const Mechanism& m, const std::vector<int>& constraints) {
    const ParameterValues values(m);
    GiNaC::exmap start{{m.t, m.run.start.value_or(0)}};
    for (int i = 0; i < m.size(); ++i) start[m.q[i]] = m.q_start[i];
    const std::vector<GiNaC::symbol> moving = m.moving();
    for (const Mechanism::Input& input : m.inputs)
        start[input.derivative[0]] = m.z->expand(input.value).subs(start, GiNaC::subs_options::no_pattern);
    std::vector<std::vector<double>> rows, kind;
    for (const int c : constraints) {
        rows.emplace_back();
        kind.emplace_back();
        for (const ex& entry : m.constraints[c].row) {
            const ex plain = m.z->expand(entry);
            double value = 0;
            try {
                value = values.number(plain.subs(start, GiNaC::subs_options::no_pattern));
            } catch (const std::exception&) {
                value = std::nan("");
            }
            rows.back().push_back(std::isfinite(value) ? value : 0);
            kind.back().push_back(is_number(plain) ? 2 : m.z->depends(entry, moving) ? 0 : 1);
        }
    }
    std::vector<int> result(rows.size(), -1);
    for (std::size_t step = 0; step < rows.size(); ++step) {
        std::size_t row = 0, column = 0;
        double best_kind = -1, best = 0;
        for (std::size_t r = 0; r < rows.size(); ++r)
            for (std::size_t c = 0; result[r] < 0 && c < rows[r].size(); ++c) {
                const double size = std::abs(rows[r][c]);
                if (size > 1e-9 && std::pair(kind[r][c], size) > std::pair(best_kind, best * (1 + 1e-9)))
                    std::tie(row, column, best_kind, best) = std::tuple(r, c, kind[r][c], size);
            }
        if (best_kind < 0)
            throw ModelError("Kane's equations: the nonholonomic constraints do not determine as many rates at the start; "
                             "give the scene generalized speeds, [speeds]");
        result[row] = static_cast<int>(column);
        for (std::size_t r = 0; r < rows.size(); ++r) {
            if (result[r] >= 0 || rows[r][column] == 0) continue;
            const double factor = rows[r][column] / rows[row][column];
            for (std::size_t c = 0; c < rows[r].size(); ++c) {
                if (rows[row][c] == 0) continue;
                rows[r][c] = c == column ? 0 : rows[r][c] - factor * rows[row][c];
                kind[r][c] = std::min({kind[r][c], kind[row][c], kind[r][column], kind[row][column]});
            }
        }
    }
    return result;
}

Kinematics with_remaining_rates(const Mechanism& m, const std::vector<int>& constraints) {
    const std::vector<int> dependent = dependent_rates(m, constraints);
    Kinematics k;
    k.eliminated = constraints;
    std::vector<int> free;
    for (int i = 0; i < m.size(); ++i)
        if (std::find(dependent.begin(), dependent.end(), i) == dependent.end()) free.push_back(i);
    const unsigned count = static_cast<unsigned>(dependent.size()), columns = static_cast<unsigned>(free.size()) + 1;
    matrix S(count, count), right(count, columns);
    for (unsigned r = 0; r < count; ++r) {
        const Mechanism::Constraint& constraint = m.constraints[constraints[r]];
        for (unsigned c = 0; c < count; ++c) S(r, c) = constraint.row[dependent[c]];
        for (unsigned c = 0; c + 1 < columns; ++c) right(r, c) = -constraint.row[free[c]];
        right(r, columns - 1) = -constraint.drift;
    }
    const matrix x = solve_exactly(S, right, m, "Kane's equations: the nonholonomic constraints depend on each other", &k.poles);
    k.h.assign(m.qdot.begin(), m.qdot.end());
    for (unsigned r = 0; r < count; ++r) {
        GiNaC::exvector terms{x(r, columns - 1)};
        for (unsigned c = 0; c + 1 < columns; ++c) terms.push_back(x(r, c) * m.qdot[free[c]]);
        k.h[dependent[r]] = m.z->name(GiNaC::add(std::move(terms)));
    }
    for (const int i : free) {
        k.u.push_back(m.qdot[i]);
        k.udot.push_back(m.qddot[i]);
        k.form.emplace_back(m.qdot[i]);
    }
    return k;
}

}  // namespace

std::vector<ex> accelerations(const Mechanism& m, const Equations& e) {
    std::vector<ex> result = m.explicit_time_derivative(e.h);
    Intermediates::Direction along;
    for (int i = 0; i < m.size(); ++i) along.emplace_back(m.q[i], e.h[i]);
    for (int k = 0; k < e.size(); ++k) along.emplace_back(e.u[k], e.udot[k]);
    const std::vector<ex> moved = m.z->push_forward(e.h, along);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = m.z->name(result[i] + moved[i]);
    return result;
}

matrix solve_exactly(const matrix& S, const matrix& right, const Mechanism& m, const std::string& message,
                     std::vector<ex>* poles) {
    Elimination elimination(S, right, m, message);
    matrix x = elimination.solve();
    if (poles != nullptr) *poles = std::move(elimination.poles);
    return x;
}

std::vector<int> allowed_speeds(const Mechanism& m) {
    std::vector<int> result{m.size(), m.size() - static_cast<int>(nonholonomic(m).size()),
                            m.size() - static_cast<int>(m.constraints.size())};
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

Kinematics kinematics(const Mechanism& m) {
    if (!m.speeds.empty()) return with_given_speeds(m);
    if (const std::vector<int> constraints = nonholonomic(m); !constraints.empty()) return with_remaining_rates(m, constraints);
    return {.u = m.qdot, .udot = m.qddot, .form = {m.qdot.begin(), m.qdot.end()}};
}

}  // namespace alembert
