// SPDX-License-Identifier: MIT
// The sines and cosines of emitted code, alone and in groups, against glibc's long double (64 bits, good to an ulp of its
// own) and, next to multiples of π/2, against CLN's 50 digits.
#include <cln/cln.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "alembert/compile.hpp"
#include "alembert/module.hpp"
#include "emit/emit.hpp"

using namespace alembert;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), nan_value = std::numeric_limits<double>::quiet_NaN();

/// A solver of n coordinates whose outputs are sin q_0, cos q_0, sin q_1 …
Module solver_of_sines(int n) {
    Program program;
    program.name = "sines";
    for (int i = 0; i < n; ++i) {
        const std::string digit = std::to_string(i);
        program.coordinates.push_back({"q" + digit, "", 0});
        const int q = program.variable({Variable::Kind::coordinate, i});
        program.roots.push_back({"output", "s" + digit, program.call(Op::sin, {q})});
        program.roots.push_back({"output", "c" + digit, program.call(Op::cos, {q})});
        for (int j = 0; j <= i; ++j) program.roots.push_back({"mass", "M" + digit, program.number(i == j ? 1 : 0)});
        program.roots.push_back({"forcing", "f" + digit, program.number(0)});
        program.roots.push_back({"acceleration", "a" + digit, program.number(0)});
    }
    return load(compile(emit(program).text, "sines", {}).object);
}

/// sin and cos of each, in order; all angles at once.
std::vector<double> sines(const Module& module, const std::vector<double>& angles) {
    std::vector<double> state = angles, rate(2 * angles.size(), 0.0), out(2 * angles.size());
    state.resize(2 * angles.size());
    module.table().outputs_at(0, state.data(), rate.data(), nullptr, out.data());
    return out;
}

double ulp(double value) {
    const double size = std::max(std::abs(value), std::numeric_limits<double>::min());
    return std::ldexp(1.0, std::ilogb(size) - 52);
}

}  // namespace

TEST_CASE("sincos: 100 000 angles up to 1e8, alone and in groups of 2 to 9, are within 1.5 ulp") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> turn(-M_PI, M_PI), wide(-1e8, 1e8), exponent(-310, 8);
    for (const int n : {1, 2, 3, 5, 8, 9}) {
        const Module module = solver_of_sines(n);
        double worst = 0;
        std::vector<double> angles(n);
        for (int k = 0; k < 18000 / n; ++k) {
            for (double& x : angles) {
                const int kind = static_cast<int>(random() % 3);
                x = kind == 0 ? turn(random) : kind == 1 ? wide(random) : std::pow(10, exponent(random));
            }
            const std::vector<double> out = sines(module, angles);
            for (int i = 0; i < n; ++i) {
                const long double s = std::sin(static_cast<long double>(angles[i])), c = std::cos(static_cast<long double>(angles[i]));
                worst = std::max({worst, static_cast<double>(std::abs(s - out[2 * i])) / ulp(static_cast<double>(s)),
                                  static_cast<double>(std::abs(c - out[2 * i + 1])) / ulp(static_cast<double>(c))});
            }
        }
        CAPTURE(n);
        CHECK(worst < 1.5);
        CHECK(worst > 0.5);  // half an ulp is what rounding alone makes
    }
}

TEST_CASE("sincos: the doubles nearest to multiples of π/2 keep their digits") {
    const cln::cl_F half_pi = cln::pi(cln::float_format(60)) / 2;
    const Module module = solver_of_sines(3);
    std::mt19937_64 random(8);
    double worst = 0;
    for (int k = 0; k < 1500; ++k) {
        const long multiple = k < 500 ? k : static_cast<long>(random() % 63661976);
        const double x = cln::double_approx(half_pi * static_cast<cln::cl_I>(multiple));
        const std::vector<double> angles{x, -std::nextafter(x, infinity), std::nextafter(x, 0)}, out = sines(module, angles);
        for (int i = 0; i < 3; ++i) {
            if (std::abs(angles[i]) < std::numeric_limits<double>::min()) continue;
            const cln::cl_F exact = cln::cl_float(cln::rational(cln::cl_float(angles[i])), cln::float_format(60));
            for (int part = 0; part < 2; ++part) {
                const cln::cl_F value = part == 0 ? cln::cl_F(cln::sin(exact)) : cln::cl_F(cln::cos(exact));
                const double error = cln::double_approx(cln::abs(value - cln::cl_float(cln::rational(cln::cl_float(out[2 * i + part])), cln::float_format(60))));
                worst = std::max(worst, error / ulp(cln::double_approx(value)));
            }
        }
    }
    CHECK(worst < 1.5);
}

TEST_CASE("sincos: zeros keep their sign, denormals are their own sine, what libm gives is given beyond 1e8") {
    for (const int n : {1, 2, 4, 7}) {
        const Module module = solver_of_sines(n);
        CAPTURE(n);
        for (const double x : {0.0, -0.0, 4.9e-324, -4.9e-324, 1e-310, 100000000.5, -1e9, 1e22, -1e300, infinity, -infinity, nan_value}) {
            CAPTURE(x);
            std::vector<double> angles(n, 1.0);
            angles[n - 1] = x;
            const std::vector<double> out = sines(module, angles);
            const double s = out[2 * n - 2], c = out[2 * n - 1];
            if (std::isfinite(x)) {
                CHECK(std::bit_cast<std::uint64_t>(s) == std::bit_cast<std::uint64_t>(std::sin(x)));
                CHECK(c == std::cos(x));
            } else {
                CHECK(std::isnan(s));
                CHECK(std::isnan(c));
            }
            if (n > 1) CHECK(std::abs(out[0] - std::sin(1.0)) <= 1.5 * ulp(std::sin(1.0)));  // its neighbours do not notice
        }
    }
}
