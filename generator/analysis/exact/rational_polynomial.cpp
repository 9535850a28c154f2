// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/rational_polynomial.hpp"

#include <algorithm>

#include "program/univariate.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::symbol;

namespace {

using Values = std::function<std::optional<numeric>(const std::vector<numeric>&)>;

/// Newton's divided differences, with expressions as values.
ex interpolated(const std::vector<numeric>& x, std::vector<ex> y, const symbol& X) {
    for (std::size_t order = 1; order < x.size(); ++order)
        for (std::size_t k = x.size() - 1; k >= order; --k)
            y[k] = ((y[k] - y[k - 1]) / (x[k] - x[k - order])).expand();
    ex result = 0;
    for (std::size_t k = x.size(); k-- > 0;) result = (result * (X - x[k]) + y[k]).expand();
    return result;
}

/// In the variables from `first` on; those before have the values `x`.
std::optional<ex> through(const Values& value, const std::vector<PolynomialVariable>& variables,
                          std::vector<numeric>& x, std::size_t first) {
    if (first == variables.size()) {
        const auto at = value(x);
        return at ? std::optional<ex>(*at) : std::nullopt;
    }
    const PolynomialVariable& variable = variables[first];
    std::vector<numeric> points;
    std::vector<ex> values;
    for (const int degree : {2, 4, 8}) {
        while (static_cast<int>(points.size()) < degree + 3) {
            const auto k = static_cast<int>(points.size());
            x[first] = numeric(k % 2 == 0 ? k + 1 : -k, 3);
            const auto at = through(value, variables, x, first + 1);
            if (!at) return std::nullopt;
            points.push_back(x[first]);
            values.push_back(*at);
        }
        std::vector<ex> cleared = values;
        if (variable.turned)
            for (std::size_t k = 0; k < points.size(); ++k)
                cleared[k] *= GiNaC::pow(1 + points[k] * points[k], numeric(degree / 2));
        const ex f = interpolated(points, std::move(cleared), variable.symbol);
        if (f.degree(variable.symbol) <= degree) return f;
    }
    return std::nullopt;
}

/// Of a polynomial in two variables: for each power of the one, the coefficients of the powers of the other.
using Coefficients = std::vector<Univariate<numeric>>;

Coefficients coefficients_of(const ex& f, const symbol& by, const symbol& in) {
    Coefficients result;
    for (int i = 0; i <= f.degree(by); ++i) {
        const ex c = f.coeff(by, i).expand();
        result.emplace_back();
        for (int j = 0; j <= c.degree(in); ++j) result.back().push_back(GiNaC::ex_to<numeric>(c.coeff(in, j)));
    }
    return result;
}

std::size_t degree_in(const Coefficients& f) {
    std::size_t degree = 0;
    for (const Univariate<numeric>& c : f) degree = std::max(degree, c.size() - 1);
    return degree;
}

Univariate<numeric> at(const Coefficients& f, const numeric& x) {
    Univariate<numeric> result;
    for (const Univariate<numeric>& c : f) result.push_back(value_at(c, x));
    return result;
}

/// Divides by 1 + x² as often as possible: by its powers may have been multiplied too often.
ex without_circle(ex f, const symbol& x) {
    for (ex q; f.has(x) && GiNaC::divide(f, 1 + x * x, q);) f = q;
    return f;
}

}  // namespace

std::optional<ex> polynomial_through(const Values& value, const std::vector<PolynomialVariable>& variables) {
    std::vector<numeric> x(variables.size());
    auto f = through(value, variables, x, 0);
    if (!f) return std::nullopt;
    for (const PolynomialVariable& variable : variables)
        if (variable.turned) f = without_circle(f->expand(), variable.symbol);
    return f;
}

ex eliminated(const ex& f, const ex& g, const symbol& by, const symbol& in) {
    const Coefficients a = coefficients_of(f, by, in), b = coefficients_of(g, by, in);
    const std::size_t degree = degree_in(a) * (b.size() - 1) + degree_in(b) * (a.size() - 1);
    std::vector<numeric> points;
    std::vector<ex> values;
    for (int k = 0; points.size() <= degree; ++k) {
        const numeric x = k % 2 == 0 ? k / 2 : -(k + 1) / 2;
        const Univariate<numeric> at_a = at(a, x), at_b = at(b, x);
        if (at_a.back().is_zero() || at_b.back().is_zero())
            continue;  // the resultant is one of lower degrees there
        points.push_back(x);
        values.emplace_back(resultant(at_a, at_b));
    }
    return interpolated(points, std::move(values), in);
}

std::optional<ex> own_factor(const ex& f, const symbol& x, const numeric& root) {
    if (!f.has(x)) return std::nullopt;
    const numeric nothing = GiNaC::pow(numeric(10), numeric(-30)),
                  something = GiNaC::pow(numeric(10), numeric(-18));
    const ex factored = GiNaC::factor(f);
    std::vector<ex> factors;
    const auto take = [&](const ex& part) {
        const ex base = GiNaC::is_a<GiNaC::power>(part) ? part.op(0) : part;
        if (base.has(x)) factors.push_back(base.expand());
    };
    if (GiNaC::is_a<GiNaC::mul>(factored))
        for (const ex& part : factored) take(part);
    else
        take(factored);
    std::optional<ex> own;
    for (const ex& factor : factors) {
        const numeric least = GiNaC::abs(root) > 1 ? GiNaC::abs(root) : numeric(1);  // the root itself may be zero
        numeric value = 0, size = 0;
        for (int k = 0; k <= factor.degree(x); ++k) {
            const numeric c = GiNaC::ex_to<numeric>(factor.coeff(x, k));
            value += c * GiNaC::pow(root, numeric(k));
            size += GiNaC::abs(c) * GiNaC::pow(least, numeric(k));
        }
        const numeric relative = GiNaC::abs(value) / size;
        if (relative < nothing && own) return std::nullopt;
        if (relative < nothing)
            own = factor;
        else if (relative < something)
            return std::nullopt;
    }
    return own;
}

}  // namespace alembert
