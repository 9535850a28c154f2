// SPDX-License-Identifier: MIT
// Dry friction, [[friction]]: scenes/friction against closed forms, and against a run in 40 digits with exact
// switching (tests/reference/belt_blocks.py).
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "contacts.hpp"
#include "edits.hpp"
#include "files.hpp"
#include "json.hpp"
#include "solved.hpp"
#include "tools.hpp"

namespace commands_friction {

using namespace alembert::test;

namespace {

constexpr double pi = 3.14159265358979323846;

std::string scene_of(const std::string& name) {
    return source_path("scenes/friction/" + name + ".toml");
}

/// The scene with some text replaced.
std::string changed(const std::string& name, const std::vector<std::pair<std::string, std::string>>& edits) {
    return temporary(name + "_changed.toml", edited(contents(scene_of(name)), edits));
}

/// The allowed error: rounding of the time, and the effect of the tolerance of 1e-12 in these scenes.
doctest::Approx near(double value) {
    return doctest::Approx(value).epsilon(1e-12);
}

void check_balance(const Json& motion) {
    CHECK(motion["work_balance"].get<double>() < 1e-12);
}

/// The ladder of scenes/friction while it slides down: theta, theta' and the force of the wall, by Newton's and
/// Euler's equations and Runge-Kutta's method.
struct Ladder {
    double theta = 0.8, rate = 0;

    /// theta'' and the forces of the floor and the wall.
    static Eigen::Vector3d solved(double theta, double rate) {
        const double m = 10, l = 2, f = 0.2, w = 0.3, c = std::cos(theta), s = std::sin(theta);
        Eigen::Matrix3d A;
        A << m * l * c, f, -1, -m * l * s, -1, -w, m * l * l / 3, -l * s + f * l * c, l * c + w * l * s;
        return alembert::test::solved(A,
                                      Eigen::Vector3d(m * l * s * rate * rate, m * l * c * rate * rate - m * g, 0))
            .value();
    }
    double wall() const { return solved(theta, rate)[2]; }
    Ladder after(double h) const {
        const auto slope = [](const Ladder& at) { return Eigen::Vector2d(at.rate, solved(at.theta, at.rate)[0]); };
        const auto moved = [&](const Eigen::Vector2d& by) { return Ladder{theta + by[0], rate + by[1]}; };
        const Eigen::Vector2d a = slope(*this), b = slope(moved(h / 2 * a)), c = slope(moved(h / 2 * b)),
                              d = slope(moved(h * c));
        return moved(h / 6 * (a + 2 * b + 2 * c + d));
    }
};

}  // namespace

TEST_CASE("friction: a block thrown up a slope stops, sticks and slides again at the times of the closed form") {
    const double m = 2, alpha = 0.3, mu = 0.4, mu_s = 0.5, v0 = 3, c = 2, end = 4;
    const Json motion = simulated(scene_of("block_on_slope"));
    const double down = g * std::sin(alpha), rub = g * std::cos(alpha);
    // Up the slope the growing force c t brakes too: v0 = (down + mu rub) t + c t²/(2 m).
    const double a = c / (2 * m), b = down + mu * rub, stop = (-b + std::sqrt(b * b + 4 * a * v0)) / (2 * a);
    const double way = -v0 * stop + b * stop * stop / 2 + c / (6 * m) * stop * stop * stop;
    const double freed = m * (mu_s * rub - down) / c;
    const auto sticks = of_kind(motion, "stick"), slips = of_kind(motion, "slip");
    REQUIRE(sticks.size() == 1);
    REQUIRE(slips.size() == 1);
    CHECK(value(sticks[0], "time") == near(stop));
    CHECK(value(sticks[0], "side") == 0);
    CHECK(value(slips[0], "time") == near(freed));
    CHECK(value(slips[0], "side") == 1);
    CHECK(slips[0]["name"] == "slope");
    const double d = down - mu * rub, T = end;
    const double speed = d * (T - freed) + c / (2 * m) * (T * T - freed * freed);
    const double s = way + d * (T - freed) * (T - freed) / 2 +
                     c / (2 * m) * ((T * T * T - freed * freed * freed) / 3 - freed * freed * (T - freed));
    CHECK(rate(motion, "s") == near(speed));
    CHECK(coordinate(motion, "s") == near(s));
    check_balance(motion);
}

TEST_CASE("friction: the period of a stick-slip oscillation is that of its closed form to 1e-10") {
    const double k = 25, m = 1, v = 0.3, w = std::sqrt(k / m), a = (0.5 - 0.2) * m * 10 / k;
    const double period = (2 * pi - 2 * std::atan(a * w / v)) / w + 2 * a / v;
    const Json motion = simulated(scene_of("stick_slip"));
    const auto slips = of_kind(motion, "slip"), sticks = of_kind(motion, "stick");
    REQUIRE(slips.size() >= 8);
    for (std::size_t n = 1; n < slips.size(); ++n)
        CHECK(value(slips[n], "time") - value(slips[n - 1], "time") == doctest::Approx(period).epsilon(1e-10));
    for (const Json& slip : slips) CHECK(value(slip, "side") == -1);
    REQUIRE(sticks.size() >= 8);
    check_balance(motion);
}

TEST_CASE("friction: three blocks on a belt stick and slip as in a 40-digit run with exact switching") {
    struct Change {
        double time;
        const char* name;
        int side;
    };
    const std::vector<Change> expected{{1.11, "second", -1},
                                       {1.26841228089485001, "first", -1},
                                       {1.80541782466727946, "third", -1},
                                       {2.46222826229571322, "first", 0},
                                       {2.89246900209157532, "third", 0},
                                       {3.19547914970490074, "first", -1},
                                       {3.29511570790048272, "second", 0},
                                       {3.91584770007950195, "second", -1},
                                       {4.11706565860215179, "third", -1},
                                       {5.21847367998464781, "third", 0},
                                       {5.91617878287110212, "first", 0},
                                       {6.33581012855765829, "second", 0},
                                       {6.392760730136493, "first", -1},
                                       {6.59886492401916389, "third", -1},
                                       {6.86814191361368065, "second", -1},
                                       {7.90106995823736904, "second", 0},
                                       {8.00870318359234204, "third", 0},
                                       {8.98633902015448477, "third", -1},
                                       {9.17095692994636582, "second", -1}};
    const Json motion = simulated(scene_of("belt_blocks"));
    std::vector<Json> found;
    for (const Json& event : motion["contacts"])
        if (value(event, "time") > 0) found.push_back(event);  // at the start all contacts stick
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        CAPTURE(k);
        CHECK(value(found[k], "time") == doctest::Approx(expected[k].time).epsilon(1e-11));
        CHECK(found[k]["name"] == expected[k].name);
        CHECK(value(found[k], "side") == expected[k].side);
    }
    CHECK(coordinate(motion, "x1") == doctest::Approx(0.144925822854660066).epsilon(1e-10));
    CHECK(coordinate(motion, "x2") == doctest::Approx(0.0962408872670016838).epsilon(1e-10));
    CHECK(rate(motion, "x3") == doctest::Approx(-0.0999161072321459574).epsilon(1e-10));
    check_balance(motion);
}

TEST_CASE(
    "friction: amplitudes of an oscillator fall in an arithmetic sequence until it sticks, by every method") {
    for (const char* method : {"auto", "dop853", "verner98", "taylor"}) {
        CAPTURE(method);
        const Json motion = simulated(scene_of("coulomb_oscillator"), {"--method", method});
        // 2.3 → −1.8 → 1.3 → −0.8 → 0.3 → −(−0.2) with mu N/k = 0.25: the mass reverses every pi/2 and sticks at 5
        // pi/2.
        const auto sticks = of_kind(motion, "stick"), slips = of_kind(motion, "slip");
        REQUIRE(sticks.size() == 1);
        CHECK(value(sticks[0], "time") == near(5 * pi / 2));
        REQUIRE(slips.size() >= 4);
        for (std::size_t n = 0; n < 4; ++n) {
            const Json& slip = slips[slips.size() - 4 + n];
            CHECK(value(slip, "time") == near(static_cast<double>(n + 1) * pi / 2));
            CHECK(value(slip, "side") == (n % 2 == 0 ? 1 : -1));
        }
        CHECK(coordinate(motion, "x") == near(0.2));
        check_balance(motion);
    }
}

TEST_CASE("friction: a billiard ball rolls after 2 v0/(7 mu g), with 5/7 of its speed") {
    const double v0 = 2, mu = 0.2, r = 0.028575;
    const Json motion = simulated(scene_of("billiard_ball"));
    const auto sticks = of_kind(motion, "stick");
    REQUIRE(sticks.size() == 1);
    const double time = 2 * v0 / (7 * mu * g);
    CHECK(value(sticks[0], "time") == near(time));
    CHECK(rate(motion, "x") == near(5 * v0 / 7));
    CHECK(rate(motion, "phi") == near(5 * v0 / 7 / r));
    CHECK(coordinate(motion, "x") == near(v0 * time - mu * g * time * time / 2 + 5 * v0 / 7 * (1 - time)));
    check_balance(motion);
}

TEST_CASE("friction: a clutch slips, locks, and slips again when it cannot transmit the torque any more") {
    const double I1 = 0.5, I2 = 1.5, M = 4, R = 0.1, mu = 0.4, mu_s = 0.45, N0 = 500, c = 50, w0 = 30;
    const Json motion = simulated(scene_of("clutch"));
    // a' − b' = w0 + M t/I1 − mu R (1/I1 + 1/I2)(N0 t − c t²/2)
    const double k = mu * R * (1 / I1 + 1 / I2);
    const double A = k * c / 2, B = M / I1 - k * N0, lock = (-B - std::sqrt(B * B - 4 * A * w0)) / (2 * A);
    const double freed = (N0 - M * I2 / (I1 + I2) / (mu_s * R)) / c;
    const auto sticks = of_kind(motion, "stick"), slips = of_kind(motion, "slip");
    REQUIRE(sticks.size() == 1);
    REQUIRE(slips.size() == 1);
    CHECK(value(sticks[0], "time") == near(lock));
    CHECK(value(slips[0], "time") == near(freed));
    const double momentum = I1 * w0 + M * 9.5;
    CHECK(I1 * rate(motion, "a") + I2 * rate(motion, "b") == near(momentum));
    CHECK(rate(motion, "a") - rate(motion, "b") ==
          doctest::Approx(B * (9.5 - freed) + A * (9.5 * 9.5 - freed * freed)).epsilon(1e-10));
    check_balance(motion);
}

TEST_CASE(
    "friction: a brake that is pressed from a given time on stops its wheel at the time of the closed form") {
    const double J = 2, R = 0.15, mu = 0.5, c = 80, w0 = 10;
    const Json motion = simulated(scene_of("brake"));
    const auto sticks = of_kind(motion, "stick");
    REQUIRE(sticks.size() == 1);
    CHECK(value(sticks[0], "time") == near(1 + std::sqrt(2 * J * w0 / (mu * R * c))));
    CHECK(std::abs(rate(motion, "phi")) < 1e-13);
    check_balance(motion);
}

TEST_CASE("friction: a normal force that becomes negative ends the run and is named") {
    const auto result = run({"simulate", changed("clutch", {{"duration = 9.5", "duration = 12"}}), "--json"});
    CHECK(result.exit == 4);
    CHECK(result.err.find("the normal force of friction 'lining' becomes negative at t = 10") !=
          std::string::npos);
}

TEST_CASE("friction: at a constraint the normal force is the absolute value of its multiplier") {
    // A bead on a circular wire in the plane, without gravity: v' = −mu v²/r, v = v0/(1 + mu v0 t/r).
    const std::string scene = temporary("bead.toml", R"toml(
[coordinates]
x = { initial = 1, rate = 0 }
y = { initial = 0, rate = 2 }
[[particle]]
name = "bead"
mass = 3
position = ["x", "y"]
[[constraint]]
name = "wire"
holonomic = "x^2 + y^2 = 1"
[[friction]]
name = "rub"
coefficient = 0.3
slip = "(x*y' - y*x')*2"
on = "wire"
[simulation]
duration = 2
tolerance = 1e-12
)toml");
    // The multiplier belongs to f = x² + y² − 1, whose gradient is 2 long, and so is the slip's: the force is
    // 2·0.3·|lambda| with the normal force 2 |lambda|.
    const Json motion = simulated(scene);
    const double v = 2 / (1 + 0.3 * 2 * 2);
    CHECK(std::hypot(rate(motion, "x"), rate(motion, "y")) == doctest::Approx(v).epsilon(1e-10));
    CHECK(motion["work_balance"].get<double>() < 1e-11);
}

TEST_CASE("friction: a derivation describes both modes, and a claim with its force is proved") {
    const auto derived = run({"derive", scene_of("block_on_slope"), "--json"});
    REQUIRE(derived.exit == 0);
    const Json one = Json::parse(derived.out)["friction"][0];
    CHECK(one["name"] == "slope");
    CHECK(one["slip"] == "s'");
    CHECK(one["sliding"] == "m*g*mu*cos(alpha)");
    CHECK(one["sticking"] == "m*g*mu_s*cos(alpha)");
    REQUIRE(one["while_sticking"].size() == 1);
    CHECK(one["while_sticking"][0]["text"] == "m*s'' - m*g*sin(alpha) = F + friction_slope");
    for (const char* name : {"block_on_slope", "stick_slip", "belt_blocks", "coulomb_oscillator", "clutch",
                             "brake", "billiard_ball"}) {
        CAPTURE(name);
        const auto checked = run({"check", scene_of(name)});
        CAPTURE(checked.out);
        CHECK(checked.exit == 0);
    }
    const Json audited = Json::parse(run({"audit", scene_of("clutch"), "--json"}).out);
    CHECK(audited["friction"][0]["modes"].size() == 3);
}

TEST_CASE("friction: mistakes in a friction are reported at their places") {
    const auto told = [](const std::string& from, const std::string& to) {
        const auto result = run({"derive", changed("block_on_slope", {{from, to}})});
        CHECK(result.exit == 3);
        return result.err;
    };
    CHECK(told("static = \"mu_s\"", "static = 0.1").find("less than its coefficient 0.4") != std::string::npos);
    CHECK(told("coefficient = \"mu\"", "coefficient = -1").find("expected 0 or more") != std::string::npos);
    CHECK(told("slip = \"s'\"", "slip = \"s'^2\"").find("not linear") != std::string::npos);
    CHECK(told("slip = \"s'\"", "slip = \"s\"").find("contains no rate") != std::string::npos);
    CHECK(told("normal = \"m*g*cos(alpha)\"", "on = \"flor\"").find("'flor'") != std::string::npos);
    CHECK(told("normal = \"m*g*cos(alpha)\"", "").find("needs one of 'on'") != std::string::npos);
}

TEST_CASE("friction: a ball with backspin grips or slides in each bounce as in Routh's closed form") {
    const double r = 0.03, mu = 0.25, e = 0.8;
    const Json motion = simulated(scene_of("spinning_ball"));
    const auto impacts = of_kind(motion, "impact");
    REQUIRE(impacts.size() >= 3);
    double x = 1, phi = -200, speed = std::sqrt(2 * g), t = speed / g;
    std::size_t count = 0;
    for (const Json& impact : impacts) {
        CAPTURE(count);
        CHECK(value(impact, "time") == near(t));
        CHECK(value(impact, "speed_before") == near(-speed));
        CHECK(value(impact, "speed_after") == near(e * speed));
        const double slip = x - r * phi, most = mu * (1 + e) * speed;
        const double change = std::abs(slip) > 3.5 * most ? -most * (slip > 0 ? 1 : -1) : -2.0 / 7 * slip;
        x += change;
        phi -= change / (0.4 * r);
        speed *= e;
        t += 2 * speed / g;
        ++count;
    }
    REQUIRE(t > 2.5);
    CHECK(rate(motion, "x") == near(x));
    CHECK(rate(motion, "phi") == near(phi));
    CHECK(x < 0);  // the spin has turned it back
    check_balance(motion);
}

// At the tolerance 1e-10 methods of orders up to 5 are right to about 1e-7.
TEST_CASE("friction: cvode and ida stick and slip at the times of the closed forms") {
    if (!has_part("alembert-sundials.so")) return;
    const double w = 5, a = 0.12, v = 0.3, period = (2 * pi - 2 * std::atan(a * w / v)) / w + 2 * a / v;
    for (const std::string method : {"cvode", "ida"}) {
        CAPTURE(method);
        const Json motion = simulated(scene_of("stick_slip"), {"--method", method, "--tolerance", "1e-10"});
        CHECK(motion["method"] == method);
        const auto slips = of_kind(motion, "slip");
        REQUIRE(slips.size() >= 8);
        for (std::size_t n = 1; n < slips.size(); ++n)
            CHECK(std::abs(value(slips[n], "time") - value(slips[n - 1], "time") - period) < 1e-7);
        CHECK(motion["work_balance"].get<double>() < 1e-6);
    }
    for (const char* const method : {"cvode", "ida"}) {
        const Json exact = simulated(scene_of("trammel")),
                   motion = simulated(scene_of("trammel"), {"--method", method, "--tolerance", "1e-10"});
        CAPTURE(method);
        REQUIRE(motion["contacts"].size() == exact["contacts"].size());
        for (std::size_t k = 0; k < exact["contacts"].size(); ++k) {
            CHECK(motion["contacts"][k]["event"] == exact["contacts"][k]["event"]);
            CHECK(std::abs(value(motion["contacts"][k], "time") - value(exact["contacts"][k], "time")) < 1e-6);
        }
    }
}

TEST_CASE("friction: verbs and methods that do not support it say so") {
    const auto told = [](const std::vector<std::string>& command) {
        const auto result = run(command);
        CHECK(result.exit == 3);
        return result.err;
    };
    for (const char* verb : {"linearize", "inverse", "impact"})
        CHECK(told({verb, scene_of("billiard_ball")}).find("'cloth'") != std::string::npos);
}

TEST_CASE("friction: eval finds the contacts that stick, and the forces that hold them") {
    // A block at rest on a slope, pulled by 5 N: it holds while 5 + m g sin alpha is below mu_s m g cos alpha.
    const auto at_rest = [](const char* force) {
        return json_of(
            {"eval", changed("block_on_slope", {{"rate = \"-v0\"", "rate = 0"},
                                                {"value = \"c*t\"", std::string("value = \"") + force + "\""}})});
    };
    const Json holds = at_rest("3"), slips = at_rest("5");
    CHECK(holds["friction"]["slope"] == "stick");
    CHECK(std::abs(holds["accelerations"]["s"].get<double>()) < 1e-14);
    CHECK(slips["friction"]["slope"] == "slip +");
    CHECK(slips["accelerations"]["s"].get<double>() ==
          near(5.0 / 2 + g * std::sin(0.3) - 0.4 * g * std::cos(0.3)));
}

TEST_CASE("friction: a ladder leaves its rough wall at the time given by Newton's equations") {
    const Json motion = simulated(scene_of("ladder"));
    const auto releases = of_kind(motion, "release", "wall");
    REQUIRE(releases.size() == 1);
    const double step = 1e-3;
    Ladder ladder;
    double t = 0;
    for (Ladder next = ladder.after(step); next.wall() > 0; next = ladder.after(step)) {
        ladder = next;
        t += step;
    }
    double low = 0, high = step;
    for (int k = 0; k < 60; ++k) (ladder.after((low + high) / 2).wall() > 0 ? low : high) = (low + high) / 2;
    CHECK(value(releases[0], "time") == doctest::Approx(t + low).epsilon(1e-11));
    check_balance(motion);
}

TEST_CASE("friction: the amplitudes of a pendulum decrease by the work of its pivot's friction until it sticks") {
    const double weight = 9.81 * 0.5, moment = 0.2 * 50 * 0.02;
    double theta = 1.2, side = 1;
    std::size_t turns = 0;
    while (weight * std::sin(theta) > moment) {
        double next = theta - 2 * moment / weight;
        for (int k = 0; k < 50; ++k)
            next += (weight * (std::cos(next) - std::cos(theta)) - moment * (theta + next)) /
                    (weight * std::sin(next) + moment);
        theta = next;
        side = -side;
        ++turns;
    }
    const Json motion = simulated(scene_of("coulomb_pendulum"));
    CHECK(of_kind(motion, "slip").size() + 1 == turns);
    CHECK(of_kind(motion, "stick").size() == 1);
    CHECK(coordinate(motion, "theta") == doctest::Approx(side * theta).epsilon(1e-11));
    check_balance(motion);
}

}  // namespace commands_friction
