// SPDX-License-Identifier: GPL-2.0-or-later
#include "formalism/rest.hpp"

#include "formalism/dalembert.hpp"
#include "report/readable.hpp"
#include "report/text.hpp"
#include "symbolic/bounded_factor.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

ex name_functions(const ex& e, Symbols& symbols, GiNaC::exmap& letters, GiNaC::exmap& functions) {
    if (GiNaC::is_a<GiNaC::function>(e)) {
        if (const auto found = letters.find(e); found != letters.end()) return found->second;
        // GiNaC's factor orders by symbol: the name is of no consequence.
        const GiNaC::symbol s = symbols.declare("f" + std::to_string(letters.size()), SymbolInfo::Kind::other);
        letters[e] = s;
        functions[s] = e;
        return s;
    }
    if (e.nops() == 0) return e;
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
    const ex product = factored(plain);
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
        result.bases.push_back(base);
    }
    return result;
}

Phrase leading_positive(const Fourier& factor) {
    for (const Term& term : factor.terms())
        if (circular(term.monomial) != nullptr) return readable(term.coefficient < 0 ? Rational(-1) * factor : factor);
    return readable(factor);
}

std::vector<RestFactor> rest_factors(const Mechanism& m, const Equations& e) {
    std::vector<RestFactor> result;
    for (const ex& condition : rest_conditions(m, e)) {
        if (m.z->tree_size(condition) > 3000) continue;
        const auto sum = fourier(m.z->expand(condition), *m.symbols, 500);
        if (!sum || sum->size() == 0 || sum->size() > 40) continue;
        const TrigonometricProduct product = product_of(expression(readable(*sum)), m);
        for (const ex& base : product.bases) {
            const ex value = base.subs(product.functions);
            if (const auto f = fourier(value, *m.symbols); f && f->size() > 0) result.push_back({value, text(leading_positive(*f))});
        }
    }
    return result;
}

}  // namespace alembert
