// SPDX-License-Identifier: MIT
// Dry friction with a cone, and several rough contacts at once: scenes/friction against closed forms, and a coin
// against its vector equations in 30 digits (tests/reference/sliding_coin.py).
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "contacts.hpp"
#include "edits.hpp"
#include "files.hpp"

namespace commands_friction_plane {

using namespace alembert::test;

namespace {

constexpr double pi = 3.14159265358979323846;

std::string scene_of(const std::string& name) {
    return source_path("scenes/friction/" + name + ".toml");
}

std::string changed(const std::string& name, const std::string& from, const std::string& to) {
    return temporary(name + "_changed.toml", edited(contents(scene_of(name)), {{from, to}}));
}

doctest::Approx near(double value) {
    return doctest::Approx(value).epsilon(1e-12);
}

void check_balance(const Json& motion) {
    CHECK(motion["work_balance"].get<double>() < 1e-12);
}

}  // namespace

TEST_CASE("friction in a plane: both ends of a dragged rod give way when no forces hold it any more") {
    // Statics: the moment about Q leaves F sin(phi0) across the rod at P; along it both ends bear at most
    // √(B² − F² sin²) + B = F cos, B = mu m g/2.
    const double phi = 0.5, force = 0.3 * g * std::cos(phi), time = force / (20 * 0.1);
    const Json motion = simulated(scene_of("dragged_rod"));
    const auto slips = of_kind(motion, "slip");
    REQUIRE(slips.size() == 2);
    CHECK(slips[0]["name"] == "at_P");
    CHECK(slips[1]["name"] == "at_Q");
    for (const Json& slip : slips) {
        CHECK(value(slip, "time") == near(time));
        const double across = slip["name"] == "at_P" ? -phi : phi;
        CHECK(std::abs(slip["direction"][0].get<double>() - std::cos(across)) < 1e-6);
        CHECK(std::abs(slip["direction"][1].get<double>() - std::sin(across)) < 1e-6);
    }
    CHECK(of_kind(motion, "stick").size() == 2);  // at the start
    check_balance(motion);

    // The same with forces −mu N v/√(v² + eps²), which need no choice of modes: it differs by about eps times the
    // duration.
    std::string smooth = contents(scene_of("dragged_rod"));
    smooth.erase(smooth.find("[[friction]]"), smooth.find("[simulation]") - smooth.find("[[friction]]"));
    smooth += R"toml(
[definitions]
px = "dot(vel(P), ex(N))"
py = "dot(vel(P), ey(N))"
qx = "dot(vel(Q), ex(N))"
qy = "dot(vel(Q), ey(N))"
p = "mu*m*g/2/sqrt(px^2 + py^2 + 1e-12)"
q = "mu*m*g/2/sqrt(qx^2 + qy^2 + 1e-12)"
[forces]
x = "-p*px - q*qx"
y = "-p*py - q*qy"
phi = "a*(p*(px*sin(phi) - py*cos(phi)) - q*(qx*sin(phi) - qy*cos(phi)))"
)toml";
    const Json other =
        simulated(temporary("smooth_rod.toml", smooth), {"--method", "radau", "--tolerance", "1e-9"});
    for (const char* q : {"x", "y", "phi"}) CHECK(std::abs(coordinate(motion, q) - coordinate(other, q)) < 1e-5);
}

TEST_CASE("friction in a plane: a table on four feet, pulled at its middle, sticks and slips as a block does") {
    // Held forces are not determined, and static friction exceeds the sliding one. With w = v t − x − mu m g/k the
    // block obeys w'' = −k w/m, from w = (static − mu) m g/k and w' = v to w' = v again.
    std::string table = R"toml(
[coordinates]
x = 0
y = 0
phi = 0
[[frame]]
name = "B"
rotate = [["z", "phi"]]
[[body]]
name = "table"
mass = 4
frame = "B"
position = ["x", "y"]
inertia = 0.33
[energy]
potential = "50*((x - 0.1*t)^2 + y^2)/2"
[simulation]
duration = 4.5
tolerance = 1e-12
)toml";
    for (const auto& [name, x, y] :
         {std::tuple{"A", 0.49, 0.1}, {"B", -0.1, 0.49}, {"C", -0.49, -0.1}, {"D", 0.1, -0.49}})
        table += fmt::format(R"toml(
[[point]]
name = "{0}"
from = "table"
axes = "B"
offset = [{1}, {2}]
[[friction]]
name = "at_{0}"
coefficient = 0.3
static = 0.36
slip = ["dot(vel({0}), ex(N))", "dot(vel({0}), ey(N))"]
normal = 9.81
)toml",
                             name, x, y);
    const Json motion = simulated(temporary("table.toml", table));
    const double w = std::sqrt(50.0 / 4), begins = 0.36 * 4 * g / (50 * 0.1), start = 0.06 * 4 * g / 50,
                 lasts = 2 * (pi - std::atan(start * w / 0.1)) / w;
    const auto slips = of_kind(motion, "slip"), sticks = of_kind(motion, "stick");
    REQUIRE(slips.size() == 4);
    REQUIRE(sticks.size() == 8);
    for (const Json& slip : slips) {
        CHECK(value(slip, "time") == near(begins));
        CHECK(std::abs(slip["direction"][1].get<double>()) < 1e-12);
    }
    for (std::size_t k = 4; k < 8; ++k) CHECK(value(sticks[k], "time") == near(begins + lasts));
    CHECK(coordinate(motion, "x") == near(0.1 * lasts + 2 * start));
    CHECK(std::abs(coordinate(motion, "phi")) < 1e-12);
    check_balance(motion);
}

TEST_CASE("friction in a plane: a struck billiard ball moves on a parabola and rolls after 2 |u|/(7 mu g)") {
    const double r = 0.028575, mu = 0.2, v0 = 2, wx = 40, wy = -25, end = 1.5;
    const double u = v0 - r * wy, v = r * wx, speed = std::hypot(u, v), roll = 2 * speed / (7 * mu * g);
    const Json motion = simulated(scene_of("billiard_ball_struck"));
    const auto sticks = of_kind(motion, "stick");
    REQUIRE(sticks.size() == 1);
    CHECK(of_kind(motion, "slip").empty());
    CHECK(value(sticks[0], "time") == near(roll));
    const double ax = -mu * g * u / speed, ay = -mu * g * v / speed;
    CHECK(rate(motion, "x") == near(v0 + ax * roll));
    CHECK(rate(motion, "y") == near(ay * roll));
    CHECK(coordinate(motion, "x") == near(v0 * roll + ax * roll * roll / 2 + (v0 + ax * roll) * (end - roll)));
    CHECK(coordinate(motion, "y") == near(ay * roll * roll / 2 + ay * roll * (end - roll)));
    check_balance(motion);
}

TEST_CASE(
    "friction in a plane: a puck that slides across a slope stops at the time and place of its closed form") {
    // dv/dpsi = v (k − cos psi)/sin psi from psi = pi/2, where v = v0; with u = tan(psi/2) the time is
    // v0/(g sin(alpha)) ∫ u^(k−2) (1 + u²)/2 du, and the distances have integrals of the same kind.
    const double k = 1.6, v0 = 2, s = g * std::sin(0.3);
    const Json motion = simulated(scene_of("puck_on_slope"));
    const auto sticks = of_kind(motion, "stick");
    REQUIRE(sticks.size() == 1);
    const auto power = [](double n) { return 1 / n; };  // ∫ u^(n−1) du from 0 to 1
    CHECK(value(sticks[0], "time") == near(v0 / s * (power(k - 1) + power(k + 1)) / 2));
    // v = v0 u^k/sin psi; dx = v sin psi dt, ds = v cos psi dt, dt = v0/s u^(k−2) (1 + u²)/2 du
    const double scale = v0 * v0 / s / 2;
    CHECK(coordinate(motion, "x") == near(scale * (power(2 * k - 1) + power(2 * k + 1))));
    CHECK(coordinate(motion, "s") == near(scale / 2 * (power(2 * k - 2) - power(2 * k + 2))));
    check_balance(motion);
}

TEST_CASE("friction in a plane: it holds within a cone, and lets go in the direction of the load") {
    // A block on a table is pulled by (3 t, 4 t): it holds until 5 t = mu_s m g, then m v' = 5 t − mu m g.
    const std::string scene = temporary("pulled_block.toml", R"toml(
[parameters]
mu = 0.4
[coordinates]
x = 0
y = 0
[[particle]]
name = "block"
mass = 2
position = ["x", "y"]
[forces]
x = "3*t"
y = "4*t"
[[friction]]
name = "table"
coefficient = "mu"
static = 0.5
slip = ["x'", "y'"]
normal = 19.62
[simulation]
duration = 3
tolerance = 1e-12
)toml");
    const double weight = 19.62, freed = 0.5 * weight / 5;
    const Json motion = simulated(scene);
    const auto slips = of_kind(motion, "slip");
    REQUIRE(slips.size() == 1);
    CHECK(value(slips[0], "time") == near(freed));
    CHECK(slips[0]["direction"][0].get<double>() == near(0.6));
    CHECK(slips[0]["direction"][1].get<double>() == near(0.8));
    const double speed = (2.5 * (9 - freed * freed) - 0.4 * weight * (3 - freed)) / 2;
    CHECK(rate(motion, "x") == near(0.6 * speed));
    CHECK(rate(motion, "y") == near(0.8 * speed));
    check_balance(motion);
    const auto at = [&](const char* t, const char* mode, double x) {
        const auto result = run({"eval", scene, "--at", std::string("t=") + t, "--json"});
        REQUIRE(result.exit == 0);
        const Json state = Json::parse(result.out);
        CHECK(state["friction"]["table"] == mode);
        CHECK(std::abs(state["accelerations"]["x"].get<double>() - x) < 1e-12);
    };
    at("1.9", "stick", 0);
    at("2.5", "slip", 0.6 * (12.5 - 0.4 * weight) / 2);
}

TEST_CASE("friction in a plane: a sliding coin rolls at the time of its vector equations in 30 digits") {
    const Json motion = simulated(scene_of("sliding_coin"), {"--no-estimate"});
    const auto sticks = of_kind(motion, "stick");
    REQUIRE(sticks.size() == 1);
    CHECK(value(sticks[0], "time") == near(0.14839178788374438897));
    CHECK(of_kind(motion, "slip").size() == 1);  // rolling needs more than the cone holds after that
    check_balance(motion);
}

TEST_CASE("friction in a plane: a derivation and an audit describe it, a claim is proved, mistakes have places") {
    const std::string puck = scene_of("puck_on_slope");
    const Json derived = Json::parse(run({"derive", puck, "--json"}).out)["friction"][0];
    CHECK(derived["slip"] == Json{"x'", "s'"});
    CHECK(Json::parse(run({"audit", puck, "--json"}).out)["friction"][0]["modes"] == Json{"stick", "slip"});
    const auto checked = run({"check", puck});
    CAPTURE(checked.out);
    CHECK(checked.exit == 0);
    const auto told = [](const std::string& from, const std::string& to) {
        const auto result = run({"derive", changed("puck_on_slope", from, to)});
        CHECK(result.exit == 3);
        return result.err;
    };
    CHECK(told("[\"x'\", \"s'\"]", "[\"x'\"]").find("1 components; expected one expression, or two") !=
          std::string::npos);
    CHECK(told("[\"x'\", \"s'\"]", "[\"x'\", \"s\"]").find("contains no rate") != std::string::npos);
    CHECK(told("normal = ", "restitution = 1\nnormal = ").find("only a [[unilateral]]") != std::string::npos);
}

TEST_CASE("friction in a plane: a ball that lands with spin slides or grips as in Routh's closed form") {
    // The impulse of friction has the direction of the sliding velocity u, which keeps it; it is mu times that of
    // the floor, or 2/7 m |u|, which stops it.
    const double r = 0.028575, speed = std::sqrt(2 * g), u = 2 + r * 25, v = r * 40, slip = std::hypot(u, v);
    for (const double mu : {0.05, 0.2}) {
        CAPTURE(mu);
        const std::string scene = edited(contents(scene_of("billiard_ball_struck")),
                                         {{"{ value = 0.2, unit = \"1\" }", fmt::format("{}", mu)},
                                          {"initial = \"r\"", "initial = \"r + 1\""},
                                          {"gap = \"z - r\"", "gap = \"z - r\"\nrestitution = 0.5"},
                                          {"duration = 1.5", "duration = 0.6"}});
        const Json motion = simulated(temporary("landing_ball.toml", scene));
        REQUIRE(of_kind(motion, "impact").size() == 1);
        const double change = std::min(mu * 1.5 * speed, 2.0 / 7 * slip);
        CHECK(rate(motion, "x") == near(2 - change * u / slip));
        CHECK(rate(motion, "y") == near(-change * v / slip));
        check_balance(motion);
    }
}

TEST_CASE(
    "friction in a plane: a spinning plate that falls flat on three feet keeps the spin of the closed form") {
    const double m = 2, J = 0.08, R = 0.3, h = 0.2, mu = 0.2, e = 0.3, end = 0.3;
    const double fall = std::sqrt(2 * h / g), v = g * fall, loss = mu * m * v * (1 + e) * R / J;
    const Json motion = simulated(scene_of("falling_tripod"));
    const auto impacts = of_kind(motion, "impact");
    REQUIRE(impacts.size() == 3);
    for (const Json& impact : impacts) {
        CHECK(value(impact, "time") == near(fall));
        CHECK(value(impact, "speed_after") == near(e * v));
        CHECK(value(impact, "reaction_impulse") == near(m * v * (1 + e) / 3));
    }
    CHECK(rate(motion, "psi") == near(12 - loss));
    CHECK(coordinate(motion, "psi") == near(12 * end - loss * (end - fall)));
    CHECK(rate(motion, "z") == near(e * v - g * (end - fall)));
    for (const char* const q : {"x", "y", "a", "b"}) CHECK(std::abs(rate(motion, q)) < 1e-12);
    check_balance(motion);
    const double spin = value(motion, "impact_loss") - 3 * 0.5 * (m / 3) * v * v * (1 - e * e);
    CHECK(spin == near(J * (12 * 12 - (12 - loss) * (12 - loss)) / 2));
    // Bounces or none, the floor has given m g t when it lies, and takes the spin away by t = J w0/(mu R m g);
    // that what is left of bounces too low to follow is removed costs a ten-millionth.
    const Json at_rest = simulated(scene_of("falling_tripod"), {"--duration", "1"});
    const auto sticks = of_kind(at_rest, "stick");
    REQUIRE(sticks.size() == 3);
    for (const Json& one : sticks)
        CHECK(value(one, "time") == doctest::Approx(J * 12 / (mu * R * m * g)).epsilon(1e-6));
    // It stops turning where friction is stronger.
    const Json still = simulated(changed("falling_tripod", "mu = { value = 0.2", "mu = { value = 0.9"));
    CHECK(std::abs(rate(still, "psi")) < 1e-12);
    // Sliding to one side too, it loses energy in the impact, and not more than there is.
    const Json across = simulated(changed("falling_tripod", "vx = { value = 0.0", "vx = { value = 1.5"));
    CHECK(rate(across, "x") < 1.5);
    CHECK(rate(across, "x") > 0);
    CHECK(rate(across, "psi") < 12);
    CHECK(value(across, "impact_loss") > 0);
    check_balance(across);
}

// The plate turns about a foot that sticks, and stops as a whole; rounding lets that foot go just before. In the
// third case a foot that has been slow for long stops with faster ones, in the fourth all are slower than 1 m/s,
// in the fifth the errors of several steps are left of a foot's velocity. At rest no load acts along the floor:
// that all feet stick without a force is consistent.
TEST_CASE("friction in a plane: a plate on three feet that slides and turns comes to rest on all of them") {
    for (const auto& [vx, mu, w0] :
         {std::tuple("1.8", "0.425", "12.0"), std::tuple("2.4", "0.8", "12.0"), std::tuple("2.4", "0.425", "12.0"),
          std::tuple("3.0", "0.8", "2.0"), std::tuple("2.25", "0.853", "-14.5")}) {
        INFO(std::string(vx) << " " << mu << " " << w0);
        const std::string scene =
            edited(contents(scene_of("falling_tripod")),
                   {{"vx = { value = 0.0", fmt::format("vx = {{ value = {}", vx)},
                    {"mu = { value = 0.2", fmt::format("mu = {{ value = {}", mu)},
                    {"w0 = { value = 12.0", fmt::format("w0 = {{ value = {}", w0)},
                    {"y   = { initial = 0",
                     fmt::format("y   = {{ initial = 0, rate = {}", std::string(w0)[0] == '-' ? 0.58 : 0)}});
        const Json motion = simulated(temporary("plate.toml", scene), {"--duration", "1.2", "--no-estimate"});
        CHECK(of_kind(motion, "stick").size() >= 3);
        for (const char* const q : {"x", "y", "z", "psi", "a", "b"}) CHECK(std::abs(rate(motion, q)) < 1e-13);
        check_balance(motion);
    }
}

TEST_CASE("friction in a plane: two balls that land at the same instant land as one does") {
    const auto balls = [](const std::string& parameters, const std::string& names) {
        std::string scene = "[parameters]\nm = 0.17\nr = 0.03\nmu = 0.2\n" + parameters, kinetic, potential,
                    contacts;
        scene += "[coordinates]\n";
        for (const char k : names) {
            const auto with = [&](std::string text) {
                for (std::size_t at = 0; (at = text.find('#')) != std::string::npos;) text[at] = k;
                return text;
            };
            scene += with(
                "x# = { initial = 0, rate = \"v#\" }\ny# = { initial = 0, rate = 0.4 }\nz# = 1\n"
                "p# = { initial = 0, rate = \"s#\" }\nq# = { initial = 0, rate = 30 }\n");
            kinetic += with(" + m*(x#'^2 + y#'^2 + z#'^2)/2 + m*r^2/5*(p#'^2 + q#'^2)");
            potential += with(" + 9.81*m*z#");
            contacts += with(
                "[[unilateral]]\nname = \"floor#\"\ngap = \"z# - r\"\nrestitution = 0.8\n"
                "[[friction]]\nname = \"skin#\"\ncoefficient = \"mu\"\n"
                "slip = [\"x#' - r*p#'\", \"y#' + r*q#'\"]\non = \"floor#\"\n");
        }
        return simulated(temporary("balls.toml", scene + "[energy]\nkinetic = \"0" + kinetic +
                                                     "\"\npotential = \"0" + potential + "\"\n" + contacts +
                                                     "[simulation]\nduration = 1.5\ntolerance = 1e-12\n"));
    };
    const Json both = balls("v1 = 2\ns1 = -60\nv2 = -1\ns2 = 5\n", "12"), first = balls("v1 = 2\ns1 = -60\n", "1"),
               second = balls("v2 = -1\ns2 = 5\n", "2");
    CHECK(of_kind(both, "impact").size() == of_kind(first, "impact").size() + of_kind(second, "impact").size());
    for (const Json* one : {&first, &second})
        for (const char* const part : {"coordinates", "rates"})
            for (const auto& entry : (*one)["final"][part].items())
                CHECK_MESSAGE(both["final"][part][entry.key()].get<double>() == near(entry.value().get<double>()),
                              entry.key());
    check_balance(both);
}

TEST_CASE("friction: a superball exchanges spin and flight without loss, as Garwin's map says") {
    const double r = 0.025;
    const Json motion = simulated(scene_of("superball"));
    const auto impacts = of_kind(motion, "impact");
    REQUIRE(impacts.size() >= 4);
    double x = 1, phi = -120;
    for (const Json& impact : impacts) {
        const double change = -4.0 / 7 * (x - r * phi);
        x += change;
        phi -= change / (0.4 * r);
        CHECK(std::abs(value(impact, "energy_loss")) < 1e-15);
    }
    CHECK(rate(motion, "x") == near(x));
    CHECK(rate(motion, "phi") == near(phi));
    check_balance(motion);
}

TEST_CASE("friction: a block rocks from corner to corner with Housner's loss") {
    const double b = 0.2, h = 0.8, R = std::hypot(b, h), alpha = std::atan(b / h);
    const Json motion = simulated(scene_of("rocking_block"));
    const auto impacts = of_kind(motion, "impact");
    REQUIRE(impacts.size() >= 3);
    // 2/3 R² theta'² = g R (cos(alpha − theta0) − cos alpha); the other corner strikes with 2 b theta'.
    double speed = -2 * b * std::sqrt(1.5 * g / R * (std::cos(alpha - 0.12) - std::cos(alpha)));
    const double kept = 1 - 1.5 * std::sin(alpha) * std::sin(alpha);
    for (std::size_t n = 0; n < impacts.size(); ++n) {
        CHECK(impacts[n]["name"] == (n % 2 == 0 ? "right" : "left"));
        CHECK(value(impacts[n], "speed_before") == doctest::Approx(speed).epsilon(1e-10));
        speed *= kept;
    }
    check_balance(motion);
}

TEST_CASE(
    "friction: a box brakes on two rough feet, stands, and with a high mass centre tips over the front one") {
    const double v0 = 2, mu = 0.4;
    const Json motion = simulated(scene_of("braking_box"));
    const auto sticks = of_kind(motion, "stick");
    REQUIRE(!sticks.empty());  // one foot that sticks holds the box
    CHECK(value(sticks[0], "time") == near(v0 / (mu * g)));
    CHECK(coordinate(motion, "x") == near(v0 * v0 / (2 * mu * g)));
    CHECK(std::abs(rate(motion, "x")) < 1e-14);
    CHECK(of_kind(motion, "release").empty());
    check_balance(motion);
    // mu h > b: the rear foot lifts at once. About the mass centre J theta'' = N (b - mu h), m y'' = N - m g and
    // y'' = -b theta'' at the start.
    const Json tall = Json::parse(
        run({"eval", changed("braking_box", "h  = { value = 0.5", "h  = { value = 0.9"), "--json"}).out);
    CHECK(tall["closed"] == Json{"front"});
    const double m = 8, J = 0.6, half = 0.3, arm = half - mu * 0.9, N = m * g / (1 + m * half * arm / J);
    CHECK(tall["accelerations"]["theta"].get<double>() == near(N * arm / J));
    CHECK(tall["multipliers"]["lambda_front"].get<double>() == near(N));
}

// While the front foot sticks the box is a pendulum about it. From theta = -0.9 on a foot that slid would jam:
// between the bounds of friction its force has a pole, near which the motion drifted off its constraints without a
// word.
TEST_CASE("friction: a box whose front foot sticks turns about it as a pendulum, past where sliding would jam") {
    const double m = 8, J = 0.6, b = 0.3, h = 0.5, I = J + m * (b * b + h * h);
    const std::string scene = temporary(
        "tipping.toml", edited(contents(scene_of("braking_box")), {{"mu = { value = 0.4", "mu = { value = 0.83"},
                                                                   {"v0 = { value = 2.0", "v0 = { value = 2.5"}}));
    const std::string file = temporary("tipping.csv", "");
    const Json motion = simulated(scene, {"-o", file});
    const auto sticks = of_kind(motion, "stick", "front_sole");
    REQUIRE(sticks.size() == 1);
    CHECK(of_kind(motion, "slip").empty());
    check_balance(motion);
    CHECK(motion["constraint_drift"].get<double>() < 1e-13);
    std::vector<std::vector<double>> rows = table_of(file);
    std::erase_if(rows, [&](const auto& row) { return row[0] <= value(sticks[0], "time"); });
    const auto energy = [&](const std::vector<double>& row) { return I * row[6] * row[6] / 2 + m * g * row[2]; };
    const auto foot = [&](const std::vector<double>& row) {
        return row[1] + h * std::sin(row[3]) + b * std::cos(row[3]);
    };
    CHECK(rows.back()[3] < -1.2);
    CHECK(energy(rows.back()) == near(energy(rows.front())));
    CHECK(foot(rows.back()) == near(foot(rows.front())));
}

}  // namespace commands_friction_plane
