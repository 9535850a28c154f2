// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/symbolic/fourier.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "allocations.hpp"
#include "symbolic_cases.hpp"

namespace symbolic_fourier {

namespace {

using namespace alembert;
using GiNaC::cos;
using GiNaC::ex;
using GiNaC::Pi;
using GiNaC::pow;
using GiNaC::sin;
using GiNaC::sqrt;
using GiNaC::symbol;

struct Plane {
    Symbols symbols;
    symbol t = symbols.declare("t", SymbolInfo::Kind::time);
    symbol a = symbols.declare("a", SymbolInfo::Kind::parameter);
    symbol b = symbols.declare("b", SymbolInfo::Kind::parameter);
    symbol n = symbols.declare("n", SymbolInfo::Kind::parameter);
    symbol x = symbols.declare("x", SymbolInfo::Kind::coordinate, 0);
    symbol y = symbols.declare("y", SymbolInfo::Kind::coordinate, 1);

    Fourier form(const ex& e) const { return fourier(e, symbols).value(); }
    bool vanishes(const ex& e) const { return is_zero(form(e)); }
    /// Zero terms without clearing denominators.
    bool is_empty(const ex& e) const { return form(e).size() == 0; }
};

TEST_CASE_FIXTURE(Plane, "fourier: identities of trigonometry have no terms left") {
    CHECK(is_empty(pow(sin(x), 2) + pow(cos(x), 2) - 1));
    CHECK(is_empty(sin(x + y) - sin(x) * cos(y) - cos(x) * sin(y)));
    CHECK(is_empty(cos(x - y) - cos(x) * cos(y) - sin(x) * sin(y)));
    CHECK(is_empty(sin(5 * x) - 16 * pow(sin(x), 5) + 20 * pow(sin(x), 3) - 5 * sin(x)));
    CHECK(is_empty(cos(x / 2) * cos(x / 2) - (1 + cos(x)) / 2));
    CHECK(is_empty(sin(a * t + b) * cos(a * t + b) - sin(2 * a * t + 2 * b) / 2));
    CHECK_FALSE(vanishes(pow(sin(x), 2) + pow(cos(y), 2) - 1));
}

TEST_CASE_FIXTURE(Plane, "fourier: multiples of a right angle shift sines into cosines") {
    CHECK(is_empty(sin(x + Pi / 2) - cos(x)));
    CHECK(is_empty(cos(x - 3 * Pi / 2) + sin(x)));
    CHECK(is_empty(sin(x + 7 * Pi) + sin(x)));
    CHECK(is_empty(cos(x + Pi / 3) - sin(Pi / 6 - x)));
    CHECK(vanishes(cos(x + Pi / 4) * sqrt(ex(2)) - cos(x) + sin(x)));
    CHECK(vanishes(sin(x + Pi / 3) * 2 - sin(x) - sqrt(ex(3)) * cos(x)));
}

TEST_CASE_FIXTURE(Plane, "fourier: roots and quotients combine and cancel") {
    const ex r = sqrt(x * x + y * y);
    CHECK(is_empty(r * r - x * x - y * y));
    CHECK(is_empty(pow(r, 3) - (x * x + y * y) * r));
    CHECK(vanishes(x * x / pow(r, 3) + y * y / pow(r, 3) - 1 / r));
    CHECK(vanishes(1 / (a - b) - (a + b) / (a * a - b * b)));
    CHECK(vanishes(1 / (1 + 1 / a) - a / (a + 1)));
    CHECK(vanishes(pow(cos(x), 2) / sin(x) + sin(x) - 1 / sin(x)));
    CHECK(vanishes(1 / (a * pow(sin(x), 2) + b * pow(cos(x), 2)) - 2 / (a + b + (b - a) * cos(2 * x))));
    CHECK(vanishes(GiNaC::tan(x) * cos(x) - sin(x)));
    CHECK(vanishes(1 + pow(GiNaC::tan(x), 2) - 1 / pow(cos(x), 2)));
    CHECK(is_empty(sqrt(4 * x * x + 4 * y * y) - 2 * r));
    CHECK(is_empty(pow(1 / sqrt(4 + 2 * x * x), 2) - 1 / (4 + 2 * x * x)));
    CHECK(is_empty(sqrt(1 / ex(2)) - 1 / sqrt(ex(2))));
    CHECK(is_empty(sqrt(2 + pow(1 / sqrt(2 + pow(cos(x), 2)), 2)) - sqrt(2 + 1 / (2 + pow(cos(x), 2)))));
    CHECK_FALSE(vanishes(sqrt(x * x) - x));
}

TEST_CASE_FIXTURE(Plane, "fourier: powers with symbols in the exponent and exponentials split into factors") {
    CHECK(is_empty(GiNaC::exp(x + 2 * y) - GiNaC::exp(x) * pow(GiNaC::exp(y), 2)));
    CHECK(is_empty(GiNaC::exp(a * x) * GiNaC::exp(-a * x) - 1));
    CHECK(is_empty(pow(x, n - 1) * x - pow(x, n)));
    CHECK(is_empty(pow(x, 2 * n) - pow(x, n) * pow(x, n)));
    CHECK(is_empty(pow(GiNaC::abs(x), 2) - x * x));
    CHECK(is_empty(GiNaC::atan(x - y) + GiNaC::atan(y - x)));
}

TEST_CASE_FIXTURE(Plane, "fourier: a coefficient is collected") {
    const Fourier f = form(a * x * cos(y) + x * sin(y) + b * x * x);
    CHECK(is_zero(coefficient(f, x) - form(a * cos(y) + sin(y))));
    CHECK(is_zero(coefficient(f, x, 2) - form(b)));
    CHECK(coefficient(f, t).size() == 0);
}

TEST_CASE_FIXTURE(Plane, "fourier: division by an expression that is identically zero is refused") {
    CHECK_THROWS_AS(form(1 / (pow(sin(x), 2) + pow(cos(x), 2) - 1)), std::domain_error);
    CHECK_THROWS_AS(form(symbol("stranger")), std::out_of_range);
}

TEST_CASE("fourier: the derivation of every mechanism is unchanged by conversion and back") {
    for (const test::NamedCase& entry : test::mechanisms()) {
        CAPTURE(entry.name);
        test::Mechanics m;
        entry.build(m);
        for (std::size_t i = 0; i < m.q.size(); ++i) {
            const ex residual = m.residual(static_cast<int>(i));
            const Fourier f = fourier(residual, m.symbols).value();
            const Fourier back = fourier(expression(f) - residual, m.symbols).value();
            CHECK(is_zero(back));
        }
    }
}

// Terms are allocated, so that what was made is known without a clock. The product has more than 2ⁿ terms, and its
// 60th power far more. In all at most 50 times the budget is made, with a few allocations for each term.
TEST_CASE("fourier: a product of many angles is given up before more terms are made than the budget allows") {
    constexpr std::size_t budget = 20000;
    for (const int exponent : {1, 60}) {
        CAPTURE(exponent);
        const auto made_for = [&](int angles) {
            Symbols symbols;
            ex product = 1;
            for (int i = 0; i < angles; ++i)
                product *= 1 + cos(symbols.declare(fmt::format("q{}", i), SymbolInfo::Kind::coordinate, i));
            return test::allocations_of(
                [&] { CHECK_FALSE(fourier(pow(product, exponent), symbols, budget).has_value()); });
        };
        const std::size_t few = made_for(20), many = made_for(40);
        CHECK(many < 10 * 50 * budget);
        CHECK(many < 3 * few);
    }
}

TEST_CASE_FIXTURE(Plane, "fourier: a budget that ends inside a quotient gives nothing, and no division by zero") {
    const ex inner = a + b / (a + cos(x) + sin(y)), e = pow(x + y, 3) / (n * inner + 1 / (b + inner)) + 1 / inner;
    const Fourier whole = form(e);
    bool refused = false, given = false;
    for (std::size_t budget = 1; budget < 20000; budget += 1 + budget / 20) {
        CAPTURE(budget);
        const auto f = fourier(e, symbols, budget);
        (f ? given : refused) = true;
        if (f) CHECK((*f - whole).size() == 0);
    }
    CHECK(refused);
    CHECK(given);
}

TEST_CASE("fourier: a deeply shared expression is walked once") {
    Symbols symbols;
    const symbol x = symbols.declare("x", SymbolInfo::Kind::coordinate);
    ex shared = x;
    for (int level = 0; level < 60; ++level) shared = GiNaC::log(2 + shared * shared);
    // The tree of `shared` has 2^60 leaves.
    CHECK(fourier(shared, symbols).value().size() == 1);
}

}  // namespace

}  // namespace symbolic_fourier
