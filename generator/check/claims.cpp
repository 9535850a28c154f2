// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "model/held_functions.hpp"
#include "program/lower/lower.hpp"
#include "scene/book_letters.hpp"

namespace alembert {

using GiNaC::ex;

int order_of(const ex& e, const Mechanism& m) {
    std::vector<GiNaC::symbol> highest = m.qddot;
    for (const Mechanism::Constraint& c : m.constraints) highest.push_back(c.multiplier);  // as unknown as q''
    for (const Mechanism::Constraint* c : m.undetermined()) highest.push_back(c->multiplier);
    for (const Mechanism::Input& input : m.inputs) highest.push_back(input.derivative[2]);
    if (m.z->depends(e, highest)) return 2;
    highest = m.qdot;
    for (const Mechanism::Input& input : m.inputs) highest.push_back(input.derivative[1]);
    return m.z->depends(e, highest) ? 1 : 0;
}

Claims::Claims(const Scene& scene, const Mechanism& mechanism, const Equations& equations,
               std::shared_ptr<RootSheets> sheets, const PrintedNames& names)
    : m_(mechanism), e_(equations), formulas_(scene, mechanism, std::move(sheets)) {
    for (const Claim& claim : scene.claims) {
        for (const Name& name : claim.unknowns) open_name(name.text, false);
        for (const Name& name : claim.constants) open_name(name.text, true);
    }
    for (const auto& [name, value] : names) formulas_.know(name, m_.z->name(formulas_.value(value)));
    for (int i = 0; i < m_.size(); ++i) {
        const std::string& q = m_.q[i].get_name();
        third_.push_back(m_.symbols->declare(q, SymbolInfo::Kind::coordinate, i, 3));
        formulas_.know(q + "'''", third_.back());
        formulas_.has_no_derivative(third_.back());
    }
    // x'(-) takes the place of x'', because at an impact there are no accelerations.
    for (int i = 0; i < m_.size(); ++i) formulas_.know(m_.q[i].get_name() + "'(-)", m_.qddot[i]);
}

void Claims::open_name(const std::string& name, bool constant) {
    for (const Open& known : open_)
        if (known.name == name) return;
    const int index = static_cast<int>(e_.lambda.size() + m_.undetermined().size() + open_.size());
    const GiNaC::symbol symbol = m_.symbols->declare(name, SymbolInfo::Kind::other, index);
    open_.push_back({name, constant, symbol, {Variable::Kind::unknown, index}});
    formulas_.know(name, symbol);
    if (!constant) formulas_.has_no_derivative(symbol);
}

std::vector<GiNaC::symbol> Claims::open_symbols() const {
    std::vector<GiNaC::symbol> result;
    for (const Open& o : open_) result.push_back(o.symbol);
    return result;
}

const std::optional<Impact::Exact>& Claims::after_impact() {
    if (std::exchange(has_struck_, true)) return after_;
    try {
        Impact result = impact(m_);
        after_ = std::move(result.exact);
        impact_obstacle_ = after_ ? "" : result.silence;
        for (const GiNaC::symbol& before : after_ ? after_->before : std::vector<GiNaC::symbol>())
            if (!after_->pose.contains(before)) {
                impact_obstacle_ = say("the rates before the impact are known in numbers only");
                after_.reset();
                break;
            }
    } catch (const std::runtime_error& e) {
        impact_obstacle_ = e.what();
    }
    return after_;
}

/// In parameters, and in coordinates that start at a number inside a sine.
ex Claims::at_impact(const ex& e) const {
    GiNaC::exmap values;
    for (int i = 0; i < m_.size(); ++i) {
        values[m_.qdot[i]] = after_->after[i];
        values[m_.qddot[i]] = after_->pose.at(after_->before[i]);  // x'(-)
    }
    for (const auto& [multiplier, impulse] : after_->reactions) values[multiplier] = impulse;
    constexpr auto plain = GiNaC::subs_options::no_pattern;
    return m_.z->name(m_.z->expand(e).subs(values, plain).subs(after_->pose, plain));
}

// The equations of motion, differentiated, determine q''' and λ':
//     K (q''', λ') = b,   K = [M −Aᵀ; A 0],   b = (f' − M' q'' + A'ᵀ λ, γ' − A' q'').
// With r = c·q''' + ρ the claim is r = det [K b; −c ρ] / det K.
ex Claims::without_third_derivatives(const ex& residual, Place at) const {
    constexpr unsigned most_unknowns = 6;
    if (!m_.z->depends(residual, third_)) return residual;
    const std::vector<ex> c = m_.z->pull_back({{residual, 1}}, third_);
    GiNaC::exvector rest{residual};
    for (std::size_t i = 0; i < c.size(); ++i) rest.push_back(-c[i] * third_[i]);
    const auto n = static_cast<unsigned>(m_.size()), size = n + static_cast<unsigned>(e_.A.size());
    if (std::any_of(c.begin(), c.end(), [&](const ex& slope) { return m_.z->depends(slope, third_); }))
        throw SceneMistake{{at, say("a claim may hold third derivatives only to the first degree")}};
    if (size > most_unknowns)
        throw SceneMistake{{at, say("claims about third derivatives are decided for at most {} coordinates and "
                                    "multipliers; this scene has {}",
                                    most_unknowns, size)}};
    const auto rate = [&](const ex& value) { return m_.time_derivative({value})[0]; };
    GiNaC::matrix K(size, size), bordered(size + 1, size + 1);
    std::vector<ex> b(size, 0);
    for (unsigned i = 0; i < n; ++i) {
        GiNaC::exvector sum{rate(e_.forcing(static_cast<int>(i)))};
        for (unsigned j = 0; j < n; ++j) {
            K(i, j) = e_.M(i, j);
            sum.push_back(-rate(e_.M(i, j)) * m_.qddot[j]);
        }
        for (unsigned k = n; k < size; ++k) {
            const ex& a = e_.A[k - n][i];
            K(i, k) = -a;
            K(k, i) = a;
            sum.push_back(rate(a) * e_.lambda[k - n]);
        }
        b[i] = GiNaC::add(std::move(sum));
    }
    for (unsigned k = n; k < size; ++k) {
        GiNaC::exvector sum{rate(e_.gamma[k - n])};
        for (unsigned i = 0; i < n; ++i) sum.push_back(-rate(e_.A[k - n][i]) * m_.qddot[i]);
        b[k] = GiNaC::add(std::move(sum));
    }
    for (unsigned i = 0; i < size; ++i) {
        for (unsigned j = 0; j < size; ++j) bordered(i, j) = K(i, j) = m_.z->name(K(i, j));
        bordered(i, size) = m_.z->name(b[i]);
        bordered(size, i) = i < n ? m_.z->name(-c[i]) : ex(0);
    }
    bordered(size, size) = m_.z->name(GiNaC::add(std::move(rest)));
    return m_.z->name(bordered.determinant(GiNaC::determinant_algo::laplace) /
                      K.determinant(GiNaC::determinant_algo::laplace));
}

bool Claims::find_open(ClaimForm& form) const {
    form.open.clear();
    form.linear = true;
    bool constants = false;
    const std::vector<GiNaC::symbol> symbols = open_symbols();
    const std::vector<ex> slopes = m_.z->pull_back({{form.residual, 1}}, symbols);
    for (std::size_t k = 0; k < open_.size(); ++k) {
        if (slopes[k].is_zero()) continue;
        form.open.push_back(static_cast<int>(k));
        form.linear = form.linear && !m_.z->depends(slopes[k], symbols);
        constants = constants || open_[k].constant;
    }
    return constants;
}

ex Claims::read_with_constants(const Expression& expression) {
    const ex value = read(expression);
    return defined_.empty() ? value : substitute(*m_.z, {value}, defined_)[0];
}

ex Claims::read_at_impact(const Expression& expression) {
    const ex value = read(expression);
    return after_impact() ? at_impact(value) : value;
}

ClaimForm Claims::read(const Claim& claim) {
    ClaimForm form;
    const ex written = m_.z->name(formulas_.value(claim.equation.lhs) - formulas_.value(claim.equation.rhs));
    const ex residual = without_state_rates(written, m_);
    form.residual = without_third_derivatives(residual, claim.place);
    form.third = !form.residual.is_equal(residual);
    form.residual = counted_from(form.residual, m_, driven_);
    if (claim.at == Claim::At::impact && after_impact()) form.residual = at_impact(form.residual);
    bool constants = find_open(form);
    if (!form.linear && !defined_.empty()) {
        form.residual = substitute(*m_.z, {form.residual}, defined_)[0];
        constants = find_open(form);
    }
    form.order = order_of(form.residual, m_);
    if (constants) {
        ex next = form.residual;
        for (int order = form.order; order < 2; ++order) {
            next = m_.time_derivative({next})[0];
            form.derivatives.push_back(next);
        }
    }
    return form;
}

std::vector<int> Claims::lower(Program& program, const std::vector<ex>& list) const {
    std::vector<std::pair<GiNaC::symbol, int>> given;
    for (std::size_t k = 0; k < e_.lambda.size(); ++k)
        given.emplace_back(e_.lambda[k], program.variable({Variable::Kind::unknown, static_cast<int>(k)}));
    int next_unknown = static_cast<int>(e_.lambda.size());
    for (const Mechanism::Constraint* c : m_.undetermined())
        given.emplace_back(c->multiplier, program.variable({Variable::Kind::unknown, next_unknown++}));
    for (const Open& o : open_) given.emplace_back(o.symbol, program.variable(o.variable));
    constexpr int beyond_all = 1 << 20;  // no state gives them: they are random in exact arithmetic
    for (const auto& [coordinate, symbol] : displacements())
        given.emplace_back(symbol, program.variable({Variable::Kind::unknown, beyond_all + coordinate}));
    const int beyond_displacements = beyond_all + m_.size();
    for (std::size_t k = 0; k < letters_.size(); ++k)
        given.emplace_back(
            letters_[k], program.variable({Variable::Kind::unknown, beyond_displacements + static_cast<int>(k)}));
    for (const auto& [call, value] : held_functions(m_))
        given.emplace_back(call, lower_expressions(program, m_, {value})[0]);
    return lower_expressions(program, m_, list, given);
}

}  // namespace alembert
