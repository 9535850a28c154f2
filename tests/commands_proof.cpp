// SPDX-License-Identifier: MIT
// `simulate --proof`: every box holds the motion in 34-digit arithmetic, by two methods that share nothing with
// the proof but the graph, and closed forms.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/derive/derived.hpp"
#include "analysis/state/assemble.hpp"
#include "program.hpp"
#include "proof/proof.hpp"
#include "scenes.hpp"
#include "simulate/reference.hpp"

namespace commands_proof {

using namespace alembert;
using alembert::test::contents;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

/// Coordinates, then rates or speeds at the end, with 20 digits that two methods agree on.
std::vector<Quad> exact_end(const std::string& text, double duration) {
    const Derived d = derived(parse_scene(text, "scene.toml"), {.use = Use::run});
    Start start = start_of(d.mechanism);
    assemble(start, d.mechanism, lower_constraints(d.mechanism), {});
    const auto at = reference(lowered(d).program, quad_start(d.mechanism, d.equations, start, duration), {});
    REQUIRE(at);
    REQUIRE(at->digits >= 18);
    std::vector<Quad> result = at->coordinates;
    const std::vector<Quad>& rates = at->speeds.empty() ? at->rates : at->speeds;
    result.insert(result.end(), rates.begin(), rates.end());
    return result;
}

double width(const Interval& x) {
    return x.high - x.low;
}

/// Proves the motion and holds the end against the reference. Returns the widest box.
double widest_of(const std::string& text, double duration) {
    const Proof proof = prove(parse_scene(text, "scene.toml"), {.duration = duration});
    CHECK(proof.motion.complete);
    const std::vector<Quad> exact = exact_end(text, duration);
    const std::vector<Interval>& box = proof.motion.rows.back().box;
    REQUIRE(box.size() == exact.size());
    double widest = 0;
    for (std::size_t i = 0; i < box.size(); ++i) {
        CAPTURE(proof.names[i]);
        CHECK(static_cast<Quad>(box[i].low) < exact[i]);
        CHECK(exact[i] < static_cast<Quad>(box[i].high));
        widest = std::max(widest, width(box[i]));
    }
    return widest;
}

/// A plane pendulum with a potential of its own, random numbers and all functions that have a series.
std::string with_forces(const std::string& forces) {
    return "[parameters]\nm = 1.3\nk = 2.7\nc = 0.1\n[coordinates]\nx = { initial = 0.4, rate = 0.9 }\ny = { "
           "initial "
           "= 0.3, rate = -0.7 }\n[energy]\nkinetic = \"m*(x'^2 + y'^2 + x'*y'*cos(x - y))/2\"\npotential = "
           "\"k*(x^2 + y^2)/2\"\n[forces]\n" +
           forces;
}

}  // namespace

TEST_CASE("proof: boxes of scenes hold the motion in 34 digits") {
    const std::pair<const char*, double> scenes[] = {
        {"textbook/double_pendulum", 3}, {"benchmark/kepler", 2},          {"textbook/spherical_pendulum", 2},
        {"textbook/heavy_top", 1},       {"textbook/elastic_pendulum", 3}, {"textbook/crane", 3},
        {"textbook/swinging_atwood", 2}, {"textbook/two_centres", 2}};
    for (const auto& [name, duration] : scenes) {
        CAPTURE(name);
        CHECK(widest_of(contents(source_path(std::string("scenes/") + name + ".toml")), duration) < 1e-8);
    }
}

TEST_CASE("proof: each function with a series, and equations that are solved order by order") {
    for (const char* const forces :
         {"x = \"-c*x' + exp(-x^2)*sin(2*t)\"", "x = \"tanh(3*x) - tan(y/2)\"",
          "x = \"log(2 + x)\"\ny = \"atan(x*y)\"", "x = \"sqrt(3 + x) - asin(x/4)\"\ny = \"acos(y/5)\"",
          "y = \"atan2(1 + y, 2 + x)\"", "x = \"(2 + x)^1.7 - (3 + y)^(-2)\"", "x = \"cosh(x) - sinh(y)\"",
          "x = \"1/(2 + x*y)^3\""}) {
        CAPTURE(forces);
        CHECK(widest_of(with_forces(forces), 1.5) < 1e-9);
    }
    std::string chain = "gravity = [0, \"-9.81\"]\n[coordinates]\n", particles, x, y;
    for (const std::string k : {"1", "2", "3", "4"}) {
        chain += "a" + k + " = { initial = 0." + k + ", rate = 0.3 }\n";
        x += (x.empty() ? "0.5*sin(a" : " + 0.5*sin(a") + k + ")", y += " - 0.5*cos(a" + k + ")";
        particles +=
            "[[particle]]\nname = \"P" + k + "\"\nmass = 1." + k + "\nposition = [\"" + x + "\", \"" + y + "\"]\n";
    }
    chain += particles;
    CHECK(widest_of(chain, 1) < 1e-6);
}

TEST_CASE("proof: decimals are exact, rows contain closed forms") {
    const std::string fall =
        temporary("fall.toml",
                  "[parameters]\ng = 9.81\n[coordinates]\nz = { initial = 0.1, rate = 0.3 }\nx = { initial = 1 "
                  "}\n[energy]\nkinetic = "
                  "\"z'^2/2 + x'^2/2\"\npotential = \"g*z + x^2/2\"\n[simulation]\nduration = 3\nsample = 0.1\n");
    const auto done = run({"simulate", fall, "--proof", "--json"});
    CHECK(done.exit == 0);
    const Json proof = Json::parse(done.out)["proof"];
    CHECK(proof["complete"] == true);
    CHECK(proof["rows"].size() == 31);
    for (const Json& row : proof["rows"]) {
        const long double t = row["time"].get<double>();
        const long double z = 0.1L + 0.3L * t - 4.905L * t * t, x = std::cos(t);
        CHECK(static_cast<long double>(row["low"][0].get<double>()) <= z);
        CHECK(z <= static_cast<long double>(row["high"][0].get<double>()));
        CHECK(static_cast<long double>(row["low"][1].get<double>()) <= x);
        CHECK(x <= static_cast<long double>(row["high"][1].get<double>()));
    }
    CHECK(proof["rows"].back()["high"][1].get<double>() - proof["rows"].back()["low"][1].get<double>() < 1e-13);
}

TEST_CASE("proof: where it ends, what is refused") {
    const std::string escape = temporary(  // x' = x², so that x is infinite at t = 1
        "escape.toml",
        "[states]\nz = { initial = 1, rate = \"z^2\" }\n[coordinates]\nx = 0\n[energy]\nkinetic = "
        "\"x'^2/2\"\npotential = \"x^2\"\n[simulation]\nduration = 2\n");
    const auto ended = run({"simulate", escape, "--proof", "--json"});
    CHECK(ended.exit == 4);
    const Json proof = Json::parse(ended.out)["proof"];
    CHECK(proof["complete"] == false);
    CHECK(proof["proved_until"].get<double>() < 1);
    CHECK(proof["proved_until"].get<double>() > 0.9);
    CHECK(run({"simulate", escape, "--proof"}).out.find("not proved after t = ") != std::string::npos);
    const auto rolls = run({"simulate", source_path("scenes/textbook/sled.toml"), "--proof"});
    CHECK(rolls.exit == 3);
    CHECK(rolls.err.find("constraints are not proved") != std::string::npos);
    CHECK(run({"simulate", escape, "--proof", "--method", "taylor"}).exit == 3);
}

TEST_CASE("proof: where a function jumps or has a pole it ends") {
    for (const auto& [force, at] : {std::pair("atan2(t-1,-1)", 1.0),
                                    {"atan2(sin(t),cos(t))", std::acos(-1.0)},
                                    {"-atan2(x-1,-1)", 0.9},
                                    {"atan(1/(t-1))", 1.0},
                                    {"tan(t)", std::acos(0.0)}}) {
        CAPTURE(force);
        const Proof proof =
            prove(parse_scene(fmt::format("[coordinates]\nx = {{ initial = 0, rate = 1 }}\n[energy]\nkinetic = "
                                          "\"x'^2/2\"\n[forces]\nx = \"{}\"\n",
                                          force),
                              "jump.toml"),
                  {.duration = 4});
        CHECK(!proof.motion.complete);
        CHECK(proof.motion.reached <= at + 0.6);
    }
}

/// Whether the box of this component at the end, which may be an earlier one, holds the value; what is not proved
/// to the end claims nothing of it.
bool holds_at_end(const std::string& scene, std::size_t component, long double value, double duration) {
    const Proof proof = prove(parse_scene(scene, "hard.toml"), {.duration = duration});
    if (!proof.motion.complete) return true;
    const Interval& box = proof.motion.rows.back().box[component];
    return static_cast<long double>(box.low) <= value && value <= static_cast<long double>(box.high);
}

TEST_CASE("proof: underflow, late starts and initial values that cancel") {
    const std::string free = "[energy]\nkinetic = \"x'^2/2\"\n[forces]\nx = ";
    // a b c d = 1 where a b underflows
    CHECK(holds_at_end("[parameters]\na = 1e-200\nb = 1e-200\nc = 1e200\nd = 1e200\n[coordinates]\nx = 0\n" +
                           free + "\"a*b*c*d\"\n",
                       1, 2, 2));
    // from 1000000 to 1000000.1, which is no double
    const std::string late = "[coordinates]\nx = 0\n" + free + "\"1000000\"\n[simulation]\nstart = 1000000\n";
    CHECK(holds_at_end(late, 0, 5000, 0.1));
    CHECK(holds_at_end(late, 1, 100000, 0.1));
    // k (√(10⁴⁰ + 1) − 10²⁰) = 5
    CHECK(holds_at_end(
        "[parameters]\nk = 1e21\nbig = 1e40\n[coordinates]\nx = { initial = \"k*(sqrt(big+1) - 1e20)\" "
        "}\n" +
            free + "\"-x\"\n",
        0, 5 * std::cos(1.0L), 1));
    // no motion at all: log(−1)
    const Proof none =
        prove(parse_scene("[parameters]\nF = 0\n[coordinates]\nx = -1\n" + free + "\"F*log(x)\"\n", "none.toml"),
              {.duration = 1});
    CHECK(!none.motion.complete);
}

}  // namespace commands_proof
