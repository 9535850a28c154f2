// SPDX-License-Identifier: MIT
// Rows that depend on each other so that each of them is needed at some pose, against the same mechanism with
// independent constraints, and against itself turned by an angle that changes nothing.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <numbers>

#include "alembert/batch/packs.hpp"
#include "alembert/native/compilation.hpp"
#include "analysis/contact/impact.hpp"
#include "codegen/emit/emit.hpp"
#include "codegen/machine/memory_solver.hpp"
#include "redundant_plate.hpp"
#include "scenes.hpp"
#include "simulate/emission.hpp"
#include "simulate/evaluate.hpp"
#include "simulate/inverse.hpp"
#include "simulate/simulate.hpp"

namespace generator_tied {

using namespace alembert;
using std::numbers::pi;

namespace {

const double headings[] = {0,   0.3, pi / 4,     1.5,     pi / 2 - 1e-5, pi / 2 - 1e-8, pi / 2, pi / 2 + 1e-11,
                           2.5, pi,  3 * pi / 2, -pi / 2, -0.1};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

/// The cart of test::redundant_wheels, whose wheels roll by three constraints that are independent at every
/// heading.
std::string cart_in_its_own_axes() {
    std::string text = test::redundant_wheels;
    const std::size_t from = text.find("[[rolling]]"), to = text.find("[[torque]]");
    return text.replace(
        from, to - from,
        "[[constraint]]\nname = \"side\"\nnonholonomic = \"y'*cos(th) - x'*sin(th)\"\n"
        "[[constraint]]\nname = \"left_rolls\"\nnonholonomic = \"x'*cos(th) + y'*sin(th) - h*th' - "
        "r*w1'\"\n"
        "[[constraint]]\nname = \"right_rolls\"\nnonholonomic = \"x'*cos(th) + y'*sin(th) + h*th' "
        "- r*w2'\"\n");
}

/// Rates that let both wheels roll, with a speed of 0.5 m/s and a turn of 0.7 rad/s.
Overrides rolling_at(double th) {
    const double v = 0.5, turn = 0.7, r = 0.1, h = 0.25;
    return {{"x", 0.2},  {"y", -0.4},  {"th", th},    {"x'", v * std::cos(th)},    {"y'", v * std::sin(th)},
            {"w1", 0.1}, {"w2", -0.6}, {"th'", turn}, {"w1'", (v - h * turn) / r}, {"w2'", (v + h * turn) / r}};
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

double value_of(const Evaluation& e, const std::string& multiplier) {
    for (const auto& [name, value] : e.multipliers)
        if (name == multiplier) return value;
    FAIL("no multiplier of this name");
    return 0;
}

/// (λ_x, λ_y) of a rolling condition, along axes that are turned by this angle.
Eigen::Vector2d force(const Evaluation& e, const std::string& rolling, double angle) {
    return Eigen::Rotation2Dd(-angle) *
           Eigen::Vector2d(value_of(e, "lambda_" + rolling + "_x"), value_of(e, "lambda_" + rolling + "_y"));
}

}  // namespace

TEST_CASE("tied: a cart with two wheels accelerates at every heading as with independent constraints") {
    const Scene wheels = parse_scene(test::redundant_wheels, "wheels.toml"),
                own = parse_scene(cart_in_its_own_axes(), "own.toml");
    for (const double th : headings) {
        CAPTURE(th);
        const Overrides at = rolling_at(th);
        const Evaluation a = evaluate(wheels, {.at = at}), b = evaluate(own, {.at = at});
        CHECK(largest_difference(a.accelerations, b.accelerations) < 1e-11);
    }
    // At rest in turning: the values of the scene's own torques, by hand.
    const double v = 0.5;
    for (const double th : headings) {
        CAPTURE(th);
        const Evaluation e = evaluate(wheels, {.at = {{"th", th},
                                                      {"th'", 0},
                                                      {"x'", v * std::cos(th)},
                                                      {"y'", v * std::sin(th)},
                                                      {"w1'", v / 0.1},
                                                      {"w2'", v / 0.1}}});
        // J th'' = h (F2 - F1) and m v' = F1 + F2 with the forces F at the wheels, T - r F = mw r²/2 w''.
        const double mass = 5 + 2 * 0.3, spin = 0.3 * 0.01 / 2, turn = 0.25 + 2 * (0.3 * 0.01 / 4 + 0.3 * 0.0625);
        const double forward = (0.2 + 0.3) / 0.1 / (mass + 2 * spin / 0.01),
                     turning = 0.25 / 0.1 * (0.3 - 0.2) / (turn + 2 * spin * 0.0625 / 0.01);
        CHECK(e.accelerations[2] == doctest::Approx(turning).epsilon(1e-12));
        CHECK(e.accelerations[4] == doctest::Approx((forward + 0.25 * turning) / 0.1).epsilon(1e-12));
    }
}

TEST_CASE("tied: the forces on the wheels turn with the cart, and are the least") {
    const Scene wheels = parse_scene(test::redundant_wheels, "wheels.toml");
    const Evaluation first = evaluate(wheels, {.at = rolling_at(0)});
    for (const double th : headings) {
        CAPTURE(th);
        const Evaluation e = evaluate(wheels, {.at = rolling_at(th)});
        for (const char* rolling : {"rl", "rr"})
            CHECK((force(e, rolling, th) - force(first, rolling, 0)).norm() < 1e-11);
        // Forces along the axle that are opposite change nothing: the least are equal.
        CHECK(force(e, "rl", th)[1] == doctest::Approx(force(e, "rr", th)[1]).epsilon(1e-11));
    }
}

TEST_CASE("tied: compiled code, code in memory and packs of a cart hold at every heading") {
    const Emission e =
        emission(parse_scene(test::redundant_wheels, "wheels.toml"), {.jacobian = true, .batch = true});
    const Scene own = parse_scene(cart_in_its_own_axes(), "own.toml");
    std::vector<Module> modules{load(compile(e.source.text, "wheels", {}).object)};
    if (const auto solver = memory_solver(e.choice.program)) modules.push_back(solver->module);
    int packs = 0;
    for (const Module& module : modules) {
        const std::vector<double> par = prepared(module);
        for (const double th : headings) {
            CAPTURE(th);
            const Evaluation expected = evaluate(own, {.at = rolling_at(th)});
            std::vector<double> state = expected.q, rate(10);
            state.insert(state.end(), expected.rates.begin(), expected.rates.end());
            module.table().rhs(0, state.data(), par.data(), rate.data());
            CHECK(largest_difference({rate.begin() + 5, rate.end()}, expected.accelerations) < 1e-11);
            if (module.pack() == nullptr) continue;
            ++packs;
            std::vector<Lanes> y(10), p(par.size()), rates(10);
            const Lanes t{};
            for (std::size_t i = 0; i < y.size(); ++i)
                for (int lane = 0; lane < lanes; ++lane) y[i][lane] = state[i];
            for (std::size_t i = 0; i < p.size(); ++i)
                for (int lane = 0; lane < lanes; ++lane) p[i][lane] = par[i];
            module.pack()->rhs(reals(&t), reals(y.data()), reals(p.data()), reals(rates.data()));
            std::vector<double> last;
            for (std::size_t i = 5; i < 10; ++i) last.push_back(rates[i][lanes - 1]);
            CHECK(largest_difference(last, expected.accelerations) < 1e-11);
        }
    }
    CHECK(packs > 0);
}

TEST_CASE("tied: a cart that is steered to a heading of 90 degrees drives there as with independent constraints") {
    const auto with_steering = [](const std::string& text) {
        std::string result =
            replaced(text, "[[frame]]", "[definitions]\nu = \"2*(pi/2 - th) - 1.2*th'\"\n[[frame]]");
        result = replaced(result, "[0,\"T1\",0]", "[0,\"0.1 - u\",0]");
        return replaced(result, "[0,\"T2\",0]", "[0,\"0.1 + u\",0]");
    };
    for (const char* method : {"auto", "taylor", "dop853", "radau"}) {
        CAPTURE(method);
        RunOptions wishes{.method = method};
        wishes.duration = 30;
        const Run a = simulate(parse_scene(with_steering(test::redundant_wheels), "wheels.toml"), wishes),
                  b = simulate(parse_scene(with_steering(cart_in_its_own_axes()), "own.toml"), wishes);
        REQUIRE_FALSE(a.failure.has_value());
        CHECK(largest_difference(a.final_coordinates, b.final_coordinates) < 1e-5);
        REQUIRE(a.estimate.has_value());
        CHECK(a.estimate->value.value_or(1) < 1e-5);
    }
}

namespace {

/// A tricycle whose front fork is turned round and round, by rolling wheels or by constraints along its own axes.
std::string tricycle(bool in_own_axes) {
    std::string text = R"toml(
[parameters]
r = 0.1
[coordinates]
x = 0
y = 0
th = 0.3
fork = 0.2
w1 = { rate_guess = 0 }
w2 = { rate_guess = 0 }
w3 = { rate_guess = 0 }
[[frame]]
name = "C"
rotate = [["z", "th"]]
[[frame]]
name = "F"
parent = "C"
rotate = [["z", "fork"]]
[[body]]
name = "cart"
mass = 5
frame = "C"
inertia = [0.1, 0.2, 0.25]
position = ["x", "y", "r"]
)toml";
    struct Wheel {
        const char *number, *frame, *place;
    };
    for (const Wheel& wheel :
         {Wheel{"1", "C", "[0, 0.25, 0]"}, Wheel{"2", "C", "[0, -0.25, 0]"}, Wheel{"3", "F", "[0.4, 0, 0]"}}) {
        text += fmt::format(
            "[[frame]]\nname = \"W{0}\"\nparent = \"{1}\"\nrotate = [[\"y\", \"w{0}\"]]\n"
            "[[body]]\nname = \"b{0}\"\nmass = 0.3\nframe = \"W{0}\"\nfrom = \"cart\"\n"
            "position = {2}\naxes = \"C\"\nshape = {{ disc = \"r\", axis = \"y\" }}\n"
            "inertia = \"from shape\"\n",
            wheel.number, wheel.frame, wheel.place);
        if (!in_own_axes)
            text += fmt::format("[[rolling]]\nname = \"r{0}\"\nbody = \"b{0}\"\ncontact = [0, 0, \"-r\"]\n",
                                wheel.number);
    }
    if (in_own_axes)
        for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{
                 {"side", "y'*cos(th) - x'*sin(th)"},
                 {"left", "x'*cos(th) + y'*sin(th) - 0.25*th' - r*w1'"},
                 {"right", "x'*cos(th) + y'*sin(th) + 0.25*th' - r*w2'"},
                 {"front", "x'*cos(th+fork) + y'*sin(th+fork) + 0.4*th'*sin(fork) - r*w3'"},
                 {"front_side", "y'*cos(th+fork) - x'*sin(th+fork) + 0.4*th'*cos(fork)"}})
            text += fmt::format("[[constraint]]\nname = \"{}\"\nnonholonomic = \"{}\"\n", name, value);
    return text +
           "[[torque]]\non = \"W1\"\nvector = [0, 0.2, 0]\naxes = \"C\"\nreaction = \"C\"\n"
           "[[torque]]\non = \"F\"\nvector = [0, 0, 0.01]\nreaction = \"C\"\n";
}

}  // namespace

// Speeds eliminate the rows by a choice of their own, and a method that solves with all rows is refused.
TEST_CASE("tied: a cart in speeds of its own accelerates alike, and ida says why it does not follow the cart") {
    const std::string speeds = "[speeds]\nv = \"x'*cos(th) + y'*sin(th)\"\nturn = \"th'\"\n";
    const Scene in_speeds = parse_scene(test::redundant_wheels + speeds, "speeds.toml"),
                own = parse_scene(cart_in_its_own_axes(), "own.toml");
    for (const double th : headings) {
        CAPTURE(th);
        const Evaluation a = evaluate(in_speeds, {.at = rolling_at(th)}),
                         b = evaluate(own, {.at = rolling_at(th)});
        CHECK(largest_difference(a.accelerations, b.accelerations) < 1e-9);
    }
    CHECK_THROWS_WITH_AS(simulate(parse_scene(test::redundant_wheels, "wheels.toml"), {.method = "ida"}),
                         doctest::Contains("rows of constraints that depend on each other at some poses"),
                         ModelError);
}

TEST_CASE("tied: a tricycle whose fork turns round moves as with independent constraints") {
    RunOptions wishes;
    wishes.duration = 3;
    const Run a = simulate(parse_scene(tricycle(false), "tricycle.toml"), wishes),
              b = simulate(parse_scene(tricycle(true), "own.toml"), wishes);
    REQUIRE_FALSE(a.failure.has_value());
    CHECK(b.final_coordinates[3] > 10);  // the fork has turned round
    CHECK(largest_difference(a.final_coordinates, b.final_coordinates) < 1e-6);
}

// The rods are alike and the linkage is the same after a turn of 120 degrees about its axis of symmetry, so that
// the first, third and fifth angle stay equal. At the pose in which they turn back four of the five rows have
// rank 3.
TEST_CASE("tied: the angles of Bricard's linkage stay equal where they turn back") {
    const Scene scene = read_scene(test::source_path("scenes/benchmark/bricard.toml"));
    for (const double rate : {0.0, 1.0, -2.0}) {
        CAPTURE(rate);
        const Evaluation e = evaluate(scene, {.at = {{"q1", -pi / 6},
                                                     {"q2", pi / 2},
                                                     {"q3", -pi / 6},
                                                     {"q4", pi / 2},
                                                     {"q5", -pi / 6},
                                                     {"q2'", rate},
                                                     {"q4'", rate}}});
        CHECK(std::abs(e.accelerations[0] - e.accelerations[2]) < 1e-12);
        CHECK(std::abs(e.accelerations[0] - e.accelerations[4]) < 1e-12);
        CHECK(e.accelerations[1] == doctest::Approx(e.accelerations[3]).epsilon(1e-12));
    }
}

TEST_CASE("tied: the forces at the teeth of planets turn with their carrier") {
    const auto scene = parse_scene(R"toml(
[parameters]
rs = 0.05
rp = 0.03
[coordinates]
s = { initial = 0, rate = 0 }
a = { initial = 0.3 }
p1 = { initial = 0 }
p2 = { initial = 0 }
[[frame]]
name = "S"
rotate = [["z", "s"]]
[[frame]]
name = "C"
rotate = [["z", "a"]]
[[frame]]
name = "P1"
rotate = [["z", "p1"]]
[[frame]]
name = "P2"
rotate = [["z", "p2"]]
[[body]]
name = "sun"
mass = 1
inertia = 0.002
frame = "S"
position = [0, 0]
[[body]]
name = "carrier"
mass = 1
inertia = 0.003
frame = "C"
position = [0, 0]
[[body]]
name = "first"
mass = 0.4
inertia = 0.0002
frame = "P1"
position = ["(rs+rp)*cos(a)", "(rs+rp)*sin(a)"]
[[rolling]]
name = "ring1"
body = "first"
contact = ["rp*cos(a)", "rp*sin(a)"]
[[rolling]]
name = "mesh1"
body = "first"
on = "sun"
contact = ["-rp*cos(a)", "-rp*sin(a)"]
[[body]]
name = "second"
mass = 0.4
inertia = 0.0002
frame = "P2"
position = ["-(rs+rp)*sin(a)", "(rs+rp)*cos(a)"]
[[rolling]]
name = "ring2"
body = "second"
contact = ["-rp*sin(a)", "rp*cos(a)"]
[[rolling]]
name = "mesh2"
body = "second"
on = "sun"
contact = ["rp*sin(a)", "-rp*cos(a)"]
[[torque]]
on = "sun"
vector = 1.0
)toml",
                                   "planets.toml");
    const auto at = [&](double a) {
        return evaluate(scene, {.at = {{"a", a}, {"s'", 9.6}, {"a'", 3}, {"p1'", -8}, {"p2'", -8}}});
    };
    const Evaluation first = at(0.3);
    for (const double a : headings) {
        CAPTURE(a);
        const Evaluation e = at(a);
        CHECK(largest_difference(e.accelerations, first.accelerations) < 1e-9);
        for (const char* rolling : {"ring1", "mesh1", "ring2", "mesh2"})
            CHECK((force(e, rolling, a) - force(first, rolling, 0.3)).norm() < 1e-9);
    }
}

namespace {

/// A bar on three supports.
const std::string three_supports = R"toml(
gravity = [0, "-9.81"]
[coordinates]
y = 0
a = 0
[[frame]]
name = "B"
rotate = [["z", "a"]]
[[body]]
name = "bar"
mass = 6
inertia = 0.5
frame = "B"
position = [0, "y"]
)toml";

const std::string three_constraints = three_supports + R"toml(
[[constraint]]
name = "left"
holonomic = "y - sin(a)"
[[constraint]]
name = "middle"
holonomic = "y + 0.2*sin(a)"
[[constraint]]
name = "right"
holonomic = "y + sin(a)"
)toml";

/// Forces at -1, 0.2 and 1 m from the middle that hold this weight with the least sum of squares: those that are
/// linear in the place, F = a + b x with Σ F = weight, Σ F x = 0.
std::vector<double> least_forces(double weight) {
    const double places[] = {-1, 0.2, 1};
    double one = 0, first = 0, second = 0;
    for (const double x : places) one += 1, first += x, second += x * x;
    const double b = -weight * first / (one * second - first * first), a = -b * second / first;
    std::vector<double> forces;
    for (const double x : places) forces.push_back(a + b * x);
    return forces;
}

double by_name(const std::vector<std::pair<std::string, double>>& values, const std::string& name) {
    for (const auto& [known, value] : values)
        if (known == name) return value;
    FAIL("no value of this name");
    return 0;
}

bool is_told(const Evaluation& e, const std::string& words) {
    return std::any_of(e.warnings.begin(), e.warnings.end(),
                       [&](const std::string& text) { return text.find(words) != std::string::npos; });
}

}  // namespace

TEST_CASE("tied: what follows from others bears the least in eval, inverse dynamics and impacts alike") {
    const Scene scene = parse_scene(three_constraints, "supports.toml");
    const std::vector<double> forces = least_forces(6 * 9.81);
    const Evaluation e = evaluate(scene, {});
    const InverseLoads needed = inverse(scene, {});
    const Struck struck =
        impact(parse_scene(three_constraints + "[[impulse]]\nat = \"bar\"\nvector = [0, -2]\n", "struck.toml"));
    REQUIRE(struck.hit.numbers.bilateral.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::string name = std::vector<std::string>{"lambda_left", "lambda_middle", "lambda_right"}[k];
        CAPTURE(name);
        CHECK(by_name(e.multipliers, name) == doctest::Approx(forces[k]).epsilon(1e-12));
        CHECK(by_name(needed.multipliers, name) == doctest::Approx(forces[k]).epsilon(1e-12));
        CHECK(struck.hit.numbers.bilateral[static_cast<Eigen::Index>(k)] ==
              doctest::Approx(forces[k] * 2 / (6 * 9.81)).epsilon(1e-12));
    }
}

TEST_CASE("tied: inverse dynamics finds loads and forces of a cart at every heading") {
    const Scene wheels = parse_scene(test::redundant_wheels, "wheels.toml");
    const auto needed = [&](double th) {
        Overrides at = rolling_at(th);
        at.emplace_back("w1''", 1);
        return inverse(wheels, {.at = at});
    };
    const InverseLoads first = needed(0);
    for (const double th : headings) {
        CAPTURE(th);
        const InverseLoads one = needed(th);
        CHECK(largest_difference(one.loads, first.loads) < 1e-11);
        CHECK(one.accelerations[4] == doctest::Approx(first.accelerations[4]).epsilon(1e-11));
        for (const std::string wheel : {"rl", "rr"}) {
            const double x = by_name(one.multipliers, "lambda_" + wheel + "_x"),
                         y = by_name(one.multipliers, "lambda_" + wheel + "_y");
            CHECK(x * std::cos(th) + y * std::sin(th) ==
                  doctest::Approx(by_name(first.multipliers, "lambda_" + wheel + "_x")).epsilon(1e-11));
        }
    }
}

TEST_CASE("tied: contacts and closed loops whose loads are not determined say so") {
    const auto gap = [](const std::string& name, const std::string& value) {
        return "[[unilateral]]\nname = \"" + name + "\"\ngap = \"" + value + "\"\n";
    };
    const std::string two = three_supports + gap("left", "y - sin(a)") + gap("right", "y + sin(a)");
    CHECK(is_told(evaluate(parse_scene(two + gap("middle", "y + 0.2*sin(a)"), "three.toml"), {}),
                  "how the contacts 'left', 'right', 'middle' share the load is not determined"));
    CHECK_FALSE(is_told(evaluate(parse_scene(two, "two.toml"), {}), "share the load"));
    const std::string door = R"toml(
gravity = [0, 0, "-9.81"]
[[body]]
name = "door"
mass = 20
inertia = [1.5, 2.3, 0.9]
[[joint]]
name = "low"
type = "revolute"
parent = "N"
child = "door"
child_point = [-0.4, 0, -0.8]
coordinates = { q = 0.3 }
)toml",
                      high = R"toml(
[[joint]]
name = "high"
type = "revolute"
parent = "N"
child = "door"
parent_point = [0, 0, 1.6]
child_point = [-0.4, 0, 0.8]
)toml";
    const std::string words = "the loads of joints in closed loops are not determined";
    CHECK(is_told(evaluate(parse_scene(door + high, "door.toml"), {.reactions = true}), words));
    CHECK_FALSE(is_told(evaluate(parse_scene(door, "door.toml"), {.reactions = true}), words));
}

TEST_CASE("tied: a pose at which the constraints lose rank but for rounding is refused") {
    const Scene scene = parse_scene(R"toml(
[parameters]
r = 0.2
d = 0.5
[coordinates]
q1 = 0.5
q2 = { guess = 0.5 }
[[particle]]
name = "A"
mass = 1
position = ["r*cos(q1)", "r*sin(q1)"]
[[particle]]
name = "B"
mass = 2
position = ["d + r*cos(q2)", "r*sin(q2)"]
[[constraint]]
name = "rod"
holonomic = "norm(pos(B) - pos(A))^2 - d^2"
[[force]]
at = "B"
vector = [0, 1]
)toml",
                                    "parallelogram.toml");
    for (const double lying : {0.0, pi, -pi, 3 * pi}) {
        CAPTURE(lying);
        CHECK_THROWS_AS(evaluate(scene, {.at = {{"q1", lying}, {"q2", lying}}}), IntegrationError);
        CHECK_NOTHROW(evaluate(scene, {.at = {{"q1", lying + 1e-6}, {"q2", lying + 1e-6}}}));
    }
}

}  // namespace generator_tied
