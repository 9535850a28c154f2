// SPDX-License-Identifier: MIT
// Numbers with bounds, roots with discs and symbolic conditions, against exact arithmetic and textbooks.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "stability/conditions.hpp"
#include "stability/linear/dense_long.hpp"
#include "stability/linear/modes.hpp"
#include "stability/spectrum.hpp"

namespace stability_numbers {

using namespace alembert;
using GiNaC::ex;

TEST_CASE("stability: numbers are exact if possible, and otherwise intervals contain the value") {
    const RealBall pi = RealBall::pi_multiple(0, 1);
    CHECK((sin(pi / 6) - RealBall(Rational(1) / 2)).is_zero());
    CHECK((cos(pi / 4) * cos(pi / 4) - RealBall(Rational(1) / 2)).is_zero());
    CHECK((sqrt(RealBall(8)) * sqrt(RealBall(2)) - 4).is_zero());
    CHECK(((1 + sqrt(RealBall(5))) / 2 * ((1 - sqrt(RealBall(5))) / 2) + 1).is_zero());
    CHECK((atan(RealBall(1)) - pi / 4).is_zero());
    CHECK(sin(RealBall(3)).sign() == 1);
    CHECK(!(exp(RealBall(1)) - exp(RealBall(1))).sign());
    CHECK((exp(RealBall(1)) - 2).sign() == 1);
    CHECK(std::abs(sqrt(RealBall(2)).number() - 1.4142135623730951) < 1e-16);
}

TEST_CASE("stability: Routh-Hurwitz conditions of third and fourth order are the textbook's") {
    const GiNaC::symbol a1("a1"), a2("a2"), a3("a3"), a4("a4");
    const auto holds = [](const std::vector<ex>& found, const std::vector<ex>& wanted) {
        if (found.size() != wanted.size()) return false;
        for (const ex& w : wanted)
            if (std::none_of(found.begin(), found.end(), [&](const ex& f) { return (f - w).expand().is_zero(); }))
                return false;
        return true;
    };
    CHECK(holds(hurwitz_conditions({1, a1, a2}), {a1, a2}));
    CHECK(holds(hurwitz_conditions({1, a1, a2, a3}), {a1, a3, a1 * a2 - a3}));
    CHECK(holds(hurwitz_conditions({1, a1, a2, a3, a4}), {a1, a2, a4, a1 * a2 * a3 - a3 * a3 - a1 * a1 * a4}));
    const auto array = routh_array({1, a1, a2, a3, a4});
    REQUIRE(array.size() == 5);
    CHECK((array[2][0] - (a1 * a2 - a3) / a1).normal().is_zero());
    CHECK((array[3][0] - (a3 - a1 * a1 * a4 / (a1 * a2 - a3))).normal().is_zero());
    CHECK((array[4][0] - a4).is_zero());
}

TEST_CASE("stability: 10000 random polynomials satisfy the conditions exactly where all roots lie to the left") {
    const GiNaC::symbol a1("a1"), a2("a2"), a3("a3"), a4("a4");
    const std::vector<ex> symbols{a1, a2, a3, a4};
    std::mt19937 random(20261);
    std::uniform_int_distribution<int> coefficient(-3, 12);
    int stable = 0;
    for (const int order : {3, 4}) {
        SymbolicPolynomial p{1};
        p.insert(p.end(), symbols.begin(), symbols.begin() + order);
        // As polynomials in doubles, which hold these whole numbers exactly.
        const std::vector<ex> conditions = hurwitz_conditions(p), all = hurwitz_determinants(p);
        for (int k = 0; k < 5000; ++k) {
            GiNaC::exmap values;
            RealBallVector numbers{1};
            for (int i = 0; i < order; ++i) {
                const int value = coefficient(random);
                values[symbols[static_cast<std::size_t>(i)]] = value;
                numbers.push_back(value);
            }
            const auto positive = [&](const std::vector<ex>& list) {
                return std::all_of(list.begin(), list.end(), [&](const ex& e) {
                    return e.subs(values, GiNaC::subs_options::no_pattern).info(GiNaC::info_flags::positive);
                });
            };
            bool left = true;
            for (const RootOf& root : roots_of(numbers)) {
                REQUIRE(root.side != RootOf::Side::unclear);
                left = left && root.side == RootOf::Side::left;
            }
            if (positive(conditions) != left || positive(all) != left) {
                CAPTURE(order);
                CAPTURE(values);
                CHECK(false);
            }
            stable += left ? 1 : 0;
        }
    }
    CHECK(stable > 1000);
    CHECK(stable < 9000);
}

TEST_CASE(
    "stability: discs hold the roots from which a polynomial was made, equal ones and those on the axis too") {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> whole(-4, 4), times(1, 2);
    for (int k = 0; k < 200; ++k) {
        std::vector<std::complex<double>> made;
        RealBallVector p{1};
        const auto multiply = [&](const RealBallVector& factor) {
            RealBallVector product(p.size() + factor.size() - 1, RealBall(0));
            for (std::size_t i = 0; i < p.size(); ++i)
                for (std::size_t j = 0; j < factor.size(); ++j) product[i + j] += p[i] * factor[j];
            p = product;
        };
        for (int f = 0; f < 3; ++f) {
            const int re = whole(random), im = whole(random), count = times(random);
            for (int c = 0; c < count; ++c)
                if (im == 0) {
                    multiply({1, -re});
                    made.emplace_back(re, 0);
                } else {
                    multiply({1, -2 * re, re * re + im * im});
                    made.emplace_back(re, im);
                    made.emplace_back(re, -im);
                }
        }
        std::vector<RootOf> found = roots_of(p);
        REQUIRE(found.size() == made.size());
        for (const std::complex<double>& root : made) {
            const auto one = std::find_if(found.begin(), found.end(),
                                          [&](const RootOf& r) { return std::abs(r.value - root) <= r.radius; });
            REQUIRE(one != found.end());
            CHECK(one->radius < 1e-14);
            CHECK(one->side == (root.real() < 0   ? RootOf::Side::left
                                : root.real() > 0 ? RootOf::Side::right
                                                  : RootOf::Side::axis));
            CHECK(one->multiplicity == std::count(made.begin(), made.end(), root));
            found.erase(one);
        }
    }
}

TEST_CASE("linearize: modes are eigenvectors, as many as there are, and those of a chain are sines") {
    // Three masses between four springs: q_k = sin(j k π/4), ω = 2 sin(j π/8).
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6, 6);
    std::vector<std::complex<double>> values;
    for (int k = 0; k < 3; ++k) {
        A(k, 3 + k) = 1;
        for (int l = 0; l < 3; ++l) A(3 + k, l) = k == l ? -2 : std::abs(k - l) == 1 ? 1 : 0;
    }
    for (int j = 1; j <= 3; ++j)
        for (const int sign : {-1, 1}) values.emplace_back(0, sign * 2 * std::sin(j * M_PI / 8));
    const std::vector<LinearMode> modes = modes_of(A, values);
    REQUIRE(modes.size() == 3);
    for (int j = 1; j <= 3; ++j) {
        const LinearMode& mode = modes[static_cast<std::size_t>(j) - 1];
        CHECK((A.cast<std::complex<double>>() * mode.vector - mode.eigenvalue * mode.vector).norm() < 1e-13);
        CHECK(std::abs(mode.vector.cwiseAbs().maxCoeff() - 1) < 1e-15);
        for (int k = 0; k < 3; ++k)
            CHECK(std::abs(mode.vector[k] * std::sin(j * M_PI / 4) -
                           mode.vector[0] * std::sin(j * (k + 1) * M_PI / 4)) < 1e-13);
    }
    // A double eigenvalue with two vectors, and one with a Jordan block.
    Eigen::MatrixXd two = Eigen::MatrixXd::Identity(2, 2), block = two;
    block(0, 1) = 1;
    CHECK(modes_of(two, {1, 1}).size() == 2);
    CHECK(modes_of(block, {1, 1}).size() == 1);
    CHECK(std::abs(modes_of(two, {1, 1})[0].vector.dot(modes_of(two, {1, 1})[1].vector)) < 1e-15);
}

TEST_CASE("least norm: regular systems are solved as by singular values, and the rank is that of these") {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto filled = [&](Eigen::Index rows, Eigen::Index columns) -> LongMatrix {
        return LongMatrix::NullaryExpr(rows, columns, [&](Eigen::Index, Eigen::Index) { return normal(random); });
    };
    for (const Eigen::Index n : {7, 8, 20}) {
        const LongMatrix left = singular_values(filled(n, n)).left, right = singular_values(filled(n, n)).right;
        const LongColumn b = filled(n, 1);
        for (const long double least : {1.0L, 1e-3L, 1e-9L, 1e-13L, 0.0L}) {
            CAPTURE(n);
            CAPTURE(static_cast<double>(least));
            // U diag(1, ..., 1, least) V^T
            LongColumn values = LongColumn::Ones(n);
            values[n - 1] = least;
            const LongMatrix A = left * values.asDiagonal() * right.transpose();
            const LongLeastNorm found = least_norm(A, b, 1e-11L);
            const bool counts = least > 1e-11L;
            CHECK(found.rank == n - (counts ? 0 : 1));
            LongColumn inverse = values.cwiseInverse();
            if (!counts) inverse[n - 1] = 0;
            const LongColumn x = right * inverse.asDiagonal() * (left.transpose() * b);
            CHECK(static_cast<double>((found.x - x).norm() / x.norm()) <
                  (counts ? 1e-16 / static_cast<double>(least) : 1e-15));
        }
    }
}

}  // namespace stability_numbers
