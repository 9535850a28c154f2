// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/notation/quotient.hpp"

#include "algebra/notation/compose.hpp"
#include "algebra/notation/readable.hpp"
#include "algebra/symbolic/bounded_factor.hpp"
#include "algebra/symbolic/exact_solve.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// Writes −(a/2)/d as −a/(2·d).
Phrase fraction(const Phrase& n, const Phrase& d) {
    if (n.kind == Phrase::Kind::negative) return phrases::negative(fraction(n.args[0], d));
    if (n.kind == Phrase::Kind::quotient) return fraction(n.args[0], phrases::product({n.args[1], d}));
    return phrases::quotient(n, d);
}

ex reciprocal_in_factors(const ex& e) {
    const ex product = factored(e);
    if (!GiNaC::is_a<GiNaC::mul>(product)) return pow(product, -1);
    GiNaC::exvector factors;
    for (std::size_t i = 0; i < product.nops(); ++i) factors.push_back(pow(product.op(i), -1));
    return GiNaC::mul(std::move(factors));
}

}  // namespace

std::optional<Phrase> readable_quotient(const ex& e, const Symbols& symbols, std::size_t most_terms,
                                        const std::function<double(const ex&)>& number) {
    const ex parts = lowest_terms(e).numer_denom();
    const int sign = number(parts.op(1)) < 0 ? -1 : 1;
    const std::size_t budget = 20 * most_terms;
    const auto whole = fourier(parts.op(0) * reciprocal_in_factors(parts.op(1)), symbols, budget);
    const auto n = fourier(sign * parts.op(0), symbols, budget), d = fourier(sign * parts.op(1), symbols, budget);
    if (!whole || !n || !d || whole->size() > most_terms) return std::nullopt;
    Phrase sum = readable(*whole);
    if (n->size() < 2 || d->size() == 0) return sum;
    Composer compose;
    const Phrase one = fraction(compose.formula(n->polynomial()), compose.formula(d->polynomial()));
    return cost(one) < cost(sum) ? one : sum;
}

}  // namespace alembert
