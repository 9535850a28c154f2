// SPDX-License-Identifier: MIT
// The equations that a formalism prints are its own, and they hold; `agree` uses every formalism that derives.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "json.hpp"
#include "program.hpp"
#include "redundant_plate.hpp"
#include "scenes.hpp"

namespace formalism_in_momenta {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::redundant_plate;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

Json derived(const std::string& scene, const std::string& by) {
    return json_of({"derive", scene, "--by", by});
}

bool are_proved(const std::string& scene, const Json& equations) {
    std::string claims;
    for (const Json& equation : equations) claims += equation["text"].get<std::string>() + "\n";
    const auto result = run({"check", scene, temporary("momenta.claims", claims)});
    INFO(claims << result.out << result.err);
    CHECK(result.exit == 0);
    return result.exit == 0;
}

}  // namespace

TEST_CASE(
    "formalisms: Routh's procedure and Hamilton's equations of symmetric tops are in momenta, and are proved") {
    for (const char* scene : {"heavy_top", "central_force", "spherical_pendulum"}) {
        const std::string file = source_path(fmt::format("scenes/textbook/{}.toml", scene));
        for (const char* by : {"routhian", "hamilton"}) {
            INFO(scene << " " << by);
            const Json json = derived(file, by);
            bool has_momenta = false;
            for (const Json& equation : json["equations"])
                has_momenta = has_momenta || equation["text"].get<std::string>().find("p_") != std::string::npos;
            CHECK(has_momenta);
            CHECK(are_proved(file, json["equations"]));
        }
    }
}

// ψ' = (p_ψ − p_φ cos θ)/(A sin² θ) in the names of the scene, where φ is the precession (Goldstein, §5-7).
TEST_CASE("formalisms: the symmetric top's rates in momenta have the book's denominators A sin^2 and C") {
    const auto result = run({"derive", source_path("scenes/textbook/heavy_top.toml"), "--by", "hamilton"});
    REQUIRE(result.exit == 0);
    CHECK(result.out.find("C*cos(theta)^2") == std::string::npos);
    CHECK(result.out.find("phi' = (p_phi-p_psi*cos(theta))/(A*sin(theta)^2)\n") != std::string::npos);
}

// H and R of a top: Goldstein, Classical Mechanics (1980), (5-63) and §8-3; a planet's R: ibid.
TEST_CASE("formalisms: Hamilton's function and the Routhian are written as books write them") {
    const auto shows = [](const std::string& scene, const std::string& by, const std::string& line) {
        const auto result =
            run({"derive", source_path("scenes/textbook/" + scene + ".toml"), "--by", by, "--steps"});
        REQUIRE(result.exit == 0);
        CAPTURE(result.out);
        CAPTURE(line);
        CHECK(result.out.find("  " + line + "\n") != std::string::npos);
    };
    shows(
        "heavy_top", "hamilton",
        "H = p_theta^2/(2*A) + p_psi^2/(2*C) + (p_phi-p_psi*cos(theta))^2/(2*A*sin(theta)^2) + m*g*l*cos(theta)");
    shows("heavy_top", "routhian",
          "R = A*theta'^2/2 - p_psi^2/(2*C) - (p_phi-p_psi*cos(theta))^2/(2*A*sin(theta)^2) - m*g*l*cos(theta)");
    shows("central_force", "routhian", "m*r'' - p_phi^2/(m*r^3) + k/r^2 = 0");
    shows("spherical_pendulum", "routhian",
          "m*l^2*theta'' - p_phi^2*cos(theta)/(m*l^2*sin(theta)^3) + m*g*l*sin(theta) = 0");
}

// Particle on a torus: R = m r² θ'²/2 − p_φ²/(2 m (R + r cos θ)²) − V, one term and not six.
TEST_CASE("formalisms: the Routhian of a particle on a torus has one term in the momentum") {
    const std::string scene = temporary("torus.toml", R"toml(
title = "torus"
[parameters]
m = 1
R = 2
r = 0.5
[coordinates]
theta = 0.3
phi = { initial = 0, rate = 1 }
[[particle]]
name = "P"
mass = "m"
position = ["(R+r*cos(theta))*cos(phi)", "(R+r*cos(theta))*sin(phi)", "r*sin(theta)"]
)toml");
    const auto result = run({"derive", scene, "--by", "routhian", "--steps"});
    REQUIRE(result.exit == 0);
    CHECK(result.out.find("R = m*r^2*theta'^2/2 - p_phi^2/(2*m*(R+r*cos(theta))^2)\n") != std::string::npos);
}

TEST_CASE(
    "formalisms: where the equations in momenta are too long, the heading does not say that they are shown") {
    const std::string scene = source_path("scenes/textbook/free_body.toml");
    const auto result = run({"derive", scene, "--by", "hamilton"});
    REQUIRE(result.exit == 0);
    const bool in_momenta = result.out.find("p_") != std::string::npos;
    CHECK(in_momenta == (result.out.find("Hamilton's canonical equations") != std::string::npos));
    CHECK(in_momenta == (result.out.find("too long to be shown") == std::string::npos));
}

// At rest a pendulum in Cartesian coordinates obeys 2 x λ = 0 and 2 y λ = m g.
TEST_CASE("steps: d'Alembert's principle with constraints balances their forces too, also at rest") {
    const auto result =
        run({"derive", source_path("scenes/textbook/cartesian_pendulum.toml"), "--by", "dalembert", "--steps"});
    REQUIRE(result.exit == 0);
    CHECK(result.out.find("Q + Q* + A^T lambda = 0:") != std::string::npos);
    CHECK(result.out.find("  2*x*lambda_rod = 0\n  2*y*lambda_rod - m*g = 0\n") != std::string::npos);
    CHECK(result.out.find("1 = 0") == std::string::npos);
}

TEST_CASE("steps: in LaTeX the formulas among the words of every formalism are typeset") {
    for (const char* const scene : {"heavy_top", "coin", "cartesian_pendulum"})
        for (const char* const by : {"lagrange", "lagrange1", "routh", "kane", "dalembert", "nielsen", "hamilton",
                                     "routhian", "appell", "maggi"}) {
            const auto result = run({"derive", source_path(std::string("scenes/textbook/") + scene + ".toml"),
                                     "--by", by, "--steps", "--format", "latex"});
            if (result.exit != 0) continue;  // it does not apply
            CAPTURE(scene);
            CAPTURE(by);
            for (const char* const plain :
                 {"A^T", "A\\^{}T", "dL/d", "dT/d", "dS/d", "dq'/", "sum of Q", "sum of p", "a\\^{}2"})
                CHECK(result.out.find(plain) == std::string::npos);
        }
}

TEST_CASE("formalisms: agree knows each formalism by which derive works, with redundant constraints too") {
    const std::string scene = temporary("twice.toml", redundant_plate);
    std::string text = run({"agree", scene, "--json"}).out;
    const Json agreed = Json::parse(text);
    CHECK(agreed["verdict"] == "proved");
    std::set<std::string> known;
    for (const Json& name : agreed["formalisms"]) known.insert(name.get<std::string>());
    CHECK(known.contains("kane"));
    for (const char* by : {"lagrange", "lagrange1", "kane", "routh", "dalembert", "nielsen", "schiehlen",
                           "hamilton", "recursive", "routhian", "appell", "maggi", "roberson-wittenburg"})
        CHECK((run({"derive", scene, "--by", by}).exit == 0) == known.contains(by));
}

}  // namespace formalism_in_momenta
