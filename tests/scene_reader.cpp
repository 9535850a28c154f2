// SPDX-License-Identifier: GPL-2.0-or-later
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "files.hpp"
#include "scene/scene.hpp"

namespace scene_reader {

using namespace alembert;

namespace {

std::string told(const std::string& text) {
    try {
        parse_scene(text, "p.toml");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

template <typename Item>
std::string names(const std::vector<Item>& items) {
    std::string list;
    for (const Item& item : items) list += (list.empty() ? "" : " ") + item.name.text;
    return list;
}

std::string components(const Vector& vector) {
    return vector.component[0].text + " | " + vector.component[1].text + " | " + vector.component[2].text;
}

}  // namespace

TEST_CASE("reader: the scene in the description of the language is read unchanged") {
    const Scene scene = parse_scene(R"toml(
title  = "Two masses on strings, pulled sideways"
source = "Zhang & Qin, Advanced Dynamics (2004), example 1-2"
gravity = [0, "g"]                  # acceleration, along the axes of N; here y points down

[parameters]                        # symbols in every derivation, numbers when it runs
m1 = 1.0
m2 = { value = 1.0, unit = "kg", about = "lower mass" }
l1 = 1.0
l2 = 0.8
g  = 9.81

[inputs]                            # given functions of time; printed as F(t)
F = "0.5*sin(3*t)"

[coordinates]                       # generalized coordinates, in state order (the order of the file)
theta1 = { initial = 0.5, rate = 0.0, unit = "rad" }
theta2 = -0.2                       # short for { initial = -0.2, rate = 0 }

[definitions]                       # abbreviations, in any order
x2 = "l1*sin(theta1) + l2*sin(theta2)"

[[particle]]
name = "M1"
mass = "m1"
position = ["l1*sin(theta1)", "l1*cos(theta1)"]

[[particle]]
name = "M2"
mass = "m2"
position = ["x2", "l1*cos(theta1) + l2*cos(theta2)"]

[[force]]
at = "M2"
vector = ["F", 0]

[simulation]
duration = 10.0
tolerance = 1e-10

[[claim]]                           # a hand derivation to be checked
equation = "(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + (m1+m2)*g*sin(theta1) = F*cos(theta1)"
source = "equation (9), first line"
)toml",
                                    "double_pendulum.toml");
    CHECK(names(scene.parameters) == "m1 m2 l1 l2 g");
    CHECK(names(scene.coordinates) == "theta1 theta2");
    CHECK(names(scene.particles) == "M1 M2");
    CHECK(components(*scene.gravity) == "0 | g | 0");
    CHECK(scene.coordinates[1].initial.text == "-0.2");
    CHECK(scene.coordinates[1].rate.text == "0");
    CHECK(scene.simulation.tolerance.text == "1e-10");
    CHECK(scene.claims.at(0).equation.rhs.text == " F*cos(theta1)");
    CHECK(scene.claims[0].at == Claim::At::motion);
}

TEST_CASE("reader: every table is read in full") {
    const Scene scene = read_scene(ALEMBERT_SOURCE_DIR "/tests/whole.toml");
    CHECK(scene.title == "Everything at once");
    CHECK(scene.source == "tests");
    CHECK(scene.notes == "Not a machine\nof this world.");
    CHECK(components(scene.gravity.value()) == "0 | -g | 0");

    CHECK(names(scene.parameters) == "m m2 g l k n I double");
    std::string values;
    for (const Parameter& p : scene.parameters) values += p.value.text + " ";
    CHECK(values == "1.50 2*m 9.81 1000.5 2e3 31 1 2 ");
    CHECK(scene.parameters[1].unit == "kg");
    CHECK(scene.parameters[1].about == "twice the first");
    CHECK(scene.parameters[1].name.place == Place{11, 1});
    CHECK(scene.parameters[1].value.place(2) == Place{11, 19});
    CHECK(scene.parameters[3].value.place(1) == Place{13, 7});  // the separator is not part of the number

    CHECK(names(scene.inputs) == "F G");
    CHECK(scene.inputs[1].value.text == "1 + t");
    CHECK(scene.inputs[1].unit == "N");

    CHECK(names(scene.coordinates) == "θ φ2 x y");
    CHECK(scene.coordinates[0].initial.text == "l/1000");
    CHECK(scene.coordinates[0].rate.text == "-0.25");
    CHECK(scene.coordinates[0].rate.tree->kind == Tree::Kind::negate);
    CHECK(scene.coordinates[0].about == "the angle");
    CHECK(scene.coordinates[2].rate.text == "g/2");
    CHECK(scene.coordinates[3].initial.text == "0");
    CHECK(names(scene.definitions) == "s v");

    REQUIRE(names(scene.frames) == "A B");
    CHECK(scene.frames[0].parent.text == "N");
    CHECK(scene.frames[0].rotations[0].letter == 'z');
    CHECK(scene.frames[0].rotations[1].letter == 0);
    CHECK(components(scene.frames[0].rotations[1].axis) == "1 | m | 0");
    CHECK(scene.frames[0].rotations[1].angle.text == "φ2 + F");
    CHECK(scene.frames[1].parent.text == "A");

    REQUIRE(names(scene.points) == "P Q");
    CHECK(scene.points[0].position.from.text == "O");
    CHECK(scene.points[1].position.from.text == "P");
    CHECK(scene.points[1].position.axes.text == "B");
    CHECK(components(scene.points[1].position.offset) == "0 | x | 1");

    REQUIRE(names(scene.particles) == "M1 M2");
    CHECK(scene.particles[0].position.from.text == "P");
    CHECK(components(scene.particles[0].position.offset) == "0 | 0 | 0");
    CHECK(scene.particles[1].mass.text == "0");
    CHECK(components(scene.particles[1].position.offset) == "x | y | 0");

    REQUIRE(names(scene.bodies) == "disk rod block");
    CHECK(scene.bodies[0].frame.text == "A");
    CHECK(scene.bodies[0].inertia->planar->text == "m*l^2/2");
    CHECK(scene.bodies[1].frame.text == "N");
    CHECK(scene.bodies[1].inertia->is_diagonal);
    CHECK(scene.bodies[1].inertia->tensor[2].text == "m");
    CHECK(scene.bodies[1].about->text == "P");
    CHECK_FALSE(scene.bodies[2].inertia->is_diagonal);
    CHECK(scene.bodies[2].inertia->tensor[3].text == "-m");
    CHECK(scene.bodies[2].inertia->tensor[5].text == "0");

    CHECK(scene.forces.at(0).at.text == "M1");
    CHECK(components(scene.forces[0].vector) == "F | -x' | 0");
    CHECK(scene.forces[0].axes.text == "A");
    CHECK(scene.forces[0].reaction->text == "M2");
    CHECK(components(scene.torques.at(0).vector) == "0 | 0 | -θ'");
    CHECK(scene.torques[0].reaction->text == "N");
    CHECK(components(scene.torques.at(1).vector) == "1 | 2 | 3");

    CHECK(scene.springs.at(0).between->second.text == "M1");
    CHECK(scene.springs[0].constant.text == "k");
    CHECK(scene.springs[0].length.text == "0.5");
    CHECK_FALSE(scene.springs.at(1).between);
    CHECK(scene.springs[1].along.text == "x - y");
    CHECK(scene.springs[1].length.text == "0");
    CHECK(scene.dampers.at(0).constant.text == "1 + x'^2");

    CHECK(scene.kinetic.text == "x'^2/2");
    CHECK(scene.potential.text == "k*x^2/2");
    CHECK_FALSE(scene.lagrangian);
    CHECK(scene.rayleigh.text == "x'^2");
    CHECK(scene.generalized_forces.at(0).coordinate.text == "x");
    CHECK(scene.generalized_forces.at(1).value.text == "-v");
    CHECK(names(scene.outputs) == "speed lift");

    REQUIRE(names(scene.events) == "touch turn");
    CHECK(scene.events[0].stop);
    CHECK_FALSE(scene.events[1].stop);

    CHECK(scene.simulation.start.text == "1");
    CHECK(scene.simulation.duration.text == "2*pi");
    CHECK(scene.simulation.method->text == "dop853");
    CHECK_FALSE(scene.simulation.step);
    CHECK(scene.simulation.max_step.text == "1/k");

    REQUIRE(scene.claims.size() == 2);
    CHECK(scene.claims[0].source == "line 1");
    CHECK(scene.claims[1].at == Claim::At::impact);
    CHECK(scene.claims[1].unknowns.at(0).text == "e");
    CHECK(scene.claims[1].constants.at(0).text == "c1");
}

TEST_CASE("reader: a byte order mark and line ends with carriage returns change nothing") {
    std::string text = "\xEF\xBB\xBF";
    for (const char c : test::contents(test::source_path("tests/whole.toml")))
        text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    const Scene scene = parse_scene(text, "p.toml");
    CHECK(scene.notes == "Not a machine\nof this world.");
    CHECK(scene.parameters[1].value.place(2) == Place{11, 19});
    CHECK(told("\xEF\xBB\xBF[coordinates]\r\nx = 0\r\n[outputs]\r\ny = \"z\"\r\n") ==
          "p.toml:4:6: unknown name 'z' in this expression\n    y = \"z\"\n         ^\n");
}

TEST_CASE("reader: the order is that of the file, however tables are written") {
    const Scene scene = parse_scene(
        "coordinates.z = 1\ncoordinates.a.initial = 2\ncoordinates.m = 3\ncoordinates.a.rate = \"k\"\n"
        "parameters = { k = 1, b = 2 }\nparticle = [ { name = \"M\", mass = 1, position = [0, \"z\"] } ]\n",
        "p.toml");
    CHECK(names(scene.coordinates) == "z a m");
    CHECK(scene.coordinates[1].rate.text == "k");
    CHECK(names(scene.parameters) == "k b");
    CHECK(names(scene.particles) == "M");
    const Scene tables = parse_scene("[coordinates.z]\n[coordinates.a]\ninitial = 0.5\n", "p.toml");
    CHECK(names(tables.coordinates) == "z a");
}

TEST_CASE("reader: escapes and line ends in strings keep their places") {
    const Scene scene = parse_scene(
        "[coordinates]\nx = 0\n[definitions]\na = \"\\u0078 + x\"\nb = \"\"\"\nx +\\\n    x\"\"\"\n", "p.toml");
    const Expression& a = scene.definitions[0].value;
    CHECK(a.text == "x + x");
    CHECK(a.place(0) == Place{4, 6});
    CHECK(a.place(1) == Place{4, 12});
    CHECK(a.place(4) == Place{4, 15});
    const Expression& b = scene.definitions[1].value;
    CHECK(b.text == "x +x");
    CHECK(b.place(0) == Place{6, 1});
    CHECK(b.place(3) == Place{7, 5});
}

TEST_CASE("reader: the nearest name is one that could have been meant") {
    const std::vector<std::string> known{"theta1", "theta2", "m", "length", "F"};
    CHECK(nearest("thetta2", known) == "theta2");
    CHECK(nearest("theat1", known) == "theta1");
    CHECK(nearest("lenght", known) == "length");
    CHECK(nearest("f", known) == "F");
    CHECK(nearest("k", known).empty());
    CHECK(nearest("velocity", known).empty());
    CHECK(nearest("θ2", {"θ1"}) == "θ1");
}

TEST_CASE("reader: impulses at points and along coordinates are read") {
    const Scene scene = parse_scene(R"toml([coordinates]
x = 0
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[[frame]]
name = "F"
rotate = [["z", "x"]]
[[impulse]]
at = "P"
vector = ["2*cos(x)", 1]
axes = "F"
[impulses]
x = "3*t"
)toml",
                                    "scene.toml");
    REQUIRE(scene.impulses.size() == 1);
    CHECK(scene.impulses[0].at.text == "P");
    CHECK(scene.impulses[0].axes.text == "F");
    CHECK(components(scene.impulses[0].vector) == "2*cos(x) | 1 | 0");
    REQUIRE(scene.generalized_impulses.size() == 1);
    CHECK(scene.generalized_impulses[0].coordinate.text == "x");
    CHECK(scene.generalized_impulses[0].value.text == "3*t");
    CHECK(scene.forces.empty());
}

TEST_CASE("reader: letters of derivations stand for names of the scene, and for no others") {
    const std::string scene = "[parameters]\nl = 1\n[coordinates]\ntheta = 0\n[letters]\n";
    const Scene good = parse_scene(scene + R"toml("\\ell" = "l"
'\omega' = "θ'"
K = "T"
)toml",
                                   "scene.toml");
    REQUIRE(good.letters.size() == 3);
    CHECK(good.letters[0].written.text == "\\ell");
    CHECK(good.letters[0].name.text == "l");
    CHECK(good.letters[1].written.text == "\\omega");
    CHECK(good.letters[1].name.text == "theta'");
    CHECK(good.letters[2].name.text == "T");
    try {
        parse_scene(scene + "q = \"length\"\n", "scene.toml");
        FAIL("a name that the scene does not have was read");
    } catch (const SceneError& mistake) {
        REQUIRE(mistake.diagnostics.size() == 1);
        CHECK(mistake.diagnostics[0].place.line == 6);
        CHECK(mistake.diagnostics[0].message.find("'length'") != std::string::npos);
    }
}

TEST_CASE("reader: a chain of a thousand links is read in any order, and the limit has a reason and a way out") {
    const auto chain = [](int links, bool is_reversed) {
        std::string scene = "[parameters]\nL = 0.2\n[coordinates]\n";
        for (int k = 0; k < links; ++k) scene += fmt::format("q{} = 0.3\n", k);
        for (int k = 0; k < links; ++k) {
            const int link = is_reversed ? links - 1 - k : k;
            scene += fmt::format(
                "[[particle]]\nname = \"P{}\"\nmass = 1\nfrom = \"{}\"\nposition = [\"L*sin(q{})\", "
                "\"-L*cos(q{})\"]\n",
                link, link == 0 ? "O" : fmt::format("P{}", link - 1), link, link);
        }
        try {
            return fmt::format("{} particles", parse_scene(scene, "chain.toml").particles.size());
        } catch (const SceneError& error) {
            return std::string(error.what());
        }
    };
    CHECK(chain(1000, false) == "1000 particles");
    CHECK(chain(1000, true) == "1000 particles");
    const std::string told = chain(2100, false);
    CHECK_MESSAGE(told.find("depends on other names through more than 2000 levels") != std::string::npos, told);
    CHECK(told.find("count it from a nearer point or frame") != std::string::npos);
}

}  // namespace scene_reader
