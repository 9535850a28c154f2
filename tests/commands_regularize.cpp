// SPDX-License-Identifier: MIT
// `simulate --regularize`: near collisions against closed forms and published digits, and where it is refused.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_regularize {

using alembert::test::Json;
using alembert::test::run;
using alembert::test::simulated;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

const std::string comet = source_path("scenes/benchmark/comet.toml");

/// The position after a hundred turns and 0.7 s of the scene's comet: u − e sin u = t + π, in 60 digits.
constexpr double x_at_end = 1.938004086151728, y_at_end = 0.004898055236709;

double error(const Json& run) {
    const Json& q = run["final"]["coordinates"];
    return std::max(std::abs(q["x"].get<double>() - x_at_end), std::abs(q["y"].get<double>() - y_at_end));
}

void check_refused(const std::string& scene, std::vector<std::string> options, const std::string& because) {
    options.insert(options.begin(), {"simulate", scene, "--regularize"});
    const auto result = run(options);
    INFO(result.err);
    CHECK(result.exit == 3);
    CHECK(result.err.find(because) != std::string::npos);
}

}  // namespace

/// Rounding changes the energy by ε/(2√3) of itself in each step, at random, and the orbit gathers 1.5 · 200π
/// times the mean of that sum, √(steps/3) of it; six times this is allowed for.
double rounded(const Json& run) {
    return 1.5 * 200 * M_PI * 2.2e-16 * std::sqrt(run["steps"].get<double>());
}

// Of half as long steps the errors of the method are 2⁸ times smaller. In t the steps are as many, and the near
// end, 1e-4 from the middle, costs all digits that it does in time: at least three.
TEST_CASE("regularize: a comet with e = 0.9999 is where Kepler's equation says after a hundred turns") {
    const Json in_t = simulated(comet, {}), own = simulated(comet, {"--regularize"}),
               fixed = simulated(comet, {"--regularize", "--step", "0.1"}),
               coarse = simulated(comet, {"--regularize", "--step", "0.2"});
    MESSAGE("errors " << error(in_t) << " in t, " << error(own) << " and " << error(fixed) << " regularized");
    CHECK(error(in_t) > 1e3 * error(own));
    CHECK(error(own) < rounded(own));
    CHECK(error(fixed) < rounded(fixed) + error(coarse) / 256);
    CHECK(own["method"] == "verner98");
    CHECK(fixed["method"] == "kahanli8");
    CHECK(own["regularized"] == true);
    CHECK_FALSE(in_t.contains("regularized"));
    for (const Json& each : {in_t, own}) CHECK(error(each) < each["error_estimate"]["value"].get<double>());
}

// Test Set for IVP Solvers, plei.F; to 16 digits here and in commands_hard. kahanli8 comes to rounding, which the
// near collisions of stars with 0.03 between them make larger: ε for each of 3000 steps at random, √3000 ε
// = 1.2e-14, times 1/0.03 is 4e-13, and 1e-12 is less than three times that. gauss has 2⁶ times the error in steps
// twice as long, to a tenth.
TEST_CASE("regularize: Pleiades in fixed steps, through its near collisions") {
    const std::string pleiades = source_path("scenes/benchmark/pleiades.toml");
    for (const std::string method : {"kahanli8", "gauss"}) {
        const Json plain = simulated(pleiades, {"--no-estimate", "--method", method, "--step", "0.001"}),
                   own = simulated(pleiades,
                                   {"--no-estimate", "--method", method, "--step", "0.001", "--regularize"});
        const auto error = [](const Json& run) {
            return std::abs(run["final"]["coordinates"]["x1"].get<double>() - 0.37061391439705129);
        };
        MESSAGE(method << ": x1 off by " << error(plain) << " in t, " << error(own) << " regularized");
        const Json coarse =
            simulated(pleiades, {"--no-estimate", "--method", method, "--step", "0.002", "--regularize"});
        CHECK(error(own) < (method == "gauss" ? 1.1 / 64 * error(coarse) : 1e-12));
        CHECK(error(plain) > 100 * error(own));
    }
}

TEST_CASE("regularize: the scene can ask for it, and a mass matrix that changes does not prevent it") {
    const std::string polar = temporary("polar.toml", R"toml(
[parameters]
e = 0.999
[coordinates]
r = "1 + e"
phi = { initial = 0, rate = "sqrt((1 - e)/(1 + e))/(1 + e)" }
[[particle]]
name = "comet"
mass = 1
position = ["r*cos(phi)", "r*sin(phi)"]
[energy]
potential = "-1/r"
[outputs]
x = "r*cos(phi)"
[simulation]
duration = "2*pi"
tolerance = 1e-12
regularize = true
)toml");
    const Json result = simulated(polar, {});
    CHECK(result["regularized"] == true);
    const double told = result["error_estimate"]["value"].get<double>();  // by a run at a tenth of the tolerance
    CHECK(std::abs(result["final"]["coordinates"]["r"].get<double>() - 1.999) < told);
    CHECK(std::abs(result["final"]["coordinates"]["phi"].get<double>() - 2 * M_PI) < told);
    CHECK(told < 1e-9);  // the three digits that 1/(1 - e) = 1000 may cost of a tolerance of 1e-12
    const auto swept = run({"sweep", polar, "--vary", "e=0.1:0.2:2"});
    CHECK(swept.exit == 3);
    CHECK(swept.err.find("sweep does not run regularized") != std::string::npos);
    CHECK(simulated(polar, {"--method", "gauss", "--step", "0.01"})["completed"] == true);
}

// A pulse of 2e-6 about x = 0.3 is passed four times in two turns, and has two zeros each time; x' is 0 at the
// four ends of the ellipse, one of which is the start.
TEST_CASE("regularize: zeros that are narrower than the steps are found, of places and of rates") {
    const std::string scene = temporary("narrow.toml", R"toml([coordinates]
x = 1.9
y = { initial = 0, rate = 0.22941573387056177 }
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[energy]
potential = "-1/norm(pos(P))"
[[event]]
name = "place"
when = "exp(-((x - 0.3)/1e-6)^2) - 0.5"
[[event]]
name = "rate"
when = "exp(-(x'/1e-6)^2) - 0.5"
[simulation]
duration = 12
)toml");
    for (const std::vector<std::string>& method : {std::vector<std::string>{"dop853"},
                                                   {"verner98"},
                                                   {"kahanli8", "--step", "0.05"},
                                                   {"gauss", "--step", "0.1"}}) {
        CAPTURE(method[0]);
        std::vector<std::string> options{"--regularize", "--no-estimate", "--method"};
        options.insert(options.end(), method.begin(), method.end());
        int places = 0, rates = 0;
        const Json result = simulated(scene, options);
        for (const Json& event : result["events"]) ++(event["name"] == "place" ? places : rates);
        CHECK(places == 8);
        CHECK(rates == 7);  // the first pulse is left from its height
    }
}

TEST_CASE("regularize: where it does not apply it says why") {
    check_refused(comet, {"--method", "taylor"}, "does not run regularized");
    check_refused(comet, {"--method", "rkn1210"}, "does not run regularized");
    check_refused(comet, {"--max-step", "0.1"}, "no longest step");
    check_refused(source_path("scenes/textbook/cartesian_pendulum.toml"), {}, "there are constraints");
    check_refused(source_path("scenes/textbook/bouncing_ball.toml"), {}, "contacts");
    check_refused(source_path("scenes/textbook/pendulum_absorber.toml"), {}, "not conserved");
    check_refused(
        temporary("spring.toml", "[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"x^2/2\"\n"),
        {}, "negative potential energy");
    check_refused(temporary("bent.toml", R"toml(
[coordinates]
x = { initial = -1, rate = 0 }
[energy]
kinetic = "x'^2/2"
potential = "-1/(1 + abs(x))"
)toml"),
                  {}, "held constant piece by piece");
}

}  // namespace commands_regularize
