// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "algebra/symbolic/functions.hpp"
#include "algebra/symbolic/intermediates.hpp"

namespace generator_intermediates {

using namespace alembert;
using GiNaC::ex;

namespace {

struct Fixture {
    Symbols symbols;
    Intermediates z{symbols};
    GiNaC::symbol x = symbols.declare("x", SymbolInfo::Kind::coordinate, 0);
    GiNaC::symbol y = symbols.declare("y", SymbolInfo::Kind::coordinate, 1);
    GiNaC::symbol a = symbols.declare("a", SymbolInfo::Kind::parameter, 0);

    double at(const ex& e, double x_value, double y_value) {
        const ex value = z.expand(e).subs(GiNaC::lst{x == x_value, y == y_value, a == 1.25}).evalf();
        return GiNaC::ex_to<GiNaC::numeric>(value).to_double();
    }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "intermediates: the same expression gets the same symbol, and expands to itself") {
    const ex e = sin(x + y) * a + pow(x * y + 1, 2);
    const ex named = z.name(e);
    CHECK(GiNaC::is_a<GiNaC::symbol>(named));
    CHECK(named.is_equal(z.name(e)));
    CHECK((z.expand(named) - e).expand().is_zero());
    CHECK(z.name(3 * x).is_equal(3 * x));
    CHECK(z.name(2 * sin(x)).is_equal(2 * z.name(sin(x))));
}

TEST_CASE_FIXTURE(Fixture, "intermediates: reverse and forward derivatives equal GiNaC's on the expanded tree") {
    const std::vector<ex> cases{sin(x * y) + cos(a * x),
                                sqrt(x * x + y * y + a),
                                pow(x * x + 1, GiNaC::numeric(-3, 2)) * y,
                                exp(-x * y) * log(2 + x * x),
                                tan(x / 4) * atan(y),
                                asin(x / 9) + acos(y / 9),
                                sinh(x) * cosh(y) * tanh(a * x),
                                pow(1 + x * x, y),
                                x / (1 + y * y),
                                *apply_function("atan2", {x, 1 + y})};
    for (const ex& e : cases) {
        CAPTURE(e);
        const ex named = z.name(e);
        const std::vector<ex> gradient = z.pull_back({{named, 1}}, {x, y});
        const ex along_x = z.push_forward({named}, {{x, 1}})[0];
        for (const auto& [px, py] : {std::pair{0.7, 0.4}, std::pair{-1.3, 2.1}, std::pair{0.2, -0.9}}) {
            CHECK(at(gradient[0], px, py) == doctest::Approx(at(e.diff(x), px, py)).epsilon(1e-13));
            CHECK(at(gradient[1], px, py) == doctest::Approx(at(e.diff(y), px, py)).epsilon(1e-13));
            CHECK(at(along_x, px, py) == doctest::Approx(at(e.diff(x), px, py)).epsilon(1e-13));
        }
    }
}

TEST_CASE_FIXTURE(Fixture, "intermediates: abs, sign, min and max have the derivatives of real functions") {
    const auto slope = [&](const char* name, const std::vector<ex>& args, double px, double py) {
        return at(z.pull_back({{z.name(*apply_function(name, args)), 1}}, {x})[0], px, py);
    };
    CHECK(slope("abs", {x}, -2, 0) == -1);
    CHECK(slope("abs", {x}, 2, 0) == 1);
    CHECK(slope("sign", {x}, 2, 0) == 0);
}

TEST_CASE_FIXTURE(Fixture, "intermediates: a twelve-fold nested expression stays small") {
    ex e = x;
    for (int level = 0; level < 60; ++level) e = z.name(sin(e) * e + y);
    CHECK(z.tree_size(e) > 1e18);
    const std::size_t before = z.entries().size();
    z.pull_back({{e, 1}}, {x, y});
    CHECK(z.entries().size() < 12 * before);
}

}  // namespace generator_intermediates
