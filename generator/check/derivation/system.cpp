// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/system.hpp"

#include <algorithm>

#include "analysis/state/force_balance.hpp"
#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "model/formalism/needs.hpp"
#include "model/formalism/routh.hpp"
#include "model/inputs_in_time.hpp"

namespace alembert {

using GiNaC::ex;

DerivedSystem::DerivedSystem(Scene scene, const std::string& by)
    : derived_(derived(std::move(scene), {.by = by, .on_sheets = true})), by_(by) {
    derived_.scene.claims.clear();
    const Balanced bound = with_force_balances(derived_.mechanism, routh);
    e_ = bound.equations;
    m_ = in_terms_of(e_, bound.mechanism);
    claims_ = std::make_unique<Claims>(derived_.scene, m_, e_, derived_.sheets, PrintedNames());
    rows_ = std::make_unique<MotionRows>(
        m_, e_, [this](Program& program, const std::vector<ex>& list) { return claims_->lower(program, list); });
}

std::vector<ex> DerivedSystem::forces(bool with_potential) const {
    std::vector<ex> result = m_.generalized_forces(false);
    const std::vector<ex> dissipative = m_.generalized_forces(true);
    const std::vector<ex> slopes =
        with_potential ? m_.z->pull_back({{m_.potential_energy(), 1}}, m_.q) : std::vector<ex>(m_.q.size(), 0);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = m_.z->name(result[i] + dissipative[i] - slopes[i]);
    return result;
}

ex DerivedSystem::reaction(int i) const {
    GiNaC::exvector terms;
    for (std::size_t k = 0; k < e_.A.size(); ++k)
        terms.push_back(e_.A[k][static_cast<std::size_t>(i)] * e_.lambda[k]);
    for (const Mechanism::Constraint* c : m_.undetermined())
        terms.push_back(c->row[static_cast<std::size_t>(i)] * c->multiplier);
    return m_.z->name(GiNaC::add(std::move(terms)));
}

ex DerivedSystem::motion_residual(int i) const {
    GiNaC::exvector terms{-e_.forcing(i), -reaction(i)};
    for (int j = 0; j < e_.size(); ++j) terms.push_back(e_.M(i, j) * m_.qddot[static_cast<std::size_t>(j)]);
    return GiNaC::add(std::move(terms));
}

// Kane's equations solve the speeds and the constraints for the rates.
std::vector<DerivedSystem::IndependentSpeed> DerivedSystem::solved_speeds() const {
    const bool any = std::any_of(m_.constraints.begin(), m_.constraints.end(),
                                 [](const Mechanism::Constraint& c) { return !c.position; });
    if (m_.speeds.empty() && !any) return {};
    const Equations solved = formalism_for(Need::minimal_speeds).derive(derived_.mechanism);
    m_.z->adopt(*solved.z);
    std::vector<IndependentSpeed> result;
    for (std::size_t k = 0; k < solved.u.size(); ++k) {
        IndependentSpeed speed{.name = solved.u[k].get_name(), .form = solved.form[k]};
        const auto is_it = [&](const Mechanism::Speed& s) { return s.u.get_name() == speed.name; };
        speed.is_of_scene = std::any_of(m_.speeds.begin(), m_.speeds.end(), is_it);
        for (std::size_t i = 0; i < m_.q.size(); ++i) {
            if (!solved.u[k].is_equal(m_.qdot[i])) continue;
            speed.is_rate = true;
            speed.name = m_.q[i].get_name();
        }
        for (const ex& rate : solved.h) speed.slopes.push_back(m_.z->pull_back({{rate, 1}}, {solved.u[k]})[0]);
        result.push_back(std::move(speed));
    }
    return result;
}

std::vector<DerivedSystem::IndependentSpeed> DerivedSystem::independent_speeds() const {
    if (!speeds_) try {
            speeds_ = solved_speeds();
        } catch (const std::exception&) {  // the speeds do not determine the rates
            speeds_.emplace();
        }
    return *speeds_;
}

std::vector<ex> DerivedSystem::conditions_of_rest() const {
    std::vector<ex> result;
    for (int i = 0; i < e_.size(); ++i) result.push_back(e_.forcing(i) + reaction(i));
    return at_rest(result);
}

std::vector<ex> DerivedSystem::at_rest(const std::vector<ex>& list) const {
    GiNaC::exmap still;
    for (const auto* motion : {&m_.qdot, &m_.qddot})
        for (const GiNaC::symbol& s : *motion) still[s] = 0;
    return substitute(*m_.z, list, still);
}

ex DerivedSystem::without_accelerations(const ex& e) const {
    GiNaC::exmap none;
    for (const GiNaC::symbol& acceleration : m_.qddot) none[acceleration] = 0;
    return substitute(*m_.z, {e}, none)[0];
}

GiNaC::exmap DerivedSystem::inputs_in_time() const {
    return alembert::inputs_in_time(m_);
}

GiNaC::exmap DerivedSystem::without_resistance() const {
    std::vector<ex> forces;
    for (const Load& load : m_.loads)
        if (load.dissipative || load.origin.kind == Origin::Kind::friction)
            for (const Load::Pair& pair : load.pairs) forces.push_back(m_.z->name(pair.force));
    GiNaC::exmap none;
    for (const Mechanism::Parameter& p : m_.parameters) {
        const bool resists = std::any_of(forces.begin(), forces.end(),
                                         [&](const ex& force) { return m_.z->depends(force, {p.symbol}); });
        if (resists && !m_.z->depends(m_.lagrangian(), {p.symbol})) none[p.symbol] = 0;
    }
    for (const ex& force : substitute(*m_.z, forces, none))
        if (!is_identically_zero(force, m_)) return {};
    return none;
}

std::vector<CheckedClaim> DerivedSystem::check(const std::vector<LineClaim>& claims,
                                               const std::map<std::string, ex>& known) const {
    Scene scene = derived_.scene;
    Mechanism mechanism = derived_.mechanism;
    mechanism.z = m_.z;
    for (const auto& [name, value] : known) mechanism.definitions.push_back({name, value});
    std::vector<Diagnostic> mistakes;
    for (const LineClaim& line : claims) {
        Claim claim;
        claim.equation = parse_equality(line.lhs + " = " + line.rhs, {}, mistakes);
        for (const std::string& name : line.constants) claim.constants.push_back({name, {}});
        if (line.open) scene.unilateral.clear();
        if (line.at_rest) claim.at = Claim::At::rest;
        if (line.at_impact) claim.at = Claim::At::impact;
        for (const auto& [name, value] : line.near) {
            claim.at = Claim::At::near;
            claim.near.emplace_back(Name{name, {}}, parse_expression(value, {}, mistakes));
        }
        scene.claims.push_back(std::move(claim));
    }
    std::erase_if(mistakes, [](const Diagnostic& one) { return one.severity == Severity::warning; });
    if (!mistakes.empty()) throw SceneError(mistakes[0].message, mistakes);
    return alembert::check(scene, mechanism, derived_.sheets, by_).claims;
}

std::vector<CheckedClaim> verdicts_on(const std::vector<LineClaim>& claims,
                                      const std::map<std::string, GiNaC::ex>& known, const DerivedSystem& system) {
    if (claims.empty()) return {};
    try {
        return system.check(claims, known);
    } catch (const std::exception& error) {
        if (claims.size() == 1) {
            CheckedClaim open;
            open.reason = error.what();
            return {open};
        }
    }
    std::vector<CheckedClaim> result;
    for (const LineClaim& claim : claims) result.push_back(std::move(verdicts_on({claim}, known, system)[0]));
    return result;
}

}  // namespace alembert
