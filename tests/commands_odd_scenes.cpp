// SPDX-License-Identifier: MIT
// Scenes in which something has no value: nothing is killed by a signal, nothing is an internal error, and where
// the scene is to blame the message has its line.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "json.hpp"
#include "program.hpp"

namespace commands_odd_scenes {

using namespace alembert::test;

namespace {

const std::string particle =
    "[coordinates]\nx = 0.5\n[[particle]]\nname = \"p\"\nmass = 1\nposition = [\"x\", 0]\n";

std::string with_parameter(const std::string& value) {
    return "[parameters]\na = 0\nb = \"" + value + "\"\n" + particle + "[outputs]\no = \"b\"\n";
}

std::string body_with(const std::string& shape) {
    return "[parameters]\nw = 0\n[coordinates]\na = 0\n[[frame]]\nname = \"A\"\nrotate = [[\"z\", "
           "\"a\"]]\n[[body]]\n"
           "name = \"b\"\nmass = 3\nframe = \"A\"\nposition = [0, 0]\nshape = " +
           shape + "\ninertia = \"from shape\"\n";
}

const std::vector<std::vector<std::string>> verbs{{"eval"},
                                                  {"eval", "--reactions"},
                                                  {"eval", "--identify"},
                                                  {"eval", "--inverse"},
                                                  {"eval", "--inertia"},
                                                  {"eval", "--kinematics", "--jacobian"},
                                                  {"eval", "--impact"},
                                                  {"derive"},
                                                  {"check"},
                                                  {"check", "--formalisms"},
                                                  {"audit"},
                                                  {"stability"},
                                                  {"equilibrium"},
                                                  {"simulate", "--duration", "0.01"},
                                                  {"bench", "--duration", "0.01", "--method", "rk4"},
                                                  {"emit"},
                                                  {"emit", "--functions", "com_jacobian,momentum"}};

Run run_on(std::vector<std::string> verb, const std::string& file) {
    verb.insert(verb.begin() + 1, file);
    return run(verb);
}

bool holds(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

/// Whether a run ended as a program ends that knows what it does.
void is_orderly(const std::vector<std::string>& verb, const std::string& file) {
    const Run result = run_on(verb, file);
    CAPTURE(fmt::format("{}", fmt::join(verb, " ")));
    CAPTURE(file);
    CAPTURE(result.err);
    CHECK(result.exit >= 0);
    CHECK(result.exit <= 4);
    CHECK(result.err.find("internal error") == std::string::npos);
    CHECK(result.out.find("internal error") == std::string::npos);
}

/// That each verb refuses a scene with this line in its message; emission may come without values.
void is_refused(const std::string& text, const std::string& place) {
    const std::string file = temporary("refused.toml", text);
    for (const auto& verb : verbs) {
        is_orderly(verb, file);
        if (verb[0] == "check" || verb[0] == "emit" || (verb[0] == "eval" && verb.size() > 1)) continue;
        const Run result = run_on(verb, file);
        CAPTURE(fmt::format("{} {}", fmt::join(verb, " "), text));
        CHECK(result.exit == 3);
        CHECK_MESSAGE(result.err.find("refused.toml:" + place) != std::string::npos, result.err);
    }
}

}  // namespace

TEST_CASE("odd scenes: a parameter without a value is refused with its line") {
    for (const char* value :
         {"1/a", "log(a)", "a^a", "a^(-1)", "sign(a)/a", "min(1/a, 2)", "acos(2 + a)", "sqrt(a - 1)", "log(a - 1)",
          "exp(1000)", "cosh(1000 + a)", "exp(exp(10))", "(-8)^(1/3)", "1e300*exp(700)"})
        is_refused(with_parameter(value), "3:");
    is_refused("[parameters]\nR = 1e300\nS = \"R*R\"\n" + particle, "3:");
    for (const char* huge : {"1e20", "1e100", "1e308"})  // CLN takes the exponential of the last two for 1
        for (const char* value : {"exp(a)", "1 + exp(2*a)", "cosh(a)", "sinh(-a)", "1/exp(-a)"})
            is_refused("[parameters]\na = " + std::string(huge) + "\nb = \"" + value + "\"\n" + particle, "3:");
    is_refused(
        "[parameters]\na = 0\n[coordinates]\nx = \"1/a\"\n[[particle]]\nname = \"p\"\nmass = 1\nposition = "
        "[\"x\", 0]\n",
        "4:");
}

TEST_CASE("odd scenes: an output without a value is warned of with its line, and --strict refuses it") {
    for (const char* value : {"1/a", "asin(2 + a)", "log(a)", "x/a", "sqrt(a - 1)", "exp(x*1e4)"}) {
        const std::string file =
            temporary("no_output.toml", "[parameters]\na = 0\n" + particle + "[outputs]\no = \"" + value + "\"\n");
        const Run result = run({"eval", file}), strict = run({"eval", file, "--strict"});
        CAPTURE(std::string(value));
        CHECK(result.exit == 0);
        CHECK_MESSAGE(holds(result.err, "no_output.toml:10:"), result.err);
        CHECK(holds(result.err, "'o' is not a finite number here"));
        CHECK(strict.exit == 3);
        CHECK(strict.out.empty());
    }
}

TEST_CASE("odd scenes: a shape without an area has no inertia, and is refused with its line") {
    is_refused(body_with("[[0, 0], [1, 1], [2, 2]]"), "13:");
    is_refused(body_with("{ wedge = [0, 0] }"), "13:");
    is_refused(body_with("{ wedge = [0, 1] }"), "13:");
    is_refused(body_with("{ polygon = [[0, 0], [0, 0], [0, 0]] }"), "13:");
}

TEST_CASE("odd scenes: units and springs that have no meaning are refused with their line") {
    is_refused("[parameters]\nl = { value = 2, unit = \"km^64*km^64\" }\n" + particle, "2:");
    is_refused("[parameters]\nl = { value = 1e250, unit = \"Qm^3\" }\n" + particle, "2:");
    is_refused(particle + "[[spring]]\nbetween = [\"p\", \"p\"]\nstiffness = 1\nlength = 1\n", "8:");
}

TEST_CASE("odd scenes: nothing is killed, and nothing is an internal error, where values are missing or extreme") {
    const std::string mass = "[[particle]]\nname = \"p\"\n", of_x = "position = [\"x\", 0]\n";
    const std::pair<const char*, std::string> scenes[] = {
        {"nothing", "[coordinates]\nx = 0\n"},
        {"no_mass", "[coordinates]\nx = 0\n" + mass + "mass = 0\n" + of_x},
        {"zero_mass", "[parameters]\nm = 0\n[coordinates]\nx = 0\n" + mass + "mass = \"m\"\n" + of_x},
        {"massless_body",
         "[coordinates]\nx = 0\n[[frame]]\nname = \"A\"\nrotate = [[\"z\", \"x\"]]\n[[body]]\nname = "
         "\"b\"\nmass = 0\nframe = \"A\"\ninertia = 0\nposition = [0, 0, 0]\n"},
        {"resting", "[coordinates]\nx = 0\n" + mass + "mass = 1\nposition = [0, 0]\n"},
        {"locked", "[coordinates]\nx = 0\n" + mass + "mass = 1\n" + of_x +
                       "[[constraint]]\nname = \"c\"\nholonomic = \"x = 0\"\n"},
        {"tiny_place", "[parameters]\nl = { value = 1, unit = \"m\" }\n[coordinates]\nx = 0\n" + mass +
                           "mass = 1\nposition = [\"l + x\", 1e-310]\n"},
        {"tiny_start", "[coordinates]\nx = { initial = 1e-310, rate = 1e-310 }\n" + mass + "mass = 1\n" + of_x},
        {"tiny_mass", "[coordinates]\nx = 0\n" + mass + "mass = 1e-320\nposition = [\"x*1e-200\", 0]\n"},
        {"huge_mass", "[coordinates]\nx = 0\n" + mass + "mass = 1e308\nposition = [\"10*x\", \"x\"]\n"},
        {"huge_gravity",
         "gravity = [0, 1e308]\n[coordinates]\nx = 1\n" + mass + "mass = 1e10\nposition = [0, \"x\"]\n"},
        {"far", "[coordinates]\nx = 1e308\n" + mass + "mass = 1\nposition = [\"10*x\", \"x^2\"]\n"},
        {"weld_underflow",
         "[[body]]\nname = \"a\"\nmass = 1\ninertia = { xx = 1, yy = 2, zz = 2 }\n[[joint]]\nname = \"f\"\ntype = "
         "\"free\"\nparent = \"N\"\nchild = \"a\"\ncoordinates = { x = 0, y = 0, z = 1, e0 = 0.6, e1 = 0, e2 = 0, "
         "e3 = "
         "0.8 }\n[[joint]]\nname = \"w\"\ntype = \"fixed\"\nparent = \"a\"\nchild = \"N\"\nparent_point = [0, 0, "
         "1]\n"},
        {"linkage_underflow",
         "[coordinates]\nx = { initial = 0, rate = -1 }\nq1 = { initial = 0, rate = -1 }\nq2 = { initial = 0, "
         "rate = "
         "-1 }\np0 = 0\np1 = 0\n[[constraint]]\nname = \"x0\"\nholonomic = \"cos(p0) - 1 + "
         "sin(q1)\"\n[[constraint]]\n"
         "name = \"y0\"\nholonomic = \"sin(p0) - cos(q1)\"\n[[constraint]]\nname = \"x1\"\nholonomic = \"1+1 - "
         "sin(q1) "
         "- 2 + sin(q2)\"\n"},
        {"pole_in_time", "[inputs]\nF = \"1/t\"\n" + particle + "[[force]]\nat = \"p\"\nvector = [\"F\", 0]\n"},
        {"no_start", "[parameters]\na = 0\n" + particle + "[simulation]\nstart = \"log(a)\"\nduration = 1\n"},
        {"wedge", body_with("{ wedge = [\"w\", \"w\"] }")},
        {"rope", "[parameters]\nR = 0.1\n" + particle +
                     "[[scenery]]\npulley = \"R\"\nname = \"wheel\"\nat = [0, 1]\n[[scenery]]\nrope = [\"p\", "
                     "\"wheel\", [0, 1]]\n"},
        {"polynomial", "[parameters]\na = 0\n[polynomial]\ncoefficients = [\"1/a\", \"1\"]\n"},
        {"output_pole",
         "[parameters]\na = 0\n" + particle + "[outputs]\no = \"x/a\"\np = \"a^a\"\nq = \"log(a)\"\n"}};
    for (const auto& [name, text] : scenes) {
        const std::string file = temporary(std::string(name) + ".toml", text);
        for (const auto& verb : verbs) is_orderly(verb, file);
        is_orderly({"report", "-o", temporary("odd.html", "")}, file);
        is_orderly({"derive", "--svg", temporary("odd.svg", "")}, file);
    }
}

TEST_CASE("odd scenes: identify says that there is nothing to identify, and what has no influence") {
    const Run empty = run({"eval", temporary("empty.toml", "[coordinates]\nx = 0\n"), "--identify"});
    CHECK(empty.exit == 3);
    CHECK(empty.err.find("no masses") != std::string::npos);
    const std::string locked =
        temporary("locked.toml", particle + "[[constraint]]\nname = \"c\"\nholonomic = \"x = 0.5\"\n");
    const Run none = run({"eval", locked, "--identify", "--json"});
    REQUIRE(none.exit == 0);
    CHECK(Json::parse(none.out)["without_influence"].size() == Json::parse(none.out)["parameters"].size());
}

TEST_CASE("odd scenes: a file to be written needs a name") {
    const Run made = run({"new", ""});
    CHECK(made.exit == 3);
    CHECK(made.err.find("the name of the file to be written is empty") != std::string::npos);
}

}  // namespace commands_odd_scenes
