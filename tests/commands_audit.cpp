// SPDX-License-Identifier: MIT
// alembert audit as a user calls it: text, JSON, exit codes.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_audit {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

std::string scene(const std::string& coordinates, const std::string& constraints) {
    return temporary("audit.toml",
                     "[coordinates]\n" + coordinates + "\n[energy]\nkinetic = \"x'^2 + y'^2\"\n" + constraints);
}

}  // namespace

TEST_CASE("commands: audit gives the rolling disc's integral in text and JSON") {
    const std::string disc = source_path("scenes/textbook/rolling_disc.toml");
    const auto plain = run({"audit", disc});
    CHECK(plain.exit == 0);
    CHECK(plain.out.find("rolling: x - r*phi = const\n") != std::string::npos);
    CHECK(plain.out.find("rolling: declared nonholonomic, but it is integrable") != std::string::npos);
    CHECK(plain.out.starts_with("2 coordinates, rank 1: 1 degree of freedom\n"));
    const auto result = run({"audit", disc, "--json"});
    REQUIRE(result.exit == 0);
    const Json json = Json::parse(result.out);
    REQUIRE(json["constraints"].size() == 1);
    const Json& rolling = json["constraints"][0];
    CHECK(rolling["name"] == "rolling");
    CHECK(rolling["kind"] == "nonholonomic");
    CHECK(rolling["integrable"] == true);
    CHECK(rolling["integral"] == "x - r*phi");
    CHECK(rolling["redundant"] == false);
    CHECK(rolling["rheonomic"] == false);
    CHECK(json["rank"] == 1);
    CHECK(json["degrees_of_freedom"] == 1);
    CHECK(json["coordinates_free"] == 1);
    const Json sleigh =
        Json::parse(run({"audit", source_path("scenes/textbook/chaplygin_sleigh.toml"), "--json"}).out);
    CHECK(sleigh["constraints"][0]["integrable"] == false);
    CHECK(sleigh["degrees_of_freedom"] == 2);
    CHECK(sleigh["coordinates_free"] == 3);
}

TEST_CASE("commands: audit of a scene without constraints reports nothing, and rank 0") {
    const auto result = run({"audit", source_path("scenes/textbook/double_pendulum.toml"), "--json"});
    REQUIRE(result.exit == 0);
    const Json json = Json::parse(result.out);
    CHECK(json["constraints"] == Json::array());
    CHECK(json["rank"] == 0);
    CHECK(json["degrees_of_freedom"] == 2);
}

TEST_CASE("commands: audit reports adjusted values") {
    const auto result = run({"audit", source_path("scenes/textbook/four_bar.toml"), "--json"});
    REQUIRE(result.exit == 0);
    const Json adjusted = Json::parse(result.out)["adjusted"];
    REQUIRE(adjusted.size() == 4);
    CHECK(adjusted[0]["name"] == "beta");
    CHECK(adjusted[0]["from"] == 0.6);
    CHECK(adjusted[1]["name"] == "beta'");
}

TEST_CASE("commands: audit reports what is wrong with the constraints before it fails") {
    const auto one = [](const std::string& name, const std::string& rule) {
        return "[[constraint]]\nname = \"" + name + "\"\n" + rule + "\n";
    };
    const std::string circle = one("circle", "holonomic = \"x^2 + y^2 = 1\""),
                      larger = one("larger", "holonomic = \"x^2 + y^2 = 2\"");
    const auto contradictory = run({"audit", scene("x = 1\ny = 0", circle + larger), "--json"});
    CHECK(contradictory.exit == 3);
    CHECK(contradictory.err.find("'circle' and 'larger' contradict each other") != std::string::npos);
    CHECK(Json::parse(contradictory.out)["constraints"].size() == 2);
    CHECK(Json::parse(contradictory.out)["contradictory"] == Json{"circle", "larger"});
    const auto broken = run({"audit", scene("x = 1\ny = 0.5", circle), "--json"});
    CHECK(broken.exit == 3);
    CHECK(broken.err.find("'circle' is off by 0.25 at the start") != std::string::npos);
    CHECK(Json::parse(broken.out)["constraints"][0]["residual"][0] == 0.25);
    CHECK(run({"audit", "nowhere.toml"}).exit == 3);
}

// The least-squares step gives about 1e-18 for z' = 0, and 1e-9 of the sizes of its terms is even smaller.
TEST_CASE("commands: guesses that end at zero up to rounding have converged") {
    const std::string disc = temporary("disc.toml", R"toml(
[parameters]
r = 0.3
[coordinates]
x = { initial = 0, rate_guess = 0 }
y = { initial = 0, rate_guess = 0 }
z = { guess = 0.3, rate_guess = 0 }
psi = 0.2
theta = 1.2
phi = { initial = 0, rate = 2 }
[[frame]]
name = "L"
rotate = [["z", "psi"], ["x", "theta"]]
[[frame]]
name = "D"
parent = "L"
rotate = [["z", "phi"]]
[[body]]
name = "disc"
mass = 1
inertia = ["r^2/4", "r^2/4", "r^2/2"]
frame = "D"
position = ["x", "y", "z"]
[[point]]
name = "C"
from = "disc"
offset = [0, "-r", 0]
axes = "L"
[[constraint]]
name = "touch"
holonomic = "dot(pos(C), ez(N))"
[[constraint]]
name = "rollx"
nonholonomic = "dot(vel(disc) + cross(omega(D), pos(disc, C)), ex(N))"
[[constraint]]
name = "rolly"
nonholonomic = "dot(vel(disc) + cross(omega(D), pos(disc, C)), ey(N))"
[[constraint]]
name = "rollz"
nonholonomic = "dot(vel(disc) + cross(omega(D), pos(disc, C)), ez(N))"
)toml");
    CHECK(run({"eval", disc}).exit == 0);
    const auto result = run({"audit", disc, "--json"});
    REQUIRE(result.exit == 0);
    const Json json = Json::parse(result.out);
    CHECK(json["rank"] == 3);
    CHECK(json["degrees_of_freedom"] == 3);
    CHECK(json["coordinates_free"] == 5);  // a rolling disc reaches every position, heading, lean and rotation
    CHECK(json["constraints"][1]["integrable"] == false);
    CHECK(json["constraints"][3]["redundant"] == true);
    CHECK(json["constraints"][3]["integral"] == "z - r*sin(theta)");
}

TEST_CASE("commands: audit tells poses at which coordinates fail from those at which the mechanism does") {
    const auto poses = [](const std::string& file) { return json_of({"audit", file})["singular_poses"]; };
    const Json polar = poses(temporary("polar.toml", R"toml(
[coordinates]
r = 1
phi = { initial = 0.5, rate = 1 }
[[particle]]
name = "p"
mass = 2
position = ["r*cos(phi)", "r*sin(phi)"]
)toml"));
    REQUIRE(polar.size() == 1);
    CHECK(polar[0]["kind"] == "description");
    CHECK(std::abs(polar[0]["coordinates"]["r"].get<double>()) < 1e-4);  // the distance counts in M by its square
    CHECK(polar[0]["among"] == Json{"phi"});
    // Of two that differ by a sign, that with the plus comes first, and right angles are exact.
    const Json board = poses(source_path("scenes/textbook/snakeboard.toml"));
    REQUIRE(board.size() == 2);
    for (int k = 0; k < 2; ++k)
        CHECK(board[k]["coordinates"]["phi"].get<double>() == (k == 0 ? 1 : -1) * std::numbers::pi / 2);
    const Json top = poses(source_path("scenes/textbook/heavy_top.toml"));
    REQUIRE(!top.empty());
    for (const Json& pose : top) {
        CHECK(pose["kind"] == "description");
        CHECK(std::abs(std::sin(pose["coordinates"]["theta"].get<double>())) < 1e-4);
    }
    const Json flat = poses(temporary("flat.toml", R"toml(
[coordinates]
al = 0.5
be = { guess = 0.1, rate_guess = 0 }
ga = { guess = 0.6, rate_guess = 0 }
[energy]
kinetic = "al'^2 + be'^2 + ga'^2"
[[constraint]]
name = "along"
holonomic = "cos(al) + 2*cos(be) - cos(ga) - 2"
[[constraint]]
name = "up"
holonomic = "sin(al) + 2*sin(be) - sin(ga)"
)toml"));
    REQUIRE(!flat.empty());
    for (const Json& pose : flat) CHECK(pose["kind"] == "mechanism");
    CHECK(poses(source_path("scenes/textbook/double_pendulum.toml")).empty());
}

}  // namespace commands_audit
