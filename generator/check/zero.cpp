// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/zero.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "algebra/symbolic/fifty_digits.hpp"
#include "algebra/symbolic/on_sides.hpp"
#include "base/language/say.hpp"
#include "model/energy.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::is_a;
using GiNaC::numeric;

namespace {

constexpr double nothing = 1e-30;  // relative to the sum of the terms' sizes; less counts as zero in fifty digits

void gather(const ex& e, GiNaC::exset& symbols) {
    if (is_a<GiNaC::symbol>(e)) symbols.insert(e);
    for (const ex& part : e) gather(part, symbols);
}

/// The value of `e` if it is real and finite, otherwise nothing.
std::optional<numeric> real_value(const ex& e) {
    const ex value = e.evalf();
    if (!is_a<numeric>(value) || !GiNaC::ex_to<numeric>(value).is_real()) return std::nullopt;
    return GiNaC::ex_to<numeric>(value);
}

/// With the parameters that the scene gives in others written out.
ex in_independent_parameters(ex e, const Mechanism& m) {
    GiNaC::exmap values;
    for (const Mechanism::Parameter& p : m.parameters)
        if (!p.independent) values[p.symbol] = m.z->expand(p.value);
    for (std::size_t round = 0; round < values.size(); ++round)  // one may stand in another
        e = e.subs(values, GiNaC::subs_options::no_pattern);
    return e;
}

/// Whether it is zero on all sides of its absolute values, signs, smaller and larger values.
bool is_zero_on_all_sides(const ex& e, const Mechanism& m, const std::vector<ex>& chosen = {}) {
    constexpr std::size_t most_sides = 6;
    const std::vector<ex> sides = sides_of(e);
    if (sides.empty()) return is_identically_zero(e, m);
    if (chosen.size() == most_sides) return false;
    // The innermost is the first. On one side of it the others may be other sides.
    for (const ex& positive : {sides[0], ex(-sides[0])}) {
        std::vector<ex> list = chosen;
        list.push_back(positive);
        if (!is_zero_on_all_sides(where_positive(e, list).expand(), m, list)) return false;
    }
    return true;
}

/// Times 10 or 100 or a tenth, and what may be negative with either sign.
numeric moved_away(const numeric& value, int seed, std::size_t k, const SymbolInfo& info) {
    const int way = seed + static_cast<int>(k) * (seed / 7 + 1);
    const numeric scale = way % 4 == 0   ? numeric(1, 10)
                          : way % 4 == 1 ? numeric(10)
                          : way % 4 == 2 ? numeric(100)
                                         : 1;
    const bool is_negative = info.kind != SymbolInfo::Kind::time && (way / 4) % 2 == 1;
    return is_negative ? -value * scale : value * scale;
}

/// The sum of |value| over the terms of the outermost sum.
std::optional<numeric> size_of(const ex& e, const GiNaC::exmap& at) {
    numeric sum = 0;
    const auto add = [&](const ex& term) {
        const auto value = real_value(term.subs(at, GiNaC::subs_options::no_pattern));
        if (value) sum += GiNaC::abs(*value);
        return value.has_value();
    };
    if (!is_a<GiNaC::add>(e)) return add(e) ? std::optional(sum) : std::nullopt;
    for (const ex& term : e)
        if (!add(term)) return std::nullopt;
    return sum;
}

}  // namespace

CheckedClaim zero_test(const ex& given, const Mechanism& m) {
    const ex e = in_independent_parameters(given, m).expand();
    CheckedClaim zero;
    zero.verdict = Verdict::proved;
    zero.normal_form = true;
    if (e.is_zero() || is_zero_on_all_sides(e, m)) return zero;
    GiNaC::exset found;
    gather(e, found);
    std::vector<GiNaC::symbol> symbols;
    for (const GiNaC::symbol& s : m.symbols->all())
        if (found.contains(s)) symbols.push_back(s);
    const FiftyDigits digits;
    // Beyond a threshold far away or of the other sign it may be otherwise.
    const int tries = sides_of(e).empty() ? 6 : 60;
    for (int seed = 1; seed <= tries; ++seed) try {
            GiNaC::exmap at;
            CheckedClaim result;
            result.verdict = Verdict::refuted;
            for (std::size_t k = 0; k < symbols.size(); ++k) {
                const int number = seed * 7 + static_cast<int>(k) * 5;
                numeric value = numeric(1 + number % 7, 1 + (number / 7 + static_cast<int>(k)) % 3) / 3;
                const SymbolInfo& info = m.symbols->info(symbols[k]);
                if (seed > 6 && info.kind != SymbolInfo::Kind::parameter) value = moved_away(value, seed, k, info);
                at[symbols[k]] = value;
                result.counterexample.emplace_back(
                    info.text(), value.denom().is_equal(1)
                                     ? fmt::format("{}", value.numer().to_int())
                                     : fmt::format("{}/{}", value.numer().to_int(), value.denom().to_int()));
            }
            const auto value = real_value(e.subs(at, GiNaC::subs_options::no_pattern));
            const auto size = size_of(e, at);
            if (!value || !size || GiNaC::abs(*value) <= numeric(nothing) * *size) continue;
            result.residual_value = value->to_double();
            result.residual = fmt::format("{:.6g}", result.residual_value);
            return result;
        } catch (const std::exception&) {  // a pole, or a function that has no value there
            continue;
        }
    CheckedClaim unknown;
    unknown.reason =
        say("what should vanish is zero to thirty digits wherever it was tried, and no proof was found");
    return unknown;
}

CheckedClaim all_of(const std::vector<CheckedClaim>& tests) {
    const CheckedClaim* result = &tests.front();
    for (const CheckedClaim& test : tests) {
        if (test.verdict == Verdict::refuted) return test;
        if (test.verdict != Verdict::proved) result = &test;
    }
    return *result;
}

}  // namespace alembert
