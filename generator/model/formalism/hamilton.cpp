// SPDX-License-Identifier: GPL-2.0-or-later
// q̇ = ∂H/∂p,   ṗ = −∂H/∂q + Q,   H(q,p,t) = Σ p q̇ − L  (Goldstein, Classical Mechanics (1980), chapter 8).
// L = ½ q̇ᵀ M q̇ + bᵀ q̇ + L₀ gives  p = M q̇ + b,   H = ½ (p − b)ᵀ M⁻¹ (p − b) − L₀.
// Elimination of p: M q̈ = −∂H/∂q |_{p = ∂L/∂q̇} + Q − (∂p/∂q) q̇ − ∂p/∂t.
#include "model/formalism/hamilton.hpp"

#include <algorithm>
#include <numeric>

#include "algebra/notation/fractions.hpp"
#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// The order in which rows are eliminated: those with the shortest diagonal element first. For a symmetric top
/// this is C, whose elimination turns A sin² θ + C cos² θ into A sin² θ.
std::vector<int> elimination_order(const GiNaC::matrix& M, const Mechanism& m) {
    std::vector<int> order(M.rows());
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> size;
    for (const int k : order) size.push_back(m.z->tree_size(M(k, k)) + (m.z->depends(M(k, k), m.q) ? 1e6 : 0));
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size[a] < size[b]; });
    return order;
}

}  // namespace

Possible<std::vector<ex>> solve_named(const GiNaC::matrix& M, const std::vector<ex>& right, const Mechanism& m) {
    Intermediates& z = *m.z;
    const int n = static_cast<int>(right.size());
    const std::vector<int> order = elimination_order(M, m);
    GiNaC::matrix L(n, n);
    std::vector<ex> inverse(n), x(n), result(n);
    for (int i = 0; i < n; ++i) {
        x[i] = right[order[i]];
        for (int j = 0; j < n; ++j) L(i, j) = M(order[i], order[j]);
    }
    for (int k = 0; k < n; ++k) {
        if (is_identically_zero(L(k, k), m))
            return Obstacle{
                say("the momenta do not determine the rates: the mass matrix is singular; give every coordinate "
                    "a mass, or use the formalism 'lagrange'")};
        inverse[k] = z.name(1 / L(k, k));
        for (int i = k + 1; i < n; ++i) {
            if (L(i, k).is_zero()) continue;
            const ex factor = z.name(L(i, k) * inverse[k]);
            for (int j = k + 1; j <= i; ++j) L(i, j) = short_form(z.name(L(i, j) - factor * L(j, k)), m);
            x[i] = z.name(x[i] - factor * x[k]);
        }
    }
    for (int k = n - 1; k >= 0; --k) {
        GiNaC::exvector rest{x[k]};
        for (int i = k + 1; i < n; ++i) rest.push_back(-L(i, k) * x[i]);
        x[k] = z.name(GiNaC::add(std::move(rest)) * inverse[k]);
    }
    for (int k = 0; k < n; ++k) result[order[k]] = x[k];
    return result;
}

namespace {

constexpr int most_inverted = 8;  // the most coordinates; for more, M⁻¹ is too long to be read

/// L = ½ q̇ᵀ M q̇ + bᵀ q̇ + L₀.
struct SecondDegree {
    std::vector<ex> momenta;  ///< M q̇ + b
    GiNaC::matrix M;
    std::vector<ex> b;
    ex L0;
};

Possible<SecondDegree> second_degree(const Mechanism& m) {
    const int n = m.size();
    if (const auto none = no_coordinates(m, say("Hamilton's equations"))) return Obstacle{*none};
    if (!m.constraints.empty())
        return Obstacle{say(
            "Hamilton's equations need independent coordinates, and the scene has constraints; use the formalism "
            "'routh'")};
    Intermediates& z = *m.z;
    const ex L = m.lagrangian();
    SecondDegree c{.momenta = z.pull_back({{L, 1}}, m.qdot), .M = GiNaC::matrix(n, n), .b = {}, .L0 = 0};
    for (int j = 0; j < n; ++j) {
        const std::vector<ex> column = z.push_forward(c.momenta, {{m.qdot[j], 1}});
        for (int i = 0; i < n; ++i) {
            c.M(i, j) = short_form(column[i], m);
            for (const ex& third : z.push_forward({column[i]}, {{m.qdot[j], 1}}))
                if (z.depends(column[i], m.qdot) && !is_identically_zero(third, m))
                    return Obstacle{say(
                        "Hamilton's equations are made for a Lagrangian of second degree in the rates; this one "
                        "is not; use the formalism 'lagrange'")};
        }
    }
    GiNaC::exmap still;
    for (const GiNaC::symbol& rate : m.qdot) still[rate] = 0;
    c.b = c.momenta;
    c.b.push_back(L);
    c.b = substitute(z, c.b, still);
    for (ex& value : c.b) value = short_form(value, m);
    c.L0 = c.b.back();
    c.b.pop_back();
    return c;
}

/// −∂H/∂q at p = ∂L/∂q̇, without M⁻¹: H = ½ wᵀ y − L₀ with M y = w = p − b has the slope
/// −½ yᵀ ∂M/∂q y − (∂b/∂q)ᵀ y − ∂L₀/∂q, and y is q̇ there.
std::vector<ex> force_at_rates(const Mechanism& m, const SecondDegree& c) {
    GiNaC::exvector terms{c.L0};
    for (int i = 0; i < m.size(); ++i) {
        terms.push_back(c.b[i] * m.qdot[i]);
        for (int j = 0; j <= i; ++j) terms.push_back(c.M(i, j) * m.qdot[i] * m.qdot[j] / (i == j ? 2 : 1));
    }
    return m.z->pull_back({{m.z->name(GiNaC::add(std::move(terms))), 1}}, m.q);
}

}  // namespace

Possible<CanonicalEquations> canonical(const Mechanism& m) {
    const Possible<SecondDegree> possible = second_degree(m);
    if (const auto obstacle = possible.obstacle()) return Obstacle{*obstacle};
    const SecondDegree& parts = possible.value();
    const int n = m.size();
    Intermediates& z = *m.z;
    CanonicalEquations c{
        .p = {}, .momenta = parts.momenta, .M = parts.M, .H = 0, .qdot = {}, .pdot = {}, .force = {}};
    GiNaC::exmap rates;
    for (int i = 0; i < n; ++i) {
        const std::string name = "p_" + m.q[i].get_name();
        GiNaC::symbol p;
        for (const GiNaC::symbol& known : m.symbols->all())
            if (m.symbols->info(known).kind == SymbolInfo::Kind::other && known.get_name() == name) p = known;
        if (p.get_name() != name) p = m.symbols->declare(name, SymbolInfo::Kind::other, i);
        c.p.push_back(p);
    }
    std::vector<ex> w;
    for (int i = 0; i < n; ++i) w.push_back(z.name(c.p[i] - parts.b[i]));
    const Possible<std::vector<ex>> solution = solve_named(c.M, w, m);
    if (const auto singular = solution.obstacle()) return Obstacle{*singular};
    const std::vector<ex>& y = solution.value();
    GiNaC::exvector H{-parts.L0};
    for (int i = 0; i < n; ++i) H.push_back(w[i] * y[i] / 2);
    c.H = short_form(z.name(GiNaC::add(std::move(H))), m);

    c.qdot = z.pull_back({{c.H, 1}}, c.p);
    c.force = z.pull_back({{c.H, -1}}, m.q);
    for (int i = 0; i < n; ++i) rates[m.qdot[i]] = c.qdot[i];
    const std::vector<ex> damping = m.generalized_forces(true), applied = m.generalized_forces(false);
    for (int i = 0; i < n; ++i) c.pdot.push_back(z.name(c.force[i] + damping[i] + applied[i]));
    c.pdot = substitute(z, c.pdot, rates);
    return c;
}

std::optional<std::string> obstacle_to_hamilton(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    return m.size() > most_inverted ? second_degree(m).obstacle() : canonical(m).obstacle();
}

Equations hamilton(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    const SecondDegree c = second_degree(m).value();
    Intermediates& z = *m.z;
    std::vector<ex> force;
    if (m.size() > most_inverted) {
        force = force_at_rates(m, c);
    } else {
        const CanonicalEquations full = canonical(m).value();
        GiNaC::exmap momenta;
        for (int i = 0; i < m.size(); ++i) momenta[full.p[i]] = full.momenta[i];
        force = substitute(z, full.force, momenta);
    }
    const std::vector<ex> pdot = m.time_derivative_without_acceleration(c.momenta);
    Equations equations = equations_without_terms("hamilton", m);
    equations.M = c.M;
    equations.dissipative = m.generalized_forces(true);
    equations.applied = m.generalized_forces(false);
    for (int i = 0; i < m.size(); ++i) equations.own.push_back(z.name(force[i] - pdot[i]));
    return equations;
}

OwnSteps steps_of_hamilton(const Mechanism& m, const Equations&) {
    const StepWriter write(m);
    const CanonicalEquations c = canonical(m).value();
    std::vector<Fourier> rates;  // q', then p'
    for (int i = 0; i < 2 * m.size(); ++i) {
        const auto f = write.normal(i < m.size() ? c.qdot[i] : c.pdot[i - m.size()]);
        if (!f) return {};
        rates.push_back(*f);
    }
    Section section{.words =
                        say("Legendre's transform: with p = dL/dq', Hamilton's function is H = sum of p q' - L:")};
    for (int i = 0; i < m.size(); ++i) write.equality(section, write.symbol_of(c.p[i]), c.momenta[i]);
    write.equality(section, StepWriter::letter("H"), c.H);
    OwnSteps result{.sections = {std::move(section)}, .title = say("Hamilton's canonical equations")};
    for (int i = 0; i < 2 * m.size(); ++i) {
        const int k = i % m.size();
        result.equations.push_back({i < m.size() ? write.symbol_of(m.qdot[k]) : write.rate(c.p[k]),
                                    in_fractions(rates[static_cast<std::size_t>(i)], *m.symbols),
                                    {}});
    }
    return result;
}

}  // namespace alembert
