// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/near_point.hpp"

#include <algorithm>
#include <cmath>

#include "base/language/say.hpp"
#include "check/zero.hpp"
#include "model/inputs_in_time.hpp"
#include "program/echelon.hpp"
#include "program/lower/start.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Expressions in normal form; the pivot is the first entry that is surely not zero.
struct NormalField {
    using Number = ex;
    static constexpr bool makes_ones = true;
    const Mechanism& m;

    std::optional<std::size_t> pivot(RowsOf<ex>& rows, std::size_t first, std::size_t column) const {
        for (std::size_t r = first; r < rows.size(); ++r) {
            const Verdict zero = zero_test(rows[r][column], m).verdict;
            if (zero == Verdict::undecided) return std::nullopt;
            if (zero == Verdict::refuted) return r;
            rows[r][column] = 0;
        }
        return rows.size();
    }
    static bool is_zero(const ex& x) { return x.is_zero(); }
    static void divide(std::vector<ex>& row, std::size_t from, const ex& by) {
        for (std::size_t k = from; k < row.size(); ++k) row[k] = (row[k] / by).normal();
    }
    static void subtract(ex& from, const ex& factor, const ex& of) { from = (from - factor * of).normal(); }
};

constexpr std::size_t rows_of_constraint = 3;  // its accelerations, rates and position in NearPoint::bound

std::string too_long() {
    return say("the equations of motion are too long for a first approximation in symbols");
}

/// √e, written without a root if e is a square.
ex root_of_square(const ex& e, const ParameterValues& values) {
    const ex factors = GiNaC::factor(e);
    ex result = 1;
    const auto take = [&](const ex& factor) {
        const bool is_square = GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).is_equal(2);
        result *= is_square ? (values.number(factor.op(0)) < 0 ? -factor.op(0) : factor.op(0)) : sqrt(factor);
    };
    if (GiNaC::is_a<GiNaC::mul>(factors))
        for (const ex& factor : factors) take(factor);
    else
        take(factors);
    return result;
}

}  // namespace

NearPoint::NearPoint(const Mechanism& mechanism, const Equations& equations,
                     const std::vector<std::pair<std::string, ex>>& near, Inputs inputs)
    : m_(mechanism), e_(equations) {
    if (inputs == Inputs::in_time)
        for (const auto& [input, value] : inputs_in_time(m_))
            if (!value.is_zero() && value.has(m_.t)) in_time_[input] = value;
    for (int i = 0; i < m_.size(); ++i) {
        base_[m_.qdot[i]] = 0;
        base_[m_.qddot[i]] = 0;
        small_.push_back({m_.qdot[i], 0});
    }
    for (const Mechanism::Input& input : m_.inputs)
        for (const GiNaC::symbol& derivative : input.derivative) {
            if (in_time_.contains(derivative)) continue;
            base_[derivative] = 0;
            small_.push_back({derivative, 0});
        }
    for (const auto& [name, given] : near) {
        const ex value = m_.z->expand(given);
        for (int i = 0; i < m_.size(); ++i) {
            if (name == m_.q[i].get_name()) small_.push_back({m_.q[i], value}), base_[m_.q[i]] = value;
            if (name != m_.q[i].get_name() + "'") continue;
            base_[m_.qdot[i]] = value;
            for (Small& small : small_)
                if (small.variable == m_.qdot[i]) small.value = value;
        }
    }
}

std::string NearPoint::obstacle() {
    if (std::string reason = place_dependent(); !reason.empty()) return reason;
    for (std::size_t k = 0; k < e_.A.size(); ++k) {
        const Mechanism::Constraint& c = m_.constraints[k];
        GiNaC::exvector rate{c.offset}, acceleration{-e_.gamma[k]};
        for (int i = 0; i < m_.size(); ++i) {
            rate.push_back(e_.A[k][i] * m_.qdot[i]);
            acceleration.push_back(e_.A[k][i] * m_.qddot[i]);
        }
        for (const ex& row : {GiNaC::ex(GiNaC::add(std::move(acceleration))),
                              GiNaC::ex(GiNaC::add(std::move(rate))), c.position.value_or(0)}) {
            if (m_.z->tree_size(row) > longest_tested) return too_long();
            bound_.push_back(read(m_.z->expand(row)));
            const bool is_solved = !in_time_.empty() && bound_.size() % rows_of_constraint == 1;
            if (!is_solved && !is_zero(at(bound_.back()), m_))
                return say("what it is held near does not obey the constraint '{}'", c.name);
        }
    }
    for (int i = 0; i < m_.size(); ++i) {
        GiNaC::exvector terms{-e_.forcing(i)};
        for (int j = 0; j < m_.size(); ++j) terms.push_back(e_.M(i, j) * m_.qddot[j]);
        for (std::size_t k = 0; k < e_.A.size(); ++k) terms.push_back(-e_.A[k][i] * e_.lambda[k]);
        const ex row = GiNaC::add(std::move(terms));
        if (m_.z->tree_size(row) > longest_tested) return too_long();
        rows_.push_back(read(m_.z->expand(row)));
    }
    if (!find_multipliers()) return say("the constraints leave their multipliers open there");
    for (int i = 0; i < m_.size(); ++i)
        if (!is_zero(at(rows_[static_cast<std::size_t>(i)]), m_)) {
            is_no_equilibrium_ = true;
            return say(
                "what it is held near is no equilibrium and no steady motion: the equation of {} does "
                "not hold "
                "there",
                m_.q[i].get_name());
        }
    return "";
}

/// Coordinates that a constraint gives at the point, though the claim does not name them: the root next to the
/// value at which the scene starts.
std::string NearPoint::place_dependent() {
    const State<double> start = start_of(m_).state();
    for (std::size_t left = m_.q.size(); left > 0; --left)
        for (const Mechanism::Constraint& c : m_.constraints) {
            if (!c.position || m_.z->tree_size(*c.position) > longest_tested) continue;
            const ex f = at(m_.z->expand(*c.position));
            std::vector<std::size_t> open;
            for (std::size_t i = 0; i < m_.q.size(); ++i)
                if (!base_.contains(m_.q[i]) && f.has(m_.q[i])) open.push_back(i);
            if (open.size() != 1) continue;
            const std::size_t i = open[0];
            const auto root = root_near(f, m_.q[i], start.q[i]);
            if (!root)
                return say("say too near which {} it holds: constraint '{}' does not give it at once",
                           m_.q[i].get_name(), c.name);
            base_[m_.q[i]] = *root;
            small_.push_back({m_.q[i], *root});
        }
    for (const Mechanism::Constraint& c : m_.constraints)
        for (std::size_t i = 0; c.position && i < m_.q.size(); ++i)
            if (!base_.contains(m_.q[i]) && m_.z->depends(*c.position, {m_.q[i]}))
                return say("say too near which {} it holds: constraint '{}' ties it to others", m_.q[i].get_name(),
                           c.name);
    return "";
}

std::optional<ex> NearPoint::root_near(const ex& f, const GiNaC::symbol& x, double start) const {
    const ex numerator = f.normal().numer().expand();
    constexpr int quadratic = 2;
    if (!numerator.is_polynomial(x) || numerator.degree(x) > quadratic || numerator.degree(x) < 1)
        return std::nullopt;
    const ex a = numerator.coeff(x, 2), b = numerator.coeff(x, 1), c = numerator.coeff(x, 0);
    if (a.is_zero()) return (-c / b).normal();
    const ParameterValues values(m_);
    ex best;
    double distance = -1;
    for (const int sign : {1, -1}) {
        const ex root = ((sign * root_of_square((b * b - 4 * a * c).expand(), values) - b) / (2 * a)).normal();
        const double away = std::abs(values.number(root) - start);
        if (!(away < distance) && distance >= 0) continue;
        best = root;
        distance = away;
    }
    return best;
}

std::optional<std::vector<std::size_t>> NearPoint::reduce(std::vector<std::vector<ex>>& rows,
                                                          std::size_t columns) const {
    return echelon(rows, columns, NormalField{m_});
}

/// The multipliers, and where inputs move it the accelerations.
GiNaC::exvector NearPoint::unknowns_at_point() const {
    GiNaC::exvector result(e_.lambda.begin(), e_.lambda.end());
    if (!in_time_.empty()) result.insert(result.end(), m_.qddot.begin(), m_.qddot.end());
    return result;
}

bool NearPoint::find_multipliers() {
    const GiNaC::exvector unknown = unknowns_at_point();
    if (unknown.empty()) return true;
    GiNaC::exmap none;
    for (const ex& one : unknown) none[one] = 0;
    for (const ex& one : unknown) base_.erase(one);
    std::vector<std::vector<ex>> rows;
    const auto add = [&](const ex& row) {
        const ex here = at(row);
        rows.emplace_back();
        for (const ex& one : unknown) rows.back().push_back(here.diff(GiNaC::ex_to<GiNaC::symbol>(one)));
        rows.back().push_back(-here.subs(none, GiNaC::subs_options::no_pattern));
    };
    for (const ex& row : rows_) add(row);
    if (!in_time_.empty())
        for (std::size_t k = 0; k < bound_.size(); k += rows_of_constraint) add(bound_[k]);  // their accelerations
    const auto pivots = reduce(rows, unknown.size());
    if (!pivots || pivots->size() < unknown.size()) return false;
    for (std::size_t k = 0; k < unknown.size(); ++k) base_[unknown[k]] = rows[k][unknown.size()];
    return true;
}

std::vector<ex> NearPoint::slopes_of(const ex& e) const {
    std::vector<ex> result;
    for (const auto* list : {&m_.qddot, &e_.lambda})
        for (const GiNaC::symbol& unknown : *list) result.push_back(at(e.diff(unknown)));
    for (const Small& small : small_) result.push_back(at(e.diff(small.variable)));
    return result;
}

}  // namespace alembert
