// SPDX-License-Identifier: MIT
// Unilateral constraints in motion against closed forms.
#include <functional>

#include "contacts.hpp"

namespace commands_contact {

using namespace alembert::test;

namespace {

double bisected(const std::function<double(double)>& f, double a, double b) {
    const bool rises = f(b) > f(a);
    for (int i = 0; i < 200; ++i) {
        const double middle = (a + b) / 2;
        ((f(middle) > 0) == rises ? b : a) = middle;
    }
    return (a + b) / 2;
}

}  // namespace

// t₁ = √(2h/g); between bounces k and k + 1: 2 t₁ eᵏ; all of them end at t₁ (1 + e)/(1 − e).
TEST_CASE("contact: a ball bounces infinitely often in a finite time, then lies with the reaction m g") {
    const std::string file = temporary("bounce.csv", "");
    const Json motion = simulated(ball(0.5, 3), {"-o", file});
    const double first = std::sqrt(2 / g);
    const std::vector<Json> impacts = of_kind(motion, "impact"), rests = of_kind(motion, "rest");
    CHECK(impacts.size() >= 15);
    double t = first, speed = g * first;
    for (const Json& impact : impacts) {
        CHECK(std::abs(value(impact, "time") - t) < 1e-10);
        CHECK(std::abs(value(impact, "speed_before") + speed) < 1e-10);
        CHECK(std::abs(value(impact, "speed_after") - speed / 2) < 1e-10);
        CHECK(std::abs(value(impact, "energy_loss") - 0.75 * speed * speed) < 1e-9);
        CHECK(std::abs(value(impact, "reaction_impulse") - 3 * speed) < 1e-9);
        t += 2 * first * (speed / 2) / (g * first);
        speed /= 2;
    }
    REQUIRE(rests.size() == 1);
    CHECK(std::abs(value(rests[0], "time") - 3 * first) < 1e-8);
    CHECK(of_kind(motion, "release").empty());
    CHECK(std::abs(coordinate(motion, "y")) < 1e-15);
    CHECK(std::abs(rate(motion, "y")) < 1e-15);
    CHECK(motion["energy_drift"].is_null());
    CHECK(motion["work_balance"].get<double>() < 1e-12);
    CHECK(std::abs(motion["impact_loss"].get<double>() - 2 * g) < 1e-9);

    const auto rows = table_of(file);  // t, y, y', lambda_floor, energy
    std::size_t twice = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (rows[i][0] == rows[i - 1][0]) ++twice;
        if (rows[i][0] < 3 * first - 1e-3) CHECK(rows[i][3] == 0);
        if (rows[i][0] > 3 * first) CHECK(std::abs(rows[i][3] - 2 * g) < 1e-12);
    }
    CHECK(twice == impacts.size());  // a row before and one after
    CHECK(rows.size() == 201 + 2 * twice);
}

TEST_CASE("contact: without loss a ball bounces fifty times and keeps its energy; without restitution it stays") {
    const Json motion = simulated(ball(1, 45.1));
    const std::vector<Json> impacts = of_kind(motion, "impact");
    REQUIRE(impacts.size() == 50);
    for (std::size_t k = 0; k < 50; ++k)
        CHECK(std::abs(value(impacts[k], "time") - (2 * static_cast<double>(k) + 1) * std::sqrt(2 / g)) < 1e-10);
    CHECK(motion["contacts"].size() == 50);
    CHECK(motion["energy_drift"].get<double>() < 1e-10);

    const Json hard = simulated(ball(0, 2));
    REQUIRE(hard["contacts"].size() == 2);
    CHECK(hard["contacts"][0]["event"] == "impact");
    CHECK(hard["contacts"][1]["event"] == "rest");
    CHECK(value(hard["contacts"][1], "time") == value(hard["contacts"][0], "time"));
}

TEST_CASE(
    "contact: a run that begins in contact tells nothing, and one that ends among the bounces is right there") {
    const std::string lying = temporary("lying.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
x = { initial = 0, rate = 1 }
y = 0
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[[unilateral]]
name = "floor"
gap = "y"
restitution = 1
[outputs]
N = "lambda_floor"
[simulation]
duration = 2
)toml");
    const Json motion = simulated(lying);
    CHECK(motion["contacts"].empty());
    CHECK(std::abs(coordinate(motion, "x") - 2) < 1e-12);
    CHECK(coordinate(motion, "y") == 0);
    const Json short_run = simulated(ball(0.5, 3), {"--duration", "1"});  // in the flight after the second bounce
    const double t2 = 2 * std::sqrt(2 / g), v2 = std::sqrt(2 * g) / 4;
    CHECK(std::abs(coordinate(short_run, "y") - (v2 * (1 - t2) - g * (1 - t2) * (1 - t2) / 2)) < 1e-11);
}

// On y = A sin wt the reaction m (g − A w² sin wt) vanishes at sin wt = g/(A w²); then a parabola.
TEST_CASE("contact: a ball on a shaking table lifts off and comes down when the closed forms say") {
    const std::string scene = temporary("table.toml", R"toml(
gravity = [0, -9.81]
[parameters]
A = 0.2
w = 10
[inputs]
s = "A*sin(w*t)"
[coordinates]
y = { initial = 0, rate = "A*w" }
[[particle]]
name = "ball"
mass = 0.7
position = [0, "y"]
[[unilateral]]
name = "table"
gap = "y - s"
restitution = 0.3
[simulation]
duration = 0.6
tolerance = 1e-12
)toml");
    const Json motion = simulated(scene);
    const double release = std::asin(g / 20) / 10;
    const double y0 = 0.2 * std::sin(10 * release), v0 = 2 * std::cos(10 * release);
    const auto height = [&](double t) { return y0 + v0 * (t - release) - g * (t - release) * (t - release) / 2; };
    const double impact = bisected([&](double t) { return height(t) - 0.2 * std::sin(10 * t); }, 0.45, 0.6);
    const double before = v0 - g * (impact - release) - 2 * std::cos(10 * impact);
    REQUIRE(motion["contacts"].size() == 2);
    CHECK(motion["contacts"][0]["event"] == "release");
    CHECK(std::abs(value(motion["contacts"][0], "time") - release) < 1e-10);
    CHECK(std::abs(value(motion["contacts"][1], "time") - impact) < 1e-10);
    CHECK(std::abs(value(motion["contacts"][1], "speed_before") - before) < 1e-9);
    CHECK(std::abs(value(motion["contacts"][1], "speed_after") + 0.3 * before) < 1e-9);
    const double after = 2 * std::cos(10 * impact) - 0.3 * before, left = 0.6 - impact;
    CHECK(std::abs(coordinate(motion, "y") - (0.2 * std::sin(10 * impact) + after * left - g * left * left / 2)) <
          1e-10);
    CHECK(motion["work_balance"].get<double>() < 1e-10);
    CHECK(simulated(scene, {"--duration", "20"})["work_balance"].get<double>() < 1e-9);
}

// Slack where v² = −g l cos θ with v² = v₀² − 2 g l (1 − cos θ): cos θ = (2 − v₀²/(g l))/3, here −1/2. With the
// angle α = π − θ from the top, the parabola meets the circle again after the time 4 v sin α/g.
TEST_CASE(
    "contact: a pendulum on a string goes slack at the angle of the closed form and taut again where its parabola "
    "ends") {
    const Json motion = simulated(source_path("scenes/textbook/slack_pendulum.toml"), {"--tolerance", "1e-12"});
    const double l = 1, v0 = std::sqrt(3.5 * g * l), theta = std::acos((2 - v0 * v0 / (g * l)) / 3);
    double release = 0;  // ∫ l dθ/v, by Simpson's rule
    for (int i = 0; i <= 2000; ++i)
        release += (i == 0 || i == 2000 ? 1
                    : i % 2 == 1        ? 4
                                        : 2) *
                   (theta / 6000) * l / std::sqrt(v0 * v0 - 2 * g * l * (1 - std::cos(theta * i / 2000)));
    const double v = std::sqrt(-g * l * std::cos(theta)), flight = 4 * v * std::sin(theta) / g;
    REQUIRE(motion["contacts"].size() >= 3);
    CHECK(motion["contacts"][0]["event"] == "release");
    CHECK(std::abs(value(motion["contacts"][0], "time") - release) < 1e-9);
    CHECK(motion["contacts"][1]["event"] == "impact");
    CHECK(std::abs(value(motion["contacts"][1], "time") - release - flight) < 1e-9);
    CHECK(motion["contacts"][2]["event"] == "rest");
    const double x = l * std::sin(theta) + v * std::cos(theta) * flight, u = v * std::cos(theta);
    const double y = -l * std::cos(theta) + v * std::sin(theta) * flight - g * flight * flight / 2,
                 w = v * std::sin(theta) - g * flight;
    CHECK(std::abs(value(motion["contacts"][1], "speed_before") + (x * u + y * w) / l) < 1e-8);
    // The tangential speed is kept; then the mass swings with the remaining energy.
    const double along = (-y * u + x * w) / l, x_end = coordinate(motion, "x"), y_end = coordinate(motion, "y");
    CHECK(std::abs(std::hypot(x_end, y_end) - l) < 1e-12);
    const double speed = std::hypot(rate(motion, "x"), rate(motion, "y"));
    CHECK(std::abs(speed * speed - along * along - 2 * g * (y - y_end)) < 1e-8);
    CHECK(motion["work_balance"].get<double>() < 1e-10);
}

// v² = u² + 2 g (1 − c) = g c on the unit circle; from then on the horizontal speed v c is constant.
TEST_CASE("contact: a particle leaves a smooth sphere where the reaction vanishes") {
    const auto scene = [](const std::string& gap) {
        return temporary("sphere.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
x = { initial = 0, rate = 0.01 }
y = 1
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[[unilateral]]
name = "sphere"
gap = ")toml" + gap + R"toml("
[simulation]
duration = 3
tolerance = 1e-12
)toml");
    };
    for (const char* gap : {"x^2 + y^2 - 1", "sqrt(x^2 + y^2) - 1", "1000*(x^2 + y^2 - 1)"}) {
        CAPTURE(gap);
        const Json motion = simulated(scene(gap));
        const double c = (2 + 1e-4 / g) / 3;
        REQUIRE(motion["contacts"].size() == 1);
        CHECK(motion["contacts"][0]["event"] == "release");
        CHECK(std::abs(rate(motion, "x") - c * std::sqrt(g * c)) < 1e-9);
        CHECK(motion["energy_drift"].get<double>() < 1e-12);
    }
}

TEST_CASE("contact: in a corner one contact sticks at once, the other after its bounces, and both last") {
    const Json motion = simulated(temporary("corner.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
x = { initial = 1, rate = -3 }
y = 0.5
[[particle]]
name = "P"
mass = 1
position = ["x", "y"]
[forces]
x = -1
[[unilateral]]
name = "wall"
gap = "x"
[[unilateral]]
name = "floor"
gap = "y"
restitution = 0.4
[simulation]
duration = 3
)toml"));
    const std::vector<Json> wall = of_kind(motion, "rest", "wall"), floor = of_kind(motion, "rest", "floor");
    REQUIRE(wall.size() == 1);
    REQUIRE(floor.size() == 1);
    CHECK(std::abs(value(wall[0], "time") - (std::sqrt(11) - 3)) < 1e-9);
    CHECK(std::abs(value(floor[0], "time") - std::sqrt(1 / g) * 1.4 / 0.6) < 1e-8);
    CHECK(coordinate(motion, "x") == 0);
    CHECK(std::abs(coordinate(motion, "y")) < 1e-15);
}

// A rod of length 1 and mass 1, I = 1/12: for its end, 1/W = 1 + 3 cos² φ; Π = (1 + e) v W, and (1 − e²) v² W/2 is
// lost.
TEST_CASE("contact: a rod falls on a table, end by end, and lies; flat, both ends bounce together") {
    const auto rod = [](const char* phi) {
        return simulated(temporary("rod.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
y = 1
phi = )toml" + std::string(phi) + R"toml(
[[frame]]
name = "B"
rotate = [["z", "phi"]]
[[body]]
name = "rod"
mass = 1
inertia = "1/12"
frame = "B"
position = [0, "y"]
[[unilateral]]
name = "left"
gap = "y - sin(phi)/2"
restitution = 0.5
[[unilateral]]
name = "right"
gap = "y + sin(phi)/2"
restitution = 0.5
[simulation]
duration = 3
tolerance = 1e-11
)toml"));
    };
    const Json tilted = rod("0.6");
    const double v = std::sqrt(2 * g * (1 - std::sin(0.6) / 2)), W = 1 / (1 + 3 * std::cos(0.6) * std::cos(0.6));
    const Json& first = tilted["contacts"][0];
    CHECK(first["name"] == "left");
    CHECK(std::abs(value(first, "time") - v / g) < 1e-11);
    CHECK(std::abs(value(first, "reaction_impulse") - 1.5 * v * W) < 1e-10);
    CHECK(std::abs(value(first, "energy_loss") - 0.375 * v * v * W) < 1e-10);
    CHECK(of_kind(tilted, "rest", "left").size() == 1);
    CHECK(of_kind(tilted, "rest", "right").size() == 1);
    CHECK(std::abs(coordinate(tilted, "y")) + std::abs(coordinate(tilted, "phi")) < 1e-15);
    CHECK(std::abs(tilted["impact_loss"].get<double>() - g) < 1e-9);  // all of the energy
    CHECK(tilted["work_balance"].get<double>() < 1e-10);

    const Json flat = rod("0");
    const std::vector<Json> left = of_kind(flat, "impact", "left"), right = of_kind(flat, "impact", "right");
    REQUIRE(left.size() == right.size());
    for (std::size_t k = 0; k < left.size(); ++k) CHECK(value(left[k], "time") == value(right[k], "time"));
    REQUIRE(of_kind(flat, "rest").size() == 2);
    CHECK(std::abs(value(of_kind(flat, "rest")[0], "time") - 3 * std::sqrt(2 / g)) < 1e-8);
}

}  // namespace commands_contact
