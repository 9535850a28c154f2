// SPDX-License-Identifier: GPL-2.0-or-later
#include <doctest/doctest.h>

#include <random>

#include "algebra/notation/latex.hpp"
#include "algebra/notation/mathml.hpp"
#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "symbolic_cases.hpp"

namespace symbolic_random {

namespace {

using namespace alembert;
using GiNaC::ex;
using GiNaC::numeric;

/// Sums, products, sines, squares, quotients, roots and other functions of everything a scene has, at random. What
/// is below a root, a fraction line or a logarithm is positive.
class Monkey {
public:
    explicit Monkey(unsigned seed) : random_(seed) {
        for (const char* name : {"m", "l", "g"}) letters_.push_back(m.parameter(name));
        letters_.push_back(m.time);
        letters_.push_back(m.input("F"));
        m.coordinates({"x", "theta"});
        for (const auto* level : {&m.q, &m.qdot, &m.qddot})
            letters_.insert(letters_.end(), level->begin(), level->end());
    }

    ex expression(int depth) {
        if (depth <= 0 || one_of(8) == 0)
            return one_of(5) == 0 ? ex(numeric(one_of(9) - 4, one_of(4) + 1)) : letter();
        const ex part = expression(depth - 1);
        switch (one_of(11)) {
            case 0:
            case 1:
            case 2:
                return part + expression(depth - 1);
            case 3:
            case 4:
            case 5:
                return part * expression(depth - 1);
            case 6:
                return one_of(2) == 0 ? sin(expression(depth - 2)) : cos(expression(depth - 2));
            case 7:
                return part * part;
            case 8:
                return 1 / (2 + part * part);
            case 9:
                return sqrt(1 + part * part);
            default:
                return transcendental();
        }
    }

    numeric positive() { return {one_of(800) + 100, 499}; }

    test::Mechanics m;

private:
    int one_of(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
    ex letter() { return letters_[static_cast<std::size_t>(one_of(static_cast<int>(letters_.size())))]; }
    ex transcendental() {
        const ex a = expression(1);
        switch (one_of(4)) {
            case 0:
                return exp(a);
            case 1:
                return tan(a);
            case 2:
                return log(3 + a * a);
            default:
                return pow(2 + a * a, numeric(one_of(5) - 2, 2));
        }
    }

    std::mt19937 random_;
    std::vector<ex> letters_;
};

TEST_CASE("readable: random expressions keep their value") {
    const long digits_before = GiNaC::Digits;
    GiNaC::Digits = 30;
    for (unsigned seed = 0; seed < 200; ++seed) {
        CAPTURE(seed);
        Monkey monkey(seed);
        const Symbols& symbols = monkey.m.symbols;
        const ex lhs = monkey.expression(5);
        const ex rhs = monkey.expression(3);
        const Fourier left = fourier(lhs, symbols).value();
        const Fourier right = fourier(rhs, symbols).value();
        const ReadableEquation equation = readable_equation(left, right);
        const ex factor = equation.divided_by ? expression(*equation.divided_by) : ex(1);
        const ex wrong[] = {expression(left) - lhs, expression(readable(left)) - lhs,
                            factor * (expression(equation.lhs) - expression(equation.rhs)) - (lhs - rhs)};
        GiNaC::exmap point;
        for (const GiNaC::symbol& symbol : symbols.all()) point[symbol] = monkey.positive();
        const ex size = 1 + abs(ex(lhs.subs(point).evalf())) + abs(ex(rhs.subs(point).evalf()));
        for (const ex& difference : wrong) {
            const ex value = (difference.subs(point) / size).evalf();
            CAPTURE(value);
            REQUIRE(GiNaC::is_a<numeric>(value));
            // 30 digits carried; fifth powers of sums of ten terms cancel a few of them
            CHECK(abs(GiNaC::ex_to<numeric>(value)) < numeric("1e-20"));
            CHECK(is_zero(fourier(difference, symbols).value()));
        }
        CHECK_FALSE(latex(equation.lhs).empty());
        CHECK_FALSE(mathml(equation.lhs, equation.rhs).empty());
    }
    GiNaC::Digits = digits_before;
}

}  // namespace

}  // namespace symbolic_random
