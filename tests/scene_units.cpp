// SPDX-License-Identifier: GPL-2.0-or-later
// What numbers with units are worth: against the conversion factors of NIST SP 811 (2008), appendix B, and by
// random products.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "alembert/base/error.hpp"
#include "scene/dimensions.hpp"
#include "scene/scene.hpp"
#include "scene/unit_text.hpp"
#include "scene/units.hpp"

namespace scene_units {

using namespace alembert;

namespace {

const double pi = std::acos(-1.0);

/// The value of a tree of numbers.
double value_of(const Tree& tree) {
    double result = tree.kind == Tree::Kind::product || tree.kind == Tree::Kind::power ? 1 : 0;
    switch (tree.kind) {
        case Tree::Kind::number:
            return std::stod(tree.text);
        case Tree::Kind::name:
            REQUIRE(tree.text == "pi");
            return pi;
        case Tree::Kind::sum:
            for (const TreePtr& arg : tree.args) result += value_of(*arg);
            return result;
        case Tree::Kind::product:
            for (const TreePtr& arg : tree.args) result *= value_of(*arg);
            return result;
        case Tree::Kind::negate:
            return -value_of(*tree.args[0]);
        case Tree::Kind::reciprocal:
            return 1 / value_of(*tree.args[0]);
        case Tree::Kind::power:
            return std::pow(value_of(*tree.args[0]), value_of(*tree.args[1]));
        default:
            FAIL("no number");
            return 0;
    }
}

double worth(const std::string& text) {
    std::vector<Diagnostic> mistakes;
    const Expression e = parse_expression(text, {}, mistakes);
    REQUIRE_MESSAGE(e, text, ": ", mistakes.empty() ? "" : mistakes[0].message);
    return value_of(*e.tree);
}

std::string mistake(const std::string& text) {
    std::vector<Diagnostic> mistakes;
    parse_expression(text, {}, mistakes);
    return mistakes.empty() ? "none" : mistakes[0].message;
}

std::vector<std::string> warnings(const std::string& scene) {
    std::vector<std::string> result;
    for (const Diagnostic& one : parse_scene(scene, "units.toml").warnings)
        if (one.kind == "unit_mismatch")
            result.push_back(fmt::format("{}: {}: {}", one.place.line, one.kind, one.message));
    return result;
}

}  // namespace

TEST_CASE("units: a number followed by a unit is what the tables of NIST say") {
    const std::pair<const char*, double> cases[] = {{"30 deg", pi / 6},
                                                    {"30°", pi / 6},
                                                    {"2 rev", 4 * pi},
                                                    {"60 rpm", 2 * pi},
                                                    {"200 mm", 0.2},
                                                    {"7cm", 0.07},
                                                    {"1 in", 0.0254},
                                                    {"1 ft", 0.3048},
                                                    {"1 mi", 1609.344},
                                                    {"5 g", 0.005},
                                                    {"3 mg", 3e-6},
                                                    {"1 lb", 0.45359237},
                                                    {"1 oz", 0.028349523125},
                                                    {"1 lbf", 4.4482216152605},
                                                    {"2 kN", 2000},
                                                    {"1 kgf", 9.80665},
                                                    {"1 psi", 6894.757293168},
                                                    {"1 bar", 1e5},
                                                    {"1 atm", 101325},
                                                    {"1 hp", 745.69987158227},
                                                    {"1 kWh", 3.6e6},
                                                    {"1 cal", 4.184},
                                                    {"1 slug", 14.593902937206},
                                                    {"90 km/h", 25},
                                                    {"1 mph", 0.44704},
                                                    {"5 min", 300},
                                                    {"2 N/mm", 2000},
                                                    {"3 N m", 3},
                                                    {"1 lbf ft", 1.3558179483314},
                                                    {"4 kg mm^2", 4e-6},
                                                    {"4 kg*mm^2", 4e-6},
                                                    {"9.81 m/s^2", 9.81},
                                                    {"9.81 m s^-2", 9.81},
                                                    {"1 lbf/in", 175.12683524648},
                                                    {"1 um", 1e-6},
                                                    {"1 GPa", 1e9},
                                                    {"2 ms", 0.002},
                                                    {"1 W/kW", 0.001}};
    for (const auto& [text, expected] : cases) {
        CAPTURE(text);
        CHECK(worth(text) == doctest::Approx(expected).epsilon(1e-13));
    }
}

TEST_CASE("units: they end where no unit follows, and are units right after a number alone") {
    CHECK(worth("2 kN * 3") == 6000);
    CHECK(worth("2 * 3 mm + 1 m") == doctest::Approx(1.006).epsilon(1e-15));
    CHECK(worth("1/2 m") == 0.5);
    std::vector<Diagnostic> none;
    CHECK(parse_expression("2 kN * t", {}, none).tree->args.back()->text == "t");
    CHECK(parse_expression("m*g", {}, none).tree->args.front()->text == "m");
    CHECK(none.empty());
    CHECK(mistake("2x").find("an operator is missing") != std::string::npos);
    CHECK(mistake("20 degC").find("a zero of its own") != std::string::npos);
    CHECK(mistake("3 m^x").find("a whole number") != std::string::npos);
    CHECK(mistake("(2 + 1) mm").find("an operator is missing") != std::string::npos);
}

TEST_CASE("units: factor, exact text and exponents of random products agree") {
    const char* words[] = {"mm",  "km",  "g",   "lb", "N",   "kN", "lbf", "s",
                           "min", "deg", "rpm", "J",  "psi", "ft", "AU"};
    std::mt19937 random(7);
    for (int k = 0; k < 300; ++k) {
        std::string text;
        double expected = 1;
        for (int word = 0; word < 1 + static_cast<int>(random() % 3); ++word) {
            const char* const name = words[random() % std::size(words)];
            const int power = 1 + static_cast<int>(random() % 3);
            const bool divides = word > 0 && random() % 2 == 0;
            text += word == 0 ? "" : divides ? "/" : random() % 2 == 0 ? " " : "*";
            text += name + (power == 1 ? std::string() : fmt::format("^{}", power));
            expected *= std::pow(meaning_of_unit(name)->factor, divides ? -power : power);
        }
        CAPTURE(text);
        const auto meaning = meaning_of_unit(text);
        REQUIRE(meaning);
        CHECK(meaning->factor == doctest::Approx(expected).epsilon(1e-14));
        CHECK((meaning->exact.empty() ? 1 : worth(meaning->exact)) == doctest::Approx(expected).epsilon(1e-13));
        const auto si = meaning_of_unit(meaning->si);  // the same, with the factor 1
        REQUIRE_MESSAGE(si, meaning->si);
        CHECK(si->factor == 1);
        CHECK(si->exponents == meaning->exponents);
    }
}

TEST_CASE("units: numbers of names are in their units, and what holds names is a quantity already") {
    const Scene scene = parse_scene(R"toml(
[parameters]
l = { value = 200, unit = "mm" }
half = { value = "l/2", unit = "mm" }
w = { value = 30, unit = "rpm" }
[inputs]
s = { value = "5*sin(2*t)", unit = "cm" }
r = { value = "l*sin(w*t)", unit = "cm" }
[coordinates]
theta = { initial = 30, rate = 10, unit = "deg" }
x = { initial = "3 ft", unit = "mm" }
)toml",
                                    "units.toml");
    CHECK(value_of(*scene.parameters[0].value.tree) == doctest::Approx(0.2).epsilon(1e-15));
    CHECK(scene.parameters[0].unit == "m");
    CHECK(scene.parameters[0].shown.unit == "mm");
    CHECK(scene.parameters[1].value.text == "l/2");
    CHECK(scene.parameters[2].unit == "rad/s");
    CHECK(scene.inputs[0].value.text.find("0.01") != std::string::npos);
    CHECK(scene.inputs[1].value.text == "l*sin(w*t)");
    CHECK(value_of(*scene.coordinates[0].initial.tree) == doctest::Approx(pi / 6));
    CHECK(value_of(*scene.coordinates[0].rate.tree) == doctest::Approx(pi / 18));
    CHECK(value_of(*scene.coordinates[1].initial.tree) == doctest::Approx(0.9144));
    CHECK(in_si(scene, "l", "150") == "(150)*(0.001)");
    CHECK(in_si(scene, "theta'", "90") == "(90)*(pi/180)");
    CHECK(in_si(scene, "l", "0.1 m") == "0.1 m");
    CHECK(in_si(scene, "unknown", "1") == "1");
}

TEST_CASE("units: those of the SI, and words that are not known, change nothing") {
    const Scene scene = parse_scene(R"toml(
[parameters]
G = { value = 39.478, unit = "AU^3/(Msun*yr^2)" }
k = { value = 5, unit = "N/m" }
[coordinates]
x = { initial = 1, unit = "AU" }
)toml",
                                    "units.toml");
    CHECK(scene.parameters[0].value.text == "39.478");
    CHECK(scene.parameters[0].unit == "AU^3/(Msun*yr^2)");
    CHECK(scene.parameters[1].shown.unit.empty());
    CHECK(scene.coordinates[0].initial.text == "1");
}

TEST_CASE("units: contradictions are told with both dimensions and the place") {
    const std::string head = R"toml([parameters]
m = { value = 1, unit = "kg" }
k = { value = 5, unit = "N/m" }
l = { value = 2, unit = "m" }
g = { value = 9.81, unit = "m/s^2" }
[coordinates]
x = { initial = 1, unit = "m" }
theta = { initial = 1, unit = "rad" }
)toml";
    const auto told = [&](const std::string& more) {
        const std::vector<std::string> found = warnings(head + more);
        return found.size() == 1 ? found[0] : fmt::format("{} warnings", found.size());
    };
    const auto holds = [](const std::string& text, std::initializer_list<const char*> words) {
        for (const char* word : words)
            if (text.find(word) == std::string::npos) return false;
        return text.find("unit_mismatch") != std::string::npos;
    };
    const std::string sum = told("[energy]\npotential = \"k*x^2/2 + m*g + m*g*l\"\n");
    CHECK_MESSAGE(holds(sum, {"10: ", "m*g", "kg*m/s^2", "kg*m^2/s^2"}), sum);
    const std::string energy = told("[energy]\nkinetic = \"m*x'^2/2\"\npotential = \"k*x\"\n");
    CHECK_MESSAGE(holds(energy, {"a potential energy is in kg*m^2/s^2", "kg*m/s^2"}), energy);
    const std::string sine = told("[energy]\npotential = \"k*l^2*sin(x)\"\n");
    CHECK_MESSAGE(holds(sine, {"the argument of sin", "'x' is in m"}), sine);
    const std::string place = told("[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"theta\", 0]\n");
    CHECK_MESSAGE(holds(place, {"the position of 'P' is in m, but its units make 1"}), place);
    const std::string force = told(
        "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", 0]\n[[force]]\nat = \"P\"\nvector = "
        "[\"m*x'\", 0]\n");
    CHECK_MESSAGE(holds(force, {"a force is in kg*m/s^2, but its units make kg*m/s"}), force);
    const std::string constraint = told("[[constraint]]\nname = \"c\"\nholonomic = \"x = theta\"\n");
    CHECK_MESSAGE(holds(constraint, {"'theta' is in 1", "'x' in m"}), constraint);
    const std::pair<const char*, const char*> calls[] = {
        {"max(l, 2 kg)", "the arguments of max have different dimensions"},
        {"min(l, m)", "the arguments of min have different dimensions"},
        {"atan2(l, m)", "the arguments of atan2 have different dimensions"},
        {"min(max(l, x), k)", "the arguments of min have different dimensions"},
        {"2^m", "an exponent is a number; 'm' is in kg"},
        {"theta^(x + l)", "an exponent is a number; 'x + l' is in m"},
        {"theta^(2 N)", "an exponent is a number"}};
    for (const auto& [typed, words] : calls) {
        const std::string said = told("[outputs]\no = \"" + std::string(typed) + "\"\n");
        CHECK_MESSAGE(holds(said, {words, "10: "}), typed, ": ", said);
    }
    for (const char* const right : {"max(l, x)", "min(l, 0)", "atan2(x, l)", "max(l, 2 mm)", "x^(l/x)",
                                    "max(x, 9.81)", "l^2.5", "max(theta, 2)", "x + 3"})
        CHECK_MESSAGE(told("[outputs]\no = \"" + std::string(right) + "\"\n") == "0 warnings", right);
    CHECK(told("[energy]\npotential = \"k*x^2/2 + m*g*l*(1 - cos(theta)) + 0.5*k*(x - 3)^2\"\n") == "0 warnings");
}

TEST_CASE(
    "warnings: what nothing uses, inertias that never turn and sines of degrees are told, and no scene here is") {
    const auto told = [](const std::string& scene) {
        std::string result;
        for (const Diagnostic& one : parse_scene(scene, "warnings.toml").warnings)
            result += fmt::format("{} {} {}; ", one.place.line, one.kind, one.name);
        return result;
    };
    CHECK(told("[parameters]\nm = 1\ng = 9.81\n[inputs]\nF = \"t\"\n[coordinates]\nx = 0\n[definitions]\nd = "
               "\"2*x\"\n"
               "[[frame]]\nname = \"A\"\nrotate = [[\"z\", \"x\"]]\n[[point]]\nname = \"Q\"\noffset = [\"x\", 0]\n"
               "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", 0]\n") ==
          "3 unused g; 5 unused F; 9 unused d; 11 unused A; 14 unused Q; ");
    CHECK(parse_scene("[parameters]\ng = 9.81\n[coordinates]\nx = 0\n", "g.toml")
              .warnings.at(0)
              .message.find("gravity = [0, \"-g\"]") != std::string::npos);
    CHECK(told("[coordinates]\nq = 0\n[[body]]\nname = \"rod\"\nmass = 1\ninertia = 2\nposition = [\"cos(q)\", "
               "\"sin(q)\"]\n") == "6 no_effect rod; ");
    CHECK(told("[coordinates]\nx = 0\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"sin(30)*x + cos(30 deg)*x + "
               "sin(pi/6)\"\n") == "5 suspicious_number ; ");
    try {
        parse_scene("allow = [\"unsed\"]\n[coordinates]\nx = 0\n", "allow.toml");
        FAIL("a kind that is none is read");
    } catch (const SceneError& error) {
        CHECK(std::string(error.what()).find("unknown kind of warning 'unsed'; did you mean 'unused'?") !=
              std::string::npos);
    }
    int scenes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(ALEMBERT_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        CAPTURE(entry.path().string());
        const Scene scene = read_scene(entry.path().string());
        CHECK(scene.warnings.empty());
        ++scenes;
    }
    CHECK(scenes > 150);
}

}  // namespace scene_units
