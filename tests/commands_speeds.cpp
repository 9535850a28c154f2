// SPDX-License-Identifier: MIT
// Scenes with [speeds], as a user runs them: closed forms, and the same motion without them.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_speeds {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::number;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {}  // namespace

// c² = v₀² + w₀² (J + m a²)/m, v = c tanh(l t + b), w = c √(m/(J + m a²)) sech(l t + b), l = a m c/(J + m a²).
TEST_CASE("commands: the sleigh in v and w follows its closed form without a multiplier") {
    const double m = 1, J = 1, a = 0.5, v0 = 0.5, w0 = 2, K = J + m * a * a;
    const double c = std::sqrt(v0 * v0 + w0 * w0 * K / m), l = a * m * c / K, b = std::atanh(v0 / c);
    for (const char* t : {"1", "3", "10"}) {
        CAPTURE(t);
        const Json json = json_of({"simulate", source_path("scenes/textbook/chaplygin_sleigh_in_speeds.toml"),
                                   "--json", "--tolerance", "1e-13", "--duration", t});
        const double phase = l * std::stod(t) + b, v = c * std::tanh(phase),
                     w = c * std::sqrt(m / K) / std::cosh(phase);
        const Json& end = json["final"];
        CHECK(std::abs(number(end, "speeds", "v") - v) < 1e-10);
        CHECK(std::abs(number(end, "speeds", "w") - w) < 1e-10);
        CHECK(std::abs(number(end, "rates", "phi") - w) < 1e-10);
        const double phi = number(end, "coordinates", "phi");
        CHECK(std::abs(number(end, "rates", "x") - v * std::cos(phi)) < 1e-10);
        CHECK(std::abs(number(end, "rates", "y") - v * std::sin(phi)) < 1e-10);
        CHECK(json["constraint_drift"].get<double>() < 1e-14);
        CHECK(json["formulation"].get<std::string>().rfind("kane", 0) == 0);
        if (std::string(t) != "10") continue;  // by quadrature in 32 digits
        CHECK(std::abs(number(end, "coordinates", "x") + 18.23918484310695690258495) < 1e-10);
        CHECK(std::abs(number(end, "coordinates", "y") - 6.323136253265931452629073) < 1e-10);
        CHECK(std::abs(phi - 3.0201244756063002614002546515393) < 1e-10);
    }
}

TEST_CASE("commands: the sleigh without speeds is reduced by Kane's equations too, at every heading") {
    const Json json = json_of({"simulate", source_path("scenes/textbook/chaplygin_sleigh.toml"), "--json", "--by",
                               "kane", "--tolerance", "1e-13"});
    CHECK(std::abs(number(json["final"], "coordinates", "x") + 18.23918484310695690258495) < 1e-10);
    CHECK(std::abs(number(json["final"], "rates", "phi") - 0.00034352657603529491905111653790) < 1e-10);
    CHECK(!json["final"].contains("speeds"));
}

// 7 x'' = −2 Ω y', 7 y'' = 2 Ω x': a circle run with k = 2Ω/7 from the state at the start.
TEST_CASE("commands: a ball on a turntable runs on a circle") {
    const std::string scene = source_path("scenes/textbook/ball_on_turntable.toml");
    const Json start = json_of({"eval", scene, "--json"});
    const double x = number(start, "coordinates", "x"), y = number(start, "coordinates", "y"),
                 vx = number(start, "rates", "x"), vy = number(start, "rates", "y"), k = 2 * 3.0 / 7, t = 2;
    CHECK(std::abs(vx - (0.05 * 4.0 - 3.0 * y)) < 1e-13);
    for (const char* by : {"kane", "routh"}) {
        CAPTURE(by);
        const Json end = json_of({"simulate", scene, "--json", "--by", by, "--tolerance", "1e-11"})["final"];
        const double s = std::sin(k * t) / k, h = (1 - std::cos(k * t)) / k;
        // A few hundred steps of local errors of 1e-11, on angles that reach 10².
        CHECK(std::abs(number(end, "coordinates", "x") - (x + vx * s - vy * h)) < 1e-9);
        CHECK(std::abs(number(end, "coordinates", "y") - (y + vy * s + vx * h)) < 1e-9);
    }
}

TEST_CASE("commands: a free body in body components keeps its energy and moves as by Lagrange's equations") {
    const std::string scene = source_path("scenes/textbook/free_body.toml");
    const Json kane = json_of({"simulate", scene, "--json", "--tolerance", "1e-12"}),
               lagrange = json_of({"simulate", scene, "--json", "--by", "lagrange", "--tolerance", "1e-12"});
    CHECK(kane["energy_drift"].get<double>() < 1e-12);
    for (const char* q : {"psi", "theta", "phi"}) {
        CHECK(std::abs(number(kane["final"], "coordinates", q) - number(lagrange["final"], "coordinates", q)) <
              1e-9);
        CHECK(std::abs(number(kane["final"], "rates", q) - number(lagrange["final"], "rates", q)) < 1e-9);
    }
}

TEST_CASE("commands: all ways of elimination give the same motion, multipliers and speeds") {
    for (const char* file : {"tests/odd/speeds_oblique.toml", "tests/odd/speeds_with_multipliers.toml",
                             "tests/odd/speeds_all_eliminated.toml"}) {
        CAPTURE(file);
        const std::string other = std::string(file).find("oblique") != std::string::npos ? "lagrange" : "routh";
        const Json a = json_of({"eval", source_path(file), "--json"}),
                   b = json_of({"eval", source_path(file), "--json", "--by", other});
        for (const char* group : {"rates", "accelerations", "speeds", "speed_rates", "multipliers", "outputs"})
            for (const auto& item : b[group].items()) {
                const std::string name = item.key();
                const double value = item.value().get<double>();
                CAPTURE(group);
                CAPTURE(name);
                CHECK(std::abs(a[group][name].get<double>() - value) < 1e-11 * (1 + std::abs(value)));
            }
        const Json first = json_of(
                       {"simulate", source_path(file), "--json", "--duration", "1", "--tolerance", "1e-11"}),
                   second = json_of({"simulate", source_path(file), "--json", "--duration", "1", "--tolerance",
                                     "1e-11", "--by", other});
        CHECK(first["formulation"].get<std::string>().rfind("kane", 0) == 0);
        for (const auto& item : second["final"]["coordinates"].items())
            CHECK(std::abs(number(first["final"], "coordinates", item.key().c_str()) -
                           item.value().get<double>()) < 1e-8);
    }
}

TEST_CASE("commands: eval and simulate give speeds by name, and rates by coordinate") {
    const std::string scene = source_path("scenes/textbook/chaplygin_sleigh_in_speeds.toml");
    const Json json = json_of({"eval", scene, "--json", "--at", "v=0.3", "--at", "w=-1", "--at", "phi=0.4"});
    CHECK(json["speeds"] == Json{{"v", 0.3}, {"w", -1.0}});  // as given, not computed from the rates
    CHECK(std::abs(number(json, "speed_rates", "v") - 0.5) < 1e-15);
    CHECK(std::abs(number(json, "speed_rates", "w") - 0.5 * 0.3 / 1.25) < 1e-15);
    CHECK(std::abs(number(json, "rates", "x") - 0.3 * std::cos(0.4)) < 1e-15);
    CHECK(json_of({"derive", scene, "--json"})["speeds"] == Json{"v", "w"});
    const std::string file = temporary("sleigh.csv", "");
    json_of({"simulate", scene, "--json", "-o", file});
    std::ifstream csv(file);
    std::string header;
    std::getline(csv, header);
    CHECK(header == "t,x,y,phi,x',y',phi',lambda_blade,energy,v,w");
}

TEST_CASE("commands: wrong speeds are refused with the reason") {
    const auto fails = [](const std::string& speeds, const std::vector<std::string>& more, int exit,
                          const std::string& message) {
        std::vector<std::string> args{
            "eval",
            temporary("speeds.toml", "[coordinates]\nx = 0.1\ny = 0.2\n[speeds]\n" + speeds +
                                         "[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", \"y\"]\n")};
        args.insert(args.end(), more.begin(), more.end());
        const auto result = run(args);
        CAPTURE(result.err);
        CHECK(result.exit == exit);
        CHECK(result.err.find(message) != std::string::npos);
    };
    fails("u = \"x'\"\n", {}, 3, "there is 1 generalized speed");
    fails("u = \"x'\"\nv = \"x'*y\"\n", {}, 3, "speeds.toml:6:1: speed 'v' is a combination");
    fails("u = \"x'\"\nv = \"y'\"\n", {"--at", "u=1"}, 3, "the scene gives rates");
    fails("u = { form = \"x'\", initial = 2 }\nv = \"y'\"\n", {"--at", "x'=1"}, 3,
          "the rates follow from the speeds");
    fails("u = { form = \"(x-0.1)*x'\", initial = 2 }\nv = \"y'\"\n", {}, 4, "lose rank at these coordinates");
    fails("u = \"(x-0.1)*x'\"\nv = \"y'\"\n", {}, 4, "there are no finite accelerations");
}

}  // namespace commands_speeds
