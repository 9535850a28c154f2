// SPDX-License-Identifier: GPL-2.0-or-later
//
// [M −Aᵀ −Gᵀ; A 0 0; G 0 0] (q'⁺, Λ, Π) = (M q'⁻ + Q̂, −b, −c − e gap'⁻), where the contacts are those that were
// struck, and e = 0 for those that did not approach. If a constraint is imposed and a contact bounces, the
// constraint is imposed first: gap'⁻ is then that of the rates that solve the same system without Q̂ and G.
#include "analysis/contact/impact_algebra.hpp"

#include <cmath>
#include <set>

#include "algebra/notation/quotient.hpp"
#include "algebra/symbolic/exact_solve.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "model/formalism/lagrange.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::exvector;

namespace {

constexpr std::size_t most_unknowns = 8;
constexpr std::size_t most_terms = 100;  // of one equation or value; longer ones are not readable
constexpr double largest_tree = 30000;

/// A row of the system, a·q' + b, and its multiplier.
struct Row {
    std::string name;
    exvector a;
    ex b, restitution = 0;
    GiNaC::symbol multiplier;
    bool contact = false;
    double value = 0;  ///< the impulse found numerically
};

class Algebra {
public:
    Algebra(Impact& impact, const Mechanism& m) : impact_(impact), m_(m), n_(static_cast<std::size_t>(m.size())) {
        for (const GiNaC::symbol& q : m.q) before_.push_back(m.symbols->declare_rate_before(q));
        const Equations equations = lagrange_operator(m);
        M_ = equations.M;
        impulse_ = m.generalized_impulses();
        find_rows();
    }

    void go() {
        if (!write_equations()) {
            impact_.equations.clear();
            impact_.conditions.clear();
            impact_.silence = say("the equations are beyond the readable size");
        }
        choose_pose();
        if (!solve() && impact_.silence.empty()) impact_.silence = say("the solution is beyond the readable size");
    }

private:
    // The rows that take part

    void find_rows() {
        const auto row = [&](const Mechanism::Constraint& c, bool contact, const ex& e, double value) {
            rows_.push_back({.name = c.name,
                             .a = exvector(c.row.begin(), c.row.end()),
                             .b = c.offset,
                             .restitution = e,
                             .multiplier = c.multiplier,
                             .contact = contact,
                             .value = value});
        };
        for (std::size_t k = 0; k < m_.constraints.size(); ++k)
            row(m_.constraints[k], false, 0, impact_.numbers.bilateral[static_cast<Eigen::Index>(k)]);
        for (std::size_t k = 0; k < impact_.contacts.size(); ++k) {
            const double value = impact_.numbers.contact[static_cast<Eigen::Index>(k)];
            const Mechanism::Unilateral& u = m_.unilateral[impact_.contacts[k]];
            if (value > 0) row(u.gap, true, impact_.numbers.stays_closed[k] ? ex(0) : u.restitution, value);
        }
    }

    // The equations, in general coordinates

    std::optional<Fourier> normal(const ex& e) const {
        if (m_.z->tree_size(e) > largest_tree) return std::nullopt;
        std::optional<Fourier> f = fourier(m_.z->expand(e), *m_.symbols, 20 * most_terms);
        if (f && f->size() > most_terms) return std::nullopt;
        return f;
    }

    ex rates(const Row& row, const std::vector<GiNaC::symbol>& of) const {
        exvector terms;
        for (std::size_t i = 0; i < n_; ++i) terms.push_back(row.a[i] * of[i]);
        return GiNaC::add(std::move(terms));
    }

    bool write_equations() {
        for (std::size_t i = 0; i < n_; ++i) {
            exvector change, cause{impulse_[i]};
            for (std::size_t j = 0; j < n_; ++j)
                change.push_back(M_(static_cast<unsigned>(i), static_cast<unsigned>(j)) *
                                 (m_.qdot[j] - before_[j]));
            for (const Row& row : rows_) cause.push_back(row.a[i] * row.multiplier);
            const auto left = normal(GiNaC::add(std::move(change))), right = normal(GiNaC::add(std::move(cause)));
            if (!left || !right) return false;
            impact_.equations.push_back(readable_equation(*left, *right));
        }
        for (const Row& row : rows_) {
            const auto left = normal(rates(row, m_.qdot) + (row.contact ? row.b : ex(0)));
            const auto right =
                normal(row.contact ? ex(-row.restitution * (rates(row, before_) + row.b)) : ex(-row.b));
            if (!left || !right) return false;
            impact_.conditions.emplace_back(row.name, readable_equation(*left, *right));
        }
        return true;
    }

    // The pose

    double number(const ex& e) const {
        const ex value = e.subs(values_, GiNaC::subs_options::no_pattern).evalf();
        return GiNaC::is_a<GiNaC::numeric>(value) ? GiNaC::ex_to<GiNaC::numeric>(value).to_double() : std::nan("");
    }

    void choose_pose() {
        const Start given = start_of(m_);
        std::size_t independent = 0;
        for (const Mechanism::Parameter& p : m_.parameters)
            if (p.independent) values_[p.symbol] = impact_.start.parameters[independent++];
        for (std::size_t round = 0; round < m_.parameters.size(); ++round)
            for (const Mechanism::Parameter& p : m_.parameters)
                if (!p.independent)
                    values_[p.symbol] = p.value.subs(values_, GiNaC::subs_options::no_pattern).evalf();
        values_[m_.t] = impact_.start.t;
        const ex t = m_.run.start.value_or(0);
        for (std::size_t i = 0; i < n_; ++i) {
            values_[m_.q[i]] = impact_.start.q[i];
            values_[before_[i]] = impact_.start.qdot[i];
            if (impact_.start.q[i] == given.q[i] && !turns_by_a_decimal(i)) pose_[m_.q[i]] = m_.q_start[i];
            if (impact_.start.qdot[i] == given.qdot[i]) pose_[before_[i]] = m_.qdot_start[i];
        }
        share_decimals();
        fix_bound_decimals();
        pose_[m_.t] = t;
        for (const Mechanism::Input& input : m_.inputs) {
            ex value = input.value;
            for (const GiNaC::symbol& derivative : input.derivative) {
                pose_[derivative] = m_.z->expand(value).subs(pose_, GiNaC::subs_options::no_pattern);
                value = m_.explicit_time_derivative({value})[0];
            }
        }
    }

    static bool is_in_turns(const ex& angle) {
        return ex(angle / GiNaC::Pi).expand().info(GiNaC::info_flags::rational);
    }

    /// Of angles that start at the same decimal, but for its sign and parts of a turn, the first stands for all.
    void share_decimals() {
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t k = 0; k < i && !pose_.contains(m_.q[i]); ++k) {
                if (pose_.contains(m_.q[k]) || m_.q_is_guess[i] || m_.q_is_guess[k]) continue;
                const ex apart = (m_.q_start[i] - m_.q_start[k]).expand(),
                         together = (m_.q_start[i] + m_.q_start[k]).expand();
                if (is_in_turns(apart))
                    pose_[m_.q[i]] = m_.q[k] + apart;
                else if (is_in_turns(together))
                    pose_[m_.q[i]] = together - m_.q[k];
            }
    }

    /// Angles that stand for decimals have no other values than these where a constraint relates them to what is
    /// known.
    void fix_bound_decimals() {
        for (const auto* constraints : {&m_.constraints, &m_.redundant})
            for (const Mechanism::Constraint& c : *constraints) {
                if (!c.position) continue;
                ex here = m_.z->expand(*c.position).subs(pose_, GiNaC::subs_options::no_pattern);
                for (const Mechanism::Parameter& p : m_.parameters)
                    here = here.subs(p.symbol == p.value, GiNaC::subs_options::no_pattern);
                std::vector<std::size_t> free;
                for (std::size_t i = 0; i < n_; ++i)
                    if (here.has(m_.q[i])) free.push_back(i);
                if (std::any_of(free.begin(), free.end(), [&](std::size_t i) { return m_.q_is_guess[i]; }) ||
                    is_identically_zero(here, m_))
                    continue;
                for (const std::size_t i : free) {
                    for (auto& [q, value] : pose_)
                        value = value.subs(m_.q[i] == m_.q_start[i], GiNaC::subs_options::no_pattern);
                    pose_[m_.q[i]] = m_.q_start[i];
                }
            }
    }

    /// A coordinate inside a function, at a number other than zero and multiples of π.
    bool turns_by_a_decimal(std::size_t i) const {
        const ex start = m_.q_start[i].expand();
        if (!GiNaC::is_a<GiNaC::numeric>(start.subs(GiNaC::Pi == 1)) || is_in_turns(start)) return false;
        std::set<unsigned> seen;  // intermediate symbols, by hash: many expressions share them
        const auto inside = [&](const ex& e, const auto& self) -> bool {
            if (GiNaC::is_a<GiNaC::function>(e)) return m_.z->depends(e, {m_.q[i]});
            if (GiNaC::is_a<GiNaC::symbol>(e)) {
                const auto* const entry = m_.z->find(GiNaC::ex_to<GiNaC::symbol>(e));
                return entry != nullptr && seen.insert(e.gethash()).second && self(entry->definition, self);
            }
            for (std::size_t k = 0; k < e.nops(); ++k)
                if (self(e.op(k), self)) return true;
            return false;
        };
        for (std::size_t a = 0; a < n_; ++a) {
            for (std::size_t b = 0; b <= a; ++b)
                if (inside(M_(static_cast<unsigned>(a), static_cast<unsigned>(b)), inside)) return true;
            if (inside(impulse_[a], inside)) return true;
            for (const Row& row : rows_)
                if (inside(row.a[a], inside)) return true;
        }
        return false;
    }

    ex at_pose(const ex& e) const {
        return in_single_angles(m_.z->expand(e).subs(pose_, GiNaC::subs_options::no_pattern));
    }

    // The solution

    /// The rates after and the multipliers of `rows`.
    std::optional<exvector> solved(const exvector& before, bool with_impulses, const std::vector<Row>& rows,
                                   const exvector& conditions) const {
        const std::size_t size = n_ + rows.size();
        ExactRows K(size, exvector(size, 0));
        exvector right(size, 0);
        for (std::size_t i = 0; i < n_; ++i) {
            right[i] = with_impulses ? at_pose(impulse_[i]) : ex(0);
            for (std::size_t j = 0; j < n_; ++j) {
                K[i][j] = mass_[i][j];
                right[i] += mass_[i][j] * before[j];
            }
            for (std::size_t k = 0; k < rows.size(); ++k) {
                K[n_ + k][i] = rows[k].a[i];
                K[i][n_ + k] = -rows[k].a[i];
            }
        }
        std::copy(conditions.begin(), conditions.end(), right.begin() + static_cast<std::ptrdiff_t>(n_));
        return solve_exactly(std::move(K), std::move(right), [this](const ex& e) { return number(e); });
    }

    bool solve() {
        if (impact_.nothing_happens) {
            for (const GiNaC::symbol& rate : before_)
                if (const auto p = phrase(at_pose(rate))) impact_.solution.push_back(*p);
            return true;
        }
        if (impact_.numbers.collisions > 1) {
            impact_.silence =
                say("several collisions follow each other in one instant; they are computed in numbers only");
            return true;
        }
        std::vector<Row> rows = independent_rows();
        if (n_ + rows.size() > most_unknowns) return false;
        mass_.assign(n_, exvector(n_));
        exvector before;
        for (std::size_t i = 0; i < n_; ++i) {
            before.push_back(at_pose(before_[i]));
            for (std::size_t j = 0; j < n_; ++j)
                mass_[i][j] = at_pose(M_(static_cast<unsigned>(i), static_cast<unsigned>(j)));
        }
        std::vector<Row> bilateral;
        for (Row& row : rows) {
            for (ex& a : row.a) a = at_pose(a);
            row.b = at_pose(row.b);
            if (!row.contact) bilateral.push_back(row);
        }
        const auto speed = [&](const Row& row, const exvector& of) {
            exvector terms{row.b};
            for (std::size_t i = 0; i < n_; ++i) terms.push_back(row.a[i] * of[i]);
            return ex(GiNaC::add(std::move(terms)));
        };
        exvector imposed = before;
        if (!impact_.imposed.empty() && bilateral.size() < rows.size()) {
            exvector conditions;
            for (const Row& row : bilateral) conditions.push_back(-row.b);
            const auto first = solved(before, false, bilateral, conditions);
            if (!first) return false;
            imposed.assign(first->begin(), first->begin() + static_cast<std::ptrdiff_t>(n_));
        }
        exvector conditions;
        for (const Row& row : rows)
            conditions.push_back(row.contact ? ex(-row.b - row.restitution * speed(row, imposed)) : ex(-row.b));
        const auto x = solved(before, true, rows, conditions);
        return x && write_solution(*x, rows, before, conditions);
    }

    /// The rows without those that follow from others, whose impulses are determined only numerically.
    std::vector<Row> independent_rows() {
        std::vector<Row> result;
        std::vector<Eigen::VectorXd> basis;
        for (const Row& row : rows_) {
            Eigen::VectorXd a(static_cast<Eigen::Index>(n_));
            for (std::size_t i = 0; i < n_; ++i)
                a[static_cast<Eigen::Index>(i)] = number(m_.z->expand(row.a[i]).subs(pose_));
            const double size = a.norm();
            for (int round = 0; round < 2; ++round)
                for (const Eigen::VectorXd& unit : basis) a -= a.dot(unit) * unit;
            if (!(a.norm() > 1e-9 * size)) {
                redundant_ = true;
                continue;
            }
            basis.push_back(a.normalized());
            result.push_back(row);
        }
        return result;
    }

    std::optional<Phrase> phrase(const ex& e) const {
        return readable_quotient(e, *m_.symbols, most_terms, [this](const ex& part) { return number(part); });
    }

    bool write_solution(const exvector& x, const std::vector<Row>& rows, const exvector& before,
                        const exvector& conditions) {
        // The solution is compared with the numeric one, which was found by another route. Signs that only the
        // scene's values decide would show here.
        double size = 0, residual = 0;
        for (std::size_t i = 0; i < n_; ++i) {
            const double after = impact_.numbers.after[static_cast<Eigen::Index>(i)];
            size = std::max({size, std::abs(after), std::abs(impact_.start.qdot[i])});
            residual = std::max(residual, std::abs(number(x[i]) - after));
        }
        if (!(residual <= 1e-8 * size)) {
            impact_.silence = say("the solution in symbols does not agree with the numbers, so it is not shown");
            return true;
        }
        std::vector<Phrase> solution;
        for (std::size_t i = 0; i < n_; ++i) {
            const auto p = phrase(x[i]);
            if (!p) return false;
            solution.push_back(*p);
        }
        impact_.solution = std::move(solution);
        impact_.exact.emplace();
        impact_.exact->pose = pose_;
        impact_.exact->before = before_;
        impact_.exact->after.assign(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n_));
        for (std::size_t k = 0; k < rows.size() && !redundant_; ++k)
            impact_.exact->reactions.emplace_back(rows[k].multiplier, x[n_ + k]);
        for (std::size_t k = 0; k < rows.size() && !redundant_; ++k)
            if (const auto p = phrase(x[n_ + k])) impact_.reactions.emplace_back(rows[k].name, *p);
        // T⁻ − T⁺ = −½ Δp·(q'⁺ + q'⁻), in which a·q'⁺ follows from the conditions.
        exvector loss;
        for (std::size_t i = 0; i < n_; ++i) loss.push_back(-at_pose(impulse_[i]) * (x[i] + before[i]) / 2);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            exvector sum{conditions[k]};
            for (std::size_t i = 0; i < n_; ++i) sum.push_back(rows[k].a[i] * before[i]);
            loss.push_back(-x[n_ + k] * GiNaC::add(std::move(sum)) / 2);
        }
        impact_.energy_loss = phrase(GiNaC::add(std::move(loss)));
        return true;
    }

    Impact& impact_;
    const Mechanism& m_;
    std::size_t n_;
    std::vector<GiNaC::symbol> before_;
    GiNaC::matrix M_;
    std::vector<ex> impulse_;
    std::vector<Row> rows_;
    GiNaC::exmap values_, pose_;
    ExactRows mass_;
    bool redundant_ = false;
};

}  // namespace

void add_algebra(Impact& impact, const Mechanism& mechanism) {
    Algebra(impact, mechanism).go();
}

}  // namespace alembert
