// SPDX-License-Identifier: MIT
// Motions of textbook scenes that have closed forms, from the parameters in the scene files.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_scenes {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

std::string scene(const std::string& name) {
    return source_path("scenes/textbook/" + name + ".toml");
}

Json simulated(const std::string& name, const std::string& duration) {
    return json_of({"simulate", scene(name), "--tolerance", "1e-13", "--duration", duration});
}

Json evaluated(const std::string& name, const std::vector<std::string>& at = {}) {
    return json_of({"eval", scene(name)}, at);
}

double distance(const Json& found, const std::map<std::string, double>& expected) {
    double worst = 0;
    for (const auto& [name, value] : expected)
        worst = std::max(worst, std::abs(found[name].get<double>() - value));
    return worst;
}

/// The rows of a CSV file, each as values by the names of the columns.
std::vector<std::map<std::string, double>> rows_of(const std::string& file) {
    std::ifstream in(file);
    std::string line, word;
    std::getline(in, line);
    std::vector<std::string> names;
    for (std::istringstream words(line); std::getline(words, word, ',');) names.push_back(word);
    std::vector<std::map<std::string, double>> rows;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        for (rows.emplace_back(); std::getline(words, word, ',');) {
            const std::string& name = names.at(rows.back().size());
            rows.back()[name] = std::stod(word);
        }
    }
    return rows;
}

}  // namespace

// v along the blade and w are constant: a circle of radius v/w. The side force is m v w, to the left of the
// heading. There are some hundred steps with local errors of 1e-13 each.
TEST_CASE("commands: the sled runs in a circle, through the headings at which tan is infinite") {
    const double v = 1.2, w = 1, t = 10;
    const Json json = simulated("sled_regular", "10");
    CHECK(distance(json["final"]["coordinates"],
                   {{"xC", v / w * std::sin(w * t)}, {"yC", v / w * (1 - std::cos(w * t))}, {"phi", w * t}}) <
          1e-10);
    CHECK(distance(json["final"]["rates"],
                   {{"xC", v * std::cos(w * t)}, {"yC", v * std::sin(w * t)}, {"phi", w}}) < 1e-10);
    CHECK(json["constraint_drift"].get<double>() < 1e-13);
    CHECK(evaluated("sled_regular")["multipliers"]["lambda1"].get<double>() ==
          doctest::Approx(-4 * v * w).epsilon(1e-14));
}

// The same circle with the constraint as the book writes it, short of the quarter turn: at phi = 1.5 an error of
// the constraint is multiplied by tan(phi) = 14.
TEST_CASE("commands: the sled with tan(phi) in its constraint runs in the same circle, up to a quarter turn") {
    const double v = 1.2, w = 0.3, t = 5;
    const Json json = simulated("sled", "5");
    CHECK(distance(json["final"]["coordinates"],
                   {{"xC", v / w * std::sin(w * t)}, {"yC", v / w * (1 - std::cos(w * t))}, {"phi", w * t}}) <
          1e-10);
    CHECK(distance(json["final"]["rates"],
                   {{"xC", v * std::cos(w * t)}, {"yC", v * std::sin(w * t)}, {"phi", w}}) < 1e-10);
}

// x'' = −2/7 Ω y', y'' = 2/7 Ω x' with 2/7 Ω = 1: a circle of radius 0.5 about (0.03, 0), once in 2 pi.
TEST_CASE("commands: the ball on a turntable runs in a circle at 2/7 of the table's rate and keeps its spin") {
    const std::string file = temporary("ball.csv", "");
    const auto result =
        run({"simulate", scene("turntable_ball"), "--tolerance", "1e-13", "--sample", "0.5", "-o", file});
    REQUIRE(result.exit == 0);
    const auto rows = rows_of(file);
    REQUIRE(rows.size() == 41);
    for (const auto& row : rows) {
        const double t = row.at("t");
        CAPTURE(t);
        CHECK(std::abs(row.at("x") - 0.03 - 0.5 * std::cos(t)) < 1e-10);
        CHECK(std::abs(row.at("y") - 0.5 * std::sin(t)) < 1e-10);
        CHECK(std::abs(row.at("spin") - 1) < 1e-10);
    }
}

// For the upper rope the lower machine acts as a mass of 4 m2 m3/(m2 + m3).
TEST_CASE("commands: the double Atwood machine moves as if the lower machine were its effective mass") {
    const double g = 9.81, m1 = 3, m2 = 1.7, m3 = 0.4, mp = 0.3;
    const double effective = 4 * m2 * m3 / (m2 + m3);
    const double a = (m1 - effective) / (m1 + effective) * g;
    const Json free = evaluated("double_atwood", {"--at", "m1=3", "m2=1.7", "m3=0.4"});
    CHECK(free["accelerations"]["x"].get<double>() == doctest::Approx(a).epsilon(1e-13));
    CHECK(free["accelerations"]["y"].get<double>() ==
          doctest::Approx((m2 - m3) / (m2 + m3) * (g + a)).epsilon(1e-13));

    const double heavy = (m1 - mp - effective) / (m1 + mp + effective) * g;
    const double pull = 2 * m2 * m3 / (m2 + m3) * (g + heavy);
    const Json ropes = evaluated("double_atwood_ropes", {"--at", "m1=3", "m2=1.7", "m3=0.4"});
    CHECK(ropes["accelerations"]["y1"].get<double>() == doctest::Approx(heavy).epsilon(1e-13));
    CHECK(ropes["accelerations"]["z"].get<double>() == doctest::Approx(-heavy).epsilon(1e-13));
    CHECK(ropes["accelerations"]["y2"].get<double>() == doctest::Approx(g - pull / m2).epsilon(1e-13));
    CHECK(ropes["outputs"]["lower_tension"].get<double>() == doctest::Approx(pull).epsilon(1e-13));
    CHECK(ropes["outputs"]["upper_tension"].get<double>() == doctest::Approx(m1 * (g - heavy)).epsilon(1e-13));

    // The ropes give inertia to a pulley without mass.
    std::ifstream file(scene("double_atwood_ropes"));
    std::string text(std::istreambuf_iterator<char>(file), {});
    text.replace(text.find("mass = \"mp\""), 11, "mass = 0");
    const auto result = run({"simulate", temporary("light.toml", text), "--json", "--tolerance", "1e-12"});
    REQUIRE(result.exit == 0);
    const Json light = Json::parse(result.out)["final"]["coordinates"];
    CHECK(light["y1"].get<double>() == doctest::Approx(5 + 9 * 0.5 * g * 0.04 / 7.96).epsilon(1e-12));
    CHECK(light["z"].get<double>() == doctest::Approx(5 - 9 * 0.5 * g * 0.04 / 7.96).epsilon(1e-12));

    const Json end = simulated("double_atwood", "3")["final"]["coordinates"];
    CHECK(end["x"].get<double>() == doctest::Approx(9 * 0.5 * g * 0.04 / 7.96).epsilon(1e-12));
    CHECK(end["y"].get<double>() == doctest::Approx(9 * 0.5 * g * 0.8 / 7.96).epsilon(1e-12));
}

// a = 2, e = 1/2, G (m1 + m2) = 8 pi²: the period is 2. Kepler's equation E − e sin E = pi t; r = a (1 − e cos E),
// tan(phi/2) = √((1 + e)/(1 − e)) tan(E/2). An error grows with the number of turns, through that of the period.
TEST_CASE("commands: two bodies obey Kepler's third law and his equation") {
    const double e = 0.5;
    for (const std::string duration : {"0.5", "1", "10"}) {
        CAPTURE(duration);
        const double t = std::stod(duration), mean = M_PI * t;
        double E = mean;
        for (int k = 0; k < 20; ++k) E -= (E - e * std::sin(E) - mean) / (1 - e * std::cos(E));
        const double turns = 2 * M_PI * std::round(E / (2 * M_PI));
        const double phi = turns + 2 * std::atan2(std::sqrt(1 + e) * std::sin((E - turns) / 2),
                                                  std::sqrt(1 - e) * std::cos((E - turns) / 2));
        const Json json = simulated("two_body", duration);
        CHECK(distance(json["final"]["coordinates"],
                       {{"X", 0.4 * t}, {"Y", -0.1 * t}, {"r", 2 * (1 - e * std::cos(E))}, {"phi", phi}}) < 1e-10);
        CHECK(json["energy_drift"].get<double>() < 1e-12);
    }
}

// phi' = c + K sin(theta), theta = theta0 + w t, K = m g r sin(beta)/((J1 + m r²) w); x and y by quadrature.
TEST_CASE("commands: the coin on an incline does not run down but wanders across") {
    const double m = 0.02, r = 0.015, J1 = 2.25e-6, w = 2, t = 5, theta0 = 0.3, theta = theta0 + w * t;
    const double K = m * 9.81 * r * std::sin(0.1) / ((J1 + m * r * r) * w), c = 20 - K * std::sin(theta0);
    const auto x = [&](double th) { return r / w * (c * std::sin(th) + K * std::sin(th) * std::sin(th) / 2); };
    const auto y = [&](double th) { return r / w * (-c * std::cos(th) + K * (th / 2 - std::sin(2 * th) / 4)); };
    const Json json = simulated("coin", "5");
    CHECK(distance(json["final"]["coordinates"],
                   {{"x", x(theta) - x(theta0)}, {"y", y(theta) - y(theta0)}, {"theta", theta}}) < 1e-11);
    CHECK(json["final"]["rates"]["phi"].get<double>() == doctest::Approx(c + K * std::sin(theta)).epsilon(1e-11));
}

}  // namespace commands_scenes
