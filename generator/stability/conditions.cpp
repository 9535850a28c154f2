// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/conditions.hpp"

#include <algorithm>

#include "algebra/symbolic/bounded_factor.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

ex coefficient(const SymbolicPolynomial& p, int k) {
    return k >= 0 && k < static_cast<int>(p.size()) ? p[static_cast<std::size_t>(k)] : ex(0);
}

SymbolicPolynomial monic(const SymbolicPolynomial& p) {
    SymbolicPolynomial result;
    for (const ex& c : p) result.push_back((c / p[0]).normal());
    return result;
}

/// An expression as factors with their powers; numbers are dropped except for their sign.
struct Factors {
    int sign = 1;
    std::vector<std::pair<ex, int>> list;
};

void split(const ex& e, int power, Factors& into) {
    if (GiNaC::is_a<GiNaC::mul>(e)) {
        for (const ex& part : e) split(part, power, into);
    } else if (GiNaC::is_a<GiNaC::numeric>(e)) {
        if (GiNaC::ex_to<GiNaC::numeric>(e).is_negative() && power % 2 != 0) into.sign = -into.sign;
    } else if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::integer)) {
        split(e.op(0), power * GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_int(), into);
    } else {
        into.list.emplace_back(e, power);
    }
}

/// An expression of the same sign without denominators, because n/d has the sign of n·d, and without squares of
/// parameters, which are taken to be other than zero. Nothing if it is positive.
ex simplest(const ex& e, const std::vector<ex>& positive) {
    const ex parts = e.normal().numer_denom();
    if (parts.op(0).is_zero()) return 0;
    Factors factors;
    split(factored(parts.op(0).expand()), 1, factors);
    Factors below;
    split(factored(parts.op(1).expand()), 1, below);
    ex result = factors.sign * below.sign;
    const auto is_positive = [&](const ex& factor) {
        return std::any_of(positive.begin(), positive.end(),
                           [&](const ex& p) { return (p - factor).expand().is_zero(); });
    };
    const auto is_negative = [&](const ex& factor) {
        return std::any_of(positive.begin(), positive.end(),
                           [&](const ex& p) { return (p + factor).expand().is_zero(); });
    };
    const auto take = [&](const ex& factor, int power, bool is_denominator) {
        const bool is_square = power % 2 == 0;
        if (is_positive(factor) || (is_square && (is_denominator || GiNaC::is_a<GiNaC::symbol>(factor)))) return;
        if (is_negative(factor)) {
            if (power % 2 != 0) result = -result;
            return;
        }
        result *= is_denominator || power % 2 != 0 ? factor : GiNaC::pow(factor, 2);
    };
    for (const auto& [factor, power] : factors.list) take(factor, power, false);
    for (const auto& [factor, power] : below.list) take(factor, power, true);
    return result;
}

/// Simplifies each condition with the help of those before it, the short ones first.
std::vector<ex> together(std::vector<ex> conditions, std::vector<ex> positive) {
    for (ex& c : conditions) c = simplest(c, positive);
    std::stable_sort(conditions.begin(), conditions.end(),
                     [](const ex& a, const ex& b) { return a.expand().nops() < b.expand().nops(); });
    std::vector<ex> result;
    for (const ex& c : conditions) {
        const ex shown = simplest(c, positive);
        if (GiNaC::is_a<GiNaC::numeric>(shown) && shown.info(GiNaC::info_flags::positive)) continue;
        positive.push_back(shown.expand());
        result.push_back(shown);
    }
    return result;
}

}  // namespace

std::vector<std::vector<ex>> routh_array(const SymbolicPolynomial& p) {
    const int n = static_cast<int>(p.size()) - 1;
    std::vector<std::vector<ex>> rows(2);
    for (int k = 0; k <= n; ++k) rows[static_cast<std::size_t>(k % 2)].push_back(p[static_cast<std::size_t>(k)]);
    if (n < 1) rows.pop_back();
    while (static_cast<int>(rows.size()) <= n) {
        const std::vector<ex>&above = rows[rows.size() - 2], &last = rows.back();
        if (last.empty() || last[0].is_zero()) break;
        std::vector<ex> next;
        for (std::size_t k = 0; k + 1 < above.size(); ++k) {
            const ex right = k + 1 < last.size() ? last[k + 1] : ex(0);
            next.push_back(((last[0] * above[k + 1] - above[0] * right) / last[0]).normal());
        }
        rows.push_back(std::move(next));
    }
    return rows;
}

std::vector<ex> hurwitz_determinants(const SymbolicPolynomial& polynomial) {
    const SymbolicPolynomial a = monic(polynomial);
    const int n = static_cast<int>(a.size()) - 1;
    std::vector<ex> result;
    for (int size = 1; size <= n; ++size) {
        GiNaC::matrix H(static_cast<unsigned>(size), static_cast<unsigned>(size));
        for (int i = 0; i < size; ++i)
            for (int j = 0; j < size; ++j)
                H(static_cast<unsigned>(i), static_cast<unsigned>(j)) = coefficient(a, 2 * j - i + 1);
        result.push_back(H.determinant().normal());
    }
    return result;
}

std::vector<ex> hurwitz_conditions(const SymbolicPolynomial& polynomial, const std::vector<ex>& positive) {
    const SymbolicPolynomial a = monic(polynomial);
    const int n = static_cast<int>(a.size()) - 1;
    std::vector<ex> conditions;
    for (int k = n; k >= 1; k -= 2) conditions.push_back(a[static_cast<std::size_t>(k)]);
    const std::vector<ex> determinants = hurwitz_determinants(a);
    for (int k = n - 1; k >= 1; k -= 2) conditions.push_back(determinants[static_cast<std::size_t>(k - 1)]);
    return together(std::move(conditions), positive);
}

std::vector<ex> real_frequency_conditions(const SymbolicPolynomial& polynomial, const std::vector<ex>& positive) {
    // e(s²) + s e'(s²): with e = Σ e_k u^(m−k) the odd coefficient beside e_k is (m − k) e_k.
    SymbolicPolynomial both;
    const int m = (static_cast<int>(polynomial.size()) - 1) / 2;
    for (int k = 0; k <= m; ++k) {
        const ex e = polynomial[static_cast<std::size_t>(2 * k)];
        both.push_back(e);
        if (k < m) both.push_back((m - k) * e);
    }
    return hurwitz_conditions(both, positive);
}

SymbolicPolynomial characteristic(const GiNaC::matrix& M, const GiNaC::matrix& D, const GiNaC::matrix& P,
                                  int zeros) {
    const GiNaC::symbol s("s");
    GiNaC::matrix sum(M.rows(), M.cols());
    for (unsigned i = 0; i < M.rows(); ++i)
        for (unsigned j = 0; j < M.cols(); ++j) sum(i, j) = M(i, j) * s * s + D(i, j) * s + P(i, j);
    const ex determinant = sum.determinant().expand();
    SymbolicPolynomial result;
    for (int k = determinant.degree(s); k >= zeros; --k) result.push_back(determinant.coeff(s, k));
    return result;
}

}  // namespace alembert
