// SPDX-License-Identifier: MIT
// The sines and cosines of emitted code, alone, in groups and in packs, for this processor and for any (SSE2
// alone, no fused multiply-add), against glibc's long double (64 bits, good to an ulp of its own) and, next to
// multiples of π/2, against CLN's 60 digits. tests/bench/sines.sh does the same at 10⁷ points, all against CLN.
#include <cln/cln.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "alembert/batch/packs.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/native/module.hpp"
#include "codegen/emit/emit.hpp"

namespace generator_sincos {

using namespace alembert;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(),
                 nan_value = std::numeric_limits<double>::quiet_NaN();

/// Flags after our own: what the processor here does best, and what every x86-64 can do.
const std::vector<std::vector<std::string>> targets{{}, {"-march=x86-64", "-ffp-contract=off"}};

/// And for compilers that may make sums in another order, as `--fast-math` lets them.
std::vector<std::vector<std::string>> targets_and_other_orders() {
    std::vector<std::vector<std::string>> result = targets;
    for (std::vector<std::string> flags : targets) {
        for (const char* const flag :
             {"-fassociative-math", "-fno-signed-zeros", "-freciprocal-math", "-DALEMBERT_REASSOCIATES"})
            flags.emplace_back(flag);
        result.push_back(std::move(flags));
    }
    return result;
}

/// A solver of n coordinates whose outputs are sin q_0, cos q_0, sin q_1 …
Module solver_of_sines(int n, const std::vector<std::string>& flags = {}) {
    Program program;
    program.name = "sines";
    for (int i = 0; i < n; ++i) {
        const std::string digit = std::to_string(i);
        program.coordinates.push_back({"q" + digit, "", 0});
        const int q = program.variable({Variable::Kind::coordinate, i});
        program.roots.push_back({Group::output, "s" + digit, program.call(Op::sin, {q})});
        program.roots.push_back({Group::output, "c" + digit, program.call(Op::cos, {q})});
        for (int j = 0; j <= i; ++j)
            program.roots.push_back({Group::mass, "M" + digit, program.number(i == j ? 1 : 0)});
        program.roots.push_back({Group::forcing, "f" + digit, program.number(0)});
        program.roots.push_back({Group::acceleration, "a" + digit, program.number(0)});
    }
    const std::string text = emit(program, {.batch = true}).text;
    return load(compile(text, "sines", {.compiler = {}, .extra_flags = flags, .cache = {}}).object);
}

/// sin and cos of each, in order; all angles at once.
std::vector<double> sines(const Module& module, const std::vector<double>& angles) {
    std::vector<double> state = angles, rate(2 * angles.size(), 0.0), out(2 * angles.size());
    state.resize(2 * angles.size());
    module.table().outputs_at(0, state.data(), rate.data(), nullptr, out.data());
    return out;
}

/// The same in one lane of a pack, the others at `others` where that is not zero, else each at its own angles.
std::vector<double> sines_in_pack(const Module& module, const std::vector<double>& angles, int lane,
                                  double others = 0) {
    std::vector<Lanes> state(2 * angles.size()), out(2 * angles.size());
    const Lanes t{};
    for (std::size_t i = 0; i < angles.size(); ++i)
        for (int l = 0; l < lanes; ++l)
            state[i][l] = l == lane ? angles[i] : others != 0 ? others : angles[i] / (l + 2);
    module.pack()->outputs_at(reals(&t), reals(state.data()), nullptr, nullptr, reals(out.data()));
    std::vector<double> result;
    for (const Lanes& value : out) result.push_back(value[lane]);
    return result;
}

double ulp(double value) {
    const double size = std::max(std::abs(value), std::numeric_limits<double>::min());
    return std::ldexp(1.0, std::ilogb(size) - 52);
}

}  // namespace

TEST_CASE("sincos: 60 000 angles up to 1e8, alone, in groups of 2 to 9 and in packs, are within 2 ulp") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> turn(-M_PI, M_PI), wide(-1e8, 1e8), exponent(-310, 8);
    for (const std::vector<std::string>& flags : targets_and_other_orders())
        for (const int n : {1, 2, 3, 8, 9}) {
            const Module module = solver_of_sines(n, flags);
            double worst[2]{};
            std::vector<double> angles(n);
            for (int k = 0; k < 6000 / n; ++k) {
                for (double& x : angles) {
                    const int kind = static_cast<int>(random() % 3);
                    x = kind == 0 ? turn(random) : kind == 1 ? wide(random) : std::pow(10, exponent(random));
                }
                const std::vector<double> out[2]{sines(module, angles), sines_in_pack(module, angles, k % lanes)};
                for (int i = 0; i < n; ++i) {
                    const long double s = std::sin(static_cast<long double>(angles[i])),
                                      c = std::cos(static_cast<long double>(angles[i]));
                    for (int way = 0; way < 2; ++way)
                        worst[way] = std::max(
                            {worst[way],
                             static_cast<double>(std::abs(s - out[way][2 * i])) / ulp(static_cast<double>(s)),
                             static_cast<double>(std::abs(c - out[way][2 * i + 1])) /
                                 ulp(static_cast<double>(c))});
                }
            }
            CAPTURE(n);
            CAPTURE(flags);
            for (const double error : worst) {
                CHECK(error < 2);
                CHECK(error > 0.5);  // half an ulp is what rounding alone makes
            }
        }
}

TEST_CASE("sincos: the doubles nearest to multiples of π/2 keep their digits") {
    const cln::cl_F half_pi = cln::pi(cln::float_format(60)) / 2;
    for (const std::vector<std::string>& flags : targets_and_other_orders()) {
        const Module module = solver_of_sines(3, flags);
        std::mt19937_64 random(8);
        double worst = 0;
        for (int k = 0; k < 1000; ++k) {
            // Of all doubles up to 1e8 these are nearest to multiples of π/2 for their size, by continued
            // fractions of π/2 times powers of two: the first misses by 6e-19, the second by 1.7e-18.
            const double nearest[] = {45.553093477052, 14461176.67027838};
            const long multiple = k < 300 ? k : static_cast<long>(random() % 63661976);
            const double x = k < 2 ? nearest[k] : cln::double_approx(half_pi * static_cast<cln::cl_I>(multiple));
            const std::vector<double> angles{x, -std::nextafter(x, infinity), std::nextafter(x, 0)};
            const std::vector<double> out =
                k % 2 == 0 ? sines(module, angles) : sines_in_pack(module, angles, k / 2 % lanes);
            for (int i = 0; i < 3; ++i) {
                if (std::abs(angles[i]) < std::numeric_limits<double>::min()) continue;
                const cln::cl_F exact =
                    cln::cl_float(cln::rational(cln::cl_float(angles[i])), cln::float_format(60));
                for (int part = 0; part < 2; ++part) {
                    const cln::cl_F value = part == 0 ? cln::cl_F(cln::sin(exact)) : cln::cl_F(cln::cos(exact));
                    const double error = cln::double_approx(
                        cln::abs(value - cln::cl_float(cln::rational(cln::cl_float(out[2 * i + part])),
                                                       cln::float_format(60))));
                    worst = std::max(worst, error / ulp(cln::double_approx(value)));
                }
            }
        }
        CAPTURE(flags);
        CHECK(worst < 2);
    }
}

TEST_CASE("sincos: zeros keep their sign, denormals are their own sine, and beyond 1e8 the values are libm's") {
    for (const std::vector<std::string>& flags : targets)
        for (const int n : {1, 2, 4, 7}) {
            const Module module = solver_of_sines(n, flags);
            CAPTURE(n);
            for (const double x : {0.0, -0.0, 4.9e-324, -4.9e-324, 1e-310, 100000000.5, -1e9, 1e22, -1e300,
                                   infinity, -infinity, nan_value})
                for (const bool packed : {false, true}) {
                    CAPTURE(x);
                    CAPTURE(packed);
                    std::vector<double> angles(n, 1.0);
                    angles[n - 1] = x;
                    const std::vector<double> out =
                        packed ? sines_in_pack(module, angles, n % lanes) : sines(module, angles);
                    const double s = out[2 * n - 2], c = out[2 * n - 1];
                    if (std::isfinite(x)) {
                        CHECK(std::bit_cast<std::uint64_t>(s) == std::bit_cast<std::uint64_t>(std::sin(x)));
                        CHECK(c == std::cos(x));
                    } else {
                        CHECK(std::isnan(s));
                        CHECK(std::isnan(c));
                    }
                    if (n > 1)
                        CHECK(std::abs(out[0] - std::sin(1.0)) <=
                              2 * ulp(std::sin(1.0)));  // its neighbours do not notice
                }
        }
}

TEST_CASE("sincos: a lane that needs libm changes no other lane by a bit") {
    const Module module = solver_of_sines(3);
    for (const double x : {0.3, 2.0, -77.7, 5e7})
        for (const double others : {1e9, infinity, nan_value}) {
            const std::vector<double> angles{x, x / 2, -x};
            CHECK(sines_in_pack(module, angles, 5) == sines_in_pack(module, angles, 5, others));
        }
}

}  // namespace generator_sincos
