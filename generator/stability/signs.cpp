// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/signs.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "alembert/base/dense.hpp"
#include "base/language/say.hpp"
#include "stability/spectrum.hpp"

namespace alembert {

namespace {

using Exponents = Monomials::Exponents;

/// The terms of one degree.
struct LeadingForm {
    int degree = 0;
    std::vector<std::pair<Exponents, RealBall>> terms;

    RealBall at(const std::vector<int>& x) const {
        RealBall sum = 0;
        for (const auto& [exponents, c] : terms) {
            RealBall term = c;
            for (std::size_t v = 0; v < x.size(); ++v)
                for (int e = 0; e < exponents[v]; ++e) term *= RealBall(x[v]);
            sum += term;
        }
        return sum;
    }
};

std::optional<LeadingForm> leading_form(const Expansion& f, const Monomials& monomials) {
    LeadingForm form;
    for (int k = 1; k < monomials.size(); ++k) {
        if (!form.terms.empty() && monomials.degree_of(k) > form.degree) break;
        const RealBall c = f.coefficient(k);
        if (c.is_zero()) continue;
        form.degree = monomials.degree_of(k);
        form.terms.emplace_back(monomials.exponents(k), c);
    }
    if (form.terms.empty()) return {};
    return form;
}

/// The signs that the form has at points with integer coordinates. Each of them is a sign of the function
/// arbitrarily near the point.
SignNear at_points(const LeadingForm& form, int n) {
    SignNear found;
    const auto look = [&](const std::vector<int>& x) {
        const std::optional<int> sign = form.at(x).sign();
        if (!sign || *sign == 0) return;
        (*sign > 0 ? found.positive : found.negative) = true;
        if (form.degree % 2 == 1) found.positive = found.negative = true;
    };
    std::vector<int> x(static_cast<std::size_t>(n), 0);
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j <= i; ++j)
            for (const int second : {1, -1, 3, -3}) {
                x[j] = second;
                x[i] = 1;
                look(x);
                x[i] = x[j] = 0;
            }
    std::mt19937 random(11);
    for (int k = 0; k < 300 && !(found.positive && found.negative); ++k) {
        for (int& one : x) one = static_cast<int>(random() % 9) - 4;
        look(x);
    }
    return found;
}

/// Is the form positive for x ≠ 0 because it is a sum of squares, zᵀ G z with a positive definite G, where z are
/// all monomials of half the degree?
bool is_sum_of_squares(const LeadingForm& form, int sign, int n) {
    const Monomials half(n, form.degree / 2);
    std::vector<int> basis;
    for (int k = 0; k < half.size(); ++k)
        if (half.degree_of(k) == half.degree()) basis.push_back(k);
    const int size = static_cast<int>(basis.size());
    if (size > 20) return false;
    std::map<Exponents, std::vector<std::pair<int, int>>> pairs;
    for (int i = 0; i < size; ++i)
        for (int j = 0; j <= i; ++j) {
            Exponents sum = half.exponents(basis[i]);
            for (int v = 0; v < n; ++v) sum[v] += half.exponents(basis[j])[v];
            pairs[sum].emplace_back(i, j);
        }
    RealBallMatrix G(size, size);
    std::vector<RealBallMatrix> more;  // matrices that may be added to G without a change of zᵀ G z
    const auto add = [](RealBallMatrix& m, const std::pair<int, int>& at, const RealBall& share) {
        const auto& [i, j] = at;
        m(i, j) += i == j ? share : share * RealBall(Rational(1) / 2);
        if (i != j) m(j, i) = m(i, j);
    };
    for (const auto& [exponents, c] : form.terms) {
        const std::vector<std::pair<int, int>>& at = pairs.at(exponents);
        for (const std::pair<int, int>& one : at)
            add(G, one, RealBall(sign) * c * RealBall(Rational(1) / static_cast<int>(at.size())));
    }
    for (const auto& [exponents, at] : pairs)
        for (std::size_t k = 1; k < at.size(); ++k) {
            more.emplace_back(size, size);
            add(more.back(), at[0], 1);
            add(more.back(), at[k], -1);
        }
    const auto s = definite_combination(G, more);
    if (!s) return false;
    for (std::size_t k = 0; k < s->size(); ++k)
        G = G + RealBall(Rational(cln::rational(cln::cl_DF((*s)[k])))) * more[k];
    const auto signs = inertia(G);
    return signs && signs->positive == size;
}

SignNear sign_of_form(const LeadingForm& form, int n) {
    if (n == 2) {
        RealBallVector c(static_cast<std::size_t>(form.degree) + 1, RealBall(0));
        for (const auto& [exponents, value] : form.terms) c[static_cast<std::size_t>(exponents[1])] = value;
        return sign_of_binary_form(c);
    }
    SignNear found = at_points(form, n);
    if (found.positive == found.negative) return found;
    found.definite = n == 1 || is_sum_of_squares(form, found.positive ? 1 : -1, n);
    return found;
}

RealBallMatrix transformed(const RealBallMatrix& Q, const RealBallMatrix& by) {
    return transposed(by) * Q * by;
}

/// Unit vectors that complete the columns of Z to a basis.
RealBallMatrix complement(const RealBallMatrix& Z) {
    const int n = Z.rows;
    RealBallMatrix all = Z;
    for (int i = 0; i < n && all.columns < n; ++i) {
        RealBallMatrix longer(n, all.columns + 1);
        for (int r = 0; r < n; ++r) {
            for (int c = 0; c < all.columns; ++c) longer(r, c) = all(r, c);
            longer(r, all.columns) = r == i ? 1 : 0;
        }
        if (rank(longer) == longer.columns) all = longer;
    }
    if (all.columns < n) throw NotAnalytic(say("a kernel is not certain"));
    std::vector<int> rows, columns;
    for (int i = 0; i < n; ++i) rows.push_back(i);
    for (int c = Z.columns; c < n; ++c) columns.push_back(c);
    return all.part(rows, columns);
}

/// W(z) = f(Z z + Y y(z)), where f_y = 0 on y(z).
SignNear sign_of_rest(const Expansion& f, const Monomials& monomials, const RealBallMatrix& Q,
                      const RealBallMatrix& Z) {
    const int n = Q.rows, nz = Z.columns;
    const RealBallMatrix Y = complement(Z);
    std::vector<Expansion> slopes;
    for (int i = 0; i < n; ++i) slopes.push_back(derivative(f, i));
    const Monomials rest(nz, monomials.degree());
    std::vector<Expansion> x(static_cast<std::size_t>(n), Expansion(0));
    for (int i = 0; i < n; ++i)
        for (int c = 0; c < nz; ++c) x[i] += Expansion(Z(i, c)) * Expansion::variable(rest, c, 0);
    const RealBallMatrix Q_yy = transformed(Q, Y);
    for (int order = 2; order < monomials.degree(); ++order) {
        // f_y along the y found so far: its terms of this degree give the next terms of y.
        std::vector<Expansion> slope;
        for (int i = 0; i < n; ++i) slope.push_back(put_into(slopes[i], x));
        for (int k = 0; k < rest.size(); ++k) {
            if (rest.degree_of(k) != order) continue;
            RealBallMatrix right(n, 1);
            for (int i = 0; i < n; ++i) right(i, 0) = -slope[i].coefficient(k);
            const auto step = solution(Q_yy, transposed(Y) * right);
            if (!step) return {};
            const RealBallMatrix move = Y * *step;
            Expansion term(1);
            for (int v = 0; v < nz; ++v)
                for (int e = 0; e < rest.exponents(k)[v]; ++e) term *= Expansion::variable(rest, v, 0);
            for (int i = 0; i < n; ++i)
                if (!move(i, 0).is_zero()) x[i] += Expansion(move(i, 0)) * term;
        }
    }
    return sign_near(put_into(f, x), rest);
}

}  // namespace

RealBallMatrix hessian(const Expansion& f, const Monomials& monomials) {
    const int n = monomials.variables();
    RealBallMatrix result(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j) {
            Exponents exponents(static_cast<std::size_t>(n), 0);
            ++exponents[i];
            ++exponents[j];
            const RealBall c = f.coefficient(monomials.index(exponents));
            result(i, j) = result(j, i) = i == j ? c + c : c;
        }
    return result;
}

SignNear sign_of_binary_form(const RealBallVector& c) {
    LeadingForm form{.degree = static_cast<int>(c.size()) - 1, .terms = {}};
    for (int k = 0; k <= form.degree; ++k)
        if (!c[k].is_zero()) form.terms.push_back({{form.degree - k, k}, c[k]});
    SignNear result = at_points(form, 2);
    for (const int y : {-64, -16, -4, -2, -1, 1, 2, 4, 16, 64})
        for (const int x : {0, 1, 3})
            if (const auto sign = form.at({x, y}).sign(); sign && *sign != 0)
                (*sign > 0 ? result.positive : result.negative) = true;
    if (form.degree % 2 == 1) result.positive = result.negative = result.positive || result.negative;
    if (result.positive == result.negative || c.front().may_be_zero() || c.back().may_be_zero()) return result;
    // If there is no real root, the form has the sign of x^d.
    result.definite = true;
    for (const RootOf& root : roots_of(c))
        result.definite = result.definite && std::abs(root.value.imag()) > root.radius;
    return result;
}

SignNear sign_near(const Expansion& f, const Monomials& monomials) {
    const int n = monomials.variables();
    const auto form = leading_form(f, monomials);
    if (!form) return {};
    if (form->degree != 2) return sign_of_form(*form, n);
    const RealBallMatrix Q = hessian(f, monomials);
    const auto signs = inertia(Q);
    if (!signs) return at_points(*form, n);
    SignNear result{.positive = signs->positive > 0, .negative = signs->negative > 0};
    result.definite = result.positive != result.negative && signs->zero == 0;
    if (result.definite || result.positive == result.negative) return result;
    const auto Z = null_space(Q);
    if (!Z || Z->columns != signs->zero) return result;
    const SignNear rest = sign_of_rest(f, monomials, Q, *Z);
    return {.positive = result.positive || rest.positive,
            .negative = result.negative || rest.negative,
            .definite = rest.definite && rest.is(result.positive ? 1 : -1)};
}

/// The least eigenvalue is concave in s; it is increased along one component of s after the other.
std::optional<std::vector<double>> definite_combination(const RealBallMatrix& Q0,
                                                        const std::vector<RealBallMatrix>& more) {
    const auto numbers = [](const RealBallMatrix& m) {
        Eigen::MatrixXd result(m.rows, m.columns);
        for (int i = 0; i < m.rows; ++i)
            for (int j = 0; j < m.columns; ++j) result(i, j) = m(i, j).number();
        return result;
    };
    const Eigen::MatrixXd base = numbers(Q0);
    std::vector<Eigen::MatrixXd> others;
    for (const RealBallMatrix& m : more) others.push_back(numbers(m));
    std::vector<double> s(more.size(), 0.0);
    const auto least = [&] {
        Eigen::MatrixXd sum = base;
        for (std::size_t k = 0; k < s.size(); ++k) sum += s[k] * others[k];
        return sum.size() == 0 ? 1.0 : eigenpairs(sum).values[0];
    };
    for (int round = 0; round < (more.size() > 1 ? 8 : 1) && least() <= 0; ++round)
        for (std::size_t k = 0; k < s.size(); ++k) {
            const double scale = 1e4 * (base.norm() + 1e-300) / (others[k].norm() + 1e-300);
            double low = s[k] - scale, high = s[k] + scale;
            const auto at = [&](double x) {
                s[k] = x;
                return least();
            };
            for (int cut = 0; cut < 120; ++cut) {
                const double left = low + (high - low) * 0.382, right = low + (high - low) * 0.618;
                (at(left) < at(right) ? low : high) = at(left) < at(right) ? left : right;
            }
            s[k] = (low + high) / 2;
        }
    if (!(least() > 0)) return {};
    return s;
}

}  // namespace alembert
