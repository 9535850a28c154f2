// SPDX-License-Identifier: MIT
// The loads of given accelerations where friction and contacts are at rest, against M q'' and the law of friction.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"

namespace commands_inverse_friction {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

Json loads(const std::string& scene, std::vector<std::string> at, std::size_t warnings = 0) {
    std::vector<std::string> args{"eval", scene, "--inverse", "--at"};
    args.insert(args.end(), at.begin(), at.end());
    const Json found = json_of(args);
    CHECK(found["warnings"].size() == warnings);
    for (const Json& one : found["warnings"]) CHECK(one["kind"] == "left_out");
    return found["loads"];
}

double load(const Json& loads, const char* name) {
    return loads[name].get<double>();
}

constexpr double tolerance = 1e-13;  // of loads of the size of 1 to 10

}  // namespace

TEST_CASE(
    "inverse: friction at rest acts against the sliding that the accelerations begin, and one that sticks is "
    "told") {
    const std::string wrist = temporary("wrist.toml", R"(coordinates = { q = 0 }
[energy]
kinetic = "0.02*q'^2/2"
[[friction]]
name = "seal"
coefficient = 0.3
static = 0.5
slip = "q'"
normal = 2
)");
    CHECK(std::abs(load(loads(wrist, {"q''=10"}), "q") - (0.2 + 0.6)) < tolerance);
    CHECK(std::abs(load(loads(wrist, {"q''=-10"}), "q") + (0.2 + 0.6)) < tolerance);
    CHECK(std::abs(load(loads(wrist, {"q''=10", "q'=-1"}), "q") - (0.2 - 0.6)) < tolerance);
    CHECK(load(loads(wrist, {"q''=0"}, 1), "q") == 0);
    const std::string said = alembert::test::run({"eval", wrist, "--inverse", "--at", "q''=0"}).err;
    CHECK(said.find("friction 'seal' does not slide here: it bears any force up to 1,") != std::string::npos);
    CHECK(alembert::test::run({"eval", wrist, "--inverse", "--strict"}).exit == 3);
}

TEST_CASE(
    "inverse: friction in a plane at rest acts along the acceleration of the slip, while it slides along the "
    "slip") {
    const std::string table = temporary("table.toml", R"(coordinates = { x = 0, y = 0 }
[[particle]]
name = "p"
mass = 2
position = ["x", "y"]
[[friction]]
name = "table"
coefficient = 0.5
slip = ["x'", "y'"]
normal = 20
)");
    const Json begins = loads(table, {"x''=3", "y''=4"});
    CHECK(std::abs(load(begins, "x") - (6 + 10 * 0.6)) < tolerance);
    CHECK(std::abs(load(begins, "y") - (8 + 10 * 0.8)) < tolerance);
    const Json slides = loads(table, {"x''=3", "y''=4", "x'=-2"});
    CHECK(std::abs(load(slides, "x") - (6 - 10)) < tolerance);
    CHECK(std::abs(load(slides, "y") - 8) < tolerance);
    const Json sticks = loads(table, {"x''=0", "y''=0"}, 1);
    CHECK(load(sticks, "x") == 0);
}

TEST_CASE(
    "inverse: friction at rest counts along the coordinates that follow, and on a belt that changes its speed") {
    // x = 2 y moves the block that rubs: with x'' = 4 the belt's block has y'' = 2, and its friction acts half on
    // x.
    const std::string pair = temporary("pair.toml", R"(coordinates = { x = 0, y = 0 }
[[particle]]
name = "p"
mass = 3
position = ["x", 0]
[[particle]]
name = "q"
mass = 1
position = ["y", 1]
[[constraint]]
name = "c"
holonomic = "x = 2*y"
[[friction]]
name = "floor"
coefficient = 0.5
slip = "y'"
normal = 8
)");
    CHECK(std::abs(load(loads(pair, {"x''=4"}), "x") - (3 * 4 + (1 * 2 + 4) / 2.)) < tolerance);
    CHECK(std::abs(load(loads(pair, {"x''=-4"}), "x") + (3 * 4 + (1 * 2 + 4) / 2.)) < tolerance);
    // The belt runs at 1 + 6 t: where the block has its speed, it slides back unless it has its acceleration.
    const std::string belt = temporary("belt.toml", R"(coordinates = { x = { initial = 0, rate = 1 } }
[[particle]]
name = "p"
mass = 3
position = ["x", 0]
[[friction]]
name = "belt"
coefficient = 0.5
slip = "x' - 1 - 6*t"
normal = 8
)");
    CHECK(std::abs(load(loads(belt, {"x''=2"}), "x") - (3 * 2 - 4)) < tolerance);
    CHECK(std::abs(load(loads(belt, {"x''=7"}), "x") - (3 * 7 + 4)) < tolerance);
    CHECK(std::abs(load(loads(belt, {"x''=6"}, 1), "x") - 3 * 6) < tolerance);
}

TEST_CASE("inverse: a closed contact that the accelerations do not open is told") {
    const std::string stop = temporary("stop.toml", R"(coordinates = { x = 0 }
[[particle]]
name = "p"
mass = 3
position = ["x", 0]
[[unilateral]]
name = "stop"
gap = "x"
)");
    CHECK(load(loads(stop, {"x''=0"}, 1), "x") == 0);
    CHECK(load(loads(stop, {"x''=2"}), "x") == 6);
    CHECK(load(loads(stop, {"x''=0", "x=1"}), "x") == 0);
    CHECK(load(loads(stop, {"x''=0", "x'=1"}), "x") == 0);
    CHECK(load(loads(stop, {"x''=-1", "x=1"}), "x") == -3);
    const auto into = run({"inverse", stop, "--at", "x''=-1"});
    CHECK(into.exit == 3);
    CHECK_MESSAGE(into.err.find("go into contact 'stop'") != std::string::npos, into.err);
}

}  // namespace commands_inverse_friction
