// SPDX-License-Identifier: MIT
// Where double precision, the budget or the form of an expression sets a limit, the program says so.
#include <cmath>

#include "contacts.hpp"
#include "edits.hpp"
#include "tools.hpp"

namespace commands_limits {

using namespace alembert::test;

namespace {

/// A particle with these loads, from x = 0 at rate 1.
std::string particle(const std::string& more) {
    return temporary("limits.toml",
                     "[coordinates]\nx = { initial = 0, rate = 1 }\n[[particle]]\nname = \"P\"\n"
                     "mass = 1\nposition = [\"x\", 0]\n" +
                         more);
}

}  // namespace

TEST_CASE("trust: an energy that is not a number is told, and the run is not trusted") {
    for (const char* text :
         {"gravity = [1e-308, \"-g\"]\n[parameters]\ng = 9.81\nM = 1e6\nR = 0.3\n[coordinates]\n"
          "x = { initial = 0, rate = 1 }\n[[particle]]\nname = \"P\"\nmass = \"M\"\n"
          "position = [\"x\", \"R\"]\n",
          "gravity = [0, \"-g\"]\n[parameters]\ng = 9.81\nl = 1e200\n[coordinates]\n"
          "theta = { initial = 0.5, rate = 0.1 }\n[[particle]]\nname = \"P\"\nmass = 1\n"
          "position = [\"l*sin(theta)\", \"-l*cos(theta)\"]\n"}) {
        CAPTURE(text);
        const std::string scene = temporary("nan_energy.toml", text);
        const auto evaluated = run({"eval", scene});
        CHECK(evaluated.err.find("the energy is not a number here") != std::string::npos);
        const Json motion = simulated(scene, {});
        CHECK(motion["energy_drift"].is_null());
        CHECK(motion["error_estimate"]["trustworthy"] == false);
        CHECK(motion["error_estimate"]["reasons"].dump().find("is not a number") != std::string::npos);
    }
}

TEST_CASE("sweep: a motion whose energy divides by zero is not done, and the row says why") {
    const std::string scene = temporary("negative_power.toml",
                                        "[coordinates]\nx = { initial = 1, rate = 0 }\n[energy]\n"
                                        "lagrangian = \"x'^-0.5 - x^2/2\"\n");
    const auto swept = run({"sweep", scene, "--vary", "x=0:1:2", "--duration", "0.5"});
    CHECK(swept.exit == 4);
    CHECK(swept.out.find(",done") == std::string::npos);
    CHECK(swept.out.find("is not a number") != std::string::npos);
}

TEST_CASE("simulate: a longest step that makes more than 1e15 steps is refused as such a step is") {
    const std::string scene = particle("[forces]\nx = \"-x\"\n");
    for (const char* length : {"1e-300", "1e-15"})
        for (const std::vector<std::string>& one : {std::vector<std::string>{"--max-step", length},
                                                    {"--max-step", length, "--method", "taylor"},
                                                    {"--step", length, "--method", "rk4"}}) {
            std::vector<std::string> words = {"simulate", scene};
            words.insert(words.end(), one.begin(), one.end());
            const auto result = run(words);
            CHECK(result.exit == 3);
            CHECK(result.err.find("more than 1e+15 steps") != std::string::npos);
        }
    const auto swept =
        run({"sweep", particle("[forces]\nx = \"-x\"\n[simulation]\nmax_step = 1e-300\n"), "--vary", "x=0:1:2"});
    CHECK(swept.exit == 3);
    CHECK(swept.err.find("more than 1e+15 steps") != std::string::npos);
}

// A series of a double pendulum takes as long as dozens of right-hand sides.
TEST_CASE("simulate: a budget ends power series after about as much work as other methods") {
    const std::string scene = source_path("scenes/textbook/double_pendulum.toml");
    const auto reached = [&](const std::string& method) {
        const auto result = run({"simulate", scene, "--json", "--no-estimate", "--duration", "1e5", "--sample",
                                 "1e3", "--method", method, "--budget", "20000"});
        CHECK(result.exit == 4);
        return Json::parse(result.out);
    };
    const Json series = reached("taylor"), usual = reached("dop853");
    CHECK(usual["evaluations"].get<long>() > 19'900);
    CHECK(series["evaluations"].get<long>() < 4'000);
    CHECK(series["evaluations"].get<long>() > 50);
}

// x'' = −0.3 sign x' from x' = 1 stops at t = 1/0.3, x = 1/0.6.
TEST_CASE("kinks: friction written as v/|v| or v/√(v²) is followed as sign(v), with a word about it") {
    for (const char* force :
         {"-0.3*x'/sqrt(x'^2)", "-0.3*x'/abs(x')", "-0.3*(2*x')/sqrt(4*x'^2)", "-0.3*x'*abs(x')/x'^2",
          "-0.3*x'^3/abs(x')^3", "-0.3*x'/(x'^2)^(1/2)", "-0.3*sign(x')"}) {
        const std::string scene = particle(fmt::format("[forces]\nx = \"{}\"\n", force));
        const auto result = run({"simulate", scene, "--json", "--budget", "100000"});
        INFO(force << "\n" << result.err);
        REQUIRE(result.exit == 0);
        const Json motion = Json::parse(result.out);
        CHECK(std::abs(motion["final"]["coordinates"]["x"].get<double>() - 1 / 0.6) < 1e-9);
        CHECK(std::abs(motion["final"]["rates"]["x"].get<double>()) < 1e-9);
        CHECK((result.err.find("is followed as sign(x')") != std::string::npos) ==
              (std::string(force) != "-0.3*sign(x')"));
    }
}

TEST_CASE("derive: a Lagrangian that divides by a rate has equations, and a state at which it has none is told") {
    for (const char* power : {"-0.5", "-1", "-2"}) {
        CAPTURE(power);
        const auto text = [&](const char* rate) {
            return temporary("negative.toml",
                             fmt::format("[coordinates]\nx = {{ initial = 1, rate = {} }}\n[energy]\nlagrangian = "
                                         "\"x'^({}) - x^2/2\"\n[simulation]\nduration = 0.1\n",
                                         rate, power));
        };
        CHECK(run({"derive", text("0")}).exit == 0);
        CHECK(run({"derive", text("1")}).exit == 0);
        const auto still = run({"simulate", text("0")}), swept = run({"sweep", text("0"), "--vary", "x=0:1:2"});
        CHECK(still.exit == 4);
        CHECK(still.err.find("internal error") == std::string::npos);
        CHECK(swept.exit != 5);
        CHECK(swept.err.find("internal error") == std::string::npos);
        // x' ∂L/∂x' − L = (p − 1) x'^p + x²/2 is conserved.
        const Json motion = simulated(text("1"), {});
        CHECK(motion["energy_drift"].get<double>() < 1e-9);
    }
}

TEST_CASE("emit: a number beyond double precision is refused in every language") {
    const std::string scene = temporary("huge.toml",
                                        "[parameters]\nk = 2\n[coordinates]\nx = { initial = 1, rate = 0 "
                                        "}\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", "
                                        "0]\n[forces]\nx = \"-1e300*1e300*k*x\"\n");
    for (const std::vector<std::string>& language :
         {std::vector<std::string>{}, {"--language", "c"}, {"--batch"}}) {
        std::vector<std::string> words = {"emit", scene, "-o", temporary("huge", "") + ".d"};
        words.insert(words.end(), language.begin(), language.end());
        const auto result = run(words);
        CHECK(result.exit == 3);
        CHECK(result.err.find("too large for double precision") != std::string::npos);
    }
}

// x'' = -c x' - k x, also where the ends of the damper meet, in every form of the equations.
TEST_CASE("simulate: a damper may pass through its own anchor") {
    const std::string scene =
        particle("[[damper]]\nbetween = [\"O\", \"P\"]\ndamping = 0.4\n[forces]\nx = \"-4*x\"\n");
    const double w = std::sqrt(4 - 0.04), t = 7;
    for (const char* method : {"auto", "dop853", "verner98", "taylor", "radau"}) {
        const Json motion = simulated(scene, {"--duration", "7", "--tolerance", "1e-12", "--method", method});
        CHECK(std::abs(motion["final"]["coordinates"]["x"].get<double>() -
                       std::exp(-0.2 * t) * std::sin(w * t) / w) < 1e-10);
        CHECK(!motion.contains("switches"));
    }
    CHECK(run({"eval", scene, "--at", "x=0"}).exit == 0);
}

}  // namespace commands_limits
