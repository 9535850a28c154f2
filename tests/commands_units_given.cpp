// SPDX-License-Identifier: MIT
// A scene says what it means in its own units: the same mechanism in millimetres, grams and degrees and in SI
// units.
#include <cmath>

#include "contacts.hpp"
#include "edits.hpp"
#include "tools.hpp"

namespace commands_units_given {

using namespace alembert::test;

namespace {

/// A pendulum on a sprung cart, driven by a torque.
std::string scene(const std::string& name, const std::string& parameters, const std::string& coordinates) {
    return temporary(name, "gravity = [0, \"-g\"]\n[parameters]\n" + parameters + "[coordinates]\n" + coordinates +
                               R"toml([[particle]]
name = "cart"
mass = "M"
position = ["x", 0]
[[particle]]
name = "bob"
mass = "m"
from = "cart"
position = ["l*sin(theta)", "-l*cos(theta)"]
[[spring]]
between = ["O", "cart"]
stiffness = "k"
[[damper]]
along = "theta"
damping = "c"
[simulation]
duration = "2 s"
tolerance = 1e-12
)toml");
}

std::string in_si() {
    return scene("units_si.toml", "M = 2\nm = 0.25\nl = 0.2\nk = 400\nc = 0.002\ng = 9.81\n",
                 "x = { initial = 0.03, rate = -0.1 }\ntheta = { initial = 0.5235987755982988, rate = "
                 "0.17453292519943295 }\n");
}

std::string in_own() {
    return scene(
        "units_own.toml",
        "M = { value = 2000, unit = \"g\" }\nm = { value = 250, unit = \"g\" }\nl = { value = 200, unit = \"mm\" "
        "}\n"
        "k = { value = 0.4, unit = \"N/mm\" }\nc = { value = 2, unit = \"N mm s/rad\" }\ng = \"981 cm/s^2\"\n",
        "x = { initial = 30, rate = -100, unit = \"mm\" }\ntheta = { initial = 30, rate = 10, unit = \"deg\" }\n");
}

}  // namespace

TEST_CASE("units: the same motion in the scene's units as in those of the SI, which JSON and CSV have") {
    const Json si = simulated(in_si(), {}), own = simulated(in_own(), {});
    for (const char* kind : {"coordinates", "rates"})
        for (const char* q : {"x", "theta"})
            CHECK(std::abs(si["final"][kind][q].get<double>() - own["final"][kind][q].get<double>()) < 1e-13);
    CHECK(own["units"]["theta"] == "rad");
    CHECK(own["units"]["x"] == "m");
    CHECK(own["warnings"].empty());
    const std::string text = run({"simulate", in_own()}).out;
    CHECK(text.find("theta [deg]") != std::string::npos);
    CHECK(text.find("x [mm]") != std::string::npos);
}

TEST_CASE("units: values of --at, --vary and tables are in the unit of the name, unless they have one") {
    const std::string own = in_own();
    const auto angle = [&](const std::string& given) {
        return Json::parse(run({"eval", own, "--at", given, "--json"}).out)["coordinates"]["theta"].get<double>();
    };
    CHECK(angle("theta=90") == doctest::Approx(std::acos(0.0)).epsilon(1e-15));
    CHECK(angle("theta=0.5 rad") == 0.5);
    CHECK(angle("theta=180*1/2") == doctest::Approx(std::acos(0.0)).epsilon(1e-15));
    const auto first = [&](const std::vector<std::string>& words) {
        std::vector<std::string> all{"sweep", own, "--duration", "0", "--json"};
        all.insert(all.end(), words.begin(), words.end());
        return Json::parse(run(all).out)["rows"][0]["final"]["coordinates"]["x"].get<double>();
    };
    CHECK(first({"--vary", "x=50:70:2"}) == doctest::Approx(0.05).epsilon(1e-14));
    CHECK(first({"--vary", "x=1 cm:2 cm:2"}) == doctest::Approx(0.01).epsilon(1e-14));
    const std::string table = temporary("units_points.csv", "x\n40\n50\n");
    CHECK(first({"--vary-from", table}) == doctest::Approx(0.04).epsilon(1e-14));
}

TEST_CASE("units: pictures and texts of sweeps and charts are in the units of the scene") {
    const std::string own = in_own(), svg = temporary("units_sweep.svg", "");
    REQUIRE(run({"sweep", own, "--vary", "theta=20:80:4", "--svg", svg, "--duration", "0.1"}).exit == 0);
    const std::string picture = contents(svg);
    CHECK(picture.find("initial theta in deg") != std::string::npos);
    CHECK(picture.find("final x in mm") != std::string::npos);
    for (const char* tick : {">20<", ">40<", ">80<"}) CHECK_MESSAGE(picture.find(tick) != std::string::npos, tick);
    const std::string locus = run({"stability", own, "--at", "theta=0", "--locus", "l=100:300"}).out;
    CHECK_MESSAGE(locus.find("l [mm] from 100 to 300") != std::string::npos, locus);
    const std::string branches = run({"equilibrium", own, "--follow", "l=100:300"}).out;
    CHECK_MESSAGE(branches.find("l [mm] from 100 to 300") != std::string::npos, branches);
}

TEST_CASE("units: guesses that moved are told in the units of the table") {
    const std::string file = temporary("moved.toml", R"toml([coordinates]
a = { initial = 30, rate = 90, unit = "deg" }
b = { guess = 28, rate_guess = 0, unit = "deg" }
x = { guess = 1, rate_guess = 0 }
[[particle]]
name = "p"
mass = 1
position = ["cos(a) + x", "sin(b)"]
[[constraint]]
name = "same"
holonomic = "a - b"
[[constraint]]
name = "held"
holonomic = "x - 2*a"
)toml");
    for (const char* const verb : {"eval", "audit", "simulate"}) {
        CAPTURE(verb);
        const auto told = run({verb, file});
        CHECK(told.exit == 0);
        const auto after = [&](const std::string& words) {
            const std::size_t at = told.out.find(words);
            REQUIRE_MESSAGE(at != std::string::npos, told.out);
            return told.out.substr(at + words.size(), told.out.find('\n', at) - at - words.size());
        };
        const std::string b = after("b from 28 to "), rate = after("b' from 0 to "), x = after("x from 1 to ");
        CHECK(std::stod(b) == doctest::Approx(30).epsilon(1e-14));
        CHECK(b.ends_with(" deg"));
        CHECK(std::stod(rate) == doctest::Approx(90).epsilon(1e-14));
        CHECK(rate.ends_with(" deg/s"));
        CHECK(x.find_first_not_of("0123456789.e-") == std::string::npos);  // a length without a unit
    }
}

TEST_CASE("units: derive --dimensions tells what the units give and what follows") {
    const auto dimensions = [](const std::string& scene) {
        const Json all = Json::parse(run({"derive", scene, "--dimensions", "--json"}).out)["dimensions"];
        std::string text;
        for (const auto& [name, one] : all.items())
            text += name + ":" + (one["unit"].is_null() ? "?" : one["unit"].get<std::string>()) +
                    (one["is_given"] ? " given; " : "; ");
        return text;
    };
    CHECK(dimensions(in_own()) == "theta:1 given; x:m given; ");
    CHECK(dimensions(temporary("units_concluded.toml", R"toml([parameters]
l = { value = 1, unit = "m" }
m = { value = 1, unit = "kg" }
w = { value = 2, unit = "rad/s" }
[coordinates]
x = 0.6
y = 0.8
s = 0
phi = 0
free = 0
[[particle]]
name = "P"
mass = "m"
position = ["x", "y"]
[[particle]]
name = "Q"
mass = "m"
position = ["s + l*cos(phi)", 0]
[energy]
kinetic = "0.37*free'^2"
[[constraint]]
name = "rod"
holonomic = "x^2 + y^2 = l^2"
[[constraint]]
name = "drive"
nonholonomic = "phi' = w"
)toml")) == "free:?; lambda_drive:kg*m^2/s^2; lambda_rod:kg/s^2; phi:1; s:m; x:m; y:m; ");
}

TEST_CASE("units: --strict makes a warning a mistake, and allow silences a kind") {
    const std::string wrong =
        "[parameters]\nk = { value = 5, unit = \"N/m\" }\n[coordinates]\nx = { initial = 1, unit = \"m\" }\n"
        "[energy]\nkinetic = \"x'^2/2\"\npotential = \"k*x^2/2 + k*x\"\n";
    const std::string scene = temporary("units_wrong.toml", wrong);
    const auto told = run({"eval", scene, "--json"});
    CHECK(told.exit == 0);
    const Json warnings = Json::parse(told.out)["warnings"];
    REQUIRE(warnings.size() >= 1);
    CHECK(warnings[0]["kind"] == "unit_mismatch");
    CHECK(warnings[0]["line"] == 7);
    CHECK(run({"eval", scene, "--strict"}).exit == 3);
    const std::string allowed = temporary("units_allowed.toml", "allow = [\"unit_mismatch\"]\n" + wrong);
    CHECK(Json::parse(run({"eval", allowed, "--json"}).out)["warnings"].empty());
    CHECK(run({"eval", allowed, "--strict"}).exit == 0);
}

}  // namespace commands_units_given
