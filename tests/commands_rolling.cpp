// SPDX-License-Identifier: GPL-2.0-or-later
// The normal reactions of bodies that roll, against the balance of forces by hand.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "json.hpp"

namespace commands_rolling {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

Json evaluated(const std::string& scene) {
    return json_of({"eval", temporary("rolling.toml", scene), "--reactions"});
}

double normal(const Json& json, const std::string& name) {
    REQUIRE(json["normal_reactions"].contains(name));
    return json["normal_reactions"][name].get<double>();
}

/// A disc of mass 3 on a slope of angle a; along the axes of N if `along`, otherwise N stands upright.
std::string on_slope(double a, bool along, const std::string& more = "") {
    const std::string place = along ? "[\"s\", \"r\"]" : "[\"s*cos(a) - r*sin(a)\", \"s*sin(a) + r*cos(a)\"]",
                      gravity = along ? "[\"-9.81*sin(a)\", \"-9.81*cos(a)\"]" : "[0, -9.81]",
                      contact = along ? "[0, \"-r\"]" : "[\"r*sin(a)\", \"-r*cos(a)\"]";
    return fmt::format(
        "gravity = {}\n[parameters]\nr = 0.4\na = {}\n[coordinates]\ns = {{ initial = 0.3, rate = "
        "1 }}\nphi = {{ initial = 0, rate = -2.5 }}\n[[frame]]\nname = \"D\"\nrotate = [[\"z\", "
        "\"phi\"]]\n[[body]]\nname = \"disc\"\nmass = 3\ninertia = \"3*r^2/2\"\nframe = \"D\"\n"
        "position = {}\n[[rolling]]\nname = \"wheel\"\nbody = \"disc\"\ncontact = {}\n{}",
        gravity, a, place, contact, more);
}

}  // namespace

TEST_CASE("rolling: a disc on a slope is pressed with m g cos a, in eval, derive and the table of simulate") {
    for (const double a : {0.0, 0.3, 0.7})
        for (const bool along : {true, false}) {
            CAPTURE(a);
            CAPTURE(along);
            const std::string scene = on_slope(a, along);
            CHECK(normal(evaluated(scene), "lambda_wheel_normal") ==
                  doctest::Approx(3 * 9.81 * std::cos(a)).epsilon(1e-12));
            const std::string file = temporary("rolling.csv", "");
            REQUIRE(
                run({"simulate", temporary("rolling.toml", scene), "--duration", "1", "--reactions", "-o", file})
                    .exit == 0);
            std::ifstream table(file);
            std::string line;
            std::getline(table, line);
            CHECK(line.substr(line.rfind(',') + 1) == "lambda_wheel_normal");
            int rows = 0;
            for (; std::getline(table, line); ++rows)
                CHECK(std::stod(line.substr(line.rfind(',') + 1)) ==
                      doctest::Approx(3 * 9.81 * std::cos(a)).epsilon(1e-12));
            CHECK(rows > 100);
        }
    const Json derived = json_of({"derive", temporary("rolling.toml", on_slope(0.3, true)), "--reactions"});
    CHECK(derived["normal_reactions"]["lambda_wheel_normal"].get<std::string>().find("cos(a)") !=
          std::string::npos);
    const auto text = run({"derive", temporary("rolling.toml", on_slope(0.3, true)), "--reactions"});
    CHECK(text.out.find("N of wheel = ") != std::string::npos);
}

// The force F at the rim, its point fixed in the body, and a mass at the centre that hangs from it.
TEST_CASE("rolling: forces, springs and masses on the body count, and what they press on is the ground") {
    const std::string pushed = on_slope(0.3, true,
                                        "[[point]]\nname = \"rim\"\nfrom = \"disc\"\noffset = [0.1, 0.2]\naxes = "
                                        "\"D\"\n[[force]]\nat = \"rim\"\nvector = [2, -7]\n");
    CHECK(normal(evaluated(pushed), "lambda_wheel_normal") ==
          doctest::Approx(3 * 9.81 * std::cos(0.3) + 7).epsilon(1e-12));
    const std::string hung = on_slope(0.3, true,
                                      "[[point]]\nname = \"hook\"\noffset = [0.3, 2.4]\n[[spring]]\nbetween = "
                                      "[\"hook\", \"disc\"]\nstiffness = 5\nlength = 0.5\n");
    CHECK(normal(evaluated(hung), "lambda_wheel_normal") ==
          doctest::Approx(3 * 9.81 * std::cos(0.3) - 5 * (2 - 0.5)).epsilon(1e-12));
}

// r_C = (R − r)(sin θ, −cos θ), so that N − m g cos θ = m (R − r) θ'².
TEST_CASE("rolling: in a round track the normal reaction contains the centripetal force") {
    const std::string scene = R"toml(gravity = [0, -9.81]
[parameters]
R = 2
r = 0.3
m = 1.7
[coordinates]
theta = { initial = 0.4, rate = 1.3 }
phi = { initial = 0, rate = "-1.3*(R - r)/r" }
[[frame]]
name = "D"
rotate = [["z", "phi"]]
[[frame]]
name = "K"
rotate = [["z", "theta"]]
[[body]]
name = "disc"
mass = "m"
inertia = "m*r^2/2"
frame = "D"
position = ["(R - r)*sin(theta)", "-(R - r)*cos(theta)"]
[[rolling]]
name = "track"
body = "disc"
contact = [0, "-r"]
axes = "K"
)toml";
    CHECK(normal(evaluated(scene), "lambda_track_normal") ==
          doctest::Approx(1.7 * (9.81 * std::cos(0.4) + 1.7 * 1.3 * 1.3)).epsilon(1e-12));
}

// Height r sin θ of the centre over the ground (θ: between the plane of the disc and the ground), so that
// N = m (g + z''). In steady turning z'' = 0.
TEST_CASE("rolling: a disc in space is pressed with m (g + z'')") {
    const std::string scene = R"toml(gravity = [0, 0, -9.81]
[parameters]
m = 2
r = 0.5
[coordinates]
x = 0
y = 0
psi = { initial = 0.2, rate = 0.7 }
theta = { initial = 0.3, rate = 0.4 }
phi = { initial = 0, rate = 3 }
[[frame]]
name = "H"
rotate = [["z", "psi"], ["x", "theta"]]
[[frame]]
name = "D"
parent = "H"
rotate = [["y", "phi"]]
[[body]]
name = "disc"
mass = "m"
inertia = ["m*r^2/4", "m*r^2/2", "m*r^2/4"]
frame = "D"
position = ["x", "y", "r*cos(theta)"]
[[rolling]]
name = "rim"
body = "disc"
contact = [0, 0, "-r"]
axes = "H"
)toml";
    // The rates of x and y that roll are found from those that are given.
    std::string guessed = scene;
    for (const char* const name : {"x = 0\n", "y = 0\n"})
        guessed.replace(guessed.find(name), 6, fmt::format("{} = {{ initial = 0, rate_guess = 0 }}\n", name[0]));
    const Json json = evaluated(guessed);
    const double acceleration = json["accelerations"]["theta"],
                 rise = -0.5 * (std::sin(0.3) * acceleration + std::cos(0.3) * 0.4 * 0.4);
    CHECK(normal(json, "lambda_rim_normal") == doctest::Approx(2 * (9.81 + rise)).epsilon(1e-11));
}

// Two wheels bear one frame: how they share its weight is not told by the wheels alone.
TEST_CASE("rolling: a normal reaction that the scene does not determine is not told") {
    const std::string scene = R"toml(gravity = [0, -9.81]
[coordinates]
x = { initial = 0, rate = 1 }
a = { initial = 0, rate = -2 }
b = { initial = 0, rate = -2 }
[[frame]]
name = "A"
rotate = [["z", "a"]]
[[frame]]
name = "B"
rotate = [["z", "b"]]
[[body]]
name = "front"
mass = 1
inertia = 0.2
frame = "A"
position = ["x + 1", 0.5]
[[body]]
name = "rear"
mass = 1
inertia = 0.2
frame = "B"
position = ["x", 0.5]
[[rolling]]
name = "one"
body = "front"
contact = [0, -0.5]
[[rolling]]
name = "two"
body = "rear"
contact = [0, -0.5]
)toml";
    CHECK(evaluated(scene)["normal_reactions"].empty());
}

}  // namespace commands_rolling
