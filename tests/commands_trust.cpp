// SPDX-License-Identifier: GPL-2.0-or-later
// The statement of a run about its accuracy, and pulses that a step could pass over, against closed forms.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"

namespace commands_trust {

using alembert::test::Json;
using alembert::test::run;
using alembert::test::simulated;
using alembert::test::temporary;

namespace {

std::string written(const std::string& text) {
    return temporary("trust.toml", text);
}

/// m x'' = F(t) − k x with m = k = 1, from the state given, 20 s.
std::string oscillator(const std::string& input, const std::string& initial = "0") {
    return written("[parameters]\nm = 1\nk = 1\nw = 1e-3\n[coordinates]\nx = { initial = " + initial +
                   ", unit = \"m\" }\n[inputs]\nF = \"" + input +
                   "\"\n[forces]\nx = \"F - k*x\"\n[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", "
                   "0]\n[simulation]\nduration = 20\n");
}

std::string pendulum(const std::string& initial) {
    return written(
        "gravity = [0, \"-g\"]\n[parameters]\nm = 1\ng = 9.81\nl = 1\n[coordinates]\ntheta = { initial = " +
        initial +
        ", unit = \"rad\" }\n[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"l*sin(theta)\", "
        "\"-l*cos(theta)\"]\n[simulation]\nduration = 20\n");
}

bool trusted(const Json& result) {
    return result["error_estimate"]["trustworthy"].get<bool>();
}
double at_end(const Json& result, const std::string& name) {
    return result["final"]["coordinates"][name].get<double>();
}

}  // namespace

// ∫ exp(−(s/w)²) sin(T − 5 − s) ds = w √π exp(−w²/4) sin(T − 5), T = 20: the pulse is over long before that.
TEST_CASE(
    "simulate: no method that chooses its steps passes over a narrow pulse, wherever it is and however narrow") {
    for (const double w : {1e-2, 1e-3, 1e-6}) {
        const double exact = w * std::sqrt(M_PI) * std::exp(-w * w / 4) * std::sin(15.0);
        for (const char* const method :
             {"auto", "dopri5", "dop853", "verner98", "abm", "bdf", "radau", "taylor"}) {
            const Json result = simulated(oscillator(fmt::format("exp(-((t-5)/{})^2)", w)),
                                          {"--method", method, "--tolerance", "1e-10"});
            CAPTURE(w);
            CAPTURE(method);
            CHECK(std::abs(at_end(result, "x") - exact) < 1e-6);
            CHECK(std::abs(at_end(result, "x") / exact - 1) < 0.05);
        }
    }
}

// A box from 7.3 to 7.301 s: x(20) = ∫ sin(20 − s) ds. A triangle of half the width w about 7.3: w sin(12.7) (1 +
// O(w²)).
TEST_CASE("simulate: switches and triangles made of sign, abs and max are found, without many short steps") {
    const Json box = simulated(oscillator("(sign(t-7.3) - sign(t-7.301))/2"));
    CHECK(std::abs(at_end(box, "x") - (std::cos(20 - 7.301) - std::cos(20 - 7.3))) < 1e-8);
    CHECK(box["steps"].get<int>() < 300);
    const Json triangle = simulated(oscillator("max(0, 1 - abs(t-7.3)/w)"));
    CHECK(std::abs(at_end(triangle, "x") - 1e-3 * std::sin(12.7)) < 1e-8);
    // The same pulse with the square multiplied out, and one that is zero where its argument is.
    const Json square = simulated(oscillator("exp(-(t^2 - 10*t + 25)/w^2)"));
    CHECK(std::abs(at_end(square, "x") - 1e-3 * std::sqrt(M_PI) * std::sin(15.0)) < 1e-7);
    const Json odd =
        simulated(oscillator("(t-5)/w*exp(-((t-5)/w)^2)"));  // ∫ s/w exp(−(s/w)²) sin(15 − s) ds = −w² √π/2 cos 15
    CHECK(std::abs(at_end(odd, "x") + 1e-6 * std::sqrt(M_PI) / 2 * std::cos(15.0)) < 1e-8);
}

TEST_CASE("sweep: no member passes over the narrow pulse that its own parameters make") {
    const std::string scene = oscillator("exp(-((t-5)/w)^2)");
    const auto result = run({"sweep", scene, "--json", "--vary", "w=1e-3:4e-3:4"});
    REQUIRE(result.exit == 0);
    const Json rows = Json::parse(result.out)["rows"];
    for (const Json& row : rows) {
        const double w = row["varied"]["w"].get<double>(),
                     exact = w * std::sqrt(M_PI) * std::exp(-w * w / 4) * std::sin(15.0);
        CHECK(std::abs(row["final"]["coordinates"]["x"].get<double>() - exact) < 1e-7);
    }
}

TEST_CASE("simulate: no step is longer than max_step, of the scene or of the command line") {
    const std::string scene = oscillator("0*t");
    for (const char* const method : {"dopri5", "dop853", "verner98", "abm", "bdf", "radau", "taylor"}) {
        CAPTURE(method);
        CHECK(simulated(scene, {"--method", method, "--max-step", "0.01"})["steps"].get<int>() >= 2000);
    }
    const auto refused = run({"simulate", scene, "--method", "rk4", "--step", "0.1", "--max-step", "0.01"});
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("a longest step of 0.01 s was asked for, but rk4 has a fixed step") !=
          std::string::npos);
    const std::string slow = written(
        "[coordinates]\nx = 1\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", "
        "0]\n[simulation]\nduration = 1\nmax_step = \"1/100\"\n");
    CHECK(simulated(slow)["steps"].get<int>() >= 100);
    CHECK(simulated(slow, {"--max-step", "0.001"})["steps"].get<int>() >= 1000);
    CHECK(simulated(slow, {"--method", "rk4", "--step", "0.5"})["steps"].get<int>() == 2);
}

// θ(t) = θ₀ cos(√(g/l) t) for small θ₀; x(t) = x₀ cos t.
TEST_CASE("simulate: a motion of any size is trusted if it has two digits, and only then") {
    for (const char* const initial : {"1e-15", "1e-9", "1e-4", "1", "1e9"}) {
        CAPTURE(initial);
        const double size = std::stod(initial);
        const auto good = [&](double exact, double end) { return std::abs(end - exact) <= 1e-2 * size; };
        for (const std::vector<std::string>& options :
             std::vector<std::vector<std::string>>{{},
                                                   {"--tolerance", "1e-6"},
                                                   {"--tolerance", "1e-3"},
                                                   {"--tolerance", "1e-20"},
                                                   {"--method", "euler", "--step", "0.05"},
                                                   {"--method", "rk4", "--step", "0.01"},
                                                   {"--method", "rk4", "--step", "50"},
                                                   {"--method", "radau", "--tolerance", "1e-9"}}) {
            CAPTURE(options);
            const Json result = simulated(oscillator("0*t", initial), options);
            if (trusted(result)) CHECK(good(size * std::cos(20.0), at_end(result, "x")));
            if (size > 1e-3) continue;
            const Json swing = simulated(pendulum(initial), options);
            if (trusted(swing)) CHECK(good(size * std::cos(std::sqrt(9.81) * 20), at_end(swing, "theta")));
        }
    }
    // A correct result is trusted.
    CHECK(trusted(simulated(oscillator("0*t", "1"))));
    CHECK(trusted(simulated(oscillator("0*t", "1e9"))));
    CHECK(trusted(simulated(pendulum("1e-4"))));
    CHECK(trusted(simulated(pendulum("1e-9"), {"--tolerance", "1e-13"})));
    CHECK(trusted(simulated(pendulum("1e-9"), {"--method", "rk4", "--step", "0.01"})));
    CHECK(trusted(simulated(pendulum("1e-15"), {"--method", "rk4", "--step", "0.01"})));
}

// x = x₀ + v t, y = y₀ + w t − g t²/2. At constant acceleration all but the first steps of abm are exact.
TEST_CASE("simulate: of a free fall no less than the true error is told, though only the first steps have one") {
    for (const std::vector<double>& start :
         {std::vector<double>{0, 0, 0, 0}, {0, 0, 1e6, 0}, {0.3, 0, 0, 12.7}, {-2, 1000, 1e-7, 0}})
        for (const double duration : {0.1, 1.0, 1000.0})
            for (const char* const method : {"abm", "dopri5", "radau"})
                for (const char* const tolerance : {"1e-3", "1e-4", "1e-6", "1e-9"}) {
                    const Json result =
                        simulated(written(fmt::format("gravity = [0, -9.81]\n[coordinates]\nx = {{ initial = {}, "
                                                      "rate = {} }}\ny = {{ initial = {}, rate = {} }}\n"
                                                      "[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", "
                                                      "\"y\"]\n[simulation]\nduration = {}\n",
                                                      start[0], start[1], start[2], start[3], duration)),
                                  {"--method", method, "--tolerance", tolerance});
                    const long double t = duration, g = 9.81L;
                    const auto off = [&](const char* group, const char* name, long double truth) {
                        return static_cast<double>(
                            std::abs(static_cast<long double>(result["final"][group][name].get<double>()) -
                                     truth) /
                            std::max(1.0L, std::abs(truth)));
                    };
                    CAPTURE(duration);
                    CAPTURE(method);
                    CAPTURE(tolerance);
                    CAPTURE(start);
                    const double told = result["error_estimate"]["value"].get<double>();
                    CHECK(off("coordinates", "x", start[0] + start[1] * t) <= told);
                    CHECK(off("coordinates", "y", start[2] + start[3] * t - g / 2 * t * t) <= told);
                    CHECK(off("rates", "y", start[3] - g * t) <= told);
                }
}

TEST_CASE("simulate: for a run that is not trusted every reason is given, for people and in JSON") {
    const std::string scene = pendulum("1.2");
    const Json result = simulated(scene, {"--method", "euler", "--step", "0.02"});
    CHECK_FALSE(trusted(result));
    CHECK(result["energy_drift"].get<double>() > 0.05);
    const Json& estimate = result["error_estimate"];
    CHECK(estimate["norm"].get<std::string>().find("max |error| / max(1, |y|)") != std::string::npos);
    CHECK(estimate["scaled"].get<double>() >= 0.01);
    std::string all;
    for (const Json& reason : estimate["reasons"]) all += reason.get<std::string>() + "\n";
    CHECK(all.find("the estimated error is") != std::string::npos);
    CHECK(all.find("the energy, which should stay, is off by") != std::string::npos);
    const auto text = run({"simulate", scene, "--method", "euler", "--step", "0.02"});
    CHECK(text.out.find("NOT TRUSTWORTHY: the estimated error is") != std::string::npos);
    CHECK(text.out.find("the energy, which should stay, is off by") != std::string::npos);
    const Json pulse = simulated(oscillator("exp(-((t-5)/w)^2)"), {"--method", "rk4", "--step", "0.1"});
    CHECK_FALSE(trusted(pulse));
}

}  // namespace commands_trust
