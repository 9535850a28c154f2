// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/neighbourhood.hpp"

#include "algebra/symbolic/exact_solve.hpp"
#include "model/energy.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double largest_tree = 3000;
constexpr unsigned most_speeds = 4;

int degree_for(std::size_t states) {
    return states <= 2 ? 10 : states <= 4 ? 6 : 4;
}

std::vector<GiNaC::symbol> states_of(const Local& local) {
    std::vector<GiNaC::symbol> result;
    for (const int r : local.essential) result.push_back(local.mechanism.q[local.split.q[r]]);
    for (const int u : local.split.u) result.push_back(local.equations.u[u]);
    return result;
}

std::optional<ex> exact_expression(const RealBall& c) {
    if (const auto r = c.rational()) return ex(GiNaC::numeric(cln::cl_N(*r)));
    if (const auto turns = c.multiple_of_pi()) return GiNaC::numeric(cln::cl_N(*turns)) * GiNaC::Pi;
    return {};
}

}  // namespace

Neighbourhood::Neighbourhood(const Local& of)
    : local(of), states(states_of(of)), monomials(size(), degree_for(states.size())) {
    std::vector<Expansion> x;
    for (int k = 0; k < size(); ++k)
        x.push_back(Expansion::variable(monomials, k, state_value(local, static_cast<std::size_t>(k))));
    state_ = state_of_series(local, x, monomials.degree());
    for (const Expansion& f : field(local, x, monomials.degree()))
        field_.push_back(without_constant(f));  // an equilibrium
}

Expansion Neighbourhood::series(const ex& in_rates) const {
    return local.series({local.mechanism.z->name(in_rates)}, state_)[0];
}

Expansion Neighbourhood::rate(const Expansion& of) const {
    Expansion sum = Expansion(0) * Expansion::variable(monomials, 0, 0);
    for (int k = 0; k < size(); ++k) sum += derivative(of, k) * field_[k];
    return sum;
}

std::optional<ex> Neighbourhood::rate(const ex& in_rates) const {
    const Mechanism& m = local.mechanism;
    const Equations& e = local.equations;
    const auto n = static_cast<unsigned>(e.size());
    if (n > most_speeds || !m.constraints.empty()) return {};
    const auto short_one = [&](const ex& value) { return m.z->tree_size(value) <= largest_tree; };
    const ex named = local.in_speeds({m.z->name(in_rates)})[0];
    if (!short_one(named)) return {};
    const ex V = m.z->expand(named);
    GiNaC::matrix M(n, n), f(n, 1), unknown(n, 1);
    for (unsigned i = 0; i < n; ++i) {
        if (!short_one(e.forcing(static_cast<int>(i)))) return {};
        f(i, 0) = m.z->expand(e.forcing(static_cast<int>(i)));
        unknown(i, 0) = GiNaC::symbol();
        for (unsigned j = 0; j < n; ++j) {
            if (!short_one(e.M(i, j))) return {};
            M(i, j) = m.z->expand(e.M(i, j));
        }
    }
    ex sum = 0;
    try {
        const GiNaC::matrix udot = M.solve(unknown, f);
        for (unsigned i = 0; i < n; ++i) sum += V.diff(e.u[i]) * udot(i, 0);
        for (std::size_t i = 0; i < e.q.size(); ++i) sum += V.diff(e.q[i]) * m.z->expand(e.h[i]);
        return lowest_terms(in_single_angles(sum));
    } catch (const std::exception&) {  // from GiNaC: at a pole, or for a derivative that it does not know
        return {};
    }
}

std::optional<ex> Neighbourhood::with_numbers(const ex& e) const {
    if (!local.mechanism.constraints.empty()) return {};
    GiNaC::exmap numbers;
    std::size_t next = 0;
    ex result = e;
    const std::vector<Mechanism::Parameter>& all = local.mechanism.parameters;
    for (const Mechanism::Parameter& p : all) {
        if (!p.independent) continue;
        const auto value = exact_expression(local.point.parameters[next++]);
        if (!value) return {};
        numbers[p.symbol] = *value;
    }
    for (std::size_t k = all.size(); k-- > 0;)  // a parameter may be defined by any other
        for (const Mechanism::Parameter& p : all)
            if (!p.independent) result = result.subs(GiNaC::exmap{{p.symbol, local.mechanism.z->expand(p.value)}});
    return result.subs(numbers);
}

bool Neighbourhood::vanishes_on(const ex& e, const RealBallMatrix& Z) const {
    GiNaC::exmap there;
    for (int k = 0; k < size(); ++k) {
        const auto at = exact_expression(state_value(local, static_cast<std::size_t>(k)));
        if (!at) return false;
        ex value = *at;
        for (int c = 0; c < Z.columns; ++c) {
            if (Z(k, c).is_zero()) continue;
            // The first states serve as the symbols z, one for each column, because the normal form knows them.
            const auto share = exact_expression(Z(k, c));
            if (!share) return false;
            value += *share * states[static_cast<std::size_t>(c)];
        }
        there[states[static_cast<std::size_t>(k)]] = value;
    }
    try {
        return is_identically_zero(e.subs(there), local.mechanism);
    } catch (const std::exception&) {  // a pole
        return false;
    }
}

std::optional<RealBall> Neighbourhood::value(const ex& e) const {
    const Monomials none(1, 0);
    const std::vector<int> held(local.point.q.size() + local.point.u.size(), -1);
    // `e` is already an expression in the speeds.
    Program program = begun(local.mechanism);
    std::vector<std::pair<GiNaC::symbol, int>> given;
    for (int i = 0; i < local.residuals.s; ++i)
        given.emplace_back(local.equations.u[i], program.variable({Variable::Kind::rate, i}));
    try {
        const int node = lower_expressions(program, local.mechanism, {local.mechanism.z->name(e)}, given)[0];
        return interpret(program, local.state_at(local.point, &none, held))[node].value();
    } catch (const std::exception&) {
        return {};
    }
}

}  // namespace alembert
