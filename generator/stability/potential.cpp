// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/potential.hpp"

#include <algorithm>

#include "model/energy.hpp"
#include "model/formalism/elements.hpp"
#include "program/lower/lower.hpp"
#include "stability/signs.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int highest_potential_degree = 10, highest_form = 6;

/// W and its gradient as a program in the essential coordinates.
class AmendedPotential {
public:
    AmendedPotential(const Local& local, const ex& H) : local_(local) {
        const Mechanism& m = local.mechanism;
        for (const int r : local.essential) coordinates_.push_back(local.split.q[r]);
        std::vector<ex> values = m.z->pull_back({{m.lagrangian(), 1}}, m.qdot);  // momenta
        values.push_back(H);
        GiNaC::exmap rest;
        std::vector<int> cyclic;
        for (const int j : local.cyclic_momenta) cyclic.push_back(local.split.u[j]);
        for (int i = 0; i < m.size(); ++i)
            if (std::find(cyclic.begin(), cyclic.end(), i) == cyclic.end()) rest[m.qdot[i]] = 0;
        values = substitute(*m.z, values, rest);
        ex W = values.back();
        std::vector<std::pair<GiNaC::symbol, int>> given;
        program_ = begun(m);
        if (!cyclic.empty()) {
            GiNaC::lst equations, unknowns;
            for (const int i : cyclic) {
                const GiNaC::symbol p = m.symbols->declare("p_" + m.q[i].get_name(), SymbolInfo::Kind::other);
                given.emplace_back(p, program_.variable({Variable::Kind::unknown, i}));
                equations.append(m.z->expand(values[i]) == p);
                unknowns.append(m.qdot[i]);
                momenta_.push_back(i);
            }
            GiNaC::exmap rates;
            const ex solved = GiNaC::lsolve(equations, unknowns);
            for (const ex& one : solved) rates[one.lhs()] = one.rhs();
            W = m.z->name(m.z->expand(W).subs(rates));
        }
        std::vector<GiNaC::symbol> by;
        for (const int i : coordinates_) by.push_back(m.q[i]);
        std::vector<ex> wanted = m.z->pull_back({{W, 1}}, by);
        wanted.push_back(W);
        nodes_ = lower_expressions(program_, m, wanted, given);
        find_momenta(m);
    }

    int size() const { return static_cast<int>(coordinates_.size()); }

    /// The gradient, then W, for coordinates given as series.
    std::vector<Expansion> at(const std::vector<Expansion>& coordinates) const {
        const std::vector<int> held(local_.point.q.size() + local_.point.u.size(), -1);
        State<Expansion> state = local_.state_at(local_.point, nullptr, held);
        for (int k = 0; k < size(); ++k) state.q[coordinates_[k]] = coordinates[k];
        if (!momenta_.empty()) state.unknown.resize(local_.point.q.size());
        for (std::size_t k = 0; k < momenta_.size(); ++k) state.unknown[momenta_[k]] = Expansion(values_[k]);
        const std::vector<Expansion> value = interpret(program_, state);
        std::vector<Expansion> result;
        for (const int node : nodes_) result.push_back(value[node]);
        return result;
    }

    RealBall value(int k) const { return local_.point.q[coordinates_[k]]; }

private:
    void find_momenta(const Mechanism& m) {
        if (momenta_.empty()) return;
        const std::vector<ex> momenta = m.z->pull_back({{m.lagrangian(), 1}}, m.qdot);
        std::vector<ex> wanted;
        for (const int i : momenta_) wanted.push_back(momenta[i]);
        const Monomials none(1, 0);
        const std::vector<int> held(local_.point.q.size() + local_.point.u.size(), -1);
        for (const Expansion& p : local_.series(wanted, none, held)) values_.push_back(p.value());
    }

    const Local& local_;
    std::vector<int> coordinates_, momenta_, nodes_;
    Program program_;
    RealBallVector values_;
};

/// The first coefficient of W along the kernel's curve: degree and coefficient.
std::optional<std::pair<int, RealBall>> along_kernel(const AmendedPotential& W, const RealBallMatrix& K,
                                                     const RealBallMatrix& kernel) {
    const int n = W.size();
    int base = 0;  // the coordinate that leads along the kernel
    for (int i = 0; i < n; ++i)
        if (std::abs(kernel(i, 0).number()) > std::abs(kernel(base, 0).number())) base = i;
    std::vector<int> others;
    for (int i = 0; i < n; ++i)
        if (i != base) others.push_back(i);
    const RealBallMatrix K_yy = K.part(others, others);
    const Monomials line(1, highest_potential_degree);
    std::vector<RealBallVector> curve(static_cast<std::size_t>(n),
                                      RealBallVector(highest_potential_degree + 1, RealBall(0)));
    curve[base][1] = 1;
    const auto series = [&] {
        std::vector<Expansion> result;
        const Expansion x = Expansion::variable(line, 0, 0);
        for (int i = 0; i < n; ++i) {
            Expansion sum(0), power(1);
            for (int k = 1; k <= highest_potential_degree; ++k) {
                power = power * x;
                if (!curve[i][k].is_zero()) sum += Expansion(curve[i][k]) * power;
            }
            result.push_back(Expansion(W.value(i)) + sum);
        }
        return result;
    };
    for (int order = 1; order < highest_potential_degree && !others.empty(); ++order) {
        const std::vector<Expansion> gradient = W.at(series());
        RealBallMatrix right(static_cast<int>(others.size()), 1);
        for (std::size_t k = 0; k < others.size(); ++k)
            right(static_cast<int>(k), 0) = -gradient[others[k]].coefficient(order);
        const auto step = solution(K_yy, right);
        if (!step) return {};
        for (std::size_t k = 0; k < others.size(); ++k) curve[others[k]][order] += step->entries[k];
    }
    const Expansion value = W.at(series()).back();
    for (int k = 2; k <= highest_potential_degree; ++k) {
        const RealBall c = value.coefficient(k);
        if (c.is_zero()) continue;
        if (!c.sign()) return {};
        return std::pair(k, c);
    }
    return {};
}

std::optional<DegenerateMinimum> by_form(const AmendedPotential& W) {
    const Monomials plane(2, highest_form);
    const Expansion value =
        W.at({Expansion::variable(plane, 0, W.value(0)), Expansion::variable(plane, 1, W.value(1))}).back();
    for (int d = 3; d <= highest_form; ++d) {
        RealBallVector form;
        bool zero = true;
        for (int k = 0; k <= d; ++k) {
            form.push_back(value.coefficient({d - k, k}));
            zero = zero && form.back().is_zero();
        }
        if (zero) continue;
        const SignNear sign = sign_of_binary_form(form);
        if (!sign.negative && !sign.definite) return {};
        return DegenerateMinimum{
            .minimum = !sign.negative, .unstable = false, .degree = d, .coefficient = form[0].number()};
    }
    return {};
}

/// Whether there are only T₂ and forces with a potential: no gyroscopic terms and no other loads.
bool is_natural(const Local& local, const PowerSign& power) {
    const Mechanism& m = local.mechanism;
    if (!power.is_zero || !local.near.matrices.moving.empty()) return false;
    for (const bool dissipative : {true, false})
        for (const ex& load : m.generalized_forces(dissipative))
            if (!is_identically_zero(load, m)) return false;
    GiNaC::exmap rest;
    for (const GiNaC::symbol& rate : m.qdot) rest[rate] = 0;
    for (const ex& momentum : substitute(*m.z, m.z->pull_back({{m.lagrangian(), 1}}, m.qdot), rest))
        if (!is_identically_zero(momentum, m)) return false;
    return true;
}

}  // namespace

std::optional<DegenerateMinimum> degenerate_minimum(const Local& local, const PowerSign& power) {
    const Mechanism& m = local.mechanism;
    if (!power.known || !m.constraints.empty() || !local.residuals.rates_are_speeds || local.essential.empty())
        return {};
    const AmendedPotential W(local, power.H);
    const int n = W.size();
    const Monomials linear(n, 1);
    std::vector<Expansion> at;
    for (int k = 0; k < n; ++k) at.push_back(Expansion::variable(linear, k, W.value(k)));
    const std::vector<Expansion> gradient = W.at(at);
    RealBallMatrix K(n, n);
    for (int i = 0; i < n; ++i) {
        if (!gradient[i].value().is_zero()) return {};
        for (int j = 0; j < n; ++j) K(i, j) = gradient[i].coefficient(1 + j);
    }
    const auto signs = inertia(K);
    if (!signs || signs->negative > 0 || signs->zero == 0) return {};
    std::optional<DegenerateMinimum> result;
    if (signs->zero == 1) {
        const auto kernel = null_space(K);
        const auto first = kernel ? along_kernel(W, K, *kernel) : std::nullopt;
        if (!first) return {};
        result = DegenerateMinimum{.minimum = first->first % 2 == 0 && first->second.sign() == 1,
                                   .unstable = false,
                                   .degree = first->first,
                                   .coefficient = first->second.number()};
    } else if (n == 2 && signs->zero == 2) {
        result = by_form(W);
    }
    if (!result || result->minimum) return result;
    result->unstable = (n == 1 && power.is_zero) || is_natural(local, power) || damping_is_complete(local, power);
    return result->unstable ? result : std::nullopt;
}

}  // namespace alembert
