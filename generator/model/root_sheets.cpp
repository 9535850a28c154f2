// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/root_sheets.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/notation/factor.hpp"
#include "algebra/notation/readable.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "algebra/symbolic/functions.hpp"
#include "algebra/symbolic/impossible.hpp"
#include "model/parameter_values.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

constexpr double largest_square = 3000;  // the most nodes with all intermediate symbols substituted
constexpr double almost_zero = 1e-9;     // at the start, of what may be positive or negative

std::optional<ex> root_of_number(const ex& e) {
    const ex root = sqrt(e);
    if (GiNaC::is_a<numeric>(root) && GiNaC::ex_to<numeric>(root).is_rational()) return root;
    return std::nullopt;
}

/// The root of a product of even powers.
std::optional<ex> root_of_product(const ex& e) {
    if (GiNaC::is_a<numeric>(e)) return root_of_number(e);
    if (GiNaC::is_a<GiNaC::power>(e)) {
        const ex half = e.op(1) / 2;
        if (half.info(GiNaC::info_flags::integer)) return pow(e.op(0), half);
        return std::nullopt;
    }
    if (!GiNaC::is_a<GiNaC::mul>(e)) return std::nullopt;
    ex product = 1;
    for (const ex& factor : e) {
        const std::optional<ex> root = root_of_product(factor);
        if (!root) return std::nullopt;
        product *= *root;
    }
    return product;
}

bool is_steady(const Polynomial& polynomial) {
    for (const Term& term : polynomial.terms())
        for (const Factor& factor : term.monomial)
            if (!factor.atom->steady) return false;
    return true;
}

/// The root of number · monomial · Π sumᵉ with even exponents.
std::optional<ex> root_of_polynomial(const Polynomial& square) {
    const Factorization factors = Factorizer()(square);
    const std::optional<ex> unit = root_of_number(expression(factors.unit));
    if (!unit) return std::nullopt;
    ex product = *unit;
    for (const Factor& factor : factors.monomial) {
        const Rational half = factor.exponent / 2;
        if (!is_integer(half)) return std::nullopt;
        product *= expression(Polynomial(factor.atom, half));
    }
    for (const auto& [sum, exponent] : factors.sums) {
        if (exponent % 2 != 0) return std::nullopt;
        product *= pow(expression(sum), exponent / 2);
    }
    return product;
}

}  // namespace

RootSheets::RootSheets(const Mechanism& m)
    : symbols_(m.symbols), moving_(m.moving()), above_zero_(positive_parameters(m)) {
    const ParameterValues values(m);
    for (const Mechanism::Parameter& p : m.parameters) start_[p.symbol] = values.number(p.symbol);
    for (int i = 0; i < m.size(); ++i) {
        start_[m.q[i]] = values.number(m.z->expand(m.q_start[i]));
        start_[m.qdot[i]] = values.number(m.z->expand(m.qdot_start[i]));
    }
    for (const Mechanism::State& state : m.states)
        start_[state.derivative[0]] = values.number(m.z->expand(state.start));
    start_[m.t] = m.run.start ? values.number(m.z->expand(*m.run.start)) : 0.0;
}

void RootSheets::suppose(std::vector<ex> positive) {
    supposed_ = std::move(positive);
    is_elsewhere_ = std::any_of(supposed_.begin(), supposed_.end(), [&](const ex& e) { return at_start(e) <= 0; });
}

double RootSheets::at_start(const ex& e) const {
    const ex value = e.subs(start_, GiNaC::subs_options::no_pattern).evalf();
    if (!GiNaC::is_a<numeric>(value) || !GiNaC::ex_to<numeric>(value).is_real()) return std::nan("");
    return GiNaC::ex_to<numeric>(value).to_double();
}

std::optional<ex> RootSheets::square_root(const ex& square, const Intermediates& z) const {
    if (z.tree_size(square) > largest_square) return std::nullopt;
    const auto f = fourier(z.expand(square), *symbols_);
    if (!f || f->polynomial().is_zero()) return std::nullopt;
    if (const auto root = root_of_polynomial(f->polynomial())) return root;
    // Finds sin² θ, which the normal form writes as (1 − cos 2θ)/2.
    return root_of_product(expression(readable(*f)));
}

/// Whether it depends on positions only: a rate is never a length.
bool RootSheets::is_of_positions(const ex& e) const {
    if (GiNaC::is_a<GiNaC::symbol>(e)) {
        const SymbolInfo& info = symbols_->info(GiNaC::ex_to<GiNaC::symbol>(e));
        return info.kind == SymbolInfo::Kind::parameter || info.kind == SymbolInfo::Kind::time ||
               ((info.kind == SymbolInfo::Kind::coordinate || info.kind == SymbolInfo::Kind::input ||
                 info.kind == SymbolInfo::Kind::state) &&
                info.order == 0);
    }
    return std::all_of(e.begin(), e.end(), [this](const ex& part) { return is_of_positions(part); });
}

std::optional<ex> RootSheets::root(const ex& square, Intermediates& z, Of of) {
    const std::optional<ex> found = square_root(square, z);
    if (!found) return std::nullopt;
    ex length = 1, rest = 1;
    const auto is_length = [&](const ex& factor) {
        const bool is_sum = GiNaC::is_a<GiNaC::add>(factor) ||
                            (GiNaC::is_a<GiNaC::power>(factor) && GiNaC::is_a<GiNaC::add>(factor.op(0)));
        const bool has_sign = !is_elsewhere_ || of == Of::distance || !z.depends(factor, moving_) ||
                              is_known_positive(factor) || is_known_positive(-factor);
        return is_of_positions(factor) && has_sign &&
               (of == Of::distance || !is_sum || !z.depends(factor, moving_));
    };
    const auto sort = [&](const ex& factor) { (is_length(factor) ? length : rest) *= factor; };
    if (GiNaC::is_a<GiNaC::mul>(*found))
        std::for_each(found->begin(), found->end(), sort);
    else
        sort(*found);
    const double size = size_of(length);
    if (!std::isfinite(size) || std::abs(size) < almost_zero) return std::nullopt;
    const ex e = size > 0 ? length : ex(-length);
    assume(e);
    return rest.is_equal(1) ? z.name(e) : z.name(e * *apply_function("abs", {z.name(rest)}));
}

bool RootSheets::is_known_positive(const ex& e) const {
    if (GiNaC::is_a<numeric>(e)) return e.info(GiNaC::info_flags::positive);
    std::vector<ex> opposite = supposed_;
    opposite.push_back(-e);
    return is_impossible(opposite, above_zero_);
}

double RootSheets::size_of(const ex& e) const {
    if (is_known_positive(e)) return 1;
    return !supposed_.empty() && is_known_positive(-e) ? -1 : at_start(e);
}

void RootSheets::assume(const ex& e) {
    if (is_known_positive(e)) return;
    for (std::vector<ex>* list : {&positive_, &needed_})
        if (std::none_of(list->begin(), list->end(),
                         [&](const ex& known) { return (known - e).expand().is_zero(); }))
            list->push_back(e);
}

/// Nothing if the expression has no factor of numbers and parameters whose sign is known.
std::optional<RootSheets::Split> RootSheets::split(const ex& e, const Intermediates& z) {
    if (z.tree_size(e) > largest_square) return std::nullopt;
    const auto f = fourier(z.expand(e), *symbols_);
    if (!f || f->polynomial().is_zero()) return std::nullopt;
    const Factorization factors = Factorizer()(f->polynomial());
    Split result{.constant = 1, .rest = 1};
    const auto take = [&](const ex& base, const ex& power, bool is_odd) {
        const double size = size_of(base);
        if (!std::isfinite(size) || std::abs(size) < almost_zero) {
            result.rest *= power;
            return;
        }
        const ex sign = size < 0 && is_odd ? -1 : 1;
        result.constant *= sign * power;
        result.rest *= sign;
        if (is_odd) assume(size < 0 ? ex(-base) : base);
    };
    take(expression(factors.unit), expression(factors.unit), true);
    for (const Factor& factor : factors.monomial) {
        const ex base = expression(Polynomial(factor.atom, 1)),
                 power = expression(Polynomial(factor.atom, factor.exponent));
        if (factor.atom->steady)
            take(base, power, !is_integer(factor.exponent / 2));
        else
            result.rest *= power;
    }
    for (const auto& [sum, exponent] : factors.sums) {
        const ex base = expression(sum), power = pow(base, exponent);
        if (is_steady(sum))
            take(base, power, exponent % 2 != 0);
        else
            result.rest *= power;
    }
    return result.constant.is_equal(1) ? std::nullopt : std::optional(result);
}

std::optional<ex> RootSheets::magnitude(const ex& e, Intermediates& z) {
    const auto parts = split(e, z);
    if (!parts) return std::nullopt;
    return z.name(parts->constant * *apply_function("abs", {z.name(parts->rest)}));
}

std::optional<ex> RootSheets::sign(const ex& e, Intermediates& z) {
    const auto parts = split(e, z);
    if (!parts) return std::nullopt;
    return z.name(*apply_function("sign", {z.name(parts->rest)}));
}

std::optional<bool> RootSheets::is_larger(const ex& a, const ex& b, const Intermediates& z) {
    if (z.depends(a - b, moving_)) return std::nullopt;
    const auto parts = split(a - b, z);
    if (!parts || !GiNaC::is_a<numeric>(parts->rest)) return std::nullopt;
    return parts->rest.info(GiNaC::info_flags::positive);
}

}  // namespace alembert
