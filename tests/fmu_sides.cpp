// SPDX-License-Identifier: MIT
// Units of scenes whose constraints have kinks: tables, abs, max and sign in them, with guesses, with start values
// that the importer sets, and from kinks on.
#include <doctest/doctest.h>

#include "fmu_exports.hpp"
#include "scenes.hpp"

namespace fmu_sides {

using namespace alembert::test;

namespace {

/// A bead on a curve in the vertical plane.
std::string bead(const std::string& curve, const std::string& start, const std::string& more = "") {
    return temporary("bead.toml", fmt::format(R"toml(
gravity = [0, -9.81]
[coordinates]
{}
[[particle]]
name = "p"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "wire"
holonomic = "{}"
{}
)toml",
                                              start, curve, more));
}

constexpr const char *to_the_left = "x = { initial = -0.3, rate = 1 }\ny = { guess = 0.1, rate_guess = 0 }\n",
                     *from_the_kink = "x = { initial = 0, rate = -1 }\ny = { guess = 0.1, rate_guess = 0 }\n",
                     *beyond_it = "x = { guess = 0.2, rate_guess = 1 }\ny = { initial = 0.09, rate = -0.3 }\n";

std::string cubic(const std::string& more) {
    return "[tables]\nh = { arguments = [\"x\"], interpolation = \"cubic\"" + more + "}\n";
}

}  // namespace

TEST_CASE("fmu: where a constraint has kinks the start is on the side on which its values are") {
    for (const char* const curve :
         {"y = x^2 + 0.2*x^2*abs(x)", "y = max(0, -x)^2 + x^2", "y = x^2*(1.5 + sign(x))"})
        for (const char* const start : {to_the_left, from_the_kink}) {
            CAPTURE(std::string(curve));
            CAPTURE(std::string(start));
            check_unit(bead(curve, start), 1);
        }
    check_unit(bead("x = y*abs(y) - y^2/2", beyond_it), 0.4);
}

TEST_CASE("fmu: tables in constraints are read between the knots at which the start is") {
    const std::string track = cubic(
        ", outside = \"line\", points = [[-1,1], [-0.6,0.3], [-0.2,0.1], [0,0], [0.3,0.2], [0.7,0.4], [1,1]]");
    check_unit(bead("y = h(x)", to_the_left, track), 1);
    check_unit(bead("y = h(x)", from_the_kink, track), 1);
    check_unit(bead("y = h(x)", to_the_left, track), 1, 1e-7, {{"x", 0.4}, {"der(x)", -2}});
    const std::string cam = cubic(", period = 1, points = [[0,1], [0.3,0.3], [0.5,0.1], [0.8,0.2]]");
    check_unit(bead("y = 0.1*h(x + t)", to_the_left, cam), 1);
    check_unit(temporary("gear.toml", R"toml(
[coordinates]
a = { initial = 0.1, rate = 2 }
b = { guess = 0.1, rate_guess = 0 }
[tables]
ratio = { arguments = ["a"], interpolation = "pchip", period = 6, points = [[0,1], [1,1.2], [2,2], [3,1.8], [4,0.9]] }
[energy]
kinetic = "(0.1*a'^2 + 0.3*b'^2)/2"
[[constraint]]
name = "gear"
nonholonomic = "b' = ratio(a)*a'"
[forces]
a = "sin(t)"
b = "-0.4*b'*abs(b')"
)toml"),
               3);
}

TEST_CASE("fmu: before the start outputs are those on the side of the values that are set") {
    const std::string scene = temporary("valve.toml", R"toml(
[coordinates]
x = { initial = -1, rate = 0.5 }
[energy]
kinetic = "x'^2/2"
[forces]
x = "3*max(0, x) - abs(x')"
[outputs]
flow = "max(0, x)^2"
)toml");
    for (const int version : {2, 3}) {
        CAPTURE(version);
        const Unit unit = exported(scene, version);
        Instance one(unit, false);
        CHECK(one.get("flow") == 0);
        one.set("x", 2);
        CHECK(one.get("flow") == 4);
        one.set("der(x)", -1);
        one.begin();
        CHECK(one.get("flow") == 4);
        CHECK(one.rates()[1] == doctest::Approx(5));
    }
}

}  // namespace fmu_sides
