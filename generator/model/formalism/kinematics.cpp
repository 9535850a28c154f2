// SPDX-License-Identifier: GPL-2.0-or-later
// [W; A] q̇ = (u − w, −b) (Kane & Levinson, Dynamics (1985), §2.12 and §2.13), where A are the rows of the
// constraints that u eliminates. x_c = Σ_r (−1)^(r+c) minor_rc right_r / det (Cramer's rule).
#include "model/formalism/kinematics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "algebra/symbolic/fourier.hpp"
#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"
#include "model/parameter_values.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::matrix;

namespace {

constexpr const char* dependent_constraints = to_say("the nonholonomic constraints depend on each other");
constexpr std::size_t largest_block = 10;  // a block of k rows has k 2^k minors

bool is_number(const ex& e) {
    return GiNaC::is_a<GiNaC::numeric>(e);
}

enum class Poles { allowed, refused };  ///< whether a divisor may depend on the state

class Elimination {
public:
    Elimination(matrix S, matrix right, const Mechanism& m, std::string message, Poles poles)
        : m_(m),
          z_(*m.z),
          S_(std::move(S)),
          right_(std::move(right)),
          message_(std::move(message)),
          policy_(poles),
          n_(S_.rows()),
          x_(n_, right_.cols()) {}

    Possible<Solution> solve() {
        for (unsigned i = 0; i < n_; ++i) {
            for (unsigned j = 0; j < n_; ++j) S_(i, j) = tidy(S_(i, j));
            rows_.push_back(i);
            columns_.push_back(i);
        }
        while (eliminate_number()) {
        }
        while (!rows_.empty())
            if (const auto obstacle = solve_block()) return Obstacle{*obstacle};
        for (auto pivot = pivots_.rbegin(); pivot != pivots_.rend(); ++pivot) {
            const auto [p, c] = *pivot;
            for (unsigned k = 0; k < right_.cols(); ++k) {
                GiNaC::exvector terms{right_(p, k)};
                for (unsigned j = 0; j < n_; ++j)
                    if (j != c) terms.push_back(-S_(p, j) * x_(j, k));
                x_(c, k) = tidy(GiNaC::add(std::move(terms)) / S_(p, c));
            }
        }
        return Solution{x_, poles_};
    }

private:
    ex tidy(const ex& e) const { return short_form(z_.name(e), m_); }

    int entries(unsigned row) const {
        return static_cast<int>(
            std::count_if(columns_.begin(), columns_.end(), [&](unsigned c) { return !S_(row, c).is_zero(); }));
    }

    /// Eliminates with a pivot that is a number, in the row with the fewest entries.
    bool eliminate_number() {
        std::optional<std::pair<unsigned, unsigned>> best;
        for (const unsigned r : rows_)
            for (const unsigned c : columns_)
                if (is_number(S_(r, c)) && !S_(r, c).is_zero() && (!best || entries(r) < entries(best->first)))
                    best = {r, c};
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

    /// Solves the block of the rows and columns that are connected with the first row.
    std::optional<std::string> solve_block() {
        std::vector<unsigned> block{rows_.front()}, columns;
        for (std::size_t i = 0; i < block.size(); ++i)
            for (const unsigned c : columns_) {
                if (S_(block[i], c).is_zero() || std::find(columns.begin(), columns.end(), c) != columns.end())
                    continue;
                columns.push_back(c);
                for (const unsigned r : rows_)
                    if (!S_(r, c).is_zero() && std::find(block.begin(), block.end(), r) == block.end())
                        block.push_back(r);
            }
        std::sort(block.begin(), block.end());
        std::sort(columns.begin(), columns.end());
        if (block.size() > largest_block)
            return say("{}, in symbols: too many of them are tied to each other", message_);
        minors_.clear();
        const ex det = block.size() == columns.size() ? minor(block, columns) : ex(0);
        if (det.is_zero() || is_identically_zero(det, m_)) return message_;
        if (const ex moving = moving_factors(det); z_.depends(moving, m_.moving())) {
            if (policy_ == Poles::refused) return message_;
            poles_.push_back(moving);
        }
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
        return std::nullopt;
    }

    /// The factors of a determinant that can vanish: 2 l cos²φ vanishes where cos φ does.
    ex moving_factors(const ex& det) const {
        const ex plain = z_.tree_size(det) < 300 ? z_.expand(det) : det;
        if (!GiNaC::is_a<GiNaC::mul>(plain) && !GiNaC::is_a<GiNaC::power>(plain)) return det;
        ex result = 1;
        const auto take = [&](const ex& factor) {
            const bool is_power =
                GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::posint);
            const bool is_pole =
                GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::negint);  // never zero
            if (!is_pole && z_.depends(factor, m_.moving())) result *= is_power ? factor.op(0) : factor;
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
    Poles policy_;
    unsigned n_;
    matrix x_;
    std::vector<ex> poles_;
    std::vector<unsigned> rows_, columns_;  // the rows and columns that have not been solved yet
    std::vector<std::pair<unsigned, unsigned>> pivots_;
    std::map<std::pair<std::vector<unsigned>, std::vector<unsigned>>, ex> minors_;
};

std::vector<int> nonholonomic(const Mechanism& m) {
    std::vector<int> result;
    for (std::size_t k = 0; k < m.constraints.size(); ++k)
        if (!m.constraints[k].holonomic) result.push_back(static_cast<int>(k));
    return result;
}

/// h for these speeds, from [W; A] q' = (u − w, −b); the right side has a column for each u and one for 1.
Possible<Kinematics> solved_for_rates(const Mechanism& m, const std::vector<Mechanism::Speed>& speeds,
                                      const std::vector<int>& eliminated, const std::string& message,
                                      Poles poles = Poles::allowed) {
    const int n = m.size(), count = static_cast<int>(speeds.size());
    Kinematics k;
    k.eliminated = eliminated;
    matrix S(n, n), right(n, count + 1);
    for (int r = 0; r < count; ++r) {
        k.u.push_back(speeds[r].u);
        k.udot.push_back(speeds[r].udot);
        k.form.push_back(speeds[r].form);
        for (int i = 0; i < n; ++i) S(r, i) = speeds[r].row[i];
        right(r, r) = 1;
        right(r, count) = -speeds[r].offset;
    }
    for (int r = count; r < n; ++r) {
        const Mechanism::Constraint& constraint = m.constraints[eliminated[r - count]];
        for (int i = 0; i < n; ++i) S(r, i) = constraint.row[i];
        right(r, count) = -constraint.offset;
    }
    Possible<Solution> solved = Elimination(S, right, m, message, poles).solve();
    if (const auto obstacle = solved.obstacle()) return Obstacle{*obstacle};
    auto [x, found] = std::move(solved).value();
    k.poles = std::move(found);
    for (int i = 0; i < n; ++i) {
        GiNaC::exvector terms{x(i, count)};
        for (int r = 0; r < count; ++r) terms.push_back(x(i, r) * k.u[r]);
        k.h.push_back(m.z->name(GiNaC::add(std::move(terms))));
    }
    return k;
}

Possible<Kinematics> with_given_speeds(const Mechanism& m) {
    const int n = m.size(), count = static_cast<int>(m.speeds.size());
    std::vector<int> eliminated, all;
    for (std::size_t c = 0; c < m.constraints.size(); ++c) all.push_back(static_cast<int>(c));
    if (count != n) eliminated = count + static_cast<int>(all.size()) == n ? all : nonholonomic(m);
    if (count + static_cast<int>(eliminated.size()) != n) {
        std::string numbers;
        for (const int allowed : allowed_speeds(m))
            numbers += (numbers.empty() ? "" : " or ") + std::to_string(allowed);
        return Obstacle{
            say("the scene has {} generalized speed{}; expected {}", count, count == 1 ? "" : "s", numbers)};
    }
    return solved_for_rates(
        m, m.speeds, eliminated,
        say("the speeds, with the constraints, do not determine the rates of the coordinates"));
}

/// The rate for which each constraint is solved. The rows are reduced in floating point at the start, with the
/// pivots that the header describes.
Possible<std::vector<int>> dependent_rates(const Mechanism& m, const std::vector<int>& constraints) {
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
            return Obstacle{
                say("the nonholonomic constraints do not determine as many rates at the start; "
                    "give the scene generalized speeds, [speeds]")};
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

Mechanism::Speed rate_as_speed(const Mechanism& m, int i) {
    Mechanism::Speed speed{.u = m.qdot[i],
                           .udot = m.qddot[i],
                           .form = m.qdot[i],
                           .row = {},
                           .offset = 0,
                           .start = {},
                           .unit = {},
                           .place = {}};
    speed.row.assign(m.q.size(), 0);
    speed.row[i] = 1;
    return speed;
}

/// The symbols of a new speed u1, u2 … and of its derivative. Names that the scene has are skipped. Every call
/// gives the same symbols.
std::pair<GiNaC::symbol, GiNaC::symbol> fresh_speed(const Mechanism& m, int& number) {
    for (;;) {
        const std::string name = "u" + std::to_string(++number);
        std::vector<GiNaC::symbol> own;
        bool taken = false;
        for (const GiNaC::symbol& s : m.symbols->all()) {
            if (m.symbols->info(s).name != name) continue;
            if (m.symbols->info(s).kind == SymbolInfo::Kind::speed)
                own.push_back(s);
            else
                taken = true;
        }
        if (taken) continue;
        for (int order = static_cast<int>(own.size()); order < 2; ++order)
            own.push_back(m.symbols->declare(name, SymbolInfo::Kind::speed, number - 1, order));
        return {own[0], own[1]};
    }
}

/// Treats groups of connected constraints and coordinates: k rows in k + 1 rates leave one combination of the
/// rates free, Σ N_j q'_j with N_j the minors of the rows. It can serve as a speed wherever the rows are
/// independent.
std::optional<Kinematics> with_null_vectors(const Mechanism& m, const std::vector<int>& constraints) {
    std::vector<Mechanism::Speed> speeds;
    std::vector<char> done(m.q.size(), 0);
    int number = 0;
    for (int i = 0; i < m.size(); ++i) {
        if (done[i] != 0) continue;
        std::vector<int> columns{i}, rows;
        done[i] = 1;
        for (std::size_t c = 0; c < columns.size(); ++c)
            for (const int r : constraints) {
                const std::vector<ex>& row = m.constraints[r].row;
                if (row[columns[c]].is_zero() || std::find(rows.begin(), rows.end(), r) != rows.end()) continue;
                rows.push_back(r);
                for (int j = 0; j < m.size(); ++j)
                    if (!row[j].is_zero() && done[j] == 0) {
                        done[j] = 1;
                        columns.push_back(j);
                    }
            }
        std::sort(columns.begin(), columns.end());
        if (rows.empty()) {
            speeds.push_back(rate_as_speed(m, i));
            continue;
        }
        const auto k = static_cast<unsigned>(rows.size());
        if (columns.size() != k + 1 || k > 4) return std::nullopt;
        Mechanism::Speed speed = rate_as_speed(m, i);
        std::tie(speed.u, speed.udot) = fresh_speed(m, number);
        speed.row.assign(m.q.size(), 0);
        GiNaC::exvector terms;
        int sign = 0;  // chosen so that the first coefficient begins with a plus
        for (unsigned j = 0; j <= k; ++j) {
            matrix minor(k, k);
            for (unsigned r = 0; r < k; ++r)
                for (unsigned c = 0; c < k; ++c)
                    minor(r, c) = m.z->expand(m.constraints[rows[r]].row[columns[c < j ? c : c + 1]]);
            const ex entry = short_form(m.z->name((j % 2 == 0 ? 1 : -1) * minor.determinant()), m);
            if (sign == 0 && !entry.is_zero()) {
                const auto f = fourier(m.z->expand(entry), *m.symbols, 200);
                sign = f && f->size() > 0 && f->terms()[0].coefficient < 0 ? -1 : 1;
            }
            speed.row[columns[j]] = sign < 0 ? m.z->name(-entry) : entry;
            terms.push_back(speed.row[columns[j]] * m.qdot[columns[j]]);
        }
        speed.form = m.z->name(GiNaC::add(std::move(terms)));
        speeds.push_back(std::move(speed));
    }
    Possible<Kinematics> result =
        solved_for_rates(m, speeds, constraints, translated(dependent_constraints), Poles::refused);
    if (!result.exists()) return std::nullopt;
    return std::move(result).value();
}

Possible<Kinematics> with_remaining_rates(const Mechanism& m, const std::vector<int>& constraints) {
    const Possible<std::vector<int>> pivots = dependent_rates(m, constraints);
    if (const auto obstacle = pivots.obstacle()) return Obstacle{*obstacle};
    const std::vector<int>& dependent = pivots.value();
    std::vector<Mechanism::Speed> speeds;
    for (int i = 0; i < m.size(); ++i)
        if (std::find(dependent.begin(), dependent.end(), i) == dependent.end())
            speeds.push_back(rate_as_speed(m, i));
    Possible<Kinematics> rates = solved_for_rates(m, speeds, constraints, translated(dependent_constraints));
    if (!rates.exists() || rates.value().poles.empty()) return rates;
    if (std::optional<Kinematics> free = with_null_vectors(m, constraints)) return *std::move(free);
    return rates;
}

}  // namespace

std::vector<ex> accelerations(const Mechanism& m, const Equations& e) {
    std::vector<ex> result = m.explicit_time_derivative(e.h);
    Intermediates::Direction along;
    for (int i = 0; i < m.size(); ++i) along.emplace_back(m.q[i], e.h[i]);
    for (int k = 0; k < e.size(); ++k)
        if (m.symbols->info(e.u[k]).kind != SymbolInfo::Kind::state)  // these change explicitly
            along.emplace_back(e.u[k], e.udot[k]);
    const std::vector<ex> moved = m.z->push_forward(e.h, along);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = m.z->name(result[i] + moved[i]);
    return result;
}

Possible<Solution> solve_exactly(const matrix& S, const matrix& right, const Mechanism& m,
                                 const std::string& message) {
    return Elimination(S, right, m, message, Poles::allowed).solve();
}

std::vector<int> allowed_speeds(const Mechanism& m) {
    std::vector<int> result{m.size(), m.size() - static_cast<int>(nonholonomic(m).size()),
                            m.size() - static_cast<int>(m.constraints.size())};
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

Kinematics rates_as_speeds(const Mechanism& m) {
    return {
        .u = m.qdot, .udot = m.qddot, .form = {m.qdot.begin(), m.qdot.end()}, .h = {m.qdot.begin(), m.qdot.end()}};
}

Possible<Kinematics> kinematics_of_masses(const Mechanism& m, const std::string& title) {
    if (const auto unknown = masses_unknown(m, title)) return Obstacle{*unknown};
    return kinematics(m);
}

Possible<Kinematics> kinematics(const Mechanism& m) {
    if (!m.speeds.empty()) return with_given_speeds(m);
    if (const std::vector<int> constraints = nonholonomic(m); !constraints.empty())
        return with_remaining_rates(m, constraints);
    return rates_as_speeds(m);
}

}  // namespace alembert
