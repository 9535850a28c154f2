// SPDX-License-Identifier: MIT
// Corners in places and constraints, at which velocities would jump; jumps of rates that no sign shows; and what
// motions of `sweep` are watched for. What is right follows from the closed forms written beside the scenes.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "json.hpp"
#include "program.hpp"

namespace commands_corners {

using namespace alembert::test;

namespace {

/// A particle that starts at x = −1 with this speed and goes along a road.
std::string on_road(const std::string& place, const std::string& interpolation,
                    const std::string& gravity = "-9.81", double rate = 3) {
    return temporary("road.toml", fmt::format(R"toml(gravity = [0, {}]
[tables]
h = {{ arguments = ["x"], outside = "line", interpolation = "{}", points = [[-5, 0], [0, 0], [1, 1], [2, 1], [3, 0], [9, 0]] }}
[coordinates]
x = {{ initial = -1, rate = {} }}
[[particle]]
name = "p"
mass = 2
position = ["x", "{}"]
[simulation]
duration = 0.9
tolerance = 1e-11
)toml",
                                              gravity, interpolation, rate, place));
}

bool says(const Run& result, const std::string& text) {
    return result.err.find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("corners: a motion that passes one in a place with speed ends there, with its time") {
    // At x = 0 after 1/3 s: until there the road is level.
    const Run road = run({"simulate", on_road("0.05*h(x)", "linear")});
    CHECK(road.exit == 4);
    CHECK_MESSAGE(says(road, "t = 0.33333333333333"), road.err);
    CHECK(says(road, "corner of h(x)"));
    CHECK(says(road, "cubic"));
    const Run valley = run({"simulate", on_road("abs(x)", "linear")});
    CHECK(valley.exit == 4);
    CHECK_MESSAGE(says(valley, "sign(x)"), valley.err);
    // Without a force nothing in the equations changes there.
    const Run free = run({"simulate", on_road("abs(x)", "linear", "0")});
    CHECK(free.exit == 4);
    CHECK_MESSAGE(says(free, "sign(x)"), free.err);
    for (const char* method : {"rk4", "dop853", "radau"})
        CHECK(run({"simulate", on_road("0.05*h(x)", "linear"), "--method", method, "--step", "0.01"}).exit != 0);
}

TEST_CASE("corners: where slopes go on, or the motion does not come to one, it goes on") {
    for (const char* interpolation : {"cubic", "pchip"})
        CHECK(run({"simulate", on_road("0.05*h(x)", interpolation)}).exit == 0);
    CHECK(run({"simulate", on_road("x*abs(x)", "linear")}).exit == 0);
    CHECK(run({"simulate", on_road("0.05*h(x)", "linear"), "--duration", "0.3"}).exit == 0);
    // A force may have corners and jump.
    CHECK(run({"simulate", temporary("force.toml", R"toml([coordinates]
x = { initial = -1, rate = 3 }
[[particle]]
name = "p"
mass = 2
position = ["x", 0]
[energy]
potential = "abs(x)"
[simulation]
duration = 0.9
)toml")})
              .exit == 0);
}

TEST_CASE("corners: of constraints and of kinetic energies they are the same") {
    const auto constrained = [](const std::string& height) {
        return temporary("wire.toml", fmt::format(R"toml(gravity = [0, -9.81]
[coordinates]
x = {{ initial = -1, rate = 3 }}
y = {{ guess = 1, rate_guess = -3 }}
[[particle]]
name = "p"
mass = 2
position = ["x", "y"]
[[constraint]]
name = "wire"
holonomic = "y = {}"
[simulation]
duration = 0.9
)toml",
                                                  height));
    };
    const Run corner = run({"simulate", constrained("abs(x)")});
    CHECK(corner.exit == 4);
    CHECK_MESSAGE(says(corner, "corner"), corner.err);
    CHECK(run({"simulate", constrained("x*abs(x) + 2")}).exit == 0);
    const Run energy = run({"simulate", temporary("inertia.toml", R"toml([coordinates]
x = { initial = -1, rate = 3 }
[energy]
kinetic = "(3 + sign(x))*x'^2/2"
[simulation]
duration = 0.9
)toml")});
    CHECK(energy.exit == 4);
    CHECK_MESSAGE(says(energy, "velocities would jump"), energy.err);
}

// The follower of a cam without inertia of its own: its weight is in the energy.
TEST_CASE("corners: what has no mass passes them") {
    const auto cam = [](const std::string& mass) {
        return temporary("cam.toml", fmt::format(R"toml([parameters]
none = 0
[tables]
lift = {{ arguments = ["angle"], period = 6, points = [[0, 0], [2, 0.03], [3, 0.03], [5, 0]] }}
[coordinates]
phi = {{ initial = 0.3, rate = 2 }}
[[frame]]
name = "C"
rotate = [["z", "phi"]]
[[body]]
name = "cam"
mass = 1
inertia = 0.05
frame = "C"
position = [0, 0]
[[particle]]
name = "follower"
mass = "{}"
position = [0, "lift(phi)"]
[energy]
potential = "2*lift(phi)"
[simulation]
duration = 2
tolerance = 1e-11
)toml",
                                                 mass));
    };
    for (const char* const mass : {"0", "none"}) {
        CAPTURE(mass);
        const Json end = simulated(cam(mass))["final"];
        // Two thirds of a turn of the cam later, J phi'^2/2 + 2 lift is what it was.
        const double phi = number(end, "coordinates", "phi"), rate = number(end, "rates", "phi");
        REQUIRE(phi > 3);
        const double lift = phi < 5 ? 0.03 * (5 - phi) / 2 : 0;
        CHECK(std::abs(0.025 * rate * rate + 2 * lift - (0.1 + 2 * 0.0045)) < 1e-10);
    }
    CHECK(says(run({"simulate", cam("1e-6")}), "passes a corner"));
    CHECK(!says(run({"emit", cam("0"), "-o", temporary("cam_code", "")}), "corner"));
}

TEST_CASE("corners: a place may have a table of a state and of an input") {
    const auto scene = [](const char* height) {
        return temporary("moved.toml", fmt::format(R"toml([tables]
h = {{ arguments = ["x"], outside = "line", points = [[-5, 0], [0.5, 0], [1, 1], [9, 9]] }}
[inputs]
F = "sin(t)"
[coordinates]
x = {{ initial = -1, rate = 3 }}
[states]
z = {{ rate = "1 - z", initial = 0.2 }}
[[particle]]
name = "p"
mass = 1
position = ["x + z + F", "{}"]
[simulation]
duration = 0.9
)toml",
                                                   height));
    };
    // z = 1 − 0.8 exp(−t) is 1/2 at t = log 1.6.
    const Run passed = run({"simulate", scene("h(z)")});
    CHECK(passed.exit == 4);
    CHECK_MESSAGE(says(passed, fmt::format("t = {:.9}", std::log(1.6))), passed.err);
    CHECK(run({"simulate", scene("h(z)"), "--duration", "0.4"}).exit == 0);
    CHECK(run({"simulate", scene("h(F - 1)")}).exit == 0);
}

TEST_CASE("corners: motions of a sweep end at them, and what is emitted is told") {
    const std::string scene = on_road("0.05*h(x)", "linear");
    const Run swept = run({"sweep", scene, "--vary", "x'=-1:3:3", "--json"});
    const Json found = Json::parse(swept.out);
    CHECK_MESSAGE(found["failed"] == 1, swept.out);  // x' = −1 and 1 do not come to x = 0 in 0.9 s
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"emit", scene, "-o", temporary("road_code", "")},
          {"emit", scene, "--fmu", temporary("road.fmu", "")}}) {
        const Run written = run(words);
        CHECK_MESSAGE(says(written, "corner of h(x)"), written.err);
    }
}

TEST_CASE("sweep: masses that become negative and pulses of long tables are in the status of a motion") {
    const Run burnt = run({"sweep", temporary("burnt.toml", R"toml(
[parameters]
c = 1
[coordinates]
h = 0
[[particle]]
name = "rocket"
mass = "2 - t"
position = [0, "h"]
leaves = [0, "t*c"]
[simulation]
duration = 5
)toml"),
                           "--vary", "c=0:0:1", "--json"});
    CHECK_MESSAGE(Json::parse(burnt.out)["failed"] == 1, burnt.out);
    std::string points;  // 81 knots, and a pulse of area 1 between two of them
    for (int k = 0; k <= 80; ++k) {
        points += fmt::format("[{}, {}], ", k, k % 2 == 0 ? 1e-3 : 0);
        if (k == 40) points += "[40.4, 0], [40.4001, 10000], [40.4002, 0], ";
    }
    const std::string pulse = temporary("pulse.toml", fmt::format(R"toml([coordinates]
x = {{ initial = 1, rate = 10 }}
[tables]
f = {{ arguments = ["x"], outside = "hold", points = [{}] }}
[[particle]]
name = "p"
mass = 1
position = ["x", 0]
[forces]
x = "f(x)"
[simulation]
duration = 6
)toml",
                                                                  points));
    const Json motions = Json::parse(run({"sweep", pulse, "--vary", "x'=10:10:1", "--json"}).out);
    const Json alone = Json::parse(run({"simulate", pulse, "--json"}).out);
    const double right = std::sqrt(100 + 2 + 2 * (60.0 - 1) * 0.5e-3);
    const bool is_right = std::abs(number(alone["final"], "rates", "x") - right) < 1e-3;
    CHECK((is_right || alone["error_estimate"]["trustworthy"] == false));
    if (!is_right) CHECK_MESSAGE(motions["failed"] == 1, motions.dump());
}

TEST_CASE("jumps: derivatives are refused where a motion passes the cut of atan2 or the pole in atan(1/x)") {
    const auto asked = [](const std::string& force, double start, const std::vector<std::string>& words) {
        const std::string scene = temporary("cut.toml", fmt::format(R"toml([parameters]
a = 1
T = 1
[coordinates]
x = {{ initial = {}, rate = 1 }}
[[particle]]
name = "p"
mass = 1
position = ["x", 0]
[forces]
x = "{}"
[simulation]
duration = 2
)toml",
                                                                    start, force));
        std::vector<std::string> all{words[0], scene};
        all.insert(all.end(), words.begin() + 1, words.end());
        const Run result = run(all);
        INFO(result.err);
        CHECK((result.exit == 0 || says(result, "jump")));
        return result.exit != 0;
    };
    const std::vector<std::string> sensitivity{"simulate", "--sensitivity", "a"},
        exponents{"stability", "--exponents", "1", "--duration", "2"},
        along{"stability", "--matrices", "--along", "--duration", "2"};
    for (const auto& ask : {sensitivity, exponents, along}) {
        CAPTURE(ask[1]);
        CHECK(asked("a*sign(x)", -1, ask) == (ask[0] != "simulate" && ask[1] != "--exponents"));
        CHECK(asked("a*atan2(x, -1)/10", -1, ask));
        CHECK(asked("a*atan(1/x)/10", -1, ask));
        CHECK(asked("a*tanh(1/x)/10", -1, ask));
        CHECK_FALSE(asked("a*atan2(x, -1)/10", 1, ask));
        CHECK_FALSE(asked("a*atan(1/x)/10", 1, ask));
        CHECK_FALSE(asked("a*atan2(x, 1)/10", -1, ask));
        CHECK_FALSE(asked("a*sin(atan2(x, -1))/10", -1, ask));
        CHECK_FALSE(asked("a*atan(1/x^2)/10", -1, ask));
    }
    // The time of the jump is moved by T alone.
    CHECK_FALSE(asked("a*sign(t - T)", -1, sensitivity));
    CHECK_FALSE(asked("a*sign(t - T)", -1, {"simulate", "--sensitivity", "a,T"}));
}

// x'' = a sign(t − 1): x'(2) = x'(0), x(1) = x(0) + x'(0) − a/2, x(2) = x(1) + (x'(0) − a) + a/2.
TEST_CASE("jumps: a jump at a time that is fixed leaves derivatives by other names as they are") {
    const Json found = json_of({"simulate", temporary("timed.toml", R"toml([parameters]
a = 1
T = 1
[coordinates]
x = { initial = -1, rate = 1 }
[[particle]]
name = "p"
mass = 1
position = ["x", 0]
[forces]
x = "a*sign(t - T)"
[simulation]
duration = 2
)toml"),
                                "--sensitivity", "a", "--json"});
    CHECK(std::abs(found["sensitivity"]["values"][0][0].get<double>() + 1) < 1e-8);
    CHECK(std::abs(found["sensitivity"]["values"][1][0].get<double>()) < 1e-8);
}

namespace {

/// A ball that an event throws back, with a state that counts and one that decays, and a guard that moves with
/// all.
std::string thrown(const std::map<std::string, double>& v) {
    return temporary("thrown.toml", fmt::format(R"toml(gravity = [0, "-g"]
[parameters]
g = {}
e = {}
w = {}
[coordinates]
x = {{ initial = 0, rate = {} }}
y = {{ initial = {}, rate = 0 }}
[states]
z = {{ rate = "-z/2 + y*w", initial = 0.4 }}
n = {{}}
[[particle]]
name = "ball"
mass = 1
position = ["x", "y"]
[forces]
x = "-0.3*x' + n*z"
y = "-0.1*y'*abs(y') + 0.2*n*x'"
[[event]]
name = "floor"
when = "y - w*x^2 - 0.1*z"
direction = "down"
set = {{ n = "n + 1", z = "z/2 + w*x + y'^2/50" }}
rates = {{ y = "-e*y' + 0.1*z", x = "0.9*x' + w*t" }}
[simulation]
duration = 1.6
tolerance = 1e-13
)toml",
                                                v.at("g"), v.at("e"), v.at("w"), v.at("x'"), v.at("y")));
}

std::vector<double> end_of(const std::map<std::string, double>& v) {
    const Json found = json_of({"simulate", thrown(v), "--no-estimate", "--json"});
    CHECK(found["events"].size() == 3);
    const Json& end = found["final"];
    return {number(end, "coordinates", "x"), number(end, "coordinates", "y"), number(end, "rates", "x"),
            number(end, "rates", "y"),       number(end, "states", "z"),      number(end, "states", "n")};
}

}  // namespace

TEST_CASE("sensitivity: derivatives through events that set states and rates are those of differences") {
    const std::map<std::string, double> v{{"g", 9.81}, {"e", 0.7}, {"w", 0.05}, {"x'", 1.1}, {"y", 1.3}};
    std::string names;
    for (const auto& [name, value] : v) names += (names.empty() ? "" : ",") + name;
    const Json found = json_of({"simulate", thrown(v), "--sensitivity", names, "--json"})["sensitivity"];
    const std::vector<std::string> of = found["of"], by = found["by"];
    CHECK(of == std::vector<std::string>{"x", "y", "x'", "y'", "z", "n"});
    for (std::size_t c = 0; c < by.size(); ++c) {
        CAPTURE(by[c]);
        std::map<std::string, double> more = v, less = v;
        const double step = 1e-5;
        more[by[c]] += step;
        less[by[c]] -= step;
        const std::vector<double> a = end_of(more), b = end_of(less);
        for (std::size_t i = 0; i < of.size(); ++i) {
            CAPTURE(of[i]);
            const double slope = (a[i] - b[i]) / (2 * step), told = found["values"][i][c];
            CHECK(std::abs(told - slope) < 2e-7 * std::max(1.0, std::abs(slope)));
        }
    }
}

// A ball that falls from h and is thrown back with e times its speed: with T for the time of the fall, √(2 h/g),
// y(t) = e g T (t − T) − g (t − T)²/2.
TEST_CASE("sensitivity: of a bounce the derivatives are those of the closed form; grazing and ends are refused") {
    const auto scene = [](double duration, const std::string& when, const std::string& more = "") {
        return temporary("bounce.toml", fmt::format(R"toml(gravity = [0, "-g"]
[parameters]
g = 9.81
e = 0.8
[coordinates]
y = {{ initial = 1.2 }}
[[particle]]
name = "ball"
mass = 1
position = [0, "y"]
[[event]]
name = "floor"
when = "{}"
rates = {{ y = "-e*y'" }}
{}
[simulation]
duration = {}
tolerance = 1e-12
)toml",
                                                    when, more, duration));
    };
    const double g = 9.81, e = 0.8, h = 1.2, fall = std::sqrt(2 * h / g), end = 0.8, d = end - fall;
    const Json found = json_of({"simulate", scene(end, "y"), "--sensitivity", "y,e,g", "--json"})["sensitivity"];
    const auto value = [&](std::size_t i, std::size_t c) { return found["values"][i][c].get<double>(); };
    const double by_h = fall / (2 * h), by_g = -fall / (2 * g);  // of the time of the fall
    const auto place = [&](double later) { return e * g * (d - fall) * later + g * d * later; };
    CHECK(std::abs(value(0, 0) - place(by_h)) < 1e-9);
    CHECK(std::abs(value(0, 1) - g * fall * d) < 1e-9);
    CHECK(std::abs(value(0, 2) - (e * fall * d - d * d / 2 + place(by_g))) < 1e-9);
    CHECK(std::abs(value(1, 0) - (e * g + g) * by_h) < 1e-9);
    CHECK(std::abs(value(1, 1) - g * fall) < 1e-9);
    CHECK(std::abs(value(1, 2) - (e * fall - d + (e * g + g) * by_g)) < 1e-9);

    const auto refused = [](const std::string& file, const std::string& why) {
        const Run result = run({"simulate", file, "--sensitivity", "e"});
        CHECK(result.exit != 0);
        CHECK_MESSAGE(says(result, why), result.err);
    };
    const std::string second = "[[event]]\nname = \"other\"\nwhen = \"2*y\"\nrates = { y = \"-e*y'\" }\n";
    refused(scene(end, "y", second), "one instant");
    const std::string pushed =
        "[[event]]\nname = \"other\"\nwhen = \"y - 1\"\nimpulses = { y = 1 }\nrates = { y = \"2*y'\" }\n";
    refused(scene(end, "y", pushed), "impulse");
}

}  // namespace commands_corners
