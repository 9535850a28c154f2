// SPDX-License-Identifier: MIT
#include "alembert/ode/radau_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace alembert {

namespace {

using Real = long double;
using Complex = std::complex<Real>;

/// A square matrix, row by row.
template <typename T>
struct Square {
    int n;
    std::vector<T> entries = std::vector<T>(static_cast<std::size_t>(n * n));
    T& operator()(int i, int j) { return entries[static_cast<std::size_t>(i * n + j)]; }
    const T& operator()(int i, int j) const { return entries[static_cast<std::size_t>(i * n + j)]; }
};

/// The inverse by Gauss-Jordan elimination with the largest pivot of each column.
template <typename T>
Square<T> inverted(Square<T> a) {
    Square<T> result{a.n};
    for (int i = 0; i < a.n; ++i) result(i, i) = 1;
    for (int c = 0; c < a.n; ++c) {
        int pivot = c;
        for (int r = c + 1; r < a.n; ++r)
            if (std::abs(a(r, c)) > std::abs(a(pivot, c))) pivot = r;
        const T scale = T(1) / a(pivot, c);
        for (int j = 0; j < a.n; ++j) {
            std::swap(a(c, j), a(pivot, j));
            std::swap(result(c, j), result(pivot, j));
            a(c, j) *= scale;
            result(c, j) *= scale;
        }
        for (int r = 0; r < a.n; ++r) {
            const T factor = a(r, c);
            if (r == c) continue;
            for (int j = 0; j < a.n; ++j) a(r, j) -= factor * a(c, j), result(r, j) -= factor * result(c, j);
        }
    }
    return result;
}

Square<Real> product(const Square<Real>& a, const Square<Real>& b) {
    Square<Real> result{a.n};
    for (int i = 0; i < a.n; ++i)
        for (int j = 0; j < a.n; ++j)
            for (int k = 0; k < a.n; ++k) result(i, j) += a(i, k) * b(k, j);
    return result;
}

Eigen::MatrixXd rounded(const Square<Real>& a) {
    Eigen::MatrixXd result(a.n, a.n);
    for (int i = 0; i < a.n; ++i)
        for (int j = 0; j < a.n; ++j) result(i, j) = static_cast<double>(a(i, j));
    return result;
}

/// The coefficients of a polynomial, lowest first.
using Polynomial = std::vector<Real>;

Polynomial derivative(const Polynomial& p) {
    Polynomial result;
    for (std::size_t k = 1; k < p.size(); ++k) result.push_back(p[k] * static_cast<Real>(k));
    return result;
}

template <typename T>
T value(const Polynomial& p, const T& x) {
    T sum = 0;
    for (std::size_t k = p.size(); k-- > 0;) sum = sum * x + p[k];
    return sum;
}

/// Σ_j s! (2s−1−j)! / ((2s−1)! j! (s−j)!) (−z)^j.
Polynomial pade_denominator(int s) {
    Polynomial q{1};
    for (int j = 0; j < s; ++j)
        q.push_back(-q.back() * static_cast<Real>(s - j) / static_cast<Real>((j + 1) * (2 * s - 1 - j)));
    return q;
}

/// For odd s: the real eigenvalue first, then one of each complex pair, that with positive imaginary part.
std::vector<Complex> eigenvalues(int s) {
    const Polynomial q = pade_denominator(s), slope = derivative(q);
    std::vector<Complex> known, all;
    while (static_cast<int>(all.size()) < s) {
        Complex x = all.empty() ? Complex(s) : Complex(s, s);
        for (int round = 0; round < 500; ++round) {
            Complex poles = 0;
            for (const Complex& zero : all) poles += Real(1) / (x - zero);
            const Complex at = value(q, x), step = at / (value(slope, x) - at * poles);
            x -= step;
            if (std::abs(step) < 1e-18L * std::abs(x)) break;
        }
        if (x.imag() < 0) x = std::conj(x);
        known.push_back(all.empty() ? Complex(x.real()) : x);
        all.push_back(known.back());
        if (all.size() > 1) all.push_back(std::conj(x));
    }
    return known;
}

/// P_s − P_{s−1} and its derivative at x in [−1, 1].
std::pair<Real, Real> legendre_difference(int s, Real x) {
    Real before = 1, value = x, slope_before = 0, slope = 1;  // P₀ and P₁
    for (int k = 1; k < s; ++k) {
        const Real next = ((2 * k + 1) * x * value - k * before) / (k + 1);
        const Real slope_next = slope_before + (2 * k + 1) * value;
        before = std::exchange(value, next);
        slope_before = std::exchange(slope, slope_next);
    }
    return {value - before, slope - slope_before};
}

/// The nodes in ]0, 1], ascending.
std::vector<Real> nodes(int s) {
    std::vector<Real> known{1};
    for (int k = 1; k < s; ++k) {
        Real x = -1 + Real(0.01);
        for (int round = 0; round < 200; ++round) {
            const auto [value, slope] = legendre_difference(s, x);
            Real poles = 0;
            for (const Real zero : known) poles += 1 / (x - zero);
            const Real step = value / (slope - value * poles);
            x -= step;
            if (std::abs(step) < 1e-19L) break;
        }
        known.push_back(x);
    }
    std::sort(known.begin(), known.end());
    for (Real& x : known) x = (1 + x) / 2;
    return known;
}

RadauTable made(int s) {
    const std::vector<Real> c = nodes(s);
    const auto at = [&](int i) { return c[static_cast<std::size_t>(i)]; };
    Square<Real> powers{s}, integrals{s}, shifted{s};
    for (int k = 0; k < s; ++k)
        for (int i = 0; i < s; ++i) {
            powers(i, k) = std::pow(at(i), static_cast<Real>(k));
            shifted(i, k) = std::pow(at(i), static_cast<Real>(k + 1));
            integrals(i, k) = shifted(i, k) / static_cast<Real>(k + 1);
        }
    const Square<Real> inverse = product(powers, inverted(integrals));
    const std::vector<Complex> mu = eigenvalues(s);

    // The columns of V and the rows of V⁻¹: that of λ, then one for each pair.
    std::vector<Polynomial> derivatives{{1}};
    for (const Real node : c) {  // M, one factor after the other
        Polynomial& M = derivatives[0];
        M.insert(M.begin(), 0);
        for (std::size_t k = 0; k + 1 < M.size(); ++k) M[k] -= node * M[k + 1];
    }
    for (int j = 1; j <= s; ++j) derivatives.push_back(derivative(derivatives.back()));
    Square<Complex> V{s};
    for (int k = 0; k < s; ++k) {
        const Complex pole = k == 0       ? mu[0]
                             : k % 2 == 1 ? mu[static_cast<std::size_t>((k + 1) / 2)]
                                          : std::conj(mu[static_cast<std::size_t>(k / 2)]);
        for (int i = 0; i < s; ++i) {
            Complex weight = 1;
            for (int j = 1; j <= s; ++j) {
                weight /= pole;
                V(i, k) += weight * value(derivatives[static_cast<std::size_t>(j)], at(i));
            }
        }
        const Complex last = V(s - 1, k);
        for (int i = 0; i < s; ++i) V(i, k) /= last;
    }
    const Square<Complex> back = inverted(V);
    RadauTable table;
    table.stages = s;
    table.c.resize(s);
    for (int i = 0; i < s; ++i) table.c[i] = static_cast<double>(at(i));
    table.c[s - 1] = 1;
    table.inverse = rounded(inverse);
    table.to_polynomial = rounded(inverted(shifted));
    table.lambda = static_cast<double>(mu[0].real());
    table.decoupling.resize(s, s);
    table.coupling.resize(s, s);
    for (int i = 0; i < s; ++i) {
        table.decoupling(0, i) = static_cast<double>(back(0, i).real());
        table.coupling(i, 0) = static_cast<double>(V(i, 0).real());
        for (int k = 1; k < s; k += 2) {
            table.decoupling(k, i) = static_cast<double>(back(k, i).real());
            table.decoupling(k + 1, i) = static_cast<double>(back(k, i).imag());
            table.coupling(i, k) = static_cast<double>(2 * V(i, k).real());
            table.coupling(i, k + 1) = static_cast<double>(-2 * V(i, k).imag());
        }
    }
    for (int k = 1; k < s; k += 2) table.mu.emplace_back(mu[static_cast<std::size_t>((k + 1) / 2)]);
    // The weights follow from Σ b̂_i c_i^k = 1/(k+1), minus γ₀ for k = 0; h f_i = Σ (A⁻¹)_ij Z_j, and the end is
    // Z_s.
    const Square<Real> weights = inverted(powers);
    table.e.resize(s);
    for (int i = 0; i < s; ++i) {
        Real sum = i == s - 1 ? -1 : 0;
        for (int j = 0; j < s; ++j)
            for (int k = 0; k < s; ++k)
                sum += inverse(j, i) * weights(k, j) *
                       (1 / static_cast<Real>(k + 1) - (k == 0 ? 1 / mu[0].real() : 0));
        table.e[i] = static_cast<double>(sum);
    }
    return table;
}

}  // namespace

const RadauTable& radau_table(int stages) {
    static const std::array<RadauTable, 3> tables = {made(3), made(5), made(7)};
    return tables[static_cast<std::size_t>((stages - 3) / 2)];
}

}  // namespace alembert
