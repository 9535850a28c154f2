// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/semidefinite.hpp"

#include <algorithm>

#include "model/energy.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int most_parts = 400;  // the most nodes of an expression that is factored

int count_nodes(const ex& e) {
    int count = 1;
    for (std::size_t i = 0; i < e.nops() && count <= most_parts; ++i) count += count_nodes(e.op(i));
    return count;
}

/// The series of an expression in the states.
std::optional<Expansion> series_of(const ex& f, const Neighbourhood& near) {
    GiNaC::exmap in_rates;
    const Equations& e = near.local.equations;
    for (std::size_t i = 0; i < e.u.size(); ++i) in_rates[e.u[i]] = e.form[i];
    try {
        return near.series(near.local.residuals.rates_are_speeds ? f : f.subs(in_rates));
    } catch (const NotAnalytic&) {
        return {};
    }
}

/// Do all derivatives up to this order vanish on the space?
bool vanishes_to_order(const ex& f, int order, const RealBallMatrix& Z, const Neighbourhood& near) {
    if (!near.vanishes_on(f, Z)) return false;
    if (order > 0)
        for (const GiNaC::symbol& x : near.states)
            if (!vanishes_to_order(f.diff(x), order - 1, Z, near)) return false;
    return true;
}

/// Adds the function (row r of `rows`) · (deviations), also as an expression if its coefficients are rational.
void add_linear(Semidefinite::ZeroSet& set, const RealBallMatrix& rows, int r, const Neighbourhood& near) {
    Expansion linear(0);
    ex text = 0;
    std::optional<Rational> first;
    bool is_exact = true;
    for (int v = 0; v < rows.columns; ++v) {
        if (rows(r, v).is_zero()) continue;
        linear += Expansion(rows(r, v)) * Expansion::variable(near.monomials, v, 0);
        const auto c = rows(r, v).rational();
        is_exact = is_exact && c && state_value(near.local, static_cast<std::size_t>(v)).is_zero();
        if (!is_exact) continue;
        if (!first) first = *c;
        const Rational share = *c / *first;
        text += GiNaC::numeric(cln::cl_N(share)) * near.states[static_cast<std::size_t>(v)];
    }
    const auto is_known = [&](const ex& known) { return known.is_equal(text); };
    if (!linear.coefficient(0).is_zero() || (is_exact && !first)) return;
    if (is_exact && std::any_of(set.texts.begin(), set.texts.end(), is_known)) return;
    set.functions.push_back(linear);
    if (is_exact) set.texts.push_back(text);
}

/// The second way: the form of lowest degree, in the variables on which it depends.
std::optional<Semidefinite> by_leading_form(const ex& f, const Neighbourhood& near) {
    const auto series = series_of(f, near);
    if (!series) return {};
    const int n = near.size();
    int degree = 0;
    for (int k = near.monomials.size() - 1; k > 0; --k)
        if (!series->coefficient(k).is_zero()) degree = near.monomials.degree_of(k);
    if (degree < 2 || degree > 4 || degree % 2 == 1) return {};
    RealBallMatrix Z, rows;
    int sign = 0;
    if (degree == 2) {
        rows = hessian(*series, near.monomials);
        const auto signs = inertia(rows);
        const auto kernel = signs ? null_space(rows) : std::nullopt;
        if (!kernel || kernel->columns != signs->zero || (signs->positive > 0) == (signs->negative > 0)) return {};
        sign = signs->positive > 0 ? 1 : -1;
        Z = *kernel;
    } else {
        std::vector<int> used;
        for (int v = 0; v < n; ++v)
            for (int k = 1; k < near.monomials.size(); ++k)
                if (near.monomials.degree_of(k) == degree && near.monomials.exponents(k)[v] > 0 &&
                    !series->coefficient(k).is_zero() && (used.empty() || used.back() != v))
                    used.push_back(v);
        rows = RealBallMatrix(static_cast<int>(used.size()), n);
        Z = RealBallMatrix(n, n - rows.rows);
        for (int v = 0, column = 0, row = 0; v < n; ++v)
            if (std::find(used.begin(), used.end(), v) == used.end())
                Z(v, column++) = 1;
            else
                rows(row++, v) = 1;
        const Monomials own(rows.rows, degree);
        Expansion form(0);
        for (int k = 1; k < near.monomials.size(); ++k) {
            if (near.monomials.degree_of(k) != degree) continue;
            Expansion term(series->coefficient(k));
            for (int r = 0; r < rows.rows; ++r)
                for (int e = 0; e < near.monomials.exponents(k)[used[static_cast<std::size_t>(r)]]; ++e)
                    term *= Expansion::variable(own, r, 0);
            form += term;
        }
        const SignNear of_form = sign_near(form, own);
        if (!of_form.definite) return {};
        sign = of_form.positive ? 1 : -1;
    }
    if (!vanishes_to_order(f, degree - 1, Z, near)) return {};
    Semidefinite result{.sign = sign, .sets = {{}}};
    for (int r = 0; r < rows.rows; ++r) add_linear(result.sets[0], rows, r, near);
    return result;
}

std::optional<Semidefinite> by_factors(const ex& f, const Neighbourhood& near, bool whole) {
    if (count_nodes(f) > most_parts) return {};
    GiNaC::exmap names;
    ex factored;
    try {
        const ex fraction = f.normal().numer_denom();
        const ex above = fraction.op(0).to_polynomial(names), below = fraction.op(1).to_polynomial(names);
        factored = GiNaC::factor(above.expand()).subs(names) * pow(GiNaC::factor(below.expand()).subs(names), -1);
    } catch (const std::exception&) {
        return {};
    }
    if (whole && !GiNaC::is_a<GiNaC::mul>(factored) && !GiNaC::is_a<GiNaC::power>(factored)) return {};
    Semidefinite result{.sign = 1, .sets = {}};
    const auto take = [&](const ex& factor) {
        const bool powered = GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::integer);
        const ex base = powered ? factor.op(0) : factor;
        const int exponent = powered ? GiNaC::ex_to<GiNaC::numeric>(factor.op(1)).to_int() : 1;
        const auto value = near.value(base);
        const auto sign = value ? value->sign() : std::nullopt;
        if (!sign) return false;
        if (*sign != 0) {
            if (exponent % 2 != 0) result.sign *= *sign;
            return true;
        }
        if (exponent < 0) return false;
        const auto series = series_of(base, near);
        if (!series) return false;
        if (exponent % 2 == 0) {
            result.sets.push_back({{*series}, {base}});
            return true;
        }
        const auto own = by_leading_form(base, near);
        if (!own) return false;
        result.sign *= own->sign;
        result.sets.insert(result.sets.end(), own->sets.begin(), own->sets.end());
        return true;
    };
    if (GiNaC::is_a<GiNaC::mul>(factored)) {
        for (const ex& factor : factored)
            if (!take(factor)) return {};
    } else if (!take(factored)) {
        return {};
    }
    return result;
}

/// Functions whose linear parts are independent, and the other functions.
struct Observed {
    std::vector<Expansion> leading, rest;
    RealBallMatrix rows;  ///< the linear parts of `leading`
};

Observed observed(const std::vector<Expansion>& functions, const Neighbourhood& near) {
    const int n = near.size();
    Observed result;
    result.rows = RealBallMatrix(0, n);
    for (const Expansion& h : functions) {
        RealBallMatrix longer(result.rows.rows + 1, n);
        std::copy(result.rows.entries.begin(), result.rows.entries.end(), longer.entries.begin());
        for (int k = 0; k < n; ++k) {
            Monomials::Exponents one(static_cast<std::size_t>(n), 0);
            one[k] = 1;
            longer(longer.rows - 1, k) = h.coefficient(near.monomials.index(one));
        }
        if (rank(longer) == longer.rows) {
            result.rows = longer;
            result.leading.push_back(h);
        } else {
            result.rest.push_back(h);
        }
    }
    return result;
}

}  // namespace

std::optional<Semidefinite> semidefinite(const ex& f, const Neighbourhood& near) {
    if (is_identically_zero(f, near.local.mechanism)) return Semidefinite{.sign = 0, .sets = {{}}};
    if (auto found = by_leading_form(f, near)) return found;
    return by_factors(f, near, true);
}

bool holds_no_other_motion(const Semidefinite::ZeroSet& set, const Neighbourhood& near) {
    const int n = near.size();
    std::vector<Expansion> functions;
    for (Expansion h : set.functions)
        for (int order = 0; order < n + 2; ++order) {
            functions.push_back(h);
            h = near.rate(h);
        }
    const Observed seen = observed(functions, near);
    const int rank_seen = seen.rows.rows;
    if (rank_seen == n) return true;
    if (rank_seen + 1 != n) return false;
    // One direction remains: the curve x = Z z + …, on which the leading functions vanish. One of the other
    // functions must not vanish on it.
    const auto Z = null_space(seen.rows);
    if (!Z || Z->columns != 1) return false;
    const RealBallMatrix across = transposed(seen.rows);
    const RealBallMatrix square = seen.rows * across;
    const Monomials line(1, near.monomials.degree());
    const Expansion z = Expansion::variable(line, 0, 0);
    std::vector<Expansion> x(static_cast<std::size_t>(n), Expansion(0));
    for (int i = 0; i < n; ++i) x[i] += Expansion((*Z)(i, 0)) * z;
    Expansion power = z;
    for (int order = 2; order < line.degree(); ++order) {
        power = power * z;
        RealBallMatrix right(rank_seen, 1);
        for (int r = 0; r < rank_seen; ++r) right(r, 0) = -put_into(seen.leading[r], x).coefficient(order);
        const auto step = solution(square, right);
        if (!step) return false;
        const RealBallMatrix move = across * *step;
        for (int i = 0; i < n; ++i)
            if (!move(i, 0).is_zero()) x[i] += Expansion(move(i, 0)) * power;
    }
    for (const Expansion& h : seen.rest) {
        const Expansion along = put_into(h, x);
        // The terms that the highest order of x contributes are not used.
        for (int k = 1; k < line.degree(); ++k) {
            const RealBall c = along.coefficient(k);
            if (c.is_zero()) continue;
            if (c.sign()) return true;
            break;
        }
    }
    return false;
}

}  // namespace alembert
