// SPDX-License-Identifier: MIT
// Points that distances hold on a line or in a plane: what is held by second derivatives alone gets the equations
// whose squares hold it, and runs. Held against the same mechanisms described by angles, and closed forms.
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>
#include <vector>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_touching {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

std::string distance(const std::string& p, const std::string& q, double length) {
    return fmt::format(
        "[[constraint]]\nname = \"{0}{1}\"\nholonomic = \"(x{0} - x{1})^2 + (y{0} - y{1})^2 = {2}^2\"\n", p, q,
        length);
}

std::string particle(const std::string& name, double mass) {
    return fmt::format("[[particle]]\nname = \"P{0}\"\nmass = {1}\nposition = [\"x{0}\", \"y{0}\"]\n", name, mass);
}

/// Cranks of length 1 on pivots at x = 0, 1, 2, whose tips a, b, c are held together by distances. All but the x
/// of a are guesses if these are off.
std::string cranks(double middle, bool third, double off = 0) {
    std::string scene = "gravity = [0, -9.81]\n[parameters]\nth = 0.5\n[coordinates]\n";
    const auto value = [&](const std::string& formula, double by) {
        return off == 0 ? fmt::format("\"{}\"", formula)
                        : fmt::format("{{ guess = \"{} + {}\", rate_guess = 0 }}", formula, by);
    };
    scene += fmt::format("xa = \"sin(th)\"\nya = {}\n", value("-cos(th)", off));
    for (const auto& [p, x, way] : {std::tuple("b", 1, -1.0), std::tuple("c", 2, 0.7)})
        scene += fmt::format("x{0} = {1}\ny{0} = {2}\n", p, value(fmt::format("{} + sin(th)", x), way * off),
                             value("-cos(th)", -0.5 * way * off));
    scene += "[simulation]\nduration = 10\ntolerance = 1e-11\n";
    scene += particle("a", 1) + particle("b", middle) + particle("c", 1);
    for (const auto& [p, x] : {std::pair("a", 0), std::pair("b", 1), std::pair("c", 2)})
        scene += fmt::format("[[constraint]]\nname = \"crank{0}\"\nholonomic = \"(x{0} - {1})^2 + y{0}^2 = 1\"\n",
                             p, x);
    scene += distance("a", "b", 1) + distance("b", "c", 1);
    return third ? scene + distance("a", "c", 2) : scene;
}

std::array<double, 3> direction(bool in_space) {
    return in_space ? std::array{2.0 / 3, 1.0 / 3, 2.0 / 3} : std::array{1.0, 0.0, 0.0};
}

/// Particles a, b, … on a rod at these places along its direction d, with the rates z × d for each metre from a
/// and 0.3 m/s along x. `distances` hold it.
std::string rod(const std::vector<double>& places, const std::string& distances, bool in_space = false,
                const std::vector<double>& masses = {}) {
    const std::array<double, 3> along = direction(in_space);
    std::string scene = in_space ? "gravity = [0, 0, -9.81]\n" : "gravity = [0, -9.81]\n", particles;
    scene += "[parameters]\nL1 = 1\nL2 = 2\nL3 = 3\n[coordinates]\n";
    for (std::size_t k = 0; k < places.size(); ++k) {
        const std::array rates{0.3 - places[k] * along[1], places[k] * along[0], 0.0};
        std::string position;
        for (int i = 0; i < (in_space ? 3 : 2); ++i) {
            const std::string name{"xyz"[i], "abcdefg"[k]};
            const auto at = static_cast<std::size_t>(i);
            scene += fmt::format("{} = {{ initial = {}, rate = {} }}\n", name, places[k] * along[at], rates[at]);
            position += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", name);
        }
        particles += fmt::format("[[particle]]\nname = \"P{}\"\nmass = {}\nposition = [{}]\n", "abcdefg"[k],
                                 masses.empty() ? 1 : masses[k], position);
    }
    return scene + "[simulation]\nduration = 5\ntolerance = 1e-11\n" + particles + distances;
}

/// |pq| = length, as `square = length²` or `√square = length`.
std::string apart(const std::string& pq, const std::string& length, bool in_space = false, bool root = false) {
    std::string square;
    for (int i = 0; i < (in_space ? 3 : 2); ++i)
        square += fmt::format("{3}({0}{1} - {0}{2})^2", "xyz"[i], pq[0], pq[1], i == 0 ? "" : " + ");
    return fmt::format("[[constraint]]\nname = \"{}\"\nholonomic = \"{} = {}\"\n", pq,
                       root ? "sqrt(" + square + ")" : square, root ? length : "(" + length + ")^2");
}

const std::string line =
    "[[constraint]]\nname = \"line\"\nholonomic = \"(xb - xa)*(yc - ya) = (yb - ya)*(xc - xa)\"\n";

Json end_of(const std::string& scene) {
    return json_of({"simulate", temporary("points.toml", scene), "--no-estimate"})["final"];
}

}  // namespace

// All tips move as pendulums of length 1 do: the same angle, whatever the middle one weighs. Errors: fewer than
// 120 steps, each with at most 1e-11 of 2 m, which the rates carry on for 10 s.
constexpr double of_cranks = 120 * 1e-11 * 2 * 10;

TEST_CASE("touching: three parallel cranks run, with a third distance that follows and a massless middle") {
    const Json pendulum = end_of(R"toml(
gravity = [0, -9.81]
[coordinates]
phi = 0.5
[[particle]]
name = "P"
mass = 1
position = ["sin(phi)", "-cos(phi)"]
[simulation]
duration = 10
tolerance = 1e-12
)toml");
    const double phi = pendulum["coordinates"]["phi"].get<double>();
    for (const double middle : {1.0, 0.0})
        for (const bool third : {false, true})
            for (const double off : {0.0, 0.1}) {  // of guesses, with which the tips are on no line
                INFO("middle " << middle << ", third distance " << third << ", guesses off by " << off);
                const Json end = end_of(cranks(middle, third, off))["coordinates"];
                for (const auto& [p, x] : {std::pair("a", 0), std::pair("b", 1), std::pair("c", 2)}) {
                    CHECK(std::abs(end[fmt::format("x{}", p)].get<double>() - x - std::sin(phi)) < of_cranks);
                    CHECK(std::abs(end[fmt::format("y{}", p)].get<double>() + std::cos(phi)) < of_cranks);
                }
            }
}

// The mass centre falls on a parabola, and the rod turns evenly about it in the plane of its direction d and the
// rates z × d. Errors: 35 steps, each with at most 1e-11 of 130 m, which the rates carry on for 5 s.
constexpr double of_rod = 35 * 1e-11 * 130 * 5;

void check_rod(const Json& end, const std::vector<double>& places, bool in_space, std::vector<double> masses) {
    masses.resize(places.size(), masses.empty() ? 1 : 0);
    double all = 0, centre = 0;
    for (std::size_t k = 0; k < places.size(); ++k) all += masses[k], centre += masses[k] * places[k];
    centre /= all;
    const double t = 5;
    const std::array<double, 3> d = direction(in_space), v{-d[1], d[0], 0};
    const double w = std::hypot(v[0], v[1]);
    for (std::size_t k = 0; k < places.size(); ++k)
        for (std::size_t i = 0; i < (in_space ? 3 : 2); ++i) {
            const std::string name{"xyz"[i], "abcdefg"[k]};
            const double turned = d[i] * std::cos(w * t) + v[i] / w * std::sin(w * t);
            const double fall = i == (in_space ? 2 : 1) ? -9.81 / 2 * t * t : 0;
            const double truth =
                centre * (d[i] + v[i] * t) + (i == 0 ? 0.3 * t : 0) + fall + (places[k] - centre) * turned;
            CAPTURE(name);
            CHECK(std::abs(end["coordinates"][name].get<double>() - truth) < of_rod);
        }
}

// |ac| = |ab| + |bc| keeps b on the line ac, but not by its row: at every pose the three rows have rank 2.
TEST_CASE("touching: a rod given by three distances runs as one given by its line, in the plane and in space") {
    for (const double middle : {1.0, 0.0}) {
        const std::vector<double> masses{1, middle, 1};
        check_rod(end_of(rod({0, 1, 3}, apart("ab", "1") + apart("bc", "2") + line, false, masses)), {0, 1, 3},
                  false, masses);
        for (const bool in_space : {false, true})
            for (const auto& [ab, bc, ac] : {std::tuple("1", "2", "3"), std::tuple("L1", "L2", "L1 + L2"),
                                             std::tuple("L1", "L2", "L3"), std::tuple("L1", "2", "L3/L1")})
                for (const bool root : {false, true}) {
                    INFO(in_space << root << " " << std::string(ac));
                    check_rod(end_of(rod({0, 1, 3},
                                         apart("ab", ab, in_space, root) + apart("bc", bc, in_space, root) +
                                             apart("ac", ac, in_space, root),
                                         in_space, masses)),
                              {0, 1, 3}, in_space, masses);
                }
    }
}

TEST_CASE(
    "touching: four points on a line run, held by a stretched ring of distances, by all of them, or irrational") {
    const std::string ring = apart("ab", "1") + apart("bc", "2") + apart("cd", "4") + apart("ad", "7");
    for (const std::string& more : {std::string(), apart("ac", "3"), apart("ac", "3") + apart("bd", "6")})
        check_rod(end_of(rod({0, 1, 3, 7}, ring + more)), {0, 1, 3, 7}, false, {});
    const double root = std::sqrt(2);
    check_rod(
        end_of(rod({0, root, 2 * root}, apart("ab", "sqrt(2)") + apart("bc", "sqrt(2)") + apart("ac", "sqrt(8)"))),
        {0, root, 2 * root}, false, {});
}

// All six distances of a flat rectangle hold it flat in space by second derivatives only. Spinning about its
// normal while it falls, it stays a rectangle 3 by 4 in a horizontal plane.
TEST_CASE("touching: a rectangle given by its sides and diagonals stays flat in space") {
    std::string scene = "gravity = [0, 0, -9.81]\n[coordinates]\n", rest;
    const double w = 1.3, t = 5;
    const std::vector<std::array<double, 2>> corners{{-1.5, -2}, {1.5, -2}, {1.5, 2}, {-1.5, 2}};
    for (std::size_t k = 0; k < 4; ++k) {
        const char name = "abcd"[k];
        const auto [x, y] = corners[k];
        scene += fmt::format(
            "x{0} = {{ initial = {1}, rate = {3} }}\ny{0} = {{ initial = {2}, rate = {4} }}\n"
            "z{0} = {{ initial = 0, rate = 0.2 }}\n",
            name, x, y, -w * y, w * x);
        rest += fmt::format(
            "[[particle]]\nname = \"P{0}\"\nmass = {1}\nposition = [\"x{0}\", \"y{0}\", \"z{0}\"]\n", name, 1);
    }
    for (const auto& [pq, length] :
         {std::pair("ab", "3"), {"bc", "4"}, {"cd", "3"}, {"ad", "4"}, {"ac", "5"}, {"bd", "5"}})
        rest += apart(pq, length, true);
    const Json end = end_of(scene + "[simulation]\nduration = 5\ntolerance = 1e-11\n" + rest)["coordinates"];
    for (std::size_t k = 0; k < 4; ++k) {
        const char name = "abcd"[k];
        const auto [x, y] = corners[k];
        CHECK(std::abs(end[fmt::format("x{}", name)].get<double>() - x * std::cos(w * t) + y * std::sin(w * t)) <
              of_rod);
        CHECK(std::abs(end[fmt::format("y{}", name)].get<double>() - x * std::sin(w * t) - y * std::cos(w * t)) <
              of_rod);
        CHECK(std::abs(end[fmt::format("z{}", name)].get<double>() - 0.2 * t + 9.81 / 2 * t * t) < of_rod);
    }
}

// A parabola on its tangent, and circles that touch from outside and inside: one point is left of the plane.
TEST_CASE("touching: an audit lists the equations that are added, with the rank of the variety") {
    const auto audited = [](const std::string& scene) {
        const auto result = run({"audit", temporary("points.toml", scene), "--json"});
        INFO(scene << result.err);
        REQUIRE(result.exit == 0);
        CHECK(result.err.find("only touch") != std::string::npos);
        return Json::parse(result.out);
    };
    const Json of = audited(rod({0, 1, 3}, apart("ab", "1") + apart("bc", "2") + apart("ac", "3")));
    CHECK(of["rank"] == 3);
    CHECK(of["degrees_of_freedom"] == 3);
    CHECK(of["rank_is_exact"] == true);
    CHECK(of["singular_poses"].empty());
    REQUIRE(of["constraints"].size() == 5);
    for (const std::size_t k : {0, 1}) {
        CHECK(of["constraints"][k]["name"] == fmt::format("ab_bc_ac_{}", k + 1));
        CHECK(of["constraints"][k]["redundant"] == false);
        CHECK(of["constraints"][k]["notes"][0].get<std::string>().find("'ab', 'bc', 'ac'") != std::string::npos);
    }
    for (const auto& [first, second, x] :
         {std::tuple("y = x^2", "y = 0", "0"), std::tuple("x^2 + y^2 = 1", "(x - 3)^2 + y^2 = 4", "1"),
          std::tuple("x^2 + y^2 = 1", "(x + 1)^2 + y^2 = 4", "1")}) {
        INFO(std::string(first) << " and " << second);
        const Json point = audited(fmt::format(
            "[coordinates]\nx = {}\ny = 0\nz = {{ initial = 0, rate = 1 }}\n[[particle]]\nname = \"P\"\nmass = 1\n"
            "position = [\"x\", \"y\", \"z\"]\n[[constraint]]\nname = \"f\"\nholonomic = \"{}\"\n"
            "[[constraint]]\nname = \"g\"\nholonomic = \"{}\"\n",
            x, first, second));
        CHECK(point["rank"] == 2);
        CHECK(point["singular_poses"].empty());
    }
}

// Five squares of sums of six coordinates with thirty symbols: their elimination would take longer than a person
// waits. The numbers alone show that the constraints touch.
TEST_CASE("touching: a combination with too many symbols is not proved, and that is told soon") {
    std::string parameters = "[parameters]\n", coordinates = "[coordinates]\n", particles, squares;
    for (int j = 0; j < 5; ++j) {
        std::string sum;
        for (int i = 0; i < 6; ++i) {
            parameters += fmt::format("a{}_{} = {}\n", j, i, 1 + (i * 7 + j * 5) % 9 + (i == j ? 12 : 0));
            sum += fmt::format("{}a{}_{}*x{}", i == 0 ? "" : " + ", j, i, i);
        }
        squares += fmt::format("{}({})^2", j == 0 ? "" : " + ", sum);
    }
    for (int i = 0; i < 6; ++i) {
        coordinates += fmt::format("x{} = 0\n", i);
        particles += fmt::format("[[particle]]\nname = \"P{0}\"\nmass = 1\nposition = [\"x{0}\", 0, 0]\n", i);
    }
    const auto refused = run(
        {"simulate",
         temporary("many.toml", parameters + coordinates + "z = 0\n[simulation]\nduration = 1\n" + particles +
                                    "[[particle]]\nname = \"Z\"\nmass = 1\nposition = [0, 0, \"z\"]\n"
                                    "[[constraint]]\nname = \"f\"\nholonomic = \"" +
                                    squares + " = z\"\n[[constraint]]\nname = \"g\"\nholonomic = \"z = 0\"\n")});
    INFO(refused.out << refused.err);
    CHECK(refused.exit == 3);
    CHECK(refused.err.find("constraints 'f', 'g' only touch") != std::string::npos);
}

// Of the proof's conditions one fails each: no polynomial of second degree, or lengths that are not known exactly.
TEST_CASE("touching: what is not proved is refused with the reason, and other lengths break what was left out") {
    const std::string open = apart("ab", "1") + apart("bc", "2");
    for (const std::string& last :
         {std::string("[[constraint]]\nname = \"ac\"\nholonomic = \"((xa - xc)^2 + (ya - yc)^2)^2 = 81\"\n"),
          apart("ac", "3*exp(1)/2.718281828459045")}) {
        const auto refused = run({"simulate", temporary("rod.toml", rod({0, 1, 3}, open + last))});
        INFO(refused.err);
        CHECK(refused.exit == 3);
        CHECK(refused.err.find("constraints 'ab', 'bc', 'ac' only touch") != std::string::npos);
    }
    std::string free = rod({0, 1, 3}, apart("ab", "L1") + apart("bc", "L2") + apart("ac", "L3"));
    for (const auto& [from, to] : {std::pair("initial", "guess"), std::pair("rate", "rate_guess")})
        for (std::size_t at = 0; (at = free.find(std::string(from) + " =", at)) != std::string::npos; at += 12)
            free.replace(at, std::string(from).size(), to);
    const std::string file = temporary("rod.toml", free);
    const auto swept = run({"sweep", file, "--vary", "L1=1:1.2:2", "--json"});
    INFO(swept.out << swept.err);
    CHECK(swept.err.find("constraint 'bc' follows from the others at the values of the scene, but is off by") !=
          std::string::npos);
}

// (x + s y)² = 0 and z = 0, with s = √2 + √3 and s² = 5 + 2√6: the second pivot is zero, but neither its number
// nor its symbols say so. Taken for a square it would hold the point at y = 0.
TEST_CASE("touching: a pivot that is zero only within rounding proves nothing") {
    for (const char* const s : {"sqrt(2) + sqrt(3)", "sqrt(3) + sqrt(5)", "sqrt(2) + sqrt(7)"}) {
        const std::map<std::string, std::string> squares{{"sqrt(2) + sqrt(3)", "5 + 2*sqrt(6)"},
                                                         {"sqrt(3) + sqrt(5)", "8 + 2*sqrt(15)"},
                                                         {"sqrt(2) + sqrt(7)", "9 + 2*sqrt(14)"}};
        const std::string scene = fmt::format(
            "[coordinates]\nx = 0\ny = 0\nz = 0\nw = {{ initial = 0, rate = 1 }}\n[[particle]]\nname = \"P\"\n"
            "mass = 1\nposition = [\"x\", \"y\", \"z\"]\n[[particle]]\nname = \"W\"\nmass = 1\n"
            "position = [\"w\", 0, 0]\n[[constraint]]\nname = \"f\"\nholonomic = \"x^2 + 2*({})*x*y + ({})*y^2 + "
            "z "
            "= 0\"\n[[constraint]]\nname = \"g\"\nholonomic = \"z = 0\"\n",
            s, squares.at(s));
        const auto refused = run({"simulate", temporary("pivot.toml", scene)});
        INFO(s << refused.out << refused.err);
        CHECK(refused.exit == 3);
        CHECK(refused.err.find("constraints 'f', 'g' only touch") != std::string::npos);
    }
}

// A parallelogram lies flat twice in a turn, and two branches meet there: the second derivatives have both signs.
TEST_CASE("touching: a linkage that lies flat at the start is not refused for that") {
    std::string scene =
        "[coordinates]\nxa = { initial = 1, rate = 0 }\nya = { initial = 0, rate = 1 }\n"
        "xb = { initial = 3, rate = 0 }\nyb = { initial = 0, rate = 1 }\n[simulation]\nduration = 1\n";
    scene += particle("a", 1) + particle("b", 1);
    scene += "[[constraint]]\nname = \"left\"\nholonomic = \"xa^2 + ya^2 = 1\"\n";
    scene += "[[constraint]]\nname = \"right\"\nholonomic = \"(xb - 2)^2 + yb^2 = 1\"\n";
    scene += distance("a", "b", 2);
    CHECK(run({"derive", temporary("flat.toml", scene)}).exit == 0);
}

}  // namespace commands_touching
