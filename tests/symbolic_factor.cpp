// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <random>

#include "algebra/notation/exponent_lattice.hpp"
#include "algebra/notation/factor.hpp"
#include "algebra/notation/irreducible.hpp"
#include "algebra/symbolic/bounded_factor.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "symbolic_cases.hpp"

namespace symbolic_factor {

using namespace alembert;
using GiNaC::ex;

namespace {

/// unit · monomial · Π sumᵉ
Polynomial product_of(const Factorization& factors) {
    Polynomial result = Polynomial::collect({{factors.monomial, factors.unit}});
    for (const auto& [sum, exponent] : factors.sums) result = result * power(sum, exponent);
    return result;
}

}  // namespace

TEST_CASE("factor: products of small sums come back as products, large ones stay whole, and all end soon") {
    const GiNaC::symbol x("x"), y("y"), z("z");
    const ex product = 3 * x * pow(x + y, 2) * (x - 2 * z);
    const ex small = factored(product.expand());
    CHECK(GiNaC::is_a<GiNaC::mul>(small));
    CHECK((small - product).expand().is_zero());
    CHECK(factored(sin(x) + 1).is_equal(sin(x) + 1));
    const ex large = pow(x, 60) + pow(y, 59) * z + pow(z, 61) * x + 1;
    CHECK(factored(large).is_equal(large));
    CHECK((factored(large * (x + y)) - large * (x + y)).expand().is_zero());
}

TEST_CASE(
    "factor: the quick proof of irreducibility holds for what GiNaC finds no factor of, and for no product") {
    test::Mechanics m;
    const ex a = m.parameter("a"), b = m.parameter("b"), c = m.parameter("c");
    const auto is_proved = [&](const ex& e) {
        const Polynomial polynomial = fourier(e.expand(), m.symbols).value().polynomial();
        const Atom atom = Polynomial(fourier(a, m.symbols).value().polynomial()).terms()[0].monomial[0].atom;
        return is_surely_irreducible(polynomial, atom, 1);
    };
    int proved = 0, irreducible = 0;
    std::mt19937_64 random(7);
    const auto number = [&] { return GiNaC::numeric(static_cast<long>(random() % 7) - 3); };
    const auto sum = [&](int degree) {
        ex result = number() * pow(b, 3) + number() * c * c + 1;
        result += pow(a, degree);
        for (int k = 1; k < degree; ++k) result += pow(a, k) * (number() * b + number() * c * c + number());
        return result;
    };
    for (int k = 0; k < 60; ++k) {
        const ex first = sum(2 + k % 3), second = sum(1 + k % 2);
        if (first.degree(a) < 1 || second.degree(a) < 1) continue;
        CAPTURE(first);
        CAPTURE(second);
        CHECK(!is_proved(first * second));
        CHECK(!is_proved((b + c + 1) * first));
        if (GiNaC::is_a<GiNaC::add>(GiNaC::factor(first.expand())) && first.degree(a) > 1) {
            ++irreducible;
            proved += is_proved(first) ? 1 : 0;
        }
    }
    MESSAGE(proved << " of " << irreducible << " irreducible sums are proved to be so");
    CHECK(irreducible > 20);
    CHECK(2 * proved > irreducible);
}

TEST_CASE("factor: sums with powers like a^3.1416 are their own factorization's product") {
    test::Mechanics m;
    const ex a = m.parameter("a"), b = m.parameter("b");
    const ex root = pow(a, GiNaC::numeric(3927, 1250));
    for (const ex& e : {root + a * a / 4, 1 + root + a * a, (a * a - b * b) * (root + 1),
                        2 * b * b + b * b * root * root + 1, a * a + 2 * a * b + b * b}) {
        CAPTURE(e);
        const Polynomial polynomial = fourier(e.expand(), m.symbols).value().polynomial();
        Factorizer factorizer;
        CHECK(product_of(factorizer(polynomial)) == polynomial);
    }
    const Polynomial square = fourier(a * a + 2 * a * b + b * b, m.symbols).value().polynomial();
    Factorizer factorizer;
    REQUIRE(factorizer(square).sums.size() == 1);
    CHECK(factorizer(square).sums[0].second == 2);
}

TEST_CASE("factor: a polynomial is searched in the fewest variables in which it can be written") {
    // k²S² − 2 k S w²J + w⁴J² − k²c²w² in k, S, w, J, c: of two products of powers
    const ExponentLattice lattice({{2, 2, 0, 0, 0}, {1, 1, 2, 1, 0}, {0, 0, 4, 2, 0}, {2, 0, 2, 0, 2}});
    CHECK(lattice.rank() == 2);
    for (const auto& row : lattice.reduced())
        for (const long exponent : row) CHECK(exponent >= 0);
    const auto whole = lattice.restored(lattice.reduced());
    CHECK(whole == std::vector<ExponentLattice::Exponents>{
                       {2, 2, 0, 0, 0}, {1, 1, 2, 1, 0}, {0, 0, 4, 2, 0}, {2, 0, 2, 0, 2}});
    test::Mechanics m;
    const ex k = m.parameter("k"), s = m.parameter("S"), w = m.parameter("w"), j = m.parameter("J"),
             c = m.parameter("c"), d = m.parameter("d");
    std::mt19937_64 random(11);
    const ex atoms[] = {k, s, w, j, c, d};
    const auto monomial = [&] {
        ex result = GiNaC::numeric(static_cast<long>(random() % 5) + 1);
        for (const ex& atom : atoms) result *= pow(atom, static_cast<long>(random() % 3));
        return result;
    };
    for (int n = 0; n < 60; ++n) {  // differences of squares
        const ex a = monomial(), b = monomial(), e = monomial();
        const ex product = ((a - b) * (a - b) - e * e).expand();
        if (product.is_zero()) continue;
        const Polynomial polynomial = fourier(product, m.symbols).value().polynomial();
        CAPTURE(product);
        Factorizer factorizer;
        const Factorization factors = factorizer(polynomial);
        CHECK(product_of(factors) == polynomial);
        int parts = 0;
        for (const auto& [sum, exponent] : factors.sums) parts += exponent;
        const bool is_in_pieces = ((a - b) * (a - b)).is_equal(e * e) || a.is_equal(b);
        CHECK((parts >= 2 || is_in_pieces));  // (a − b − e) (a − b + e)
    }
}

}  // namespace symbolic_factor
