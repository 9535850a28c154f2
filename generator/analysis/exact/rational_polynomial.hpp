// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Polynomials over the rational numbers that are known by their values, and their factors.
///
///     const auto f = polynomial_through(values, {{X, .turned = true}, {Y}});
///     own_factor(*f, X, root)      // the irreducible factor that vanishes at a root known in digits

#include <functional>
#include <optional>
#include <vector>

#include <ginac/ginac.h>

namespace alembert {

struct PolynomialVariable {
    GiNaC::symbol symbol;
    bool turned = false;  ///< the tangent of a half angle: the values are fractions over powers of 1 + x²
};

/// The numerator of a function of these variables with rational values, of degree 8 at most in each of them.
/// Nothing if it is no such polynomial, or where it has no value.
std::optional<GiNaC::ex> polynomial_through(
    const std::function<std::optional<GiNaC::numeric>(const std::vector<GiNaC::numeric>&)>& value,
    const std::vector<PolynomialVariable>& variables);

/// The resultant of two polynomials in `by` and `in`, and nothing else, by which `by` is eliminated: by its values
/// at numbers in place of `in`.
GiNaC::ex eliminated(const GiNaC::ex& f, const GiNaC::ex& g, const GiNaC::symbol& by, const GiNaC::symbol& in);

/// The irreducible factor of f(x) that vanishes at `root`, a number of fifty digits, with coefficients that are
/// fractions. Nothing if digits do not tell which it is. FiftyDigits must be in force.
std::optional<GiNaC::ex> own_factor(const GiNaC::ex& f, const GiNaC::symbol& x, const GiNaC::numeric& root);

}  // namespace alembert
