// SPDX-License-Identifier: GPL-2.0-or-later
// The condition of rest: Σ F·δr = 0 with the inertia forces of the prescribed motion (Zhang & Qin, equation (20)
// of example 1-1), written as a product. A factor a cos x + b or a sin x + b gives its roots.
#include "model/formalism/rest.hpp"

#include <algorithm>
#include <tuple>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/bounded_factor.hpp"
#include "base/language/say.hpp"
#include "model/formalism/dalembert.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Functions and roots become symbols.
ex name_functions(const ex& e, Symbols& symbols, GiNaC::exmap& letters, GiNaC::exmap& functions) {
    const auto letter = [&](const ex& call) {
        if (const auto found = letters.find(call); found != letters.end()) return found->second;
        // GiNaC's factor orders by symbol, so the name does not matter.
        const GiNaC::symbol s = symbols.declare("f" + std::to_string(letters.size()), SymbolInfo::Kind::other);
        letters[call] = s;
        functions[s] = call;
        return ex(s);
    };
    if (GiNaC::is_a<GiNaC::function>(e)) return letter(e);
    if (e.nops() == 0) return e;
    if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::rational) &&
        !e.op(1).info(GiNaC::info_flags::integer)) {
        const GiNaC::numeric exponent = GiNaC::ex_to<GiNaC::numeric>(e.op(1));
        return pow(letter(pow(e.op(0), 1 / ex(exponent.denom()))), exponent.numer());
    }
    GiNaC::exvector parts;
    for (const ex& part : e) parts.push_back(name_functions(part, symbols, letters, functions));
    if (GiNaC::is_a<GiNaC::add>(e)) return GiNaC::add(std::move(parts));
    if (GiNaC::is_a<GiNaC::mul>(e)) return GiNaC::mul(std::move(parts));
    return pow(parts[0], parts[1]);
}

}  // namespace

TrigonometricProduct product_of(const ex& e, const Mechanism& m) {
    TrigonometricProduct result;
    GiNaC::exmap letters;
    const ex plain = name_functions(e, *m.symbols, letters, result.functions);
    result.vanishes = plain.is_zero();
    ex product = factored(plain);
    if (GiNaC::is_a<GiNaC::add>(product)) {
        const ex parts = plain.numer_denom();
        result.has_poles = !GiNaC::is_a<GiNaC::numeric>(parts.op(1));
        if (result.has_poles) product = factored(parts.op(0).expand());
    }
    std::vector<ex> factors;
    if (GiNaC::is_a<GiNaC::mul>(product))
        factors.assign(product.begin(), product.end());
    else
        factors.push_back(product);
    for (const ex& factor : factors) {
        const ex base = GiNaC::is_a<GiNaC::power>(factor) ? factor.op(0) : factor;
        if (GiNaC::is_a<GiNaC::numeric>(base)) continue;
        if (GiNaC::is_a<GiNaC::symbol>(base) &&
            m.symbols->info(GiNaC::ex_to<GiNaC::symbol>(base)).kind == SymbolInfo::Kind::parameter)
            continue;
        const bool divides = GiNaC::is_a<GiNaC::power>(factor) && GiNaC::is_a<GiNaC::numeric>(factor.op(1)) &&
                             factor.op(1).info(GiNaC::info_flags::negative);
        if (divides)  // never zero
            result.has_poles = true;
        else
            result.bases.push_back(base);
        result.is_repeated = result.is_repeated || (!divides && !base.is_equal(factor));
    }
    return result;
}

Phrase leading_positive(const Fourier& factor) {
    for (const Term& term : factor.terms())
        if (circular(term.monomial) != nullptr)
            return readable(term.coefficient < 0 ? Rational(-1) * factor : factor);
    const bool minus = factor.size() > 0 && factor.terms()[0].coefficient < 0;
    return readable(minus ? Rational(-1) * factor : factor);
}

namespace {

/// The conditions of rest as products, and the roots of their factors.
struct RestSteps {
    explicit RestSteps(const Mechanism& mechanism) : m(mechanism) {}

    const Mechanism& m;
    Section products{.words = say("With all rates and accelerations zero:")};
    Section roots{.words = say("with the roots (modulo the period):")};

    void add(const Phrase& sum) {
        const TrigonometricProduct found = product_of(expression(sum), m);
        std::vector<Phrase> atoms, sums;
        for (const ex& base : found.bases) {
            const auto f = fourier(base.subs(found.functions), *m.symbols);
            if (!f || f->size() == 0) continue;
            (GiNaC::is_a<GiNaC::add>(base) ? sums : atoms).push_back(leading_positive(*f));
            if (m.size() == 1) add_root(base, found.functions);
        }
        // GiNaC's order changes from run to run.
        const auto by_text = [](const Phrase& a, const Phrase& b) { return text(a) < text(b); };
        std::sort(atoms.begin(), atoms.end(), by_text);
        std::sort(sums.begin(), sums.end(), by_text);
        atoms.insert(atoms.end(), sums.begin(), sums.end());
        std::sort(roots.equalities.begin(), roots.equalities.end(), [](const auto& a, const auto& b) {
            const int simple_a = a.first.kind == Phrase::Kind::call, simple_b = b.first.kind == Phrase::Kind::call;
            return std::tuple(simple_a, text(a.first), text(a.second)) <
                   std::tuple(simple_b, text(b.first), text(b.second));
        });
        // If there are parameters only, no factor vanishes, and rest is impossible.
        const Phrase left = found.vanishes                     ? phrases::number(0)
                            : atoms.empty() || found.has_poles ? sum
                                                               : phrases::product(atoms);
        products.equalities.emplace_back(left, phrases::number(0));
    }

private:
    void add_root(const ex& base, const GiNaC::exmap& functions) {
        const ex q = m.q[0];
        const auto normal = [&](const ex& e) { return fourier(e.subs(functions), *m.symbols); };
        for (const auto& [s, call] : functions) {
            if (!GiNaC::is_a<GiNaC::function>(call) || !base.has(s) || base.degree(s) != 1) continue;
            const ex slope = base.coeff(s, 1), rest = base.coeff(s, 0);
            if (slope.subs(functions).has(q) || rest.subs(functions).has(q)) continue;
            const std::string name = GiNaC::ex_to<GiNaC::function>(call).get_name();
            const auto arg = fourier(call.op(0), *m.symbols);
            if (!arg || (name != "sin" && name != "cos")) continue;
            if (rest.is_zero()) {
                const Phrase half_turn = phrases::quotient(phrases::pi(), phrases::number(2));
                roots.equalities.emplace_back(readable(*arg), name == "sin" ? phrases::number(0) : half_turn);
                if (name == "sin") roots.equalities.emplace_back(readable(*arg), phrases::pi());
            } else if (normal(-rest / slope)) {
                // numerator and denominator are written separately: a quotient of two readable sums
                const ex sign = normal(slope)->terms()[0].coefficient < 0 ? -1 : 1;
                roots.equalities.emplace_back(
                    phrases::call(name, {readable(*arg)}),
                    phrases::quotient(readable(*normal(-rest * sign)), readable(*normal(slope * sign))));
            }
        }
        if (base.is_equal(q))
            roots.equalities.emplace_back(phrases::symbol(m.q[0], m.symbols->info(m.q[0])), phrases::number(0));
    }
};

}  // namespace

std::vector<RestFactor> rest_factors(const Mechanism& m, const Equations& e) {
    std::vector<RestFactor> result;
    for (const ex& condition : rest_conditions(m, e)) {
        if (m.z->tree_size(condition) > 3000) continue;
        const auto sum = fourier(m.z->expand(condition), *m.symbols, 500);
        if (!sum || sum->size() == 0 || sum->size() > 40) continue;
        const TrigonometricProduct product = product_of(expression(readable(*sum)), m);
        for (const ex& base : product.bases) {
            const ex value = base.subs(product.functions);
            if (const auto f = fourier(value, *m.symbols); f && f->size() > 0)
                result.push_back({value, text(leading_positive(*f))});
        }
    }
    return result;
}

OwnSteps steps_of_dalembert(const Mechanism& m, const Equations& e) {
    const StepWriter write(m);
    const VirtualWork work = virtual_work(m);
    Section works{
        .words = say(
            "Virtual work of the applied forces, dW = sum of Q dq, and of the inertia forces, dW* = sum of Q* dq; "
            "Q + Q* = 0:")};
    for (int i = 0; i < m.size(); ++i) {
        write.force(works, "Q", m.q[i], work.conservative[i] + work.dissipative[i] + work.applied[i]);
        write.force(works, "Q*", m.q[i], work.inertia[i]);
    }
    if (!e.A.empty())
        works.words.replace(works.words.rfind("Q + Q* = 0"), std::string::npos, say("Q + Q* + A^T lambda = 0:"));
    RestSteps rest(m);
    const std::vector<ex> conditions = rest_conditions(m, e);
    for (int i = 0; i < m.size(); ++i) {
        GiNaC::exvector balance{conditions[i]};
        for (std::size_t k = 0; k < e.A.size(); ++k) balance.push_back(e.A[k][i] * e.lambda[k]);
        const auto f = write.normal(GiNaC::add(std::move(balance)));
        if (f && e.A.empty())
            rest.add(readable(*f));
        else if (f)
            rest.products.equalities.emplace_back(readable(*f), phrases::number(0));
    }
    OwnSteps result{.sections = {std::move(works), std::move(rest.products)}};
    if (!rest.roots.equalities.empty()) result.sections.push_back(std::move(rest.roots));
    return result;
}

}  // namespace alembert
