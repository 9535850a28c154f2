// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/rigid/coefficient_texts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "program/prime.hpp"
#include "program/reduce_rows.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_symbols = 6;  // parameters in which coefficients are written as polynomials

/// As a fraction if its denominator has three digits at the most, otherwise as decimals.
std::string text_of(const Rational& r) {
    const cln::cl_I above = cln::numerator(r), below = cln::denominator(r);
    if (below > 999) return fmt::format("{:.10g}", cln::double_approx(r));
    const auto digits = [](const cln::cl_I& n) {
        return (cln::minusp(n) ? "-" : "") + std::to_string(uint64_of(cln::abs(n)));
    };
    return cln::equal(below, 1) ? digits(above) : fmt::format("{}/{}", digits(above), digits(below));
}

/// Exponents of each monomial of degree two at the most.
std::vector<std::vector<int>> monomials_of(std::size_t symbols) {
    std::vector<std::vector<int>> result{std::vector<int>(symbols, 0)};
    for (std::size_t i = 0; i < symbols; ++i) {
        result.push_back(result[0]);
        ++result.back()[i];
        for (std::size_t k = i; k < symbols; ++k) {
            result.push_back(result[0]);
            ++result.back()[i];
            ++result.back()[k];
        }
    }
    return result;
}

std::string monomial_text(const Rational& factor, const std::vector<int>& exponents,
                          const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t k = 0; k < names.size(); ++k)
        if (exponents[k] > 0)
            text +=
                (text.empty() ? "" : "*") + names[k] + (exponents[k] > 1 ? fmt::format("^{}", exponents[k]) : "");
    if (text.empty()) return coefficient_text(factor);
    if (factor == Rational(1)) return text;
    return factor == Rational(-1) ? "-" + text : text_of(factor) + "*" + text;
}

}  // namespace

std::optional<Rational> short_fraction(Prime p) {
    constexpr std::int64_t bound = 1'000'000'000;
    if (!p.is_plain()) return std::nullopt;
    std::int64_t r0 = static_cast<std::int64_t>(Prime::modulus), r1 = static_cast<std::int64_t>(p.bits()), t0 = 0,
                 t1 = 1;
    while (r1 > bound) {
        const std::int64_t quotient = r0 / r1;
        r0 = std::exchange(r1, r0 - quotient * r1);
        t0 = std::exchange(t1, t0 - quotient * t1);
    }
    if (t1 == 0 || std::abs(t1) > bound) return std::nullopt;
    return Rational(cln::cl_I(t1 < 0 ? -r1 : r1)) / cln::cl_I(std::abs(t1));
}

std::string coefficient_text(const Rational& r) {
    cln::cl_I rest = cln::denominator(r);
    for (const int factor : {2, 5})
        while (cln::zerop(cln::mod(rest, factor))) rest = cln::exquo(rest, factor);
    return cln::equal(rest, 1) ? fmt::format("{:.10g}", cln::double_approx(r)) : text_of(r);
}

std::vector<std::string> polynomials(const RegressorColumns& columns, const ColumnDependence& nominal,
                                     const std::vector<DependentEntry>& entries, const std::vector<Prime>& values,
                                     const std::vector<Quantity>& parameters) {
    std::vector<std::string> texts(entries.size()), names;
    const std::vector<int> used = columns.used_parameters();
    if (used.empty() || used.size() > most_symbols) return texts;
    for (const int k : used) names.push_back(parameters[static_cast<std::size_t>(k)].name);
    const std::vector<std::vector<int>> monomials = monomials_of(used.size());
    std::vector<std::vector<Prime>> equations;
    for (std::uint64_t sample = 1; equations.size() < monomials.size() + 2; ++sample) {
        std::vector<Prime> at = values;
        for (const int k : used)
            at[static_cast<std::size_t>(k)] =
                ModularPoint{.seed = 7 * sample}.variable({Variable::Kind::parameter, k});
        const std::optional<ColumnDependence> d = columns.dependence(at);
        if (!d || d->pivots != nominal.pivots) return texts;
        equations.emplace_back();
        for (const std::vector<int>& exponents : monomials) {
            Prime value = 1;
            for (std::size_t k = 0; k < used.size(); ++k)
                for (int e = 0; e < exponents[k]; ++e) value *= at[static_cast<std::size_t>(used[k])];
            equations.back().push_back(value);
        }
        for (const DependentEntry& e : entries) equations.back().push_back(d->rows[e.row][e.column]);
    }
    if (reduce_rows(equations, monomials.size()) != static_cast<int>(monomials.size())) return texts;
    for (std::size_t e = 0; e < entries.size(); ++e) {
        const std::size_t column = monomials.size() + e;
        std::string text;
        for (std::size_t k = 0; k < equations.size(); ++k) {
            const Prime factor = equations[k][column];
            if (factor.is_zero()) continue;
            const std::optional<Rational> fraction = short_fraction(factor);
            if (k >= monomials.size() || !fraction) {  // no such polynomial
                text.clear();
                break;
            }
            const std::string term = monomial_text(*fraction, monomials[k], names);
            text += text.empty() ? term : term[0] == '-' ? " - " + term.substr(1) : " + " + term;
        }
        texts[e] = text;
    }
    return texts;
}

}  // namespace alembert
