// SPDX-License-Identifier: MIT
// What most likely is not meant is told or refused, at its place; the same scene said rightly is silent.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "json.hpp"
#include "program.hpp"

namespace commands_told {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

/// A mass of 2 kg on a line, with what is added.
std::string on_line(const std::string& more) {
    return temporary(
        "line.toml",
        "[coordinates]\nx = { initial = 1, rate = 0.5, unit = \"m\" }\n[parameters]\nm = { value = 2, unit "
        "= \"kg\" }\nk = { value = 3, unit = \"N/m\" }\nl = { value = 0.4, unit = \"m\" }\nc = { value = "
        "0.1, unit = \"N*s/m\" }\nF = { value = 1, unit = \"N\" }\n[[particle]]\nname = \"p\"\nmass = "
        "\"m\"\nposition = [\"x\", 0]\n" +
            more);
}

int warnings(const std::string& scene, const std::string& kind) {
    int count = 0;
    const Json found = json_of({"eval", scene});
    for (const Json& one : found["warnings"]) count += one["kind"] == kind;
    return count;
}

}  // namespace

TEST_CASE(
    "told: units of springs and dampers along a coordinate, impulses, normal forces and contacts are looked at") {
    const struct {
        std::string right, wrong;
    } cases[] = {
        {"[[spring]]\nalong = \"x\"\nstiffness = \"k\"\nlength = \"l\"\n",
         "[[spring]]\nalong = \"x\"\nstiffness = \"m\"\nlength = \"l\"\n"},
        {"[[spring]]\nalong = \"x - l\"\nstiffness = \"k\"\n",
         "[[spring]]\nalong = \"x\"\nstiffness = \"k\"\nlength = \"m\"\n"},
        {"[[damper]]\nalong = \"x\"\ndamping = \"c\"\n", "[[damper]]\nalong = \"x\"\ndamping = \"k\"\n"},
        {"[[impulse]]\nat = \"p\"\nvector = [\"c*l\", 0]\n", "[[impulse]]\nat = \"p\"\nvector = [\"F\", 0]\n"},
        {"[[friction]]\nname = \"f\"\ncoefficient = 0.2\nslip = \"x'\"\nnormal = \"F\"\n",
         "[[friction]]\nname = \"f\"\ncoefficient = 0.2\nslip = \"x'\"\nnormal = \"m\"\n"},
    };
    for (const auto& [right, wrong] : cases) {
        CAPTURE(wrong);
        CHECK(warnings(on_line(right), "unit_mismatch") == 0);
        CHECK(warnings(on_line(wrong), "unit_mismatch") == 1);
    }
}

TEST_CASE("told: a force at a constant distance along N from a body that turns is at no place of the body") {
    const auto body = [](const std::string& axes, const std::string& from, const std::string& more = "") {
        return temporary("body.toml", fmt::format(R"([coordinates]
x = 0.3
a = 0.4
[[frame]]
name = "A"
rotate = [["z", "a"]]
[[body]]
name = "b"
mass = 2
inertia = 3
frame = "A"
position = ["x", 0]
[[point]]
name = "P"
{}
axes = "{}"
[[force]]
at = "P"
vector = [2, 5]
{})",
                                                  from, axes, more));
    };
    CHECK(warnings(body("N", "offset = [\"x\", 0.5]"), "moving_place") == 1);
    CHECK(warnings(body("N", "from = \"b\"\noffset = [0, 0.5]"), "moving_place") == 1);
    CHECK(warnings(body("A", "from = \"b\"\noffset = [0, 0.5]"), "moving_place") == 0);
    CHECK(warnings(body("N", "from = \"b\"\noffset = [0, 0]"), "moving_place") == 0);
    CHECK(warnings(body("N", "offset = [1, 2]"), "moving_place") == 0);
    // Neither is one at a constant distance along the axes of another frame, unless these are fixed in the body.
    const auto frame = [](const std::string& angle, const std::string& parent) {
        return fmt::format("[[frame]]\nname = \"F\"\nparent = \"{}\"\nrotate = [[\"z\", \"{}\"]]\n", parent,
                           angle);
    };
    const std::string beside = "from = \"b\"\noffset = [0, 0.5]";
    CHECK(warnings(body("F", beside, frame("2*a", "N")), "moving_place") == 1);
    CHECK(warnings(body("F", beside, frame("0.3", "N")), "moving_place") == 1);
    CHECK(warnings(body("F", beside, frame("0.3", "A")), "moving_place") == 0);
}

TEST_CASE("told: negative normal forces and sizes, rotations in degrees, names of columns and of rows left out") {
    const auto negative =
        run({"eval", on_line("[[friction]]\nname = \"f\"\ncoefficient = 1\nslip = \"x'\"\nnormal = -1\n")});
    CHECK(negative.exit == 4);
    CHECK(negative.err.find("the normal force of friction 'f' is -1") != std::string::npos);
    const auto disc = [](const std::string& size) {
        return temporary("disc.toml",
                         "coordinates = { a = 0 }\nparameters = { r = -0.5, l = \"2*r + 3\" }\n[[frame]]\nname = "
                         "\"A\"\nrotate = [[\"z\", \"a\"]]\n[[body]]\nname "
                         "= \"b\"\nmass = 3\nframe = \"A\"\nposition = [0, 0]\nshape = " +
                             size + "\ninertia = \"from shape\"\n");
    };
    CHECK(run({"eval", disc("{ disc = 2 }")}).exit == 0);
    const auto small = run({"eval", disc("{ disc = -2 }")});
    CHECK(small.exit == 3);
    CHECK(small.err.find("disc.toml:11:18: a size of 'disc' is -2") != std::string::npos);
    CHECK(run({"eval", disc("{ box = [1, -1, 1] }")}).exit == 3);
    for (const auto& [size, exit] : {std::pair("\"r\"", 3), std::pair("\"-r\"", 0), std::pair("\"l\"", 0),
                                     std::pair("\"l - 3\"", 3), std::pair("\"r^2\"", 0)}) {
        CAPTURE(std::string(size));
        const auto by_parameter = run({"eval", disc(fmt::format("{{ disc = {} }}", size))});
        CHECK(by_parameter.exit == exit);
    }
    const std::string frame =
        "[[frame]]\nname = \"A\"\nrotate = [[\"z\", {}]]\n[outputs]\no = \"dot(ex(A), ey(N))\"\n";
    CHECK(warnings(on_line(fmt::format(fmt::runtime(frame), "90")), "suspicious_number") == 1);
    CHECK(warnings(on_line(fmt::format(fmt::runtime(frame), "\"90 deg\"")), "suspicious_number") == 0);
    CHECK(warnings(on_line(fmt::format(fmt::runtime(frame), "1.2")), "suspicious_number") == 0);
    for (const char* name : {"t", "x", "energy"})
        CHECK(run({"eval", on_line(fmt::format("[outputs]\n{} = 1\n", name))}).exit == 3);
    CHECK(run({"eval", on_line("[outputs]\nE = 1\n")}).exit == 0);
    const auto wheel = [](const char* row) {
        return temporary("wheel.toml", fmt::format(R"(gravity = [0, -10]
[coordinates]
x = {{ rate = 1 }}
phi = {{ rate = -2 }}
[[frame]]
name = "A"
rotate = [["z", "phi"]]
[[body]]
name = "b"
mass = 2
frame = "A"
inertia = 1
position = ["x", 0.5]
[[rolling]]
name = "w"
body = "b"
contact = [0, -0.5]
[outputs]
o = "lambda_w_{}"
)",
                                                   row));
    };
    CHECK(run({"eval", wheel("x")}).exit == 0);
    const auto left_out = run({"eval", wheel("y")});
    CHECK(left_out.exit == 3);
    CHECK(left_out.err.find("wheel.toml:19:6: there is no 'lambda_w_y'") != std::string::npos);
}

TEST_CASE(
    "told: a quotient that is followed as a sign, however it is written, and no length of a spring or damper") {
    // The model writes |x| of a spring or damper on a line, whatever else the scene holds.
    const std::string spring = "[[spring]]\nbetween = [\"O\", \"p\"]\nstiffness = \"k\"\nlength = \"l\"\n",
                      damper = "[[damper]]\nbetween = [\"O\", \"p\"]\ndamping = \"c\"\n",
                      other = "[forces]\nx = \"-F*x*abs(x)\"\n";
    for (const std::string& scene : {spring, damper, spring + damper + other})
        CHECK(warnings(on_line(scene), "quotient_of_size") == 0);
    for (const char* force : {"-F*x/abs(x)", "-F*abs(x)/x", "-F*x/sqrt(x^2)", "-F*(x^2)^(3/2)/x^3",
                              "-F*sqrt(dot(pos(p), pos(p)))/x", "-F*x'/norm(vel(p))"}) {
        CAPTURE(force);
        const std::string load = fmt::format("[forces]\nx = \"{}\"\n", force);
        CHECK(warnings(on_line(load), "quotient_of_size") == 1);
        CHECK(warnings(on_line(spring + damper + load), "quotient_of_size") == 1);
    }
    CHECK(warnings(on_line("[[spring]]\nalong = \"sqrt(x^2)\"\nstiffness = \"k\"\nlength = \"l\"\n"),
                   "quotient_of_size") == 1);
}

TEST_CASE(
    "told: a motion of a joint stands where the file has it, and one whose name says another place is refused") {
    const auto planar = [](const std::string& lines) {
        return temporary(
            "planar.toml",
            "[[body]]\nname = \"B\"\nmass = 3\ninertia = [1, 1, 1]\n[[joint]]\nname = \"j\"\nparent = "
            "\"N\"\nchild = \"B\"\ntype = \"planar\"\n" +
                lines + "\n[outputs]\noy = \"dot(pos(B), ey(N))\"\n");
    };
    const auto refused = run({"eval", planar("coordinates = { x = 0.1, phi = 0.2 }\nmotion = { y = \"0.7\" }")});
    CHECK(refused.exit == 3);
    CHECK(refused.err.find(
              "'y' is an angle here; write the prescribed one in 'coordinates' too, at its place: y = 0") !=
          std::string::npos);
    CHECK(run({"eval", planar("motion = { y = \"0.7\" }\ncoordinates = { x = 0.1, phi = 0.2 }")}).exit == 3);
    const Json right =
        json_of({"eval", planar("coordinates = { x = 0.1, y = 0, phi = 0.2 }\nmotion = { y = \"0.7\" }")});
    CHECK(right["outputs"]["oy"] == 0.7);
    CHECK(run({"eval", planar("coordinates = { x = 0.1, y = 0.2 }\nmotion = { phi = \"0.7\" }")}).exit == 0);
    CHECK(run({"eval", planar("coordinates = { u = 0.1, w = 0.2 }\nmotion = { v = \"0.7\" }")}).exit == 0);
    // z is the turn of a planar joint, whatever its name, and a longer name may mean something else.
    CHECK(warnings(planar("motion = { x = \"0.7\" }\ncoordinates = { y = 0.1, z = 0.2 }"), "joint_order") == 0);
    CHECK(warnings(planar("coordinates = { x = 0.1, z = 0.2 }\nmotion = { turn = \"0.7\" }"), "joint_order") == 0);
    CHECK(warnings(planar("motion = { s = \"0.7\" }\ncoordinates = { j_x = 0.1, turn = 0.2 }"), "joint_order") ==
          1);
    CHECK(warnings(planar("coordinates = { s = 0, j_x = 0.1, turn = 0.2 }\nmotion = { s = \"0.7\" }"),
                   "joint_order") == 0);
    CHECK(warnings(planar("coordinates = { y = 0, x = 0.1, turn = 0.2 }\nmotion = { y = \"0.7\" }"),
                   "joint_order") == 0);
    const auto free = [](const std::string& lines) {
        return temporary(
            "free.toml",
            "[[body]]\nname = \"B\"\nmass = 3\ninertia = { xx = 1, yy = 1, zz = 1 }\n[[joint]]\nname = "
            "\"j\"\nparent = \"N\"\nchild = \"B\"\ntype = \"free\"\nangles = \"zyx\"\n" +
                lines + "\n");
    };
    CHECK(
        run({"eval", free("coordinates = { x = 0.1, y = 0, z = 0, rot_z = 0.2, rot_y = 0.3 }\nmotion = { rot_x = "
                          "\"0.7\" }")})
            .exit == 0);
}

TEST_CASE("told: an event whose expression ends along the motion, with every method, and none that has values") {
    const auto scene = [](const std::string& when) {
        return temporary("ends.toml",
                         "[coordinates]\nx = { initial = 0, rate = 1 }\n[[particle]]\nname = \"P\"\nmass = "
                         "1\nposition = [\"x\", 0]\n[[event]]\nname = \"reaches\"\nwhen = \"" +
                             when + "\"\nstop = true\n[simulation]\nduration = 10\n");
    };
    const auto told = [](const std::string& file, const std::string& method) {
        int count = 0;
        std::vector<std::string> args{"simulate", file, "--method", method};
        if (method == "rk4") args.insert(args.end(), {"--step", "0.1"});
        const Json found = json_of(args);
        for (const Json& one : found["warnings"])
            count += one["kind"] == "not_a_number" &&
                     one["message"].get<std::string>().find(
                         "the expression of event 'reaches' has a value at t = ") != std::string::npos;
        return count;
    };
    for (const char* method : {"auto", "taylor", "dop853", "radau", "rk4", "rkn86", "abm"}) {
        CAPTURE(method);
        CHECK(told(scene("sqrt(25 - x^2) + 1"), method) == 1);  // ends without a zero
        CHECK(told(scene("sqrt(25 - x^2) - 3"), method) == 0);  // stops before
        CHECK(told(scene("sqrt(25 + x^2) + 1"), method) == 0);
        CHECK(told(scene("log(x - 7)"), method) == 0);  // begins, and stops at x = 8
    }
}

TEST_CASE("told: an input takes a value at a state, and its derivatives are zero") {
    const std::string scene = on_line("[inputs]\nu = \"2*t\"\n[forces]\nx = \"u + u'\"\n");
    CHECK(json_of({"eval", scene})["accelerations"]["x"] == 1);
    CHECK(json_of({"eval", scene, "--at", "u=5"})["accelerations"]["x"] == 2.5);
    CHECK(std::abs(json_of({"eval", scene, "--inverse", "--at", "u=5", "x''=1"})["loads"]["x"].get<double>() + 3) <
          1e-14);
    // A spring balances it: k x = u (1 + …) gives x = 5/3.
    const std::string held = on_line(
        "[inputs]\nu = \"2*t\"\n[[force]]\nat = \"p\"\nvector = [\"u\", 0]\n[[spring]]\n"
        "along = \"x\"\nstiffness = \"k\"\n");
    const Json rest = json_of({"equilibrium", held, "--at", "u=5"});
    REQUIRE(rest["equilibria"].size() == 1);
    CHECK(std::abs(rest["equilibria"][0]["coordinates"]["x"].get<double>() - 5. / 3) < 1e-12);
    CHECK(json_of({"eval", held, "--inertia", "--at", "u=5"})["mass"] == 2);
    CHECK(json_of({"eval", held, "--kinematics", "--at", "u=5"})["coordinates"]["x"] == 1);
    CHECK(run({"stability", held, "--at", "u=5", "x=5/3", "x'=0"}).exit == 0);
    CHECK(run({"linearize", held, "--at", "u=5", "x=5/3", "x'=0"}).exit == 0);
    CHECK(run({"eval", scene, "--at", "u=1/0"}).exit == 3);
    CHECK(run({"eval", scene, "--at", "v=5"}).exit == 3);
}

TEST_CASE("told: no output overwrites a file of a class or of loops, and a class ends at its folder") {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(temporary("x", "")).parent_path() / "class",
                   outside = folder.parent_path() / "other.md";
    fs::remove_all(folder);
    fs::create_directories(folder);
    const std::string text = "The equation of motion is $m \\ddot x = 0$.\n";
    std::ofstream(folder / "own.md") << text;
    std::ofstream(outside) << text;
    fs::create_symlink(outside, folder / "linked.md");
    fs::remove(folder.parent_path() / "page.html");
    fs::create_symlink(folder / "own.md", folder.parent_path() / "page.html");
    const std::string scene = on_line("");
    const auto graded = run({"check", scene, folder.string()});
    CHECK(graded.out.find("own.md") != std::string::npos);
    // What is not followed has its row too, with the reason.
    const Json book = Json::parse(run({"check", scene, folder.string(), "--json"}).out);
    CHECK(graded.out.find("linked.md") != std::string::npos);
    int problems = 0;
    for (const Json& row : book["derivations"])
        if (row["file"] == "linked.md")
            problems += row.value("problem", "").find("leads out of the folder") != std::string::npos;
    CHECK(problems == 1);
    CHECK(run({"check", scene, folder.string(), "--html", (folder.parent_path() / "page.html").string()}).exit ==
          3);
    CHECK(alembert::test::contents((folder / "own.md").string()) == text);
    const std::string loops = temporary("loops.toml", "");
    CHECK(run({"import", alembert::test::source_path("tests/robots/arm6.urdf"), "-o", loops, "--loops", loops})
              .exit == 3);
}

TEST_CASE("told: a stiffness or damping that is a negative number, with its line, unless the scene allows it") {
    const std::string spring = "[[spring]]\nalong = \"x\"\nstiffness = ",
                      damper = "[[damper]]\nalong = \"x\"\ndamping = ";
    for (const auto& [more, told] :
         {std::pair{spring + "-5\n", "15:13: warning: the stiffness of this spring is -5: "},
          std::pair{spring + "\"-k\"\n", "15:14: warning: the stiffness of this spring is -3: "},
          std::pair{damper + "\"-2*c\"\n", "15:12: warning: the damping of this damper is -0.2: "}}) {
        CAPTURE(more);
        const auto result = run({"eval", on_line(more)});
        CHECK(result.exit == 0);
        CHECK(result.err.find(told) != std::string::npos);
        CHECK(warnings(on_line(more), "suspicious_number") == 1);
    }
    // What varies is meant, as the damping of van der Pol's equation.
    for (const std::string& more :
         {spring + "\"k\"\n", damper + "\"c\"\n", damper + "\"-c*(1 - x^2/l^2)\"\n", spring + "0\n"})
        CHECK(warnings(on_line(more), "suspicious_number") == 0);
    const std::string negative = on_line(spring + "-5\n");
    CHECK(run({"eval", negative, "--at", "k=1"}).err.find("stiffness") != std::string::npos);
    CHECK(run({"eval", on_line(spring + "\"k\"\n"), "--at", "k=-1"}).err.find("is -1: ") != std::string::npos);
}

TEST_CASE("told: values of --at in another unit, of angles too, and the line of a division by zero") {
    const std::string scene = temporary("angles.toml", R"toml(
[parameters]
l = { value = 1, unit = "m" }
[coordinates]
theta = { initial = 0.5, unit = "rad" }
[[particle]]
name = "p"
mass = 1
position = ["l*sin(theta)", "-l*cos(theta)"]
[energy]
potential = "1/theta"
)toml");
    const auto told = [&](const char* at) { return run({"eval", scene, "--at", at}).err; };
    CHECK(told("theta=1 kg").find("'theta' is in rad, and its value '1 kg' is in kg") != std::string::npos);
    CHECK(told("theta'=1 kg").find("'theta'' is in rad/s, and") != std::string::npos);
    CHECK(told("l=20 deg").find("'l' is in m, and its value '20 deg' is in 1 (a number or an angle)") !=
          std::string::npos);
    CHECK(told("theta=20 deg").empty());
    CHECK(told("theta=0").find("a division by zero in [energy] potential (line 11)") != std::string::npos);
}

}  // namespace commands_told
