// SPDX-License-Identifier: MIT
// `[tables]`, functions by points: values and derivatives as scipy 1.17 has them (CubicSpline, PchipInterpolator),
// runs through their knots against closed forms and scipy, claims, files, and all ways out of the program.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "edits.hpp"
#include "files.hpp"
#include "json.hpp"
#include "program.hpp"
#include "shell.hpp"

namespace commands_point_tables {

using namespace alembert::test;

namespace {

/// A particle on x with the force `load`, and these outputs.
std::string on_line(const std::string& tables, const std::string& load, const std::string& outputs = "",
                    const std::string& start = "initial = 1") {
    return fmt::format(R"toml(
[parameters]
m = 1
[coordinates]
x = {{ {} }}
[tables]
{}
[[particle]]
name = "p"
mass = "m"
position = ["x", 0]
[forces]
x = "{}"
[outputs]
{}
)toml",
                       start, tables, load, outputs);
}

const char* const points = "points = [[0, 0.3], [0.7, 1.2], [1.5, 0.4], [2, -0.5], [3.1, 0.2], [4, 0.3]]";

double output(const Json& answer, const std::string& name) {
    return answer["outputs"][name].get<double>();
}

/// x(t) of m x'' = −k x with k = 1 for x > 0 and k = 2 for x < 0, from x = 1 at rest.
double between_two_springs(double t) {
    const double half = std::numbers::pi, soft = half / std::sqrt(2.0);
    t = std::fmod(t, half + soft);
    if (t < half / 2) return std::cos(t);
    if (t < half / 2 + soft) return -std::sin(std::sqrt(2.0) * (t - half / 2)) / std::sqrt(2.0);
    return std::sin(t - half / 2 - soft);
}

const char* const two_springs =
    "f = { arguments = [\"x\"], points = [[-2, -4], [-1, -2], [0, 0], [1, 1], [3, 3]] }";

std::string refused(const std::string& tables, const std::string& load = "-f(x)") {
    const Run result = run({"eval", temporary("refused.toml", on_line(tables, load))});
    CHECK(result.exit == 3);
    return result.err;
}

bool has(const std::string& text, const std::string& part) {
    INFO(text);
    CHECK(text.find(part) != std::string::npos);
    return true;
}

}  // namespace

TEST_CASE("point tables: values and derivatives are those of scipy") {
    struct Known {
        const char *how, *more;
        std::array<double, 9> values;  // f, f', f'' at 0.3, 1.9, 3.5
    };
    for (const Known& one : {
             Known{"linear",
                   "",
                   {0.3 + 0.9 / 0.7 * 0.3, 0.9 / 0.7, 0, 0.4 - 1.8 * 0.4, -1.8, 0, 0.2 + 0.4 / 9, 1. / 9, 0}},
             Known{"cubic",
                   "",
                   {0.8036910920573233, 1.5020050973431882, -1.7696520951455663, -0.37429744514466023,
                    -1.4899530184720802, 4.172630113088502, 0.3655825804101384, 0.08515293911846233,
                    -1.2979085996324358}},
             Known{"cubic",
                   "period = 4,",
                   {0.6994089832999367, 1.568465824706738, 0.22398719191316463, -0.3802922861968971,
                    -1.4456810442877717, 4.482712171312371, 0.21349728729725662, -0.18897710928444256,
                    0.024856929649918147}},
             Known{"pchip",
                   "",
                   {0.88466472303207, 1.5051506316812437, -3.2264334305150637, -0.4274337078651683,
                    -1.3599101123595512, 10.856629213483142, 0.26452307811201914, 0.13037587665913175,
                    -0.19156088796151388}},
         }) {
        const std::string scene = temporary(
            "values.toml",
            on_line(fmt::format("f = {{ arguments = [\"x\"], interpolation = \"{}\", {} {} }}", one.how, one.more,
                                points),
                    "-f(x)", "value = \"f(x)\"\nslope = \"diff(f(x), x)\"\nbend = \"diff(f(x), x, 2)\""));
        std::size_t k = 0;
        for (const char* const x : {"0.3", "1.9", "3.5"}) {
            INFO(one.how, one.more, x);
            const Json there = json_of({"eval", scene, "--at", fmt::format("x={}", x)});
            for (const char* const name : {"value", "slope", "bend"}) {
                const double wanted = one.values[k++];
                CHECK(std::abs(output(there, name) - wanted) < 2e-14 * std::max(1.0, std::abs(wanted)));
            }
        }
    }
    // A period on, the same; x of the second argument of a grid that is given in any order.
    const std::string bicubic = temporary(
        "bicubic.toml",
        on_line(R"(f = { arguments = ["x", "y"], interpolation = "cubic", points = [
        [1, 0, 3], [0, 0, 1], [0, 0.5, 2], [0, 2, 0], [0, 3, 1], [1, 0.5, 1], [1, 2, 2], [1, 3, 2],
        [2.5, 3, 2], [2.5, 0, 0], [2.5, 0.5, 1], [2.5, 2, 4]] })",
                "0*x", "value = \"f(x, 1.1)\"\nalong = \"diff(f(x, 1.1), 1)\"\nacross = \"diff(f(x, 1.1), 2)\""));
    const Json there = json_of({"eval", bicubic, "--at", "x=1.7"});
    CHECK(std::abs(output(there, "value") - 1.1561930917057903) < 1e-14);
    CHECK(std::abs(output(there, "along") - 1.4071810704225347) < 1e-14);
    CHECK(std::abs(output(there, "across") - 2.0111032154407935) < 1e-14);
}

TEST_CASE("point tables: beyond the points a table holds its value, goes on along its tangent, or has none") {
    const auto at = [](const std::string& how, const std::string& x) {
        return json_of(
            {"eval",
             temporary("outside.toml",
                       on_line(fmt::format("f = {{ arguments = [\"x\"], outside = \"{}\", interpolation = "
                                           "\"pchip\", points = [[0, 0], [1, 1], [2, 4]] }}",
                                           how),
                               "-f(x)", "value = \"f(x)\"\nslope = \"diff(f(x), x)\"")),
             "--at", "x=" + x});
    };
    CHECK(output(at("hold", "3"), "value") == 4);
    CHECK(output(at("hold", "3"), "slope") == 0);
    // Through three points with slopes 1 and 3: the end's slope is (3·3 − 1)/2 = 4.
    CHECK(std::abs(output(at("line", "3"), "value") - 8) < 1e-14);
    CHECK(std::abs(output(at("line", "3"), "slope") - 4) < 1e-14);
    CHECK(output(at("line", "-2"), "value") == 0);
    // x grows from rest as the load 1 says, and comes to 2 at t = 2.
    const std::string scene = temporary(
        "ends.toml", on_line("f = { arguments = [\"s\"], points = [[0, 1], [2, 1]] }", "f(x)", "", "initial = 0"));
    const Run result = run({"simulate", scene, "--duration", "5"});
    CHECK(result.exit == 4);
    has(result.err,
        "the table 'f' is 2, and its points end at 2; give more points, or outside = \"hold\" or \"line\"");
    const Run start = run({"eval", scene, "--at", "x=3"});
    CHECK(start.exit == 4);
    has(start.err, "the table 'f' is 3, and its points end at 2");
}

TEST_CASE("point tables: the order of a method does not fall at knots") {
    const std::string scene = temporary("two_springs.toml", on_line(two_springs, "-f(x)"));
    const double end = 3 * (1 + 1 / std::sqrt(2.0)) * std::numbers::pi + 0.4;
    const auto error = [&](const std::vector<std::string>& how) {
        std::vector<std::string> more{"--duration", fmt::format("{:.17g}", end), "--no-estimate"};
        more.insert(more.end(), how.begin(), how.end());
        return std::abs(number(simulated(scene, more)["final"], "coordinates", "x") - between_two_springs(end));
    };
    for (const char* const method : {"auto", "dopri5", "dop853", "verner98", "radau"}) {
        INFO(method);
        CHECK(error({"--method", method, "--tolerance", "1e-12"}) < 2e-10);
    }
    const std::string held =
        temporary("held.toml",
                  edited(contents(scene), {{"arguments = [\"x\"],", "arguments = [\"x\"], outside = \"line\","}}));
    const Json series = simulated(held, {"--method", "taylor", "--tolerance", "1e-13", "--duration",
                                         fmt::format("{:.17g}", end), "--no-estimate"});
    CHECK(std::abs(number(series["final"], "coordinates", "x") - between_two_springs(end)) < 1e-11);
    // A quarter of the step: 256 times less by order 4, where kinks within steps leave order 2 and 16 times less.
    const double coarse = error({"--method", "rk4", "--step", "0.05"}),
                 fine = error({"--method", "rk4", "--step", "0.0125"});
    CHECK(coarse < 1e-6);
    CHECK(coarse / fine > 120);
    // A load over the time.
    const std::string ramp = temporary(
        "ramp.toml",
        on_line("f = { arguments = [\"t\"], points = [[0, 0], [0.37, 2], [1.1, -1], [2.9, 0.5], [4, 0]] }",
                "f(2*t)", "", "initial = 0"));
    // v is the area under f, x that of v: 0.5 ∫ f over the pieces.
    const Json motion = simulated(ramp, {"--duration", "2", "--method", "rk4", "--step", "0.3"});
    CHECK(std::abs(number(motion["final"], "rates", "x") - 0.5 * (0.37 + 0.5 * 0.73 - 0.25 * 1.8 + 0.275)) <
          1e-12);
}

// Numbers of scipy 1.17: DOP853, rtol 2.3e-14, from knot to knot.
TEST_CASE("point tables: a monotone cubic as a spring moves a mass as scipy says") {
    const std::string scene = temporary(
        "pchip_spring.toml",
        on_line(
            "f = { arguments = [\"x\"], interpolation = \"pchip\", points = [[-2, -5], [-1, -1.5], [-0.3, -0.5], "
            "[0.4, 0.3], [1, 2], [2, 6]] }",
            "-f(x)", "", "initial = 1.7"));
    for (const std::string method : {"auto", "dop853", "radau", "abm"}) {
        const Json motion = simulated(scene, {"--duration", "10", "--tolerance", "1e-12", "--method", method});
        INFO(method);
        const double allowed = method == "abm" ? 1e-8 : 1e-9;
        CHECK(std::abs(number(motion["final"], "coordinates", "x") + 1.2005241661961654) < allowed);
        CHECK(std::abs(number(motion["final"], "rates", "x") + 1.9100929160200728) < allowed);
    }
}

// The cam: scipy 1.17, DOP853 at rtol 2.3e-14 from knot to knot. The ball: v = v_e − (v_e − v_i) e^(−s t) piece by
// piece.
TEST_CASE("point tables: a cam by table and a measured drag end where a closed form and scipy end") {
    const Json cam = simulated(source_path("scenes/elements/cam.toml"));
    CHECK(std::abs(number(cam["final"], "coordinates", "phi") - 50.511361990201294) < 1e-9);
    CHECK(std::abs(number(cam["final"], "rates", "phi") - 29.14198933715456) < 1e-9);
    const std::vector<double> v{0, 5, 10, 20, 30, 40}, F{0, 0.4, 1.5, 5.6, 14, 26};
    double t = 0, y = 0, now = 0;
    const double g = 9.81, end = 5;
    for (std::size_t i = 0; t < end; ++i) {
        const double s = (F[i + 1] - F[i]) / (v[i + 1] - v[i]), last = (g - F[i]) / s + v[i];
        const double whole = last > v[i + 1] ? std::log((last - now) / (last - v[i + 1])) / s : end;
        const double passed = std::min(whole, end - t), rest = last - now;
        y += last * passed - rest * (1 - std::exp(-s * passed)) / s;
        now = last - rest * std::exp(-s * passed);
        t += passed;
    }
    const Json ball = simulated(source_path("scenes/elements/drag_table.toml"));
    CHECK(std::abs(number(ball["final"], "coordinates", "y") - y) < 1e-9);
    CHECK(std::abs(number(ball["final"], "rates", "y") - now) < 1e-9);
}

TEST_CASE(
    "point tables: in constraints they hold a bead on its wire, and both a value and its slope change at one "
    "knot") {
    const std::string wire =
        "[tables]\nf = { arguments = [\"x\"], interpolation = \"cubic\", outside = \"line\", points = "
        "[[-2, 2], [-1, 0.7], [0, 0], [1, 0.9], [2, 2]] }\n[[particle]]\nname = \"p\"\nmass = 1\n";
    const std::string by_constraint =
        temporary("wire.toml",
                  "gravity = [0, -9.81]\n[coordinates]\nx = -0.8\ny = { guess = 0.6, rate_guess = 0 }\n" + wire +
                      "position = [\"x\", \"y\"]\n[[constraint]]\nname = \"wire\"\nholonomic = \"y = f(x)\"\n");
    const std::string by_place = temporary(
        "bead.toml", "gravity = [0, -9.81]\n[coordinates]\nx = -0.8\n" + wire + "position = [\"x\", \"f(x)\"]\n");
    const std::vector<std::string> how{"--duration", "5", "--tolerance", "1e-12"};
    const Json here = simulated(by_constraint, how), there = simulated(by_place, how);
    CHECK(std::abs(number(here["final"], "coordinates", "x") - number(there["final"], "coordinates", "x")) < 1e-9);
    CHECK(here["energy_drift"].get<double>() < 1e-10);
    CHECK(json_of({"check", by_constraint, "--formalisms"})["verdict"] == "proved");
    // z' = f(x) x': the speed stays, and z − ∫ f dx, whatever the slope of f does.
    const std::string skate = temporary("skate.toml", R"toml(
[coordinates]
x = { initial = 0, rate = 1 }
z = { initial = 0.2, rate_guess = 0 }
[tables]
f = { arguments = ["x"], outside = "line", points = [[-2, 2], [-1, 0.7], [0, 0], [1, 0.9], [2, 2]] }
[[particle]]
name = "p"
mass = 1
position = ["x", "z"]
[[constraint]]
name = "c"
nonholonomic = "z' = f(x)*x'"
)toml");
    const Json motion = simulated(skate, {"--duration", "3", "--tolerance", "1e-12"});
    const double x = number(motion["final"], "coordinates", "x"), s = x - 1;
    CHECK(motion["energy_drift"].get<double>() < 1e-11);
    CHECK(std::abs(number(motion["final"], "coordinates", "z") - (0.2 + 0.45 + 0.9 * s + 0.55 * s * s)) < 1e-10);
}

TEST_CASE("point tables: claims hold for the function, counterexamples have its numbers") {
    for (const char* const name : {"cam", "drag_table"})
        for (const Json& claim :
             json_of({"check", source_path(fmt::format("scenes/elements/{}.toml", name))})["claims"])
            CHECK(claim["verdict"] == "proved");
    const std::string scene = temporary("claims.toml", on_line(two_springs, "-f(x)") +
                                                           "[[claim]]\nequation = \"m*x'' = -f(x)\"\n[[claim]]\n"
                                                           "equation = \"m*x'' = f(x)\"\n");
    const Json claims = json_of({"check", scene}, {}, 1)["claims"];
    CHECK(claims[0]["verdict"] == "proved");
    CHECK(claims[1]["verdict"] == "refuted");
    const Json& seen = claims[1]["counterexample"];
    INFO(seen.dump());
    const auto value = [&](const std::string& name) {
        const std::string text = seen[name].get<std::string>();
        const std::size_t slash = text.find('/');
        return slash == std::string::npos ? std::stod(text)
                                          : std::stod(text.substr(0, slash)) / std::stod(text.substr(slash + 1));
    };
    const double x = value("x");
    CHECK(std::abs(value("f(x)") - (x < 0 ? 2 * x : x)) < 1e-12);
}

TEST_CASE("point tables: derivations print them as functions, with their derivatives") {
    const std::string scene =
        edited(contents(source_path("scenes/elements/cam.toml")), {{"duration = 2", "duration = 1"}});
    const Run text = run({"derive", temporary("cam.toml", scene)});
    CHECK(text.exit == 0);
    has(text.out, "diff(lift(phi),phi)");
    const Run latex = run({"derive", temporary("cam.toml", scene), "--format", "latex"});
    has(latex.out, "\\frac{\\mathrm{d}\\mathrm{lift}}{\\mathrm{d}\\varphi}");
}

TEST_CASE("point tables: what is wrong is told where it stands") {
    has(refused("f = 3"), "table 'f' is the integer 3; expected its arguments and its points");
    has(refused("f = { points = [[0, 0], [1, 1]] }"), "expected one or two names, as in arguments = [\"x\"]");
    has(refused("f = { arguments = [\"x\"] }"), "needs 'points' or a 'file'");
    has(refused("f = { arguments = [\"x\"], points = [[0, 0]] }"), "there are fewer than two points");
    has(refused("f = { arguments = [\"x\"], points = [[0, 0], [1, \"a\"]] }"),
        "point 2 is no list of 2 finite numbers");
    has(refused("f = { arguments = [\"x\"], points = [[0, 0], [2, 1], [1, 1]] }"),
        "point 3: x is 1 after 2; expected growing values");
    has(refused("f = { arguments = [\"x\"], interpolation = \"spline\", points = [[0, 0], [2, 1]] }"),
        "expected one of \"linear\", \"cubic\", \"pchip\"");
    has(refused("f = { arguments = [\"x\"], period = 2, outside = \"hold\", points = [[0, 0], [2, 0]] }"),
        "leave out 'outside'");
    has(refused("f = { arguments = [\"x\"], period = 1, points = [[0, 0], [2, 0]] }"), "more than its period 1");
    has(refused("f = { arguments = [\"x\"], period = 2, points = [[0, 0], [2, 1]] }"), "expected the same");
    has(refused("f = { arguments = [\"x\", \"y\"], points = [[0, 0, 1], [0, 1, 1], [1, 0, 1]] }", "-f(x, x)"),
        "there is no value for x = 1, y = 1");
    has(refused("f = { arguments = [\"x\"], points = [[0, 0], [2, 1]] }", "-f(x, 2)"),
        "'f' takes 1 argument, not 2");
    has(refused("f = { arguments = [\"x\"], colour = 1, points = [[0, 0], [2, 1]] }"), "colour");
    has(refused("f = { arguments = [\"x\"], file = \"nowhere.csv\" }"), "there is no file 'nowhere.csv'");
    has(refused("f = { arguments = [\"x\"], file = \"/etc/passwd\" }"), "not in the folder of the scene or below");
    has(refused("f = { arguments = [\"x\"], file = \"../x.csv\" }"), "not in the folder of the scene or below");
}

TEST_CASE("point tables: files are read within limits, and nothing outside of the scene's folder") {
    const std::string folder = temporary_folder("files");
    const auto answer = [&](const std::string& text, const std::string& file = "points.csv") {
        std::ofstream(folder + "/points.csv") << text;
        std::ofstream(folder + "/scene.toml") << on_line(
            fmt::format("f = {{ arguments = [\"x\"], file = \"{}\" }}", file), "-f(x)", "value = \"f(x)\"");
        return run({"eval", folder + "/scene.toml", "--json"});
    };
    for (const char* const text :
         {"0,0\n2,4\n", "x, f\n0, 0\n\n2, 4   # the last\n", "0;0\r\n2;4\r\n", "# measured\n0 0\n2\t4",
          "\xEF\xBB\xBF\"x\",\"f\"\r\n\"0\",\"0\"\r\n\"2\", \"4\"\r\n"})
        CHECK(output(Json::parse(answer(text).out), "value") == 2);
    has(answer("0,0\n1,2,3\n").err, "points.csv: line 2 is '1,2,3'; expected 2 numbers");
    has(answer("0,0\n1,x\n").err, "line 2 is '1,x'");
    has(answer("0,0\n1,inf\n").err, "line 2");
    has(answer("0;0\n1;0,5\n").err, "the decimal sign is a point");
    has(answer("0,0\n2,1\n1,1\n").err, "line 3: x is 1 after 2");
    const Run link = run_shell("ln -sf /etc/hostname \"$1/link.csv\"", {folder});
    REQUIRE(link.exit == 0);
    has(answer("0,0\n2,4\n", "link.csv").err, "not in the folder of the scene or below");
    // A map: the second argument in the first line.
    std::ofstream(folder + "/map.csv") << "x\\y, 0, 1, 3\n0, 1, 2, 4\n2, 5, 6, 8\n";
    std::ofstream(folder + "/scene.toml")
        << on_line("f = { arguments = [\"x\", \"y\"], file = \"map.csv\" }", "-f(x, x)", "value = \"f(x, 2)\"");
    CHECK(output(json_of({"eval", folder + "/scene.toml"}), "value") == 1 + 2 * 1 + 2);
}

TEST_CASE("point tables: units of arguments and values convert, and dimensions are looked at") {
    const std::string scene = temporary(
        "units.toml",
        on_line("f = { arguments = [\"x\"], units = [\"mm\"], unit = \"kN\", points = [[0, 0], [2000, 4]] }",
                "-f(x)", "value = \"f(x)\"", "initial = 1, unit = \"m\""));
    CHECK(output(json_of({"eval", scene}), "value") == 2000);
    const Run doubt = run(
        {"eval", temporary("units.toml", edited(contents(scene), {{"value = \"f(x)\"", "value = \"f(x')\""}}))});
    has(doubt.err, "the argument of the table f is in m; 'x'' is in m/s");
}

TEST_CASE("point tables: all ways out of the program agree") {
    const std::string scene = temporary(
        "ways.toml",
        on_line("f = { arguments = [\"x\"], interpolation = \"pchip\", outside = \"line\", points = [[-1, -3], "
                "[-0.5, -1], "
                "[0, 0], [0.7, 1.2], [0.9, 2]] }\n"
                "g = { arguments = [\"t\"], period = 1, points = [[0, 0], [0.3, 1], [0.6, -0.5]] }\n"
                "h = { arguments = [\"x\", \"v\"], outside = \"hold\", interpolation = \"cubic\", points = [[-1, "
                "-1, 0.1], "
                "[-1, 0, 0.4], [-1, 1, 0.2], [0, -1, 0.3], [0, 0, 0.2], [0, 1, 0.5], [1, -1, 0], [1, 0, 0.1], [1, "
                "1, 0.4]] }\n"
                "k = { arguments = [\"x\", \"v\"], outside = \"line\", points = [[-1, -1, 0.1], [-1, 1, 0.2], "
                "[0, -1, 0.3], [0, 1, 0.5], [1, -1, 0], [1, 1, 0.4]] }",
                "-f(x) + g(t) - h(x, x')*x' - k(x, x')*x'"));
    const Json memory = simulated(scene, {"--duration", "3", "--tolerance", "1e-12"});
    const double x = number(memory["final"], "coordinates", "x"), v = number(memory["final"], "rates", "x");
    for (const std::vector<std::string>& how : {std::vector<std::string>{"--code", "compiled"},
                                                {"--method", "radau"},
                                                {"--by", "kane"},
                                                {"--by", "hamilton"}}) {
        INFO(how[1]);
        std::vector<std::string> more{"--duration", "3", "--tolerance", "1e-12"};
        more.insert(more.end(), how.begin(), how.end());
        const Json motion = simulated(scene, more);
        CHECK(std::abs(number(motion["final"], "coordinates", "x") - x) < 1e-9);
        CHECK(std::abs(number(motion["final"], "rates", "x") - v) < 1e-9);
    }
    // The same functions in C, C++ and JavaScript, at one state.
    const Json here = json_of({"eval", scene, "--at", "x=0.31", "x'=-0.4", "t=1.7"});
    const double a = number(here, "accelerations", "x");
    const std::string folder = temporary_folder("ways");
    std::ofstream(folder + "/c.c") << R"(#include "ways.h"
#include <stdio.h>
int main(void) {
    double par[ways_par], state[] = {0.31, -0.4}, rate[2];
    ways_defaults(par);
    ways_rhs(1.7, state, par, rate);
    printf("%.17g\n", rate[1]);
    return 0;
})";
    const Run c = run_shell(
        "cd \"$2\" && \"$ALEMBERT\" emit \"$1\" --language c -o . >/dev/null && "
        "cc -std=c99 -Wall -Wextra -Werror -O1 c.c ways.c -lm -o c && ./c",
        {scene, folder});
    INFO(c.err);
    REQUIRE(c.exit == 0);
    CHECK(std::abs(std::stod(c.out) - a) < 1e-14);
    const Run cpp = run_shell(
        "cd \"$2\" && \"$ALEMBERT\" emit \"$1\" --batch -o . >/dev/null && "
        "c++ -std=c++17 -O1 -Wall -Wextra -Werror -c ways.cpp -o ways.o",
        {scene, folder});
    INFO(cpp.err);
    CHECK(cpp.exit == 0);
    const Run js = run_shell(
        "cd \"$2\" && \"$ALEMBERT\" emit \"$1\" --language js -o . >/dev/null && "
        "node -e \"import('./ways.mjs').then(m => { const r = [0, 0]; "
        "m.rhs(1.7, [0.31, -0.4], m.defaults(), r); console.log(r[1]) })\"",
        {scene, folder});
    INFO(js.err);
    REQUIRE(js.exit == 0);
    CHECK(std::abs(std::stod(js.out) - a) < 1e-14);
}

TEST_CASE("point tables: a measured input of many rows is a table, and a run knows its times") {
    std::string rows = "t,u\n";
    for (int k = 0; k <= 2000; ++k) rows += fmt::format("{},{}\n", k / 1000.0, k % 2 == 0 ? 1 : 0);
    const std::string scene = temporary("measured.toml", R"toml(
[inputs]
u = { value = 0, given = "outside" }
[coordinates]
x = 0
[[particle]]
name = "p"
mass = 1
position = ["x", 0]
[forces]
x = "u"
)toml");
    // Each pair of rows gives the impulse 1/2000 and is symmetric: x = t²/4 at the ends of pairs, less the pairs'
    // own part.
    const Json motion = simulated(
        scene, {"--input", "u=" + temporary("rows.csv", rows), "--duration", "2", "--tolerance", "1e-12"});
    CHECK(std::abs(number(motion["final"], "rates", "x") - 1) < 1e-11);
    CHECK(std::abs(number(motion["final"], "coordinates", "x") - 1) < 1e-11);
}

TEST_CASE("point tables: a pulse of some ten thousandths of the run is not passed over") {
    for (const double begin : {1.0, 2.3, 7.77})
        for (const double width : {1e-3, 1e-4, 1e-5}) {
            const std::string scene = temporary(
                "pulse.toml",
                on_line(
                    fmt::format(
                        "u = {{ arguments = [\"t\"], points = [[0, 0], [{}, 0], [{}, {}], [{}, 0], [10, 0]] }}",
                        begin, begin + width, 0.1 / width, begin + 2 * width),
                    "u(t)", "", "initial = 0"));
            CAPTURE(begin);
            CAPTURE(width);
            const Json motion = simulated(scene, {"--duration", "10"});
            CHECK(std::abs(number(motion["final"], "rates", "x") - 0.1) < 1e-9);
        }
}

TEST_CASE("point tables: the rounding of a table's numbers refutes no claim") {
    const std::string scene =
        on_line("f = { arguments = [\"x\"], points = [[0, 0.1], [2, 0.4]], outside = \"line\" }", "f(x)", "",
                "initial = 0.5");
    const Json answer = Json::parse(run({"check", temporary("rounding.toml", scene + R"toml(
[[claim]]
equation = "f(1) = 0.25"
[[claim]]
equation = "m*x'' = 0.1 + 0.15*x"
[[claim]]
equation = "f(1) = 0.26"
)toml"),
                                         "--json"})
                                        .out);
    CHECK(answer["claims"][0]["verdict"] == "undecided");
    CHECK(answer["claims"][1]["verdict"] == "undecided");
    CHECK(answer["claims"][2]["verdict"] == "refuted");
}

}  // namespace commands_point_tables
