// SPDX-License-Identifier: MIT
// `[[event]]` with impulses and a direction: kicks, compared with closed forms and with other coordinates for the
// same system.
#include "contacts.hpp"
#include "tools.hpp"

namespace commands_kicks {

using namespace alembert::test;

namespace {

/// x'' + 2 a x' + 4 x = 0 from rest at x = 0.2, m = 1, kicked forward by P wherever it passes zero.
const char* const escapement = R"toml(
[parameters]
P = 0.3
a = 1
[coordinates]
x = 0.2
[energy]
kinetic = "x'^2/2"
potential = "2*x^2"
[forces]
x = "-2*a*x'"
[[event]]
name = "tick"
when = "x"
impulses = { x = "P*sign(x')" }
[[event]]
name = "turn"
when = "x'"
[simulation]
duration = 40
tolerance = 1e-14
)toml";

/// A mass of 2 falls from 2 and is thrown back at the height h, with e times its speed.
std::string batted(double e, double h, double duration) {
    return temporary("batted.toml", fmt::format(R"toml(
gravity = [0, -9.81]
[coordinates]
y = 2
[[particle]]
name = "B"
mass = 2
position = [0, "y"]
[[event]]
name = "mark"
when = "y - {1}"
[[event]]
name = "bat"
when = "y - {1}"
direction = "down"
impulses = {{ y = "-(1 + {0})*2*y'" }}
[[event]]
name = "rising"
when = "y - {1}"
direction = "up"
[simulation]
duration = {2}
tolerance = 1e-12
)toml",
                                                e, h, duration));
}

std::vector<Json> named(const Json& motion, const std::string& name) {
    std::vector<Json> result;
    for (const Json& event : motion["events"])
        if (event["name"] == name) result.push_back(event);
    return result;
}

}  // namespace

// Half a period lasts π/ω and reduces the speed by the factor d = exp(−aπ/ω), ω² = 4 − a²; so v⁻ → d (v⁻ + P), and
// after the kick P/(1 − d) in the limit.
TEST_CASE(
    "kicks: the escapement of a linear oscillator has the times, the energies and the limit cycle of its closed "
    "form") {
    const double a = 1, P = 0.3, omega = std::sqrt(4 - a * a), d = std::exp(-a * M_PI / omega);
    const double first = (M_PI - std::atan(omega / a)) / omega, rise = std::atan(omega / a) / omega;
    const double speed = P / (1 - d), amplitude = speed * std::exp(-a * rise) * std::sin(omega * rise) / omega;
    const std::string scene = temporary("escapement.toml", escapement);
    for (const std::vector<std::string>& method : {std::vector<std::string>{},
                                                   {"--method", "taylor"},
                                                   {"--method", "radau"},
                                                   {"--method", "gauss", "--step", "0.02"}}) {
        std::vector<std::string> more = {"--no-estimate", "--duration",
                                         fmt::format("{:.17g}", first + 20 * M_PI / omega + rise)};
        more.insert(more.end(), method.begin(), method.end());
        const Json motion = simulated(scene, more);
        INFO(motion["method"]);
        const double allowed = motion["method"] == "gauss" ? 1e-9 : 1e-12;  // gauss: fourth order, 0.02 a step
        const std::vector<Json> ticks = named(motion, "tick"), turns = named(motion, "turn");
        REQUIRE(ticks.size() == 21);
        REQUIRE(turns.size() >= 20);
        double before = 0.2 * 4 / omega * std::exp(-a * first) * std::sin(omega * first);
        for (std::size_t k = 0; k < ticks.size(); ++k) {
            const double time = first + static_cast<double>(k) * M_PI / omega;
            CHECK(std::abs(value(ticks[k], "time") - time) < allowed * time);
            CHECK(std::abs(value(ticks[k], "energy_gain") - P * (before + P / 2)) < allowed);
            CHECK(ticks[k]["impulses"]["x"].get<double>() == (k % 2 == 0 ? -P : P));
            if (k < 20) CHECK(std::abs(value(turns[k], "time") - time - rise) < 20 * allowed);
            before = d * (before + P);
        }
        CHECK(std::abs(before / d - speed) < 1e-12);
        CHECK(std::abs(std::abs(coordinate(motion, "x")) - amplitude) < allowed);
        CHECK(motion["work_balance"].get<double>() < 1e-9);
    }
}

// With the amplitude A = θ'/ω = 0.05 the period of the pendulum is longer by the part A²/16, so that the limit of
// small amplitudes is reached to about 2e-4.
TEST_CASE("kicks: the clock of the gallery approaches the amplitude of its formula from below and from above") {
    const double m = 1, l = 0.994, c = 0.062, P = 0.0048,
                 d = std::exp(-M_PI * c / std::sqrt(4 * m * m * g * l * l * l - c * c));
    for (const char* start : {"0.02", "0.08"}) {
        std::ifstream file(source_path("scenes/gallery/clock.toml"));
        std::string text(std::istreambuf_iterator<char>(file), {});
        text.replace(text.find("initial = 0.02"), 14, std::string("initial = ") + start);
        const Json motion = simulated(temporary("clock.toml", text), {"--no-estimate", "--duration", "400"});
        const double after = P / (m * l * l * (1 - d)), gain = P * (after - P / (m * l * l) / 2);
        CHECK(std::abs(value(motion["events"].back(), "energy_gain") / gain - 1) < 3e-4);
        CHECK((value(motion["events"][0], "energy_gain") < gain) == (start == std::string("0.02")));
    }
}

// From 2 to 1 in √(2/g); then flights of 2 eᵏ v/g, v² = 2g.
TEST_CASE(
    "kicks: a body thrown back at a height has the flights of free fall by every method, and direction tells the "
    "zeros that count") {
    const double e = 0.8, v = std::sqrt(2 * g);
    const std::string scene = batted(e, 1, 2.5);
    for (const std::string method :
         {"dopri5", "dop853", "verner76", "verner98", "rkn86", "rkn1210", "taylor", "abm", "bdf", "radau", "rk4",
          "gauss", "rattle", "rattle8", "verlet", "kahanli8"}) {
        std::vector<std::string> more = {"--no-estimate", "--method", method};
        const bool fixed = method[0] == 'k' || method[0] == 'g' || method == "rk4" || method.starts_with("rat") ||
                           method == "verlet";
        if (fixed) more.insert(more.end(), {"--step", "0.01"});
        const Json motion = simulated(scene, more);
        INFO(method);
        const std::vector<Json> bats = named(motion, "bat"), marks = named(motion, "mark");
        REQUIRE(bats.size() == 4);
        REQUIRE(marks.size() == 4);  // the zero at the kick counts once
        CHECK(named(motion, "rising").empty());
        CHECK(motion["events"][0]["name"] == "mark");
        CHECK(motion["events"][1]["name"] == "bat");
        double time = std::sqrt(2 / g), speed = v;
        const double allowed = method == "bdf" || method == "verlet"
                                   ? 1e-9
                                   : 2e-12;  // bdf: to its tolerance; verlet: its dense output is cubic
        for (std::size_t k = 0; k < bats.size(); ++k) {
            CHECK(std::abs(value(bats[k], "time") - time) < allowed);
            CHECK(std::abs(value(marks[k], "time") - time) < allowed);
            CHECK(std::abs(value(bats[k], "energy_gain") + (1 - e * e) * speed * speed) < 100 * allowed);
            speed *= e;
            time += 2 * speed / g;
        }
        const double left = 2.5 - (time - 2 * speed / g);
        CHECK(std::abs(coordinate(motion, "y") - 1 - speed * left + g * left * left / 2) < 10 * allowed);
    }
}

TEST_CASE("kicks: where rates jump, the table has two rows, and the scene's speeds jump too") {
    const std::string csv = temporary("batted.csv", "");
    const Json motion = simulated(batted(0.5, 1, 1), {"--no-estimate", "-o", csv});
    const double time = named(motion, "bat")[0]["time"];
    int rows = 0;
    double before = 0, after = 0;
    for (const std::vector<double>& row : table_of(csv))
        if (row[0] == time) (rows++ == 0 ? before : after) = row[2];
    CHECK(rows == 2);
    CHECK(std::abs(before + std::sqrt(2 * g)) < 1e-11);
    CHECK(std::abs(after + before / 2) < 1e-11);
}

// One pendulum: its angle; the speed w = 3 θ' + θ/10; Cartesian coordinates on a rod, where an impulse P along θ
// is P ∂r/∂θ.
TEST_CASE(
    "kicks: a pendulum is kicked alike in its angle, in a generalized speed and in coordinates with a "
    "constraint") {
    const std::string angle = R"toml(
gravity = [0, -9.81]
[coordinates]
theta = 0.3
[[particle]]
name = "B"
mass = 1
position = ["sin(theta)", "-cos(theta)"]
[forces]
theta = "-0.2*theta'"
[[event]]
name = "tick"
when = "theta"
impulses = { theta = "0.4*sign(theta')" }
[simulation]
duration = 20
tolerance = 1e-13
)toml";
    const Json one = simulated(temporary("angle.toml", angle));
    const Json speed = simulated(temporary("speed.toml", angle + "[speeds]\nw = \"3*theta' + theta/10\"\n"));
    const Json rod = simulated(temporary("rod.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
x = "sin(0.3)"
y = "-cos(0.3)"
[[particle]]
name = "B"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "rod"
holonomic = "x^2 + y^2 = 1"
[forces]
x = "-0.2*x'"
y = "-0.2*y'"
[[event]]
name = "tick"
when = "x"
impulses = { x = "-0.4*y*sign(x')", y = "0.4*x*sign(x')" }
[simulation]
duration = 20
tolerance = 1e-13
)toml"));
    REQUIRE(one["events"].size() > 15);
    for (const Json* other : {&speed, &rod}) {
        REQUIRE((*other)["events"].size() == one["events"].size());
        for (std::size_t k = 0; k < one["events"].size(); ++k) {
            CHECK(std::abs(value(one["events"][k], "time") - value((*other)["events"][k], "time")) < 1e-11);
            CHECK(std::abs(value(one["events"][k], "energy_gain") - value((*other)["events"][k], "energy_gain")) <
                  1e-11);
        }
        CHECK((*other)["work_balance"].get<double>() < 1e-12);
    }
    CHECK(std::abs(coordinate(one, "theta") - coordinate(speed, "theta")) < 1e-11);
    CHECK(std::abs(speed["final"]["speeds"]["w"].get<double>() - 3 * rate(one, "theta") -
                   coordinate(one, "theta") / 10) < 1e-10);
    CHECK(std::abs(std::sin(coordinate(one, "theta")) - coordinate(rod, "x")) < 1e-11);
    CHECK(rod["constraint_drift"].get<double>() < 1e-13);
}

// With v along the blade and w = φ', T = (m v² + (J + m a²) w²)/2, here (v² + 1.25 w²)/2, which is conserved
// between kicks.
TEST_CASE(
    "kicks: a blade that does not slip takes up what pushes across it, in rates with a multiplier and in speeds "
    "without") {
    const std::string sleigh = R"toml(
[coordinates]
x = {0}
y = 0
phi = {1}
[[frame]]
name = "S"
rotate = [["z", "phi"]]
[[point]]
name = "B"
offset = ["x", "y"]
[[body]]
name = "sleigh"
mass = 1
inertia = 1
frame = "S"
from = "B"
position = [0.5, 0]
axes = "S"
[[constraint]]
name = "blade"
nonholonomic = "dot(vel(B), ey(S))"
[[event]]
name = "slow"
when = "phi' - 0.3"
direction = "down"
impulses = {{ phi = 1.5, x = "-0.2*cos(phi) + 3*sin(phi)", y = "-0.2*sin(phi) - 3*cos(phi)" }}
[simulation]
duration = 10
tolerance = 1e-12
)toml";
    const Json rates =
        simulated(temporary("sleigh.toml", fmt::format(fmt::runtime(sleigh), "{ initial = 0, rate = 0.5 }",
                                                       "{ initial = 0, rate = 2 }")));
    const Json speeds = simulated(temporary(
        "sleigh_speeds.toml", fmt::format(fmt::runtime(sleigh), "0", "0") +
                                  "[speeds]\nv = { form = \"x'*cos(phi) + y'*sin(phi)\", initial = 0.5 }\n"
                                  "w = { form = \"phi'\", initial = 2 }\n"));
    REQUIRE(rates["events"].size() == 6);
    REQUIRE(speeds["events"].size() == 6);
    double v = 0.5, w = 2;
    for (std::size_t k = 0; k < 6; ++k) {
        v = std::sqrt(v * v + 1.25 * (w * w - 0.09));
        const double gain = -0.2 * (v - 0.1) + 1.5 * 0.9;
        for (const Json* motion : {&rates, &speeds})
            CHECK(std::abs(value((*motion)["events"][k], "energy_gain") - gain) < 1e-10);
        CHECK(std::abs(value(rates["events"][k], "time") - value(speeds["events"][k], "time")) < 1e-10);
        v -= 0.2;
        w = 0.3 + 1.5 / 1.25;
    }
    CHECK(std::abs(coordinate(rates, "x") - coordinate(speeds, "x")) < 1e-10);
    CHECK(rates["work_balance"].get<double>() < 1e-11);
    CHECK(speeds["work_balance"].get<double>() < 1e-11);
}

// a and b touch. The impulses act together: 3 on a, 1 on b, −2 on c. A contact at rest does not rebound, so a and
// b go on with 4/3.
TEST_CASE(
    "kicks: all that is zero at one instant is told in the scene's order, acts as one impact with the closed "
    "contacts, and then stops") {
    const Json motion = simulated(temporary("together.toml", R"toml(
[coordinates]
a = 0
b = 0
c = 5
[energy]
kinetic = "(a'^2 + 2*b'^2 + c'^2)/2"
[[unilateral]]
name = "ab"
gap = "b - a"
restitution = 1
[[event]]
name = "one"
when = "t - 1"
impulses = { a = 3 }
[[event]]
name = "two"
when = "exp(t) - exp(1)"
impulses = { c = -2, b = 1 }
stop = true
[[event]]
name = "mark"
when = "sin(t) - sin(1)"
[[event]]
name = "end"
when = "t^2 - 1"
stop = true
[[event]]
name = "later"
when = "t - 1.000001"
[simulation]
duration = 20
)toml"),
                                  {"--no-estimate"});
    const std::vector<std::string> expected = {"one", "two", "mark", "end"};
    REQUIRE(motion["events"].size() == expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        CHECK(motion["events"][k]["name"] == expected[k]);
        CHECK(std::abs(value(motion["events"][k], "time") - 1) < 1e-12);
    }
    CHECK(std::abs(motion["final"]["time"].get<double>() - 1) < 1e-12);
    for (const char* q : {"a", "b"}) CHECK(std::abs(rate(motion, q) - 4.0 / 3) < 1e-14);
    CHECK(std::abs(rate(motion, "c") + 2) < 1e-14);
    CHECK(std::abs(value(motion["events"][0], "energy_gain") - 2) < 1e-14);
    CHECK(std::abs(value(motion["events"][1], "energy_gain") - 8.0 / 3) < 1e-14);
}

TEST_CASE(
    "kicks: a body that lies is lifted by an impulse, not pressed through the floor, and bounces as it falls "
    "back") {
    const Json motion = simulated(temporary("hop.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
y = 0
[[particle]]
name = "B"
mass = 2
position = [0, "y"]
[[unilateral]]
name = "floor"
gap = "y"
restitution = 0.5
[[event]]
name = "press"
when = "t - 0.5"
impulses = { y = -6 }
[[event]]
name = "lift"
when = "t - 1"
impulses = { y = 6 }
[[event]]
name = "down"
when = "y"
direction = "down"
[simulation]
duration = 3
tolerance = 1e-12
)toml"));
    CHECK(named(motion, "press")[0]["energy_gain"] == 0);
    CHECK(std::abs(value(named(motion, "lift")[0], "energy_gain") - 9) < 1e-13);
    const std::vector<Json> falls = named(motion, "down");
    REQUIRE(falls.size() > 3);
    for (int k = 0; k < 3; ++k)
        CHECK(std::abs(value(falls[static_cast<std::size_t>(k)], "time") - 1 - 6 / g * (2 - std::ldexp(1, -k))) <
              1e-11);
    CHECK(std::abs(motion["impact_loss"].get<double>() - 9) < 1e-10);
    CHECK(coordinate(motion, "y") < 1e-12);
    CHECK(motion["work_balance"].get<double>() < 1e-11);
}

TEST_CASE(
    "kicks: an event whose value the closed contact keeps at zero is silent, and a stiff companion changes "
    "nothing") {
    const Json motion = simulated(temporary("wavy.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
x = { initial = 0, rate = 0.3 }
y = 1
[[particle]]
name = "B"
mass = 2
position = ["x", "y"]
[[unilateral]]
name = "floor"
gap = "y - 0.1*sin(x)"
restitution = 0.5
[[event]]
name = "land"
when = "y - sin(x)/10"
impulses = { y = 0 }
[simulation]
duration = 5
)toml"),
                                  {"--no-estimate"});
    const double rest = value(of_kind(motion, "rest").back(), "time");
    CHECK(motion["events"].size() == of_kind(motion, "impact").size());
    CHECK(value(motion["events"].back(), "time") < rest);
    CHECK(motion["final"]["time"] == 5);

    const auto oscillator = [](const std::string& coordinate, const std::string& kinetic,
                               const std::string& force) {
        return simulated(
            temporary("companion.toml",
                      "[coordinates]\nx = 0.2\n" + coordinate + "[energy]\nkinetic = \"x'^2/2" + kinetic +
                          "\"\npotential = \"2*x^2\"\n[forces]\nx = \"-0.2*x'\"\n" + force +
                          "[[event]]\nname = \"tick\"\nwhen = \"x\"\nimpulses = { x = \"0.3*sign(x')\" }\n"
                          "[simulation]\nduration = 20\ntolerance = 1e-10\n"),
            {"--no-estimate"});
    };
    const Json alone = oscillator("", "", ""),
               stiff = oscillator("z = 0.2\n", " + z'^2/2", "z = \"-1e5*z' - 1e7*(z - x)\"\n");
    CHECK(stiff["switched"]["method"] == "radau");
    REQUIRE(stiff["events"].size() == alone["events"].size());
    for (std::size_t k = 0; k < alone["events"].size(); ++k)
        CHECK(std::abs(value(alone["events"][k], "time") - value(stiff["events"][k], "time")) < 1e-8);
}

TEST_CASE("kicks: a body stopped in flight falls on, even if rounding puts it on either side of the height") {
    for (const double h : {0.0, 1.0, 0.3})
        for (const std::string method : {"dopri5", "dop853", "verner98", "taylor", "abm", "radau"}) {
            const Json motion = simulated(batted(0, h, 3), {"--no-estimate", "--method", method});
            INFO(method << " at " << h);
            CHECK(named(motion, "bat").size() == 1);
            const double fall = 3 - std::sqrt(2 * (2 - h) / g);
            CHECK(std::abs(coordinate(motion, "y") - h + g * fall * fall / 2) < 1e-10);
        }
}

TEST_CASE("kicks: infinitely many in a finite time end with a message, however fast they come") {
    for (const double e : {0.99, 0.8, 0.1, 0.001})
        for (const double h : {0.0, 1.0}) {
            const auto result = run({"simulate", batted(e, h, 1000), "--no-estimate"});
            INFO(e << " " << h << " " << result.err);
            CHECK(result.exit == 4);
            CHECK(result.err.find("the impulses of event 'bat' follow each other without end") !=
                  std::string::npos);
        }
}

TEST_CASE("kicks: bench compares them with a strict run") {
    const std::string scene = temporary("escapement.toml", escapement);
    const auto measured = run({"bench", scene, "--method", "dop853", "--duration", "5", "--json"});
    REQUIRE(measured.exit == 0);
    const Json bench = Json::parse(measured.out);
    CHECK(bench["reference"]["digits"].get<int>() >= 12);
    CHECK(bench["runs"].back()["error"].get<double>() < 1e-11);
}

TEST_CASE("kicks: cvode and ida find the events, and kick as dop853 does") {
    if (!has_part("alembert-sundials.so")) return;
    const std::string scene = temporary("escapement.toml", escapement);
    const Json exact = simulated(scene, {"--duration", "5", "--tolerance", "1e-12", "--method", "dop853"});
    for (const std::string method : {"cvode", "ida"}) {
        CAPTURE(method);
        const Json motion = simulated(scene, {"--duration", "5", "--tolerance", "1e-10", "--method", method});
        REQUIRE(motion["events"].size() == exact["events"].size());
        for (std::size_t k = 0; k < exact["events"].size(); ++k)
            CHECK(std::abs(value(motion["events"][k], "time") - value(exact["events"][k], "time")) < 1e-6);
        CHECK(motion["work_balance"].get<double>() < 1e-6);
    }
}

}  // namespace commands_kicks
