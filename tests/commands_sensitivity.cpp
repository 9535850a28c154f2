// SPDX-License-Identifier: MIT
// `simulate --sensitivity` against differences of motions in 34-digit arithmetic.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/derive/derived.hpp"
#include "analysis/state/assemble.hpp"
#include "edits.hpp"
#include "program.hpp"
#include "scenes.hpp"
#include "simulate/reference.hpp"
#include "simulate/simulate.hpp"

namespace commands_sensitivity {

using namespace alembert;
using alembert::test::contents;
using alembert::test::edited;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using Json = nlohmann::json;
using Values = std::map<std::string, double>;

namespace {

/// A mass on a spring that swings in the plane, damped and driven; where it starts depends on k.
std::string swinging_spring(Values v) {
    const auto number = [&](const char* name) { return nlohmann::json(v.at(name)).dump(); };
    return "title = \"swinging spring\"\ngravity = [0, \"-g\"]\n[parameters]\ng = 9.81\nl = 1\nm = " +
           number("m") + "\nk = " + number("k") +
           "\n[coordinates]\nr = { initial = \"l + k/400\", rate = " + number("r'") +
           " }\nphi = { initial = " + number("phi") + R"toml(, rate = 0.3 }
[[particle]]
name = "P"
mass = "m"
position = ["r*sin(phi)", "-r*cos(phi)"]
[[spring]]
along = "r"
stiffness = "k"
length = "l"
[forces]
phi = "-0.1*phi' + 0.2*sin(3*t)"
[simulation]
duration = 2
)toml";
}

/// Coordinates, then rates or speeds at the end.
std::vector<Quad> end_of(const std::string& text) {
    const Derived d = derived(parse_scene(text, "spring.toml"), {.use = Use::run});
    Start start = start_of(d.mechanism);
    assemble(start, d.mechanism, lower_constraints(d.mechanism), {});
    const auto at = reference(lowered(d).program, quad_start(d.mechanism, d.equations, start, {}), {});
    REQUIRE(at);
    std::vector<Quad> all = at->coordinates;
    const std::vector<Quad>& rates = at->speeds.empty() ? at->rates : at->speeds;
    all.insert(all.end(), rates.begin(), rates.end());
    return all;
}

/// A value in a scene's text: "NUMBER" stands for it in the line.
struct Varied {
    std::string name, line, number;
    double value() const { return std::stod(number); }
};

std::string with_value(const std::string& text, const Varied& v, double value) {
    return edited(text,
                  {{edited(v.line, {{"NUMBER", v.number}}), edited(v.line, {{"NUMBER", Json(value).dump()}})}});
}

/// The derivative of a list of numbers that follows from a value, by differences of fourth order. The motions have
/// at least 17 digits.
template <typename Values>
std::vector<double> slope(const Varied& v, const Values& values) {
    const double h = 1e-4 * std::max(0.1, std::abs(v.value()));
    std::vector<Quad> sums;
    for (const int step : {-2, -1, 1, 2}) {
        const std::vector<Quad> all = values(v.value() + step * h);
        sums.resize(all.size());
        const Quad weight = static_cast<Quad>((step * step == 1 ? 8 : -1) * (step > 0 ? 1 : -1)) / (12 * Quad(h));
        for (std::size_t i = 0; i < all.size(); ++i) sums[i] += weight * all[i];
    }
    std::vector<double> result;
    for (const Quad sum : sums) result.push_back(static_cast<double>(sum));
    return result;
}

/// The derivatives at the end are those of differences of the motions in 34 digits, relative to the largest one.
void check_derivatives(const std::string& text, const std::vector<Varied>& all) {
    std::vector<std::string> names;
    for (const Varied& v : all) names.push_back(v.name);
    const Run run =
        simulate(parse_scene(text, "scene.toml"), {.tolerance = 1e-12, .estimate = false, .sensitivity = names});
    REQUIRE(run.sensitivity);
    for (std::size_t c = 0; c < all.size(); ++c) {
        const std::vector<double> expected =
            slope(all[c], [&](double value) { return end_of(with_value(text, all[c], value)); });
        REQUIRE(expected.size() == run.sensitivity->of.size());
        double largest = 1;
        for (const double x : expected) largest = std::max(largest, std::abs(x));
        for (std::size_t i = 0; i < expected.size(); ++i) {
            INFO(run.sensitivity->of[i] << " by " << all[c].name);
            CHECK(std::abs(run.sensitivity->values[i][c] - expected[i]) <= 1e-9 * largest);
        }
    }
}

}  // namespace

TEST_CASE("simulate --sensitivity: the derivatives of the end are those of differences in 34 digits") {
    const Values nominal{{"m", 1.25}, {"k", 40}, {"phi", 0.5}, {"r'", 0.75}};
    const std::vector<std::string> names{"k", "phi", "m", "r'"};
    const std::string file = temporary("sensitivity.toml", swinging_spring(nominal));
    const auto result =
        run({"simulate", file, "--sensitivity", "k,phi,m,r'", "--tolerance", "1e-12", "--no-estimate", "--json"});
    REQUIRE(result.exit == 0);
    const Json found = Json::parse(result.out)["sensitivity"];
    CHECK(found["of"] == Json({"r", "phi", "r'", "phi'"}));
    CHECK(found["by"] == Json(names));
    CHECK(found["time"] == 2);
    const Run same = simulate(parse_scene(swinging_spring(nominal), "spring.toml"),
                              {.tolerance = 1e-12, .estimate = false, .sensitivity = names});
    REQUIRE(same.sensitivity);
    constexpr double step = 1e-6;
    for (std::size_t c = 0; c < names.size(); ++c) {
        Values above = nominal, below = nominal;
        above[names[c]] += step;
        below[names[c]] -= step;
        const std::vector<Quad> up = end_of(swinging_spring(above)), down = end_of(swinging_spring(below));
        for (std::size_t i = 0; i < 4; ++i) {
            const double expected =
                static_cast<double>((up[i] - down[i]) / static_cast<Quad>(above[names[c]] - below[names[c]]));
            INFO("component " << i << " by " << names[c]);
            CHECK(std::abs(found["values"][i][c].get<double>() - expected) <= 1e-9);
            CHECK(same.sensitivity->values[i][c] == found["values"][i][c].get<double>());
        }
    }
}

TEST_CASE(
    "simulate --sensitivity: with constraints guesses follow, and the derivatives are those of differences") {
    const std::string crank =
        edited(contents(source_path("scenes/textbook/slider_crank.toml")), {{"duration = 3", "duration = 0.7"}});
    check_derivatives(crank, {{"r", "r  = { value = NUMBER", "0.15"},
                              {"l", "l  = { value = NUMBER", "0.4"},
                              {"m2", "m2 = { value = NUMBER", "0.8"},
                              {"alpha", "alpha = { initial = NUMBER", "0.3"},
                              {"alpha'", "rate = NUMBER", "12"}});
}

TEST_CASE("simulate --sensitivity: speeds, rolling without slipping and quaternions, against differences") {
    const std::string sleigh = edited(contents(source_path("scenes/textbook/chaplygin_sleigh_in_speeds.toml")),
                                      {{"duration = 10", "duration = 3"}});
    check_derivatives(sleigh, {{"a", "a = { value = NUMBER", "0.5"},
                               {"phi", "phi = { initial = NUMBER", "0"},
                               {"w", "form = \"phi'\", initial = NUMBER", "2.0"}});
    const std::string body = edited(contents(source_path("scenes/textbook/free_body_quaternion.toml")),
                                    {{"duration = 50", "duration = 4"}});
    check_derivatives(body, {{"B", "B = { value = NUMBER", "2.0"}, {"w1", "ex(F))\", initial = NUMBER", "0.01"}});
}

TEST_CASE(
    "simulate --sensitivity-of: the adjoint equations give the derivatives of differences, for outputs too") {
    const std::string text =
        edited(contents(source_path("scenes/textbook/slider_crank.toml")), {{"duration = 3", "duration = 0.7"}}) +
        "\n[outputs]\nformula = \"r*alpha'^2 + l*x\"\npush = \"m3*x''\"\n";
    const std::vector<Varied> all{
        {"r", "r  = { value = NUMBER", "0.15"}, {"l", "l  = { value = NUMBER", "0.4"},
        {"m3", "m3 = { value = NUMBER", "2.0"}, {"alpha", "alpha = { initial = NUMBER", "0.3"},
        {"alpha'", "rate = NUMBER", "12"},      {"g", "g  = { value = NUMBER", "9.81"}};
    const auto found = [&](const std::vector<std::string>& names, const std::vector<std::string>& of) {
        const Run run =
            simulate(parse_scene(text, "scene.toml"),
                     {.tolerance = 1e-12, .estimate = false, .sensitivity = names, .sensitivity_of = of});
        REQUIRE(run.sensitivity);
        return *run.sensitivity;
    };
    const Sensitivity s = found({"r", "l", "m3", "alpha", "alpha'", "g"}, {"formula", "x'", "push"});
    CHECK(s.adjoint);
    for (std::size_t c = 0; c < all.size(); ++c) {
        INFO("by " << all[c].name);
        const std::vector<double> expected = slope(all[c], [&](double value) {
            const std::vector<Quad> end = end_of(with_value(text, all[c], value));
            const Quad r = all[c].name == "r" ? value : Quad(15) / 100,
                       l = all[c].name == "l" ? value : Quad(4) / 10;
            return std::vector<Quad>{r * end[3] * end[3] + l * end[2], end[5]};
        });
        for (std::size_t i = 0; i < 2; ++i)
            CHECK(std::abs(s.values[i][c] - expected[i]) <= 1e-9 * std::max(1.0, std::abs(expected[i])));
        // Another way to each: forwards, one name alone.
        const Sensitivity forward = found({all[c].name}, {"formula", "x'", "push"});
        CHECK(!forward.adjoint);
        for (std::size_t i = 0; i < 3; ++i)
            CHECK(std::abs(s.values[i][c] - forward.values[i][0]) <=
                  1e-9 * std::max(1.0, std::abs(forward.values[i][0])));
    }
    // An output with accelerations, against differences of its values.
    const auto push = [&](double value) {
        const Run run = simulate(parse_scene(with_value(text, all[4], value), "scene.toml"),
                                 {.tolerance = 1e-13, .estimate = false});
        return run.rows.values.back();
    };
    CHECK(std::abs((push(12.0001) - push(11.9999)) / 0.0002 / s.values[2][4] - 1) < 1e-6);
}

TEST_CASE(
    "simulate --sensitivity: names that cannot vary and motions that are not smooth are refused with a reason") {
    const auto refused = [](const char* scene, const char* names) {
        const auto result = run({"simulate", source_path(scene), "--sensitivity", names});
        CHECK(result.exit == 3);
        return result.err;
    };
    CHECK(refused("scenes/textbook/double_pendulum.toml", "tehta1").find("'theta1'") != std::string::npos);
    CHECK(refused("scenes/textbook/double_pendulum.toml", "t").find("neither") != std::string::npos);
    CHECK(refused("scenes/textbook/cartesian_pendulum.toml", "x").find("'x' cannot vary by itself") !=
          std::string::npos);
    CHECK(refused("scenes/textbook/slider_crank.toml", "x").find("cannot vary by itself") != std::string::npos);
    CHECK(refused("scenes/friction/coulomb_oscillator.toml", "x").find("friction") != std::string::npos);
}

TEST_CASE("simulate --sensitivity: a derivative that is infinite is named") {
    const std::string scene = temporary("root.toml", R"toml(
[parameters]
k = 1
[coordinates]
x = { initial = 0, rate = 1 }
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[forces]
x = "k*sqrt(x)"
[simulation]
duration = 1
)toml");
    const auto result = run({"simulate", scene, "--sensitivity", "x"});
    CHECK(result.exit == 4);
    CHECK(result.err.find("d(x')/d(x) (component 3)") != std::string::npos);
}

}  // namespace commands_sensitivity
