// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/integrals.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/derive/derived.hpp"
#include "analysis/exact/motions.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"
#include "model/formalism/needs.hpp"
#include "program/lower/lower.hpp"
#include "stability/signs.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double next_to_nothing = 1e-20;
constexpr double short_enough = 3000;  // nodes of a tree that GiNaC may differentiate and normalize

/// Is `ratio` ≤ 0 near the state: negative there, or minus a sum of even powers with positive coefficients?
bool is_nonpositive(const ex& ratio, const Local& local) {
    const Mechanism& m = local.mechanism;
    const Monomials none(1, 0);
    const std::vector<int> held(static_cast<std::size_t>(local.residuals.n + local.residuals.s), -1);
    const auto sign_of = [&](const ex& e) -> std::optional<int> {
        try {
            return local.series({m.z->name(e)}, none, held)[0].value().sign();
        } catch (const NotAnalytic&) {  // 0/0
            return {};
        }
    };
    if (const auto sign = sign_of(ratio); sign && *sign < 0) return true;
    const ex sum = ratio.expand();
    const auto is_even = [&](const ex& term) {
        ex constant = 1;
        const auto part = [&](const ex& factor) {
            const bool moves = m.z->depends(factor, m.moving()) || m.z->depends(factor, m.qdot);
            if (!moves) {
                constant *= factor;
                return true;
            }
            return GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::even);
        };
        bool even = true;
        if (GiNaC::is_a<GiNaC::mul>(term))
            for (const ex& factor : term) even = even && part(factor);
        else
            even = part(term);
        const auto sign = even ? sign_of(constant) : std::nullopt;
        return sign && *sign <= 0;
    };
    if (!GiNaC::is_a<GiNaC::add>(sum)) return sum.is_zero() || is_even(sum);
    return std::all_of(sum.begin(), sum.end(), is_even);
}

/// Tests the loads one by one: each force must oppose its own velocity. One that moves by itself, as along axes
/// that are turned, may push.
bool each_brakes(const Local& local) {
    const Mechanism& m = local.mechanism;
    GiNaC::exmap still;
    for (const GiNaC::symbol& rate : m.qdot) still[rate] = 0;
    for (const Load& load : m.loads)
        for (const Load::Pair& pair : load.pairs) {
            if (m.z->tree_size(pair.velocity) > short_enough || m.z->tree_size(pair.force) > short_enough)
                return false;
            const ex force = m.z->expand(pair.force), velocity = m.z->expand(pair.velocity);
            if (force.is_zero() || velocity.is_zero()) continue;
            if (!is_identically_zero(velocity.subs(still, GiNaC::subs_options::no_pattern), m)) return false;
            if (!is_nonpositive((force / velocity).normal(), local)) return false;
        }
    return true;
}

/// Coordinates on which nothing depends are no variables here, and the functions must not contain them.
std::vector<GiNaC::symbol> left_out(const Local& local) {
    std::vector<GiNaC::symbol> result;
    for (int i = 0; i < local.residuals.n; ++i)
        if (!local.is_essential(i)) result.push_back(local.mechanism.q[i]);
    return result;
}

bool holds_none(const ex& in_rates, const Local& local) {
    const Mechanism& m = local.mechanism;
    const ex e = local.in_speeds({in_rates})[0];
    const std::vector<GiNaC::symbol> none = left_out(local);
    if (!m.z->depends(e, none)) return true;
    for (const ex& slope : m.z->pull_back({{e, 1}}, none))
        if (!is_identically_zero(slope, m)) return false;
    return true;
}

bool constraints_hold_none(const Local& local) {
    for (const Mechanism::Constraint& c : local.mechanism.constraints) {
        if (c.position && !holds_none(*c.position, local)) return false;
        for (const ex& entry : c.row)
            if (!holds_none(entry, local)) return false;
    }
    return true;
}

/// A candidate is an integral if its time derivative vanishes at exact random motions.
bool is_constant(const ex& candidate, const Motions& motions, const Mechanism& m) {
    const ex rate = m.time_derivative({candidate})[0];
    Program program = begun(m);
    const std::vector<int> node = lower_expressions(program, m, {rate});
    constexpr double sure = -60;  // log₂ of the probability of an error
    double failure = 0;
    for (std::uint64_t seed = 1; seed < 200 && failure > sure; ++seed) {
        const auto state = motions.at(seed);
        if (!state) continue;
        const auto at = evaluate_mod(program, state->point, node);
        if (!at) continue;
        if (!at->exact || !state->exact || !at->value[node[0]].is_zero()) return false;
        failure += std::log2(std::max(2.0, at->degree[node[0]] * state->degree)) + at->conditions +
                   state->conditions - 61;
    }
    return failure <= sure;
}

/// Angular momenta about O along the axes of N.
std::vector<ex> angular_momenta(const Mechanism& m) {
    std::array<ex, 3> sum{0, 0, 0};
    for (const MassElement& body : m.masses) {
        const Vector3 &r = body.position, &v = body.velocity;
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            sum[k] += body.mass * (r[i] * v[j] - r[j] * v[i]);
        }
        if (!body.rotation) continue;
        const std::array<ex, 6> I = central_inertia(body, *m.z);
        const Vector3& w = body.rotation->w_NB_B;
        const std::array<ex, 3> own{I[0] * w[0] + I[3] * w[1] + I[5] * w[2],
                                    I[3] * w[0] + I[1] * w[1] + I[4] * w[2],
                                    I[5] * w[0] + I[4] * w[1] + I[2] * w[2]};
        for (int axis = 0; axis < 3; ++axis)
            for (int k = 0; k < 3; ++k) sum[k] += own[axis] * body.rotation->axes[axis][k];
    }
    std::vector<ex> result;
    for (const ex& component : sum) result.push_back(m.z->name(component));
    return result;
}

/// Calls `ask` with exact motions of the scene, if there are any.
template <typename Ask>
void with_motions(const Local& local, const Ask& ask) {
    const Mechanism& m = local.mechanism;
    if (!m.unilateral.empty()) return;
    try {
        const Derived other = local.residuals.rates_are_speeds
                                  ? static_cast<const Derived&>(local.near)
                                  : derived_again(local.near, m, formalism_in_rates(m).name);
        const Motions motions(m, other.equations);
        if (motions.obstacle().empty() && motions.loose().empty()) ask(motions);
    } catch (const std::exception&) {  // of a formalism that does not apply, or of expressions beyond GiNaC
    }
}

std::vector<ex> constant_angular_momenta(const Local& local) {
    const Mechanism& m = local.mechanism;
    std::vector<ex> result;
    if (!masses_are_known(m)) return result;
    with_motions(local, [&](const Motions& motions) {
        const std::vector<ex> candidates = angular_momenta(m);
        std::vector<ex> found;
        ex square = 0;
        bool all = true;
        for (const ex& candidate : candidates) {
            const bool constant = is_constant(candidate, motions, m);
            if (constant && holds_none(candidate, local)) found.push_back(candidate);
            all = all && constant;
            square += candidate * candidate;
        }
        if (const ex magnitude = m.z->name(square); all && holds_none(magnitude, local))
            found.push_back(magnitude);
        result = std::move(found);
    });
    return result;
}

/// The gradients and second derivatives, with respect to the variables, of the functions in the combination, H
/// first.
struct EnergyForms {
    int size = 0;
    std::vector<RealBallVector> gradient;
    std::vector<RealBallMatrix> second;
};

EnergyForms forms_of(const Local& local, const std::vector<ex>& functions) {
    const Residuals& r = local.residuals;
    std::vector<int> variables;
    EnergyForms result;
    for (int i = 0; i < r.n; ++i) variables.push_back(local.is_essential(i) ? result.size++ : -1);
    for (int i = 0; i < r.s; ++i) variables.push_back(result.size++);
    const Monomials monomials(result.size, 2);
    const auto take = [&](const Expansion& value) {
        RealBallVector gradient;
        RealBallMatrix second(result.size, result.size);
        for (int i = 0; i < result.size; ++i) {
            gradient.push_back(value.coefficient(1 + i));
            for (int j = 0; j <= i; ++j) {
                Monomials::Exponents exponents(static_cast<std::size_t>(result.size), 0);
                ++exponents[i];
                ++exponents[j];
                const RealBall c = value.coefficient(monomials.index(exponents));
                second(i, j) = second(j, i) = i == j ? c + c : c;
            }
        }
        result.gradient.push_back(std::move(gradient));
        result.second.push_back(std::move(second));
    };
    for (const Expansion& value : local.series(functions, monomials, variables)) take(value);
    const auto all = interpret(r.program, local.state_at(local.point, &monomials, variables));
    for (const std::vector<int>* rows : {&r.position, &r.velocity})
        for (const int node : *rows) take(all[node]);
    return result;
}

/// With `either_sign`, H is conserved, so that a maximum is sufficient too.
bool definite(const Local& local, const std::vector<ex>& functions, bool either_sign) {
    const EnergyForms forms = forms_of(local, functions);
    const int n = forms.size, count = static_cast<int>(forms.gradient.size());
    // Multipliers: columns of `balance` are gradients, that of H last.
    RealBallMatrix balance(n, count), level(count - 1, n);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < count; ++k) {
            balance(i, (k + count - 1) % count) = forms.gradient[k][i];
            if (k > 0) level(k - 1, i) = forms.gradient[k][i];
        }
    const auto multipliers = null_space(balance, next_to_nothing), Z = null_space(level, next_to_nothing);
    if (!multipliers || !Z) return false;
    int particular = -1;
    std::vector<int> free;
    for (int c = 0; c < multipliers->columns; ++c)
        if (!(*multipliers)(count - 1, c).is_zero())
            particular = c;
        else
            free.push_back(c);
    if (particular < 0) return false;
    const auto combined = [&](int c) {
        RealBallMatrix sum(n, n);
        for (int k = 0; k < count; ++k) {
            const RealBall& factor = (*multipliers)((k + count - 1) % count, c);
            if (!factor.is_zero()) sum = sum + factor * forms.second[k];
        }
        return transposed(*Z) * sum * *Z;
    };
    std::vector<RealBallMatrix> more;
    for (const int c : free) more.push_back(combined(c));
    for (const int sign : {1, -1}) {
        if (sign < 0 && !either_sign) break;
        RealBallMatrix Q = RealBall(sign) * combined(particular);
        const auto s = definite_combination(Q, more);
        if (!s) continue;
        for (std::size_t k = 0; k < s->size(); ++k)
            Q = Q + RealBall(Rational(cln::rational(cln::cl_DF((*s)[k])))) * more[k];
        const auto signs = inertia(Q);
        if (signs && signs->positive == Q.rows) return true;
    }
    return false;
}

}  // namespace

bool is_integral(const ex& function, const Local& local) {
    bool result = false;
    with_motions(local, [&](const Motions& motions) {
        result = is_constant(local.mechanism.z->name(function), motions, local.mechanism);
    });
    return result;
}

PowerSign power_sign(const Local& local) {
    const Mechanism& m = local.mechanism;
    PowerSign result;
    const Energy energy = energy_of(m);
    m.z->adopt(*energy.z);
    result.H = energy.jacobi;
    const int p = static_cast<int>(local.split.u.size());
    result.damping = RealBallMatrix(p, p);
    for (const Mechanism::Constraint& c : m.constraints)
        if (!is_identically_zero(c.offset, m)) return result;
    if (!holds_none(result.H, local)) return result;
    if (energy.jacobi_conserved) {
        result.known = result.is_zero = true;
        return result;
    }
    if (!is_identically_zero(m.explicit_time_derivative({m.lagrangian()})[0], m)) return result;
    const std::vector<ex> dampers = m.generalized_forces(true), others = m.generalized_forces(false);
    ex work = 0;
    for (int i = 0; i < m.size(); ++i) work += (dampers[i] + others[i]) * m.qdot[i];
    const ex power = m.z->name(work);
    if (is_identically_zero(power, m)) {
        result.known = result.is_zero = true;
        return result;
    }
    const Residuals& r = local.residuals;
    const int all = r.n + r.s;
    const Monomials squares(all, 2);
    std::vector<int> variables;
    for (int k = 0; k < all; ++k) variables.push_back(k);
    const Expansion P = local.series({power}, squares, variables)[0];
    RealBallMatrix D(r.s, r.s);
    for (int i = 0; i < r.s; ++i)
        for (int j = 0; j <= i; ++j) {
            Monomials::Exponents exponents(static_cast<std::size_t>(all), 0);
            ++exponents[r.n + i];
            ++exponents[r.n + j];
            const RealBall c = P.coefficient(squares.index(exponents));
            D(i, j) = D(j, i) = i == j ? -c : -c * RealBall(Rational(1) / 2);
        }
    std::vector<int> of_speeds, columns;
    for (int i = 0; i < r.s; ++i) of_speeds.push_back(r.n + i);
    for (int j = 0; j < p; ++j) columns.push_back(static_cast<int>(local.split.q.size()) + j);
    const RealBallMatrix U = local.tangent.along.part(of_speeds, columns);
    result.damping = transposed(U) * D * U;
    if (each_brakes(local)) {
        result.known = true;
        return result;
    }
    // −q'ᵀ D q' with a constant D, or a D that is definite at the state.
    if (!r.rates_are_speeds || m.z->tree_size(power) > short_enough) return result;
    const ex whole = m.z->expand(power).expand();
    bool quadratic = true, constant = true;
    ex left = whole;
    for (const GiNaC::symbol& a : m.qdot)
        for (const GiNaC::symbol& b : m.qdot) {
            const ex c = whole.diff(a).diff(b);
            quadratic = quadratic && !m.z->depends(c, m.qdot);
            constant = constant && !m.z->depends(c, m.moving());
            left -= c * a * b / 2;
        }
    if (!quadratic || !is_identically_zero(left, m)) return result;
    const auto signs = inertia(D);
    result.known = signs && signs->negative == 0 && (constant || signs->zero == 0);
    return result;
}

bool damping_is_complete(const Local& local, const PowerSign& power) {
    if (!power.known || power.is_zero) return false;
    std::vector<int> free;
    for (int j = 0; j < power.damping.rows; ++j)
        if (std::find(local.cyclic_momenta.begin(), local.cyclic_momenta.end(), j) == local.cyclic_momenta.end())
            free.push_back(j);
    const auto signs = inertia(power.damping.part(free, free));
    return signs && signs->positive == static_cast<int>(free.size());
}

std::optional<IntegralProof> proof_by_integrals(const Local& local, const PowerSign& power) {
    if (!power.known || !constraints_hold_none(local)) return {};
    const Mechanism& m = local.mechanism;
    const Energy energy = energy_of(m);
    IntegralProof proof{.relative = !is_identically_zero(power.H - energy.energy, in_terms_of(energy, m))};
    std::vector<ex> functions{power.H};
    if (definite(local, functions, power.is_zero)) return proof;
    if (!local.cyclic_momenta.empty()) {
        const std::vector<ex> momenta = m.z->pull_back({{m.lagrangian(), 1}}, m.qdot);
        for (const int j : local.cyclic_momenta) functions.push_back(momenta[local.split.u[j]]);
        proof.by = IntegralProof::By::momenta;
        if (definite(local, functions, power.is_zero)) return proof;
    }
    const std::vector<ex> angular = constant_angular_momenta(local);
    functions.insert(functions.end(), angular.begin(), angular.end());
    proof.by = IntegralProof::By::angular_momenta;
    if (!angular.empty() && definite(local, functions, power.is_zero)) return proof;
    return {};
}

}  // namespace alembert
