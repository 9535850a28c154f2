// SPDX-License-Identifier: GPL-2.0-or-later
// R(q_e, q̇_e, p_c, t) = L − Σ p_c q̇_c, d/dt ∂R/∂q̇_e − ∂R/∂q_e = Q_e, ṗ_c = 0 (Goldstein, Classical Mechanics
// (1980), chapter 8). q̇_c = M_cc⁻¹ (p_c − p_c|_{q̇_c = 0}). For comparison with other formalisms the rows are
// combined again: row e + M_ec M_cc⁻¹ row c has the matrix M of all coordinates.
#include "model/formalism/routhian.hpp"

#include "algebra/notation/fractions.hpp"
#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"
#include "model/formalism/hamilton.hpp"

namespace alembert {

using GiNaC::ex;

std::vector<int> cyclic_coordinates(const Mechanism& m) {
    const std::vector<ex> slope = m.z->pull_back({{m.lagrangian(), 1}}, m.q);
    const std::vector<ex> damping = m.generalized_forces(true), applied = m.generalized_forces(false);
    std::vector<int> cyclic;
    for (int i = 0; i < m.size(); ++i)
        if (is_identically_zero(slope[i], m) && is_identically_zero(damping[i], m) &&
            is_identically_zero(applied[i], m))
            cyclic.push_back(i);
    return cyclic;
}

Possible<Reduction> reduction(const Mechanism& m) {
    Intermediates& z = *m.z;
    Reduction r{.cyclic = cyclic_coordinates(m),
                .remaining = {},
                .p = {},
                .momenta = {},
                .rates = {},
                .R = 0,
                .M = {},
                .own = {}};
    if (r.cyclic.empty())
        return Obstacle{say(
            "Routh's procedure removes cyclic coordinates, and the scene has none: L depends on each of them, or "
            "a force acts on it")};
    const Possible<CanonicalEquations> possible = canonical(m);  // its obstacles, p and M
    if (const auto obstacle = possible.obstacle()) return Obstacle{*obstacle};
    const CanonicalEquations& all = possible.value();
    const int c = static_cast<int>(r.cyclic.size()), e = m.size() - c;
    for (int i = 0, k = 0; i < m.size(); ++i)
        if (k < c && r.cyclic[k] == i)
            ++k;
        else
            r.remaining.push_back(i);
    GiNaC::exmap still;
    GiNaC::matrix Mcc(c, c);
    for (int i = 0; i < c; ++i) {
        r.p.push_back(all.p[r.cyclic[i]]);
        r.momenta.push_back(all.momenta[r.cyclic[i]]);
        still[m.qdot[r.cyclic[i]]] = 0;
        for (int j = 0; j < c; ++j) Mcc(i, j) = all.M(r.cyclic[i], r.cyclic[j]);
    }
    std::vector<ex> right = substitute(z, r.momenta, still);
    for (int i = 0; i < c; ++i) right[i] = z.name(r.p[i] - right[i]);
    Possible<std::vector<ex>> rates_of_cyclic = solve_named(Mcc, right, m);
    if (const auto singular = rates_of_cyclic.obstacle()) return Obstacle{*singular};
    r.rates = std::move(rates_of_cyclic).value();
    // L is of second degree in the rates, so R = L|_{q̇_c = 0} − ½ (p_c − p_c|_{q̇_c = 0})ᵀ q̇_c.
    GiNaC::exvector R{short_form(substitute(z, {m.lagrangian()}, still)[0], m)};
    for (int i = 0; i < c; ++i) R.push_back(-right[i] * r.rates[i] / 2);
    r.R = short_form(z.name(GiNaC::add(std::move(R))), m);

    std::vector<GiNaC::symbol> state;
    for (const int i : r.remaining) state.push_back(m.q[i]);
    for (const int i : r.remaining) state.push_back(m.qdot[i]);
    const std::vector<ex> gradient = z.pull_back({{r.R, 1}}, state);
    const std::vector<ex> p(gradient.begin() + e, gradient.end());
    const std::vector<ex> pdot = m.time_derivative_without_acceleration(p);
    r.M = GiNaC::matrix(e, e);
    for (int j = 0; j < e; ++j) {
        const std::vector<ex> column = z.push_forward(p, {{state[e + j], 1}});
        for (int i = 0; i < e; ++i) r.M(i, j) = column[i];
        r.own.push_back(z.name(gradient[j] - pdot[j]));
    }
    return r;
}

std::optional<std::string> obstacle_to_routhian(const Mechanism& m) {
    return reduction(with_own_intermediates(m)).obstacle();
}

Equations routhian(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    const Reduction r = reduction(m).value();
    Intermediates& z = *m.z;
    const int n = m.size(), c = static_cast<int>(r.cyclic.size()), e = n - c;
    Equations equations = equations_without_terms("routhian", m);
    equations.dissipative = m.generalized_forces(true);
    equations.applied = m.generalized_forces(false);
    equations.own.resize(n);
    const std::vector<ex> pdot = m.time_derivative_without_acceleration(r.momenta);
    GiNaC::matrix Mcc(c, c);
    for (int j = 0; j < n; ++j) {
        const std::vector<ex> column = z.push_forward(r.momenta, {{m.qdot[j], 1}});
        for (int i = 0; i < c; ++i) equations.M(r.cyclic[i], j) = equations.M(j, r.cyclic[i]) = column[i];
    }
    for (int i = 0; i < c; ++i) {
        equations.own[r.cyclic[i]] = z.name(-pdot[i]);
        for (int j = 0; j < c; ++j) Mcc(i, j) = equations.M(r.cyclic[i], r.cyclic[j]);
    }
    GiNaC::exmap momenta;
    for (int i = 0; i < c; ++i) momenta[r.p[i]] = r.momenta[i];
    const std::vector<ex> own = substitute(z, r.own, momenta);
    for (int i = 0; i < e; ++i) {
        std::vector<ex> row;
        for (const int k : r.cyclic) row.push_back(equations.M(k, r.remaining[i]));
        const std::vector<ex> X = solve_named(Mcc, row, m).value();  // M_cc⁻¹ M_ce, column e
        GiNaC::exvector f{own[i]};
        for (int k = 0; k < c; ++k) f.push_back(X[k] * equations.own[r.cyclic[k]]);
        equations.own[r.remaining[i]] = z.name(GiNaC::add(std::move(f)));
        for (int j = 0; j < e; ++j) {
            GiNaC::exvector entry{r.M(j, i)};
            for (int k = 0; k < c; ++k) entry.push_back(X[k] * equations.M(r.cyclic[k], r.remaining[j]));
            equations.M(r.remaining[j], r.remaining[i]) = z.name(GiNaC::add(std::move(entry)));
        }
    }
    return equations;
}

OwnSteps steps_of_routhian(const Mechanism& m, const Equations& equations) {
    const StepWriter write(m);
    const Reduction r = reduction(m).value();
    std::string names;
    for (const int i : r.cyclic) names += (names.empty() ? "" : ", ") + m.q[i].get_name();
    Section section{
        .words =
            say("Cyclic coordinates: {}. Their momenta are constants; the Routhian R = L - sum of p q':", names)};
    for (std::size_t k = 0; k < r.cyclic.size(); ++k)
        write.equality(section, write.symbol_of(r.p[k]), r.momenta[k]);
    for (std::size_t k = 0; k < r.cyclic.size(); ++k)
        write.equality(section, write.symbol_of(m.qdot[r.cyclic[k]]), r.rates[k]);
    write.equality(section, StepWriter::letter("R"), r.R);
    OwnSteps result{.sections = {std::move(section)},
                    .title = say("Routh's equations of the coordinates that are not cyclic")};
    const int e = static_cast<int>(r.remaining.size());
    for (int i = 0; i < e; ++i) {
        GiNaC::exvector left{-r.own[i], -equations.dissipative[r.remaining[i]]};
        for (int j = 0; j < e; ++j) left.push_back(r.M(i, j) * m.qddot[r.remaining[j]]);
        const auto f = write.normal(GiNaC::add(std::move(left))),
                   right = write.normal(equations.applied[r.remaining[i]]);
        if (!f || !right) return {};
        result.equations.push_back(equation_in_fractions(*f, *right, *m.symbols));
        result.equations.back().divided_by.reset();
    }
    for (const GiNaC::symbol& p : r.p) result.equations.push_back({write.rate(p), phrases::number(0), {}});
    return result;
}

}  // namespace alembert
