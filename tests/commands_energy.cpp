// SPDX-License-Identifier: MIT
// Whether energy is conserved if a given motion leaves T₁ and T₀ in T although t itself cancels. The verdict of
// `simulate` is compared with E from `eval` at the two ends of the run.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "json.hpp"
#include "program.hpp"

namespace commands_energy {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

const std::string run_table = "[simulation]\nduration = 3\ntolerance = 1e-12\n";

// Zhang & Qin call it a gyroscope with two degrees of freedom: the axis stays horizontal on the turning Earth.
const std::string gyrocompass = R"toml(
[parameters]
Om = 0.5
A = 1.0
C = 2.0
lat = 0.7
[coordinates]
alpha = 0.3
psi = { initial = 0, rate = 20 }
[[frame]]
name = "E"
rotate = [["z", "Om*t"], ["y", "pi/2 - lat"]]
[[frame]]
name = "G"
parent = "E"
rotate = [["x", "alpha"]]
[[frame]]
name = "R"
parent = "G"
rotate = [["z", "psi"]]
[[body]]
name = "rotor"
at = "O"
mass = 1
frame = "R"
inertia = ["A", "A", "C"]
)toml";

const std::string arm = R"toml(
gravity = [0, 0, -9.81]
[parameters]
Om = 2.0
[coordinates]
th = 0.4
[[frame]]
name = "T"
rotate = [["z", "Om*t"]]
[[particle]]
name = "P"
mass = 1.5
position = ["0.2 + sin(th)", 0, "-cos(th)"]
axes = "T"
)toml";

const std::string jointed = R"toml(
gravity = [0, 0, -9.81]
[[body]]
name = "A"
mass = 1
inertia = [1, 1, 1]
[[joint]]
name = "a"
type = "revolute"
parent = "N"
child = "A"
motion = { phi = "2*t" }
coordinates = { phi = 0 }
[[body]]
name = "B"
mass = 1.5
inertia = [0.3, 0.4, 0.5]
[[joint]]
name = "b"
type = "revolute"
parent = "A"
child = "B"
parent_point = [0.2, 0, 0]
child_point = [0, 0, 1]
axis = "y"
coordinates = { th = 0.4 }
)toml";

/// E at the final state of a run.
double energy_at(const std::string& scene, const Json& state) {
    std::vector<std::string> words{"eval", scene, "--json", "--at",
                                   fmt::format("t={:.17g}", state["time"].get<double>())};
    for (const auto& [name, value] : state["coordinates"].items())
        words.push_back(fmt::format("{}={:.17g}", name, value.get<double>()));
    for (const auto& [name, value] : state["rates"].items())
        words.push_back(fmt::format("{}'={:.17g}", name, value.get<double>()));
    return json_of(words)["energy"];
}

}  // namespace

TEST_CASE(
    "commands: where a given motion leaves T1 and T0 in T, energy is not conserved and Jacobi's integral is") {
    for (const std::string& text : {gyrocompass, arm}) {
        const std::string scene = temporary("driven.toml", text + run_table);
        const auto result = run({"simulate", scene, "--json"});
        REQUIRE(result.exit == 0);
        const Json json = Json::parse(result.out);
        const auto first = run({"eval", scene, "--json"});
        const double E = energy_at(scene, json["final"]), E0 = Json::parse(first.out)["energy"];
        CHECK(std::abs(E - E0) > 1e-3);
        CHECK(json["energy_drift"].is_null());
        CHECK(json["work_balance"].get<double>() < 1e-10);
        CHECK(json["jacobi_drift"].get<double>() < 1e-10);
    }
}

TEST_CASE("commands: a prescribed motion does work, and an input that moves nothing does none") {
    const auto driven = run({"simulate", temporary("driven.toml", jointed + run_table), "--json"});
    REQUIRE(driven.exit == 0);
    const Json json = Json::parse(driven.out);
    CHECK(json["energy_drift"].is_null());
    CHECK(json["work_balance"].get<double>() < 1e-9);

    // The frame turns, but it carries only a ball, whose orientation does not matter: T = ½ m r'² along its z
    // axis.
    const std::string idle = temporary("idle.toml", R"toml(
[coordinates]
r = { initial = 0.2, rate = 1 }
[[frame]]
name = "T"
rotate = [["z", "t"]]
[[particle]]
name = "P"
mass = 2
position = [0, 0, "r"]
axes = "T"
[[spring]]
along = "r"
stiffness = 3
)toml" + run_table);
    const auto free = run({"simulate", idle, "--json"});
    REQUIRE(free.exit == 0);
    CHECK(Json::parse(free.out)["energy_drift"].get<double>() < 1e-10);
}

}  // namespace commands_energy
