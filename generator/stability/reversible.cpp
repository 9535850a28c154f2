// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/reversible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "derive/derived.hpp"
#include "exact/motions.hpp"
#include "lower/lower.hpp"
#include "program/reduce_rows.hpp"
#include "stability/periodic.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

using PrimeRows = std::vector<std::vector<Prime>>;

/// The rates of the states as functions of the state, modulo the prime. The speeds of the local system are F = J
/// q'
/// + F₀; a state is given by positions and by F.
class ExactRates {
public:
    ExactRates(const Local& local, const Equations& e)
        : local_(local), n_(local.mechanism.q.size()), p_(local.split.u.size()), m_(e.A.size()) {
        const Mechanism m = in_terms_of(e, local.mechanism);
        std::vector<ex> speeds;
        for (const int u : local.split.u)
            speeds.push_back(local.residuals.rates_are_speeds ? ex(m.qdot[u]) : local.equations.form[u]);
        std::vector<ex> list = speeds;
        for (const ex& speed : speeds)
            for (const ex& slope : m.z->pull_back({{speed, 1}}, m.qdot)) list.push_back(slope);
        for (const auto& row : e.A) list.insert(list.end(), row.begin(), row.end());
        for (std::size_t k = 0; k < m_; ++k) list.push_back(m.constraints[k].drift);
        list.insert(list.end(), e.gamma.begin(), e.gamma.end());
        for (int i = 0; i < e.size(); ++i)
            for (int j = 0; j < e.size(); ++j) list.push_back(e.M(i, j));
        for (int i = 0; i < e.size(); ++i) list.push_back(m.z->name(e.forcing(i)));
        for (const ex& rate : m.time_derivative(speeds)) list.push_back(rate);
        program_ = begun(m);
        nodes_ = lower_expressions(program_, m, list);
    }

    struct Values {
        std::vector<Prime> speeds;  ///< F
        std::vector<Prime> rates;   ///< of the essential coordinates, then F'
        double degree = 1, conditions = 0;
    };

    /// At the positions of `point` with these values of F; with those that its rates give if `speeds` is empty.
    std::optional<Values> at(ModularPoint point, std::vector<Prime> speeds) const {
        Values result;
        if (speeds.empty()) {
            const auto here = evaluated(point, result);
            if (!here) return {};
            for (std::size_t k = 0; k < p_; ++k) speeds.push_back((*here)[k]);
        }
        result.speeds = speeds;
        if (!set_rates(point, speeds, result) || !set_accelerations(point, result)) return {};
        const auto here = evaluated(point, result);
        if (!here) return {};
        for (const int r : local_.essential)
            result.rates.push_back(point.given.at({Variable::Kind::rate, local_.split.q[r]}));
        for (std::size_t k = 0; k < p_; ++k) result.rates.push_back((*here)[here->size() - p_ + k]);
        return result;
    }

private:
    std::size_t rows_at() const { return p_ + p_ * n_; }
    std::size_t drift_at() const { return rows_at() + m_ * n_; }
    std::size_t gamma_at() const { return drift_at() + m_; }
    std::size_t mass_at() const { return gamma_at() + m_; }
    std::size_t forcing_at() const { return mass_at() + n_ * n_; }

    std::optional<std::vector<Prime>> evaluated(const ModularPoint& point, Values& bound) const {
        const auto at = evaluate_mod(program_, point, nodes_);
        if (!at || !at->exact) return {};
        std::vector<Prime> result;
        double degree = 1;
        for (const int node : nodes_) {
            result.push_back(at->value[static_cast<std::size_t>(node)]);
            degree = std::max(degree, at->degree[static_cast<std::size_t>(node)]);
        }
        bound.degree *= degree * static_cast<double>(n_ + m_ + 1) + 1;  // of a quotient of determinants
        bound.conditions = std::max(bound.conditions, at->conditions);
        return result;
    }

    void set(ModularPoint& point, Variable::Kind kind, const std::function<Prime(std::size_t)>& value) const {
        for (std::size_t i = 0; i < n_; ++i) point.given[{kind, static_cast<int>(i)}] = value(i);
    }

    /// J q' = F − F₀, A q' = −drift.
    bool set_rates(ModularPoint& point, const std::vector<Prime>& speeds, Values& bound) const {
        set(point, Variable::Kind::rate, [](std::size_t) { return Prime(0); });
        set(point, Variable::Kind::acceleration, [](std::size_t) { return Prime(0); });
        const auto here = evaluated(point, bound);
        if (!here) return false;
        PrimeRows rows;
        const auto add = [&](std::size_t from, Prime right) {
            rows.emplace_back(here->begin() + static_cast<std::ptrdiff_t>(from),
                              here->begin() + static_cast<std::ptrdiff_t>(from + n_));
            rows.back().push_back(right);
        };
        for (std::size_t k = 0; k < p_; ++k) add(p_ + k * n_, speeds[k] - (*here)[k]);
        for (std::size_t k = 0; k < m_; ++k) add(rows_at() + k * n_, -(*here)[drift_at() + k]);
        if (rows.size() != n_ || reduce_rows(rows, n_) < static_cast<int>(n_)) return false;
        set(point, Variable::Kind::rate, [&](std::size_t i) { return rows[i][n_]; });
        return true;
    }

    /// M q'' − Aᵀλ = f, A q'' = γ.
    bool set_accelerations(ModularPoint& point, Values& bound) const {
        const auto here = evaluated(point, bound);
        if (!here) return false;
        const std::size_t size = n_ + m_;
        PrimeRows rows(size, std::vector<Prime>(size + 1));
        for (std::size_t i = 0; i < n_; ++i) {
            for (std::size_t j = 0; j < n_; ++j) rows[i][j] = (*here)[mass_at() + i * n_ + j];
            for (std::size_t k = 0; k < m_; ++k) {
                rows[n_ + k][i] = (*here)[rows_at() + k * n_ + i];
                rows[i][n_ + k] = -rows[n_ + k][i];
            }
            rows[i][size] = (*here)[forcing_at() + i];
        }
        for (std::size_t k = 0; k < m_; ++k) rows[n_ + k][size] = (*here)[gamma_at() + k];
        if (reduce_rows(rows, size) < static_cast<int>(size)) return false;
        set(point, Variable::Kind::acceleration, [&](std::size_t i) { return rows[i][size]; });
        return true;
    }

    const Local& local_;
    std::size_t n_, p_, m_;
    Program program_;
    std::vector<int> nodes_;  ///< F, J, A, drift, γ, M, f, F'
};

/// A state with other values of the coordinates on which nothing should depend.
ModularPoint turned(ModularPoint point, const Local& local) {
    for (int i = 0; i < local.residuals.n; ++i)
        if (!local.is_essential(i))
            point.given[{Variable::Kind::coordinate, i}] = point.random(900, static_cast<std::uint64_t>(i));
    return point;
}

/// Do the rates of (z, −v), v the speed at this position, equal those of (z, v) but for the signs? All parameters
/// are random: what is found holds for all values of these.
bool is_reversed(const Local& local, const Motions& motions, const ExactRates& rates, std::size_t speed) {
    constexpr double sure = -60;  // log₂ of the probability of an error
    const std::size_t at_speed = local.essential.size() + speed;
    double failure = 0;
    for (std::uint64_t seed = 1; seed < 100 && failure > sure; ++seed) {
        const auto state = motions.at(seed);
        if (!state) continue;
        if (!state->exact) return false;
        const auto forth = rates.at(state->point, {});
        if (!forth) continue;
        std::vector<Prime> speeds = forth->speeds;
        speeds[speed] = -speeds[speed];
        // Where no constraint ties the positions, cyclic coordinates are also seen to have no influence.
        const auto back = rates.at(motions.steps().empty() ? turned(state->point, local) : state->point, speeds);
        if (!back) continue;
        for (std::size_t k = 0; k < forth->rates.size(); ++k) {
            const Prime expected = k == at_speed ? forth->rates[k] : -forth->rates[k];
            if (!(back->rates[k] - expected).is_zero()) return false;
        }
        failure += std::log2(2 * (forth->degree + back->degree) * state->degree) + forth->conditions +
                   back->conditions + state->conditions - 61;
    }
    return failure <= sure;
}

}  // namespace

Decision by_reversal(const Local& local, const std::vector<RootOf>& roots) {
    const Mechanism& m = local.mechanism;
    Certain square = 0;  // the sum of the squares of the eigenvalues, −2ω²
    for (int i = 0; i < local.A.rows; ++i)
        for (int k = 0; k < local.A.rows; ++k) square += local.A(i, k) * local.A(k, i);
    if (square.sign() != -1 || !m.unilateral.empty() || changes_with_time(m, local.equations)) return {};
    for (const RootOf& root : roots)
        if (root.side == RootOf::Side::left || root.side == RootOf::Side::right) return {};
    try {
        const Derived other = local.residuals.rates_are_speeds
                                  ? static_cast<const Derived&>(local.near)
                                  : derived_again(local.near, m, m.constraints.empty() ? "lagrange" : "routh");
        const Motions motions(m, other.equations);
        if (!motions.obstacle().empty() || !motions.loose().empty()) return {};
        const ExactRates rates(local, other.equations);
        for (std::size_t j = 0; j < local.split.u.size(); ++j) {
            if (!local.point.u[local.split.u[j]].is_zero() || !is_reversed(local, motions, rates, j)) continue;
            const std::string name = local.equations.u[local.split.u[j]].get_name();
            return {StabilityVerdict::stable, StabilityTheorem::reversible,
                    fmt::format("the equations do not change if {} and t change their signs, and one pair of "
                                "eigenvalues +-{:.8g}i is on the imaginary axis: all motions near this one are "
                                "periodic in what is not cyclic, about steady motions near this one",
                                name, std::sqrt(-square.number() / 2))};
        }
    } catch (const std::exception&) {  // of a formalism that does not apply, or of expressions beyond GiNaC
    }
    return {};
}

}  // namespace alembert
