// SPDX-License-Identifier: MIT
// One elimination and one polynomial over several fields: results are put into what they solve.
#include <doctest/doctest.h>

#include <random>

#include "analysis/exact/real_values.hpp"
#include "program/prime_polynomial.hpp"
#include "program/reduce_rows.hpp"
#include "program/univariate.hpp"
#include "stability/interval/matrix.hpp"

namespace fields {

using namespace alembert;
using GiNaC::numeric;

namespace {

constexpr std::size_t n = 5;

/// Whole numbers in −4 … 4; the last column is the right side.
std::vector<std::vector<int>> system_of(std::mt19937& random) {
    std::vector<std::vector<int>> rows(n, std::vector<int>(n + 1));
    for (auto& row : rows)
        for (int& entry : row) entry = static_cast<int>(random() % 9) - 4;
    return rows;
}

template <typename Number>
RowsOf<Number> in(const std::vector<std::vector<int>>& rows) {
    RowsOf<Number> result;
    for (const auto& row : rows) result.emplace_back(row.begin(), row.end());
    return result;
}

}  // namespace

TEST_CASE("fields: one elimination solves systems of primes, fractions and numbers with bounds") {
    const unsigned seed = 4711;
    CAPTURE(seed);
    std::mt19937 random(seed);
    int regular = 0;
    for (int k = 0; k < 40; ++k) {
        std::vector<std::vector<int>> system = system_of(random);
        if (k % 4 == 3)  // of lower rank
            for (std::size_t c = 0; c < n; ++c) system[4][c] = system[0][c] - 2 * system[2][c];
        auto primes = in<Prime>(system);
        const int rank = reduce_rows(primes, n);
        const auto fractions = solve_rows(in<numeric>(system), n);
        RealBallMatrix A(n, n), b(n, 1);
        for (int i = 0; i < A.rows; ++i) {
            for (int j = 0; j < A.columns; ++j)
                A(i, j) = system[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
            b(i, 0) = system[static_cast<std::size_t>(i)][n];
        }
        CHECK(alembert::rank(A) == rank);
        const auto certain = solution(A, b);
        CHECK(fractions.has_value() == (rank == static_cast<int>(n)));
        CHECK(certain.has_value() == fractions.has_value());
        if (!fractions || !certain) continue;
        ++regular;
        for (std::size_t i = 0; i < n; ++i) {
            const cln::cl_RA x = cln::the<cln::cl_RA>((*fractions)[i].to_cl_N());
            CHECK(primes[i][n] == *Prime::from(x));
            CHECK((*certain)(static_cast<int>(i), 0).rational() == x);
            numeric residual = -numeric(system[i][n]);
            for (std::size_t j = 0; j < n; ++j) residual += numeric(system[i][j]) * (*fractions)[j];
            CHECK(residual.is_zero());
        }
    }
    CHECK(regular >= 20);
}

TEST_CASE("fields: dependent rows of primes leave zeros, and the rank counts columns that are asked for alone") {
    RowsOf<Prime> rows{{0, 2, 4, 1}, {0, 1, 2, 3}, {0, 0, 0, 7}};
    CHECK(reduce_rows(rows, 3) == 1);
    CHECK(rows[0] == std::vector<Prime>{0, 1, 2, Prime(2).inverse()});
    CHECK(rows[1][1].is_zero());
    CHECK(rows[2] == std::vector<Prime>{0, 0, 0, 7});
}

TEST_CASE("fields: polynomials over primes and over fractions divide, interpolate and have the same resultant") {
    const Univariate<Rational> f{6, -5, -2, 1}, g{-3, 1};  // (x − 1)(x + 2)(x − 3)
    const auto [quotient, rest] = univariate::divided(f, g);
    CHECK(quotient == Univariate<Rational>{-2, 1, 1});
    CHECK(rest.empty());
    CHECK(univariate::remainder(f, Univariate<Rational>{-2, 1}) == Univariate<Rational>{-4});
    // (x − 3)² (2x + 1) has the double root 3.
    const Univariate<Rational> h{9, 12, -11, 2};
    CHECK(univariate::divisor(h, univariate::derivative(h)) == Univariate<Rational>{-3, 1});
    CHECK(value_at(h, Rational(3)) == 0);
    CHECK(value_at(h, Rational(1)) == 12);
    std::vector<Rational> x{0, 1, -1, 2}, y;
    for (const Rational& at : x) y.push_back(value_at(h, at));
    CHECK(interpolate(x, y) == h);
    // Π over the roots of f, times the leading coefficient: h(1) h(−2) h(3) = 0, and with x + 1 instead f(−1).
    CHECK(resultant(f, h) == 0);
    CHECK(resultant(f, Univariate<Rational>{1, 1}) == -value_at(f, Rational(-1)));
    const PrimePolynomial modulo{6, -5, -2, 1}, other{1, 1};
    CHECK(resultant(modulo, other) == -value_at(modulo, Prime(-1)));
    CHECK(roots(modulo, 1).size() == 3);
    for (const Prime root : roots(modulo, 1)) CHECK(value_at(modulo, root).is_zero());
    CHECK(univariate::divisor(modulo, PrimePolynomial{-3, 1}) == PrimePolynomial{-3, 1});
}

TEST_CASE(
    "modulo the prime: inverses multiply to one, and roots of quadratics are those of cubics that hold them") {
    const ModularPoint point{.seed = 5};
    CHECK(Prime(0).inverse() == Prime(0));
    for (const std::int64_t n : {1L, 2L, -1L, -2L, 3L, 1234567890123456789L})
        CHECK(Prime(n) * Prime(n).inverse() == Prime(1));
    for (std::uint64_t k = 0; k < 50; ++k) {
        const Prime a = point.random(1, k), b = point.random(2, k), c = point.random(3, k), d = a + b * Prime::i();
        CHECK(a * a.inverse() == Prime(1));
        CHECK(a.inverse() == a.power(Prime::modulus - 2));
        CHECK(d * d.inverse() == Prime(1));
        CHECK(roots({a * b * c, -(a + b) * c, c}, k) == std::vector<Prime>{std::min(a, b), std::max(a, b)});
        CHECK(roots({a * a * c, -2 * a * c, c}, k) == std::vector<Prime>{a});
        // Random coefficients: half of these polynomials have no root.
        const Prime other = point.random(4, k);
        const std::vector<Prime> two = roots({a, b, c}, k);
        std::vector<Prime> three = roots({-a * other, a - b * other, b - c * other, c}, k);
        std::erase(three, other);
        CHECK(two == three);
        for (const Prime root : two) CHECK(value_at(PrimePolynomial{a, b, c}, root).is_zero());
        CHECK(two.empty() == !(b * b - 4 * a * c).is_square());
    }
    CHECK(roots({1, 0, 1}, 1).empty());  // i is not plain
}

}  // namespace fields
