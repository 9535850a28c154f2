// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/equilibrium/energy_rate.hpp"

#include <algorithm>

#include "algebra/symbolic/functions.hpp"
#include "algebra/symbolic/impossible.hpp"
#include "model/parameter_values.hpp"
#include "stability/equilibrium/loads.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Each parameter with the sign that it has at these values: 0, or c, or −c for a positive symbol c.
std::pair<GiNaC::exmap, std::vector<GiNaC::symbol>> signs_in_use(const Mechanism& m,
                                                                 const std::vector<double>& parameters) {
    const ParameterValues values(m, parameters);
    std::pair<GiNaC::exmap, std::vector<GiNaC::symbol>> result;
    for (const Mechanism::Parameter& p : m.parameters) {
        const double value = values.number(p.symbol);
        if (value < 0) result.first[p.symbol] = -p.symbol;
        if (value == 0) result.first[p.symbol] = 0;
        if (value < 0 || value > 0) result.second.push_back(p.symbol);
    }
    return result;
}

/// Whether `e` is a sum of products of positive numbers and parameters with even powers, or absolute values, of v.
bool is_positive_but_for(const ex& e, const GiNaC::symbol& v, const std::vector<GiNaC::symbol>& above_zero) {
    const auto is_kept = [&](const ex& factor) {
        const bool is_power = GiNaC::is_a<GiNaC::power>(factor);
        const ex base = is_power ? factor.op(0) : factor, exponent = is_power ? factor.op(1) : ex(1);
        if (GiNaC::is_a<GiNaC::numeric>(factor)) return factor.info(GiNaC::info_flags::positive);
        if (base.is_equal(absolute(v))) return exponent.info(GiNaC::info_flags::positive);
        if (base.is_equal(v))
            return exponent.info(GiNaC::info_flags::even) && exponent.info(GiNaC::info_flags::positive);
        return std::any_of(above_zero.begin(), above_zero.end(), [&](const auto& s) { return base.is_equal(s); });
    };
    const auto is_term = [&](const ex& term) {
        if (!term.has(v)) return false;
        return GiNaC::is_a<GiNaC::mul>(term) ? std::all_of(term.begin(), term.end(), is_kept) : is_kept(term);
    };
    return GiNaC::is_a<GiNaC::add>(e) ? std::all_of(e.begin(), e.end(), is_term) : is_term(e);
}

}  // namespace

EnergyRate energy_rate(const Mechanism& m, const SteadyProblem& problem, const std::vector<double>& parameters) {
    const bool holonomic = std::all_of(m.constraints.begin(), m.constraints.end(),
                                       [](const Mechanism::Constraint& c) { return c.position.has_value(); });
    if (!m.inputs.empty() || m.has_kicks() || !holonomic || !problem.residuals().rates_are_speeds)
        return EnergyRate::open;
    const auto Q = written_out_loads(m);
    if (!Q || std::any_of(Q->begin(), Q->end(), [&](const ex& force) { return force.has(m.t); }))
        return EnergyRate::open;
    GiNaC::exmap still;
    for (const GiNaC::symbol& rate : m.qdot) still[rate] = 0;
    std::vector<ex> at_rest;
    ex power = 0;
    bool acts_on_cyclic = false;
    for (int i = 0; i < m.size(); ++i) {
        at_rest.push_back((*Q)[i].subs(still, GiNaC::subs_options::no_pattern));
        const ex rest = ((*Q)[i] - at_rest.back()).expand();
        acts_on_cyclic = acts_on_cyclic || (!rest.is_zero() && !problem.essential()[static_cast<std::size_t>(i)]);
        power += rest * m.qdot[i];
    }
    if (!have_potential(at_rest, m)) return EnergyRate::open;
    power = power.expand();
    if (power.is_zero() && at_rest == *Q) return EnergyRate::constant;
    for (int i = 0; i < m.size(); ++i)
        if (!problem.essential()[static_cast<std::size_t>(i)] && power.has(m.qdot[i])) acts_on_cyclic = true;
    if (acts_on_cyclic) return EnergyRate::open;
    const auto [signs, above_zero] = signs_in_use(m, parameters);
    power = power.subs(signs, GiNaC::subs_options::no_pattern).expand();
    if (power.is_zero() || is_impossible({power}, above_zero)) return EnergyRate::falls;
    const bool is_one = m.size() == 1 && m.constraints.empty();
    return is_one && is_positive_but_for(power, m.qdot[0], above_zero) ? EnergyRate::grows : EnergyRate::open;
}

}  // namespace alembert
