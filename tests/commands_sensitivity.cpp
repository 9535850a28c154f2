// SPDX-License-Identifier: MIT
// `simulate --sensitivity` against differences of motions in 34-digit arithmetic.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "derive/derived.hpp"
#include "program.hpp"
#include "run/reference.hpp"
#include "run/simulate.hpp"
#include "scenes.hpp"

namespace commands_sensitivity {

using namespace alembert;
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

/// Coordinates, then rates at the end.
std::vector<Quad> end_of(const std::string& text) {
    const Derived d = derived(parse_scene(text, "spring.toml"), {.use = Use::run});
    const Start start = start_of(d.mechanism);
    const auto at = reference(lowered(d).program, quad_start(d.mechanism, d.equations, start, {}), {});
    REQUIRE(at);
    std::vector<Quad> all = at->coordinates;
    all.insert(all.end(), at->rates.begin(), at->rates.end());
    return all;
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
    "simulate --sensitivity: names that cannot vary and motions that are not smooth are refused with a reason") {
    const auto refused = [](const char* scene, const char* names) {
        const auto result = run({"simulate", source_path(scene), "--sensitivity", names});
        CHECK(result.exit == 3);
        return result.err;
    };
    CHECK(refused("scenes/textbook/double_pendulum.toml", "tehta1").find("'theta1'") != std::string::npos);
    CHECK(refused("scenes/textbook/double_pendulum.toml", "t").find("neither") != std::string::npos);
    CHECK(refused("scenes/textbook/cartesian_pendulum.toml", "x").find("constraints") != std::string::npos);
    CHECK(refused("scenes/friction/coulomb_oscillator.toml", "x").find("friction") != std::string::npos);
}

}  // namespace commands_sensitivity
