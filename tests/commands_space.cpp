// SPDX-License-Identifier: MIT
// Mechanisms in space, as a user runs them: what is conserved, hand derivations, and mistakes that are reported.
#include <doctest/doctest.h>

#include <cmath>

#include "edits.hpp"
#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_space {

using alembert::test::edited;
using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::number;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using alembert::test::textbook_text;

TEST_CASE("space: mistakes in a quaternion or a contact at the scene's values are reported") {
    const auto off =
        run({"derive",
             temporary("off.toml", edited(textbook_text("free_body_quaternion"), {{"e1 = 0", "e1 = 0.01"}}))});
    CHECK(off.exit == 3);
    CHECK(off.err.find("the sum of squares of the quaternion of frame 'F' is 1.0001 at the start; expected 1") !=
          std::string::npos);
    const auto near = run({"eval", temporary("near.toml", edited(textbook_text("free_body_quaternion"),
                                                                 {{"e0 = 1", "e0 = 1.0000000001"}}))});
    CHECK(near.exit == 0);
    const std::string still =
        "[coordinates]\nx = 0\n[[body]]\nname = \"B\"\nmass = 1\nposition = [0, 0, \"x\"]\n[[body]]\nname = "
        "\"D\"\nmass = 1\n"
        "position = [0, 1, \"x\"]\n[[rolling]]\nname = \"r\"\nbody = \"B\"\non = \"D\"\ncontact = [0, 0, -1]\n";
    const auto idle = run({"derive", temporary("idle.toml", still)});
    CHECK(idle.exit == 3);
    CHECK(idle.err.find("rolling 'r' says nothing") != std::string::npos);
    const auto torn =
        run({"derive", temporary("torn.toml", edited(still, {{"[0, 1, \"x\"]", "[0, \"t\", \"x\"]"}}))});
    CHECK(torn.exit == 3);
    CHECK(torn.err.find("rolling 'r' cannot hold: along y the contact moves by itself") != std::string::npos);
}

TEST_CASE("space: the gallery's mechanisms in space keep their energy and their loops") {
    for (const char* name : {"rssr", "six_joint_arm", "stewart"}) {
        CAPTURE(name);
        const Json motion = json_of({"simulate", source_path(std::string("scenes/gallery/") + name + ".toml"),
                                     "--json", "--duration", "1"});
        CHECK(motion["energy_drift"].get<double>() < 1e-9);
        if (!motion["constraint_drift"].is_null()) CHECK(motion["constraint_drift"].get<double>() < 1e-12);
    }
}

// The crank's end, the rocker's foot and end: the coupler connects them with its length at every position of the
// crank.
TEST_CASE("space: the rocker of the spatial four-bar stands where the crank's angle puts it") {
    const Json end = json_of({"simulate", source_path("scenes/gallery/rssr.toml"), "--json"})["final"];
    const double alpha = number(end, "coordinates", "alpha"), beta = number(end, "coordinates", "beta");
    const double a = 0.3, b = 1.2, c = 0.8, d = 1.0, h = 0.2;
    // The rocker turns about -y: its end is (d + c cos beta, h, c sin beta).
    const double x = d + c * std::cos(beta) - a * std::cos(alpha), y = h - a * std::sin(alpha),
                 z = c * std::sin(beta);
    CHECK(std::abs(std::sqrt(x * x + y * y + z * z) - b) < 1e-11);
    CHECK(std::abs(alpha - 0.5) > 2 * M_PI);  // the crank goes round
}

TEST_CASE("space: the Furuta pendulum of bodies obeys its hand derivation, and its work is accounted for") {
    const std::string scene = source_path("scenes/gallery/furuta_joints.toml");
    CHECK(run({"check", scene}).out.rfind("proved", 0) == 0);
    CHECK(json_of({"simulate", scene, "--json"})["work_balance"].get<double>() < 1e-10);
}

TEST_CASE("space: impossible moments are refused or reported with the body, at the values of the run") {
    const std::string text =
        "[parameters]\nJ = 1\n[coordinates]\nphi = 0\n[[frame]]\nname = \"F\"\nrotate = [[\"z\", "
        "\"phi\"]]\n[[body]]\nname = \"B\"\n"
        "mass = 1\nframe = \"F\"\nposition = [0, 0]\ninertia = [1, 1, \"J\"]\n";
    const auto with = [&](const std::string& inertia) {
        return temporary("moments.toml", edited(text, {{"[1, 1, \"J\"]", inertia}}));
    };
    CHECK(run({"derive", with("[1, 1, \"2*J\"]")}).err.empty());
    const auto wide = run({"derive", with("[1, 1, \"3*J\"]")});
    CHECK(wide.exit == 0);
    CHECK(wide.err.find("moments.toml:13:11: warning: the principal moments of inertia of body 'B', 1, 1 and 3, "
                        "break the triangle inequality") != std::string::npos);
    const auto negative = run({"derive", with("[1, 1, \"-J\"]")});
    CHECK(negative.exit == 3);
    CHECK(negative.err.find("the moment of inertia of body 'B' is -1; expected zero or more") !=
          std::string::npos);
    const auto tilted = run({"agree", with("{ xx = 1, yy = 1, zz = 1, xy = 2 }")});
    CHECK(tilted.exit == 3);
    CHECK(tilted.err.find("the principal moments of inertia of body 'B', -1, 1 and 3, are not all zero or more") !=
          std::string::npos);
    const auto later = run({"eval", with("[1, 1, \"J\"]"), "--at", "J=-0.5"});
    CHECK(later.exit == 3);
    CHECK(later.err.find("of body 'B', -0.5, 1 and 1, are not all") != std::string::npos);
    // About a point half a metre away: the contribution of the mass centre exceeds the given moment.
    const auto about = run({"derive", with("[1, 0.1, 1]\nabout = \"P\"\n[[point]]\nname = \"P\"\nfrom = "
                                           "\"B\"\noffset = [0.5, 0]\naxes = \"F\"")});
    CHECK(about.exit == 3);
    CHECK(about.err.find("(about its mass centre; they are given about 'P'), -0.15, ") != std::string::npos);
}

TEST_CASE("space: a loop that cannot close is reported with its joint and the distance of its bodies") {
    const std::string text =
        "[[body]]\nname = \"A\"\nmass = 1\ninertia = [1, 1, 1]\n[[joint]]\nname = \"a\"\ntype = "
        "\"revolute\"\nparent = \"N\"\n"
        "child = \"A\"\ncoordinates = { q = 0 }\n[[joint]]\nname = \"b\"\ntype = \"revolute\"\nparent = "
        "\"A\"\nchild = \"N\"\n";
    const auto apart = run({"derive", temporary("apart.toml", text + "parent_point = [0, 0, 1]\n")});
    CHECK(apart.exit == 3);
    CHECK(apart.err.find("joint 'b' cannot close: in its locked direction 3") != std::string::npos);
    CHECK(apart.err.find("the bodies stand apart by -1, and no coordinate can change that") != std::string::npos);
    // The coordinates move these bodies, but never far enough.
    const auto far =
        run({"derive", temporary("far.toml", text + "parent_point = [1, 0, 0]\nchild_point = [3, 0, 0]\n")});
    CHECK(far.exit == 3);
    CHECK(far.err.find("joint 'b' cannot close its loop: constraints 'b_1' and 'b_2' contradict each other") !=
          std::string::npos);
    CHECK(far.out.empty());
}

TEST_CASE(
    "space: an arm of seven joints with all its parameters as symbols accelerates as the one with numbers, by "
    "every formalism of joints") {
    const auto evaluated = [](const std::string& name, const std::string& by) {
        return json_of({"eval", source_path("scenes/benchmark/trees/" + name + ".toml"), "--by", by, "--json"});
    };
    const Json numbers = evaluated("arm7", "recursive")["accelerations"];
    for (const char* by : {"recursive", "kane", "schiehlen", "roberson-wittenburg"}) {
        CAPTURE(by);
        const Json symbols = evaluated("arm7_symbols", by)["accelerations"];
        for (const auto& [name, value] : numbers.items()) {
            CAPTURE(name);
            CHECK(std::abs(symbols[name].get<double>() - value.get<double>()) <
                  1e-12 * std::max(1.0, std::abs(value.get<double>())));
        }
    }
    // The numbers are symbols: another mass and another offset give another arm.
    const Json other = json_of({"eval", source_path("scenes/benchmark/trees/arm7_symbols.toml"), "--at", "m7=0.9",
                                "--at", "px4=0.01", "--json"})["accelerations"];
    CHECK(std::abs(other["q7"].get<double>() - numbers["q7"].get<double>()) > 1e-3);
}

}  // namespace commands_space
