// SPDX-License-Identifier: MIT
// Cranks of equal lengths whose tips a coupler keeps in line: parallel cranks with more constraints than they
// need, which follow from each other on the branch on which the cranks are parallel, and not where one is crossed.
// Held against the pendulum as which all of them swing, however they are described.
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "json.hpp"
#include "program.hpp"
#include "tables.hpp"

namespace commands_branches {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::temporary;

namespace {

constexpr double duration = 3;

const std::string head = "gravity = [0, -9.81]\n[simulation]\nduration = 3\ntolerance = 1e-11\n";

/// The angle of a pendulum from the vertical and its rate; those of the cranks at the start.
struct Swing {
    double angle, rate;
};

const std::vector<Swing> swings{{0, 2}, {0.5, 1}, {M_PI / 2, 1}, {3, 0.5}};

/// Angles that begin at `zero` from the vertical that hangs down.
const std::vector<double> zeros{0, M_PI / 2, M_PI, -M_PI / 2, 0.7};

double swung(const Swing& swing) {
    const Json end = json_of({"simulate",
                              temporary("pendulum.toml", head + fmt::format(R"toml(
[coordinates]
phi = {{ initial = {}, rate = {} }}
[[particle]]
name = "P"
mass = 1
position = ["sin(phi)", "-cos(phi)"]
)toml",
                                                                            swing.angle, swing.rate)),
                              "--no-estimate"});
    return end["final"]["coordinates"]["phi"].get<double>();
}

/// a0 is given, and all others are guesses.
std::string coordinates(const Swing& swing, double zero) {
    std::string scene = "[coordinates]\n";
    for (int k = 0; k < 3; ++k)
        scene += fmt::format("a{0} = {{ {1} = {2:.17g}, {3} = {4} }}\n", k, k == 0 ? "initial" : "guess",
                             swing.angle - zero, k == 0 ? "rate" : "rate_guess", swing.rate);
    return scene;
}

/// Each tip has a mass, and all three distances between them are given.
std::string by_distances(const Swing& swing, double zero) {
    std::string scene = head + coordinates(swing, zero);
    for (int k = 0; k < 3; ++k)
        scene += fmt::format(
            "[[particle]]\nname = \"P{0}\"\nmass = 1\nposition = [\"{0} + sin(a{0} + {1:.17g})\", \"-cos(a{0} + "
            "{1:.17g})\"]\n",
            k, zero);
    for (const auto& [i, j] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)})
        scene += fmt::format(
            "[[constraint]]\nname = \"c{0}{1}\"\nholonomic = \"dot(pos(P{0}, P{1}), pos(P{0}, "
            "P{1})) = {2}\"\n",
            i, j, (j - i) * (j - i));
    return scene;
}

/// Massless cranks carry a body at three points.
std::string by_a_body(const Swing& swing, double zero) {
    std::string scene = head + coordinates(swing, zero);
    scene += fmt::format("x = {{ guess = {:.17g}, rate_guess = {:.17g} }}\n", 1 + std::sin(swing.angle),
                         swing.rate * std::cos(swing.angle));
    scene += fmt::format("y = {{ guess = {:.17g}, rate_guess = {:.17g} }}\n", -std::cos(swing.angle),
                         swing.rate * std::sin(swing.angle));
    scene += R"toml(
th = { guess = 0, rate_guess = 0 }
[[frame]]
name = "B"
rotate = [["z", "th"]]
[[body]]
name = "C"
mass = 3
frame = "B"
position = ["x", "y"]
inertia = 0.4
)toml";
    for (int k = 0; k < 3; ++k)
        scene += fmt::format(
            "[[constraint]]\nname = \"x{0}\"\nholonomic = \"x + {1}*cos(th) = {0} + sin(a{0} + "
            "{2:.17g})\"\n[[constraint]]\nname = \"y{0}\"\nholonomic = \"y + {1}*sin(th) = "
            "-cos(a{0} + {2:.17g})\"\n",
            k, k - 1, zero);
    return scene;
}

/// Two cranks and a massless coupler with an angle of its own. The only mass is on it, at this distance from the
/// tip of the first crank.
std::string by_a_massless_coupler(const Swing& swing, double zero, double distance) {
    return head + fmt::format(R"toml(
[coordinates]
a0 = {{ initial = {0:.17g}, rate = {1} }}
a1 = {{ guess = {0:.17g}, rate_guess = {1} }}
a2 = {{ guess = {0:.17g}, rate_guess = {1} }}
c = {{ guess = {2:.17g}, rate_guess = 0 }}
[[particle]]
name = "P"
mass = 1
position = ["sin(a0 + {3:.17g}) + {4}*cos(c + {3:.17g})", "-cos(a0 + {3:.17g}) + {4}*sin(c + {3:.17g})"]
[[constraint]]
name = "x"
holonomic = "sin(a0 + {3:.17g}) + 2*cos(c + {3:.17g}) = 2 + sin(a1 + {3:.17g})"
[[constraint]]
name = "y"
holonomic = "-cos(a0 + {3:.17g}) + 2*sin(c + {3:.17g}) = -cos(a1 + {3:.17g})"
[[constraint]]
name = "same"
holonomic = "a2 = a1"
)toml",
                              swing.angle - zero, swing.rate, -zero, zero, distance);
}

/// Massless cranks carry a mass in the middle between their tips, whose distance is given: the mass matrix is
/// singular wherever the cranks are parallel.
std::string by_the_middle(const Swing& swing, double zero) {
    return head + fmt::format(R"toml(
[coordinates]
a0 = {{ initial = {0:.17g}, rate = {1} }}
a1 = {{ guess = {0:.17g}, rate_guess = {1} }}
a2 = {{ guess = {0:.17g}, rate_guess = {1} }}
[[particle]]
name = "P"
mass = 1
position = ["1 + (sin(a0 + {2:.17g}) + sin(a1 + {2:.17g}))/2", "-(cos(a0 + {2:.17g}) + cos(a1 + {2:.17g}))/2"]
[[constraint]]
name = "rod"
holonomic = "(2 + sin(a1 + {2:.17g}) - sin(a0 + {2:.17g}))^2 + (cos(a1 + {2:.17g}) - cos(a0 + {2:.17g}))^2 = 4"
[[constraint]]
name = "same"
holonomic = "a2 = a1"
)toml",
                              swing.angle - zero, swing.rate, zero);
}

/// Bodies and revolute joints, of which two close loops. The tip stands at `zero` in the axes of the crank.
std::string by_joints(const Swing& swing, double zero) {
    const double x = std::sin(zero), y = -std::cos(zero), angle = swing.angle - zero;
    std::string scene = head;
    for (const char* const name : {"K0", "K1", "K2"})
        scene += fmt::format("[[body]]\nname = \"{}\"\nmass = 1\ninertia = [0, 0, 0]\n", name);
    scene += "[[body]]\nname = \"C\"\nmass = 1\ninertia = [0, 0.4, 0.4]\n";
    for (int k = 0; k < 3; ++k)
        scene += fmt::format(
            "[[joint]]\nname = \"g{0}\"\ntype = \"revolute\"\nparent = \"N\"\nchild = \"K{0}\"\nparent_point = "
            "[{0}, 0, 0]\nchild_point = [{1:.17g}, {2:.17g}, 0]\ncoordinates = {{ a{0} = {{ {3} = {4:.17g}, {5} = "
            "{6} }} }}\n",
            k, -x, -y, k == 0 ? "initial" : "guess", angle, k == 0 ? "rate" : "rate_guess", swing.rate);
    for (int k = 0; k < 3; ++k) {
        scene += fmt::format(
            "[[joint]]\nname = \"t{0}\"\ntype = \"revolute\"\nparent = \"K{0}\"\nchild = "
            "\"C\"\nchild_point = [{1}, 0, 0]\n",
            k, k - 1);
        if (k == 0)
            scene += fmt::format("coordinates = {{ b = {{ guess = {:.17g}, rate_guess = {} }} }}\n", -angle,
                                 -swing.rate);
    }
    return scene;
}

// Fewer steps than these, each with at most 1e-11 of 2, which the rates carry on.
constexpr int most_steps = 700;
constexpr double of_cranks = most_steps * 1e-11 * 2 * duration;

void check(const std::string& scene, double zero, double truth) {
    CAPTURE(zero);
    const Json motion = json_of({"simulate", temporary("cranks.toml", scene), "--no-estimate"});
    CHECK(motion["steps"].get<int>() < most_steps);
    const Json& end = motion["final"];
    for (const char* const angle : {"a0", "a1", "a2"})
        CHECK(std::abs(end["coordinates"][angle].get<double>() + zero - truth) < of_cranks);
}

}  // namespace

TEST_CASE("branches: three cranks swing as one, by three distances or by joints, from whatever pose and zero") {
    for (const Swing& swing : swings) {
        CAPTURE(swing.angle);
        const double truth = swung(swing);
        for (const double zero : zeros) check(by_distances(swing, zero), zero, truth);
        for (const double zero : {0.0, M_PI / 2, 0.4}) check(by_joints(swing, zero), zero, truth);
    }
}

// The first two swings stay away from the poses in which the cranks lie flat, the third passes one, and the last
// turns over and over.
TEST_CASE("branches: massless cranks that carry a body at three points swing as a pendulum") {
    for (const Swing& swing : {swings[0], swings[1], swings[3], {0.3, 9}}) {
        CAPTURE(swing.angle);
        const double truth = swung(swing);
        for (const double zero : zeros) check(by_a_body(swing, zero), zero, truth);
    }
}

TEST_CASE(
    "branches: cranks with a massless coupler, or massless with a mass between them, turn through flat poses") {
    for (const Swing& swing : {swings[1], swings[3], {0.3, 9}, {-2, 7}}) {
        CAPTURE(swing.angle);
        const double truth = swung(swing);
        for (const double zero : zeros) {
            for (const double distance : {0, 1}) check(by_a_massless_coupler(swing, zero, distance), zero, truth);
            check(by_the_middle(swing, zero), zero, truth);
        }
    }
}

// Only the rates at the start tell on which branch the cranks go on.
TEST_CASE("branches: linkages with massless cranks begin in flat poses") {
    for (const Swing& swing : {Swing{M_PI / 2, 1}, {M_PI / 2, -4}, {-M_PI / 2, 3}}) {
        CAPTURE(swing.angle);
        CAPTURE(swing.rate);
        const double truth = swung(swing);
        for (const double zero : zeros) {
            check(by_a_body(swing, zero), zero, truth);
            for (const double distance : {0, 1}) check(by_a_massless_coupler(swing, zero, distance), zero, truth);
            check(by_the_middle(swing, zero), zero, truth);
        }
    }
}

// M has no inertia against a' - b' anywhere on the way. The rod holds this motion, except where the linkage lies
// flat.
TEST_CASE("branches: a motion that begins flat is trusted") {
    for (const double zero : zeros) {
        const std::string scene = head + fmt::format(R"toml(
[coordinates]
a = {{ initial = {0:.17g}, rate = -4 }}
b = {{ guess = {0:.17g}, rate_guess = -4 }}
[[particle]]
name = "P"
mass = 1
position = ["1 + (sin(a + {1:.17g}) + sin(b + {1:.17g}))/2", "-(cos(a + {1:.17g}) + cos(b + {1:.17g}))/2"]
[[constraint]]
name = "rod"
holonomic = "(2 + sin(b + {1:.17g}) - sin(a + {1:.17g}))^2 + (cos(b + {1:.17g}) - cos(a + {1:.17g}))^2 = 4"
)toml",
                                                     M_PI / 2 - zero, zero);
        const Json motion = json_of({"simulate", temporary("flat.toml", scene), "--method", "dop853"});
        CAPTURE(motion["error_estimate"].dump());
        CHECK(motion["error_estimate"]["trustworthy"] == true);
        CHECK(std::abs(motion["final"]["coordinates"]["b"].get<double>() + zero - swung({M_PI / 2, -4})) <
              of_cranks);
    }
}

TEST_CASE("branches: sweep follows the branch through flat poses as simulate does") {
    const std::string scene =
        temporary("swept_cranks.toml", by_a_massless_coupler({-1, 7}, 0, 0) + "[parameters]\nm = 1\n");
    const std::string table = temporary("swept_cranks.csv", "");
    REQUIRE(alembert::test::run({"sweep", scene, "--vary", "m=1:2:2", "-o", table}).exit == 0);
    const double truth = swung({-1, 7});
    for (const char* const angle : {"final_a0", "final_a1"})
        for (const double end : alembert::test::column(table, angle)) CHECK(std::abs(end - truth) < of_cranks);
}

TEST_CASE("branches: audit names the distance that follows on this branch, from whatever zero") {
    for (const Swing& swing : swings)
        for (const double zero : zeros) {
            CAPTURE(swing.angle);
            CAPTURE(zero);
            const Json found = json_of({"audit", temporary("cranks.toml", by_distances(swing, zero))});
            std::vector<std::string> redundant;
            for (const Json& c : found["constraints"])
                if (c["redundant"].get<bool>()) redundant.push_back(c["name"].get<std::string>());
            CHECK(redundant == std::vector<std::string>{"c12"});
            CHECK(found["degrees_of_freedom"].get<int>() == 1);
            CHECK(found["coordinates_free"].get<int>() == 1);
        }
}

}  // namespace commands_branches
