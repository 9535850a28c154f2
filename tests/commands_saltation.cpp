// SPDX-License-Identifier: MIT
// Derivatives through impacts, impulses, events and jumps of forces, against differences of tight motions and
// closed forms; and what has none.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include "edits.hpp"
#include "json.hpp"
#include "program.hpp"
#include "simulate/simulate.hpp"

namespace commands_saltation {

using namespace alembert::test;

namespace {

using Values = std::map<std::string, double>;

/// Names in braces stand for their values: "x' = {v}".
std::string with(std::string text, const Values& values) {
    for (const auto& [name, value] : values) {
        const std::string mark = "<" + name + ">";
        for (std::size_t at; (at = text.find(mark)) != std::string::npos;)
            text.replace(at, mark.size(), fmt::format("{:.17g}", value));
    }
    return temporary("jumps.toml", text);
}

/// Coordinates, rates, states.
std::vector<double> end_of(const std::string& scene) {
    const Json end = json_of({"simulate", scene, "--no-estimate", "--json"})["final"];
    std::vector<double> all;
    for (const char* const kind : {"coordinates", "rates", "states"})
        if (end.contains(kind))
            for (const Json& value : end[kind]) all.push_back(value);
    return all;
}

/// Derivatives by these values, which the scene has between < and >, against differences of second order with
/// extrapolation: of motions at 1e-13 they have nine digits.
void check_differences(const std::string& text, const Values& values) {
    std::string names;
    for (const auto& [name, value] : values) names += (names.empty() ? "" : ",") + name;
    const Json found = json_of({"simulate", with(text, values), "--sensitivity", names, "--json"})["sensitivity"];
    const std::vector<std::string> by = found["by"];
    for (std::size_t c = 0; c < by.size(); ++c) {
        CAPTURE(by[c]);
        const auto slope = [&](double step) {
            Values more = values, less = values;
            more[by[c]] += step;
            less[by[c]] -= step;
            const std::vector<double> a = end_of(with(text, more)), b = end_of(with(text, less));
            std::vector<double> result;
            for (std::size_t i = 0; i < a.size(); ++i) result.push_back((a[i] - b[i]) / (2 * step));
            return result;
        };
        const std::vector<double> one = slope(1e-4), two = slope(2e-4);
        REQUIRE(one.size() == found["values"].size());
        double size = 1;
        for (const double x : one) size = std::max(size, std::abs(x));
        for (std::size_t i = 0; i < one.size(); ++i) {
            CAPTURE(i);
            CHECK(std::abs(found["values"][i][c].get<double>() - (4 * one[i] - two[i]) / 3) < 1e-7 * size);
        }
    }
}

const char* const run_at = "[simulation]\ntolerance = 1e-13\nduration = ";

void check_refused(const std::string& scene, const std::string& names, const std::string& why) {
    CAPTURE(why);
    const Run result = run({"simulate", scene, "--sensitivity", names});
    CHECK(result.exit != 0);
    CHECK_MESSAGE(result.err.find(why) != std::string::npos, result.err);
}

}  // namespace

TEST_CASE("saltation: a ball that bounces on a moving table, by all of its numbers") {
    check_differences(fmt::format(R"toml(gravity = [0, "-g"]
[parameters]
g = <g>
e = <e>
A = <A>
w = <w>
[coordinates]
x = {{ initial = 0, rate = <x'> }}
y = {{ initial = <y> }}
[[particle]]
name = "ball"
mass = "1 + A"
position = ["x", "y"]
[forces]
x = "-0.2*x'"
[[unilateral]]
name = "table"
gap = "y - A*sin(w*t + x)"
restitution = "e"
{}2.4
)toml",
                                  run_at),
                      {{"g", 9.81}, {"e", 0.8}, {"A", 0.06}, {"w", 5}, {"x'", 0.7}, {"y", 0.9}});
}

TEST_CASE("saltation: a Duffing oscillator with a stop, and a double pendulum that strikes a wall") {
    check_differences(fmt::format(R"toml(
[parameters]
k = <k>
d = <d>
F = <F>
[coordinates]
x = {{ initial = <x>, rate = 0.1 }}
[[particle]]
name = "m"
mass = 0.8
position = ["x", 0]
[forces]
x = "k*x - x^3 - 0.1*x' + F*cos(1.3*t)"
[[unilateral]]
name = "stop"
gap = "d - x"
restitution = 0.6
{}9
)toml",
                                  run_at),
                      {{"k", 1}, {"d", 1.1}, {"F", 0.9}, {"x", 0.4}});
    check_differences(fmt::format(R"toml(gravity = [0, "-9.81"]
[parameters]
l = <l>
e = <e>
[coordinates]
a = {{ initial = <a> }}
b = {{ initial = 0.5, rate = <b'> }}
[[particle]]
name = "A"
mass = 1.2
position = ["l*sin(a)", "-l*cos(a)"]
[[particle]]
name = "B"
mass = 0.7
position = ["l*sin(a) + 0.8*sin(b)", "-l*cos(a) - 0.8*cos(b)"]
[[unilateral]]
name = "wall"
gap = "0.3 + l*sin(a) + 0.8*sin(b)"
restitution = "e"
{}1.3
)toml",
                                  run_at),
                      {{"l", 1.1}, {"e", 0.7}, {"a", 0.4}, {"b'", -0.3}});
}

TEST_CASE("saltation: impulses of events beside constraints, and a bead on a rod that strikes") {
    check_differences(fmt::format(R"toml(gravity = [0, "-9.81"]
[parameters]
J = <J>
l = <l>
[coordinates]
x = {{ initial = "l*sin(0.7)" }}
y = {{ guess = "-l*cos(0.7)" }}
[[particle]]
name = "P"
mass = 1.5
position = ["x", "y"]
[[constraint]]
name = "rod"
holonomic = "x^2 + y^2 - l^2"
[[event]]
name = "kick"
when = "x - 0.1*t"
impulses = {{ x = "J*(1 + y)", y = "0.2*x'" }}
{}2.5
)toml",
                                  run_at),
                      {{"J", 0.4}, {"l", 1.2}});
    check_differences(fmt::format(R"toml(gravity = [0, "-9.81"]
[parameters]
l = <l>
e = <e>
[coordinates]
x = {{ initial = "l*sin(0.7)" }}
y = {{ guess = "-l*cos(0.7)" }}
[[particle]]
name = "P"
mass = 1.5
position = ["x", "y"]
[[constraint]]
name = "rod"
holonomic = "x^2 + y^2 - l^2"
[[unilateral]]
name = "wall"
gap = "x + 0.2"
restitution = "e"
{}2.5
)toml",
                                  run_at),
                      {{"e", 0.9}, {"l", 1.2}});
}

// Forces that jump where a sign changes and the motion goes on through it.
TEST_CASE("saltation: forces that jump at places, at speeds and at times that the names move") {
    const auto scene = [](const std::string& force) {
        return fmt::format(R"toml(
[parameters]
c = <c>
p = <p>
[coordinates]
x = {{ initial = <x>, rate = <x'> }}
[[particle]]
name = "m"
mass = 1
position = ["x", 0]
[forces]
x = "{}"
[tables]
f = {{ arguments = ["length"], outside = "hold", points = [[-1, 0.5], [0.3, -0.5], [1, 2]] }}
{}3.3
)toml",
                           force, run_at);
    };
    const Values values{{"c", 0.7}, {"p", 0.4}, {"x", 1.1}, {"x'", -0.9}};
    check_differences(scene("-x - c*sign(x - p)"), values);
    check_differences(scene("-2*x + c*sign(x' - p) + 0.2*abs(x)"), values);
    check_differences(scene("-x + c*sign(t - 2*p)*x"), values);
    check_differences(scene("-x - c*sign(x - p*cos(t))*x'"), values);
    check_differences(scene("-x") + "[energy]\npotential = \"c*f(x - p)\"\n", values);
    // Steps of an event onto another side.
    check_differences(scene("-x - c*sign(x' + 0.3)*x") +
                          "[[event]]\nname = \"turn\"\nwhen = \"x - 0.25\"\n"
                          "rates = { x = \"-c*x'\" }\n",
                      values);
}

// A ball falls from h = 1.2 for T = √(2 h/g); then y = e g T (t − T) − g (t − T)²/2.
TEST_CASE("saltation: rows of derivatives before and after an impact are those of the closed form") {
    const auto run = alembert::simulate(
        alembert::parse_scene(R"toml(gravity = [0, "-9.81"]
[parameters]
e = 0.8
[coordinates]
y = { initial = 1.2 }
[[particle]]
name = "ball"
mass = 1
position = [0, "y"]
[[unilateral]]
name = "floor"
gap = "y"
restitution = "e"
[simulation]
duration = 0.85
)toml",
                              "bounce.toml"),
        {.tolerance = 1e-12, .sample = 0.1, .estimate = false, .sensitivity = {"e"}, .sensitivity_rows = true});
    REQUIRE(run.sensitivity);
    REQUIRE(run.sensitivity->times.size() == 10);
    const double fall = std::sqrt(2 * 1.2 / 9.81);
    for (std::size_t k = 0; k < 10; ++k) {
        const double t = run.sensitivity->times[k], by_e = t < fall ? 0 : 9.81 * fall * (t - fall);
        CHECK(std::abs(t - std::min(0.85, 0.1 * static_cast<double>(k))) < 1e-12);
        CHECK(std::abs(run.sensitivity->rows[k][0][0] - by_e) < 1e-9);
    }
}

TEST_CASE("saltation: where derivatives do not exist they are refused with the reason") {
    const auto scene = [](const std::string& head, const std::string& force, const std::string& more) {
        return temporary("none.toml", fmt::format(R"toml(
[parameters]
p = 1
[coordinates]
{}
[states]
z = {{ initial = 0 }}
[[particle]]
name = "P"
mass = 1
position = ["x", 0]
[forces]
x = "{}"
{}
[simulation]
duration = 2
tolerance = 1e-10
)toml",
                                                  head, force, more));
    };
    const std::string moving = "x = { initial = 0, rate = 1 }";
    const auto event = [](const std::string& when) {
        return "[[event]]\nname = \"e\"\nwhen = \"" + when + "\"\nset = { z = \"2\" }\n";
    };
    // x = t − t²/2 touches 1/2 at t = 1; a little lower it passes, a little higher it stays below.
    check_refused(scene(moving, "z-1", event("x - 0.5*p")), "p", "grazed");
    check_refused(scene(moving, "z-1", event("x - 0.5*p - 1e-12")), "p", "turns back");
    check_refused(scene(moving, "-1", "[[unilateral]]\nname = \"c\"\ngap = \"0.5*p + 1e-12 - x\"\n"), "p",
                  "turns back");
    check_refused(scene(moving, "-0.9 + 0.1*sign(x - 0.5*p - 1e-12)", ""), "p", "turns back");
    CHECK(run({"simulate", scene(moving, "-1 + 0.1*x*abs(x - 0.5*p - 1e-12)", ""), "--sensitivity", "p"}).exit ==
          0);
    CHECK(run({"simulate", scene(moving, "z-1", event("x - 0.4*p")), "--sensitivity", "p"}).exit == 0);
    CHECK(run({"simulate", scene(moving, "z-1", event("x - 0.6*p")), "--sensitivity", "p"}).exit == 0);
    // At its zero where the motion begins: x moves it, x' does not.
    check_refused(scene(moving, "z", event("x")), "x", "where the motion begins");
    CHECK(run({"simulate", scene(moving, "z", event("x")), "--sensitivity", "x'"}).exit == 0);
    check_refused(scene(moving, "z + sign(x)", ""), "x", "where the motion begins");
    // What stays.
    check_refused(scene("x = { initial = 1, rate = -1 }", "-1", "[[unilateral]]\nname = \"c\"\ngap = \"x\"\n"),
                  "p", "contact 'c'");
    check_refused(scene("x = { initial = 1, rate = 0.5 }", "-3*p*sign(x')", ""), "p", "stays at its zero");
    check_refused(scene("x = { initial = 1, rate = -1 }", "0",
                        "[[unilateral]]\nname = \"c\"\ngap = \"x\"\nrestitution = 0.5\n" + event("x")),
                  "p", "one instant");
    // A jump of a rate that is small beside the rate (atan2 jumps by 2 π).
    check_refused(scene("x = { initial = 0, rate = 2 }", "p*(1000 + 0.15*atan2(x-1,-1)) + z", ""), "p", "jumps");
    check_refused(scene("x = { initial = 0, rate = 2 }", "p*(1000 + 1e-5*atan2(x-1,-1)) + z", ""), "p", "jumps");
    CHECK(run({"simulate", scene("x = { initial = 0, rate = 2 }", "1000*p + sin(atan2(x-1,-1)) + z", ""),
               "--sensitivity", "p"})
              .exit == 0);
}

namespace {

/// The multipliers of a periodic motion by their size, and the whole answer.
std::pair<std::vector<std::complex<double>>, Json> multipliers(const std::string& scene,
                                                               const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"stability", scene, "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Run result = run(words);
    REQUIRE_MESSAGE(result.exit <= 2, result.err);
    const Json found = Json::parse(result.out);
    std::vector<std::complex<double>> values;
    for (const Json& one : found["floquet"]) values.emplace_back(one[0].get<double>(), one[1].get<double>());
    return {values, found};
}

void check_trace(const std::vector<std::complex<double>>& found, double trace, double det, double near) {
    REQUIRE(found.size() == 2);
    CHECK(std::abs(found[0] + found[1] - trace) < near * std::max(1.0, std::abs(trace)));
    CHECK(std::abs(found[0] * found[1] - det) < near * std::max(1.0, std::abs(det)));
}

}  // namespace

// The ball meets the table s(t) = A sin(w t + p) at t = T/2 + k T with T = 2π/w: v = g T/2 upwards, and
// v = e (g T/2 + s') + s'. Between impacts at t and t' with the speed v after the first, τ = t' − t,
//
//     s(t) + v τ − g τ²/2 = s(t'),    v' = −e (v − g τ) + (1 + e) s'(t').
TEST_CASE("periods: a ball that bounces on a moving table has the multipliers of its map") {
    for (const double e : {0.8, 0.55}) {
        CAPTURE(e);
        const double g = 9.81, w = 12, A = e > 0.6 ? 0.03 : 0.08, T = 2 * std::numbers::pi / w, v = g * T / 2;
        const double speed = v * (1 - e) / (1 + e), p = std::acos(-speed / (A * w));
        REQUIRE(speed < A * w);
        const double at = w * T / 2 + p, height = A * std::sin(at), bend = -A * w * w * std::sin(at);
        const double by_t = speed - v + g * T, by_next = v - g * T - speed;  // of s(t) + v τ − g τ²/2 − s(t')
        const double next_by_t = -by_t / by_next, next_by_v = -T / by_next;
        const double v_by_t = e * g * (next_by_t - 1) + (1 + e) * bend * next_by_t,
                     v_by_v = -e + e * g * next_by_v + (1 + e) * bend * next_by_v;
        const auto [found, all] =
            multipliers(temporary("table.toml", fmt::format(R"toml(gravity = [0, "-9.81"]
[coordinates]
y = {{ initial = {:.17g}, rate = 0.01 }}
[[particle]]
name = "ball"
mass = 2
position = [0, "y"]
[[unilateral]]
name = "table"
gap = "y - {}*sin({}*t + {:.17g})"
restitution = {}
[simulation]
period = "2*pi/{}"
)toml",
                                                            height + v * v / (2 * g) + 0.002, A, w, p, e, w)));
        check_trace(found, next_by_t + v_by_v, next_by_t * v_by_v - next_by_v * v_by_t, 1e-7);
        CHECK(all["assumed"][0]["kind"] == "numbers");
        const double largest = std::abs(found[0]);
        CHECK(all["verdict"] == (largest < 1 ? "asymptotically stable" : "unstable"));
    }
}

// Φ = E(1/2) K E(1/2), with the damped oscillator's E and K of the kick.
TEST_CASE("periods: a kicked oscillator and the escapement of a clock have multipliers of closed forms") {
    const double c = 0.05, w = std::sqrt(4 - c * c), k = 0.9, decay = std::exp(-c);
    const double E11 = decay * (std::cos(w) + c / w * std::sin(w)), E12 = decay * std::sin(w) / w, E21 = -4 * E12,
                 E22 = decay * (std::cos(w) - c / w * std::sin(w));
    const double trace = E11 + E22 - k * E12, det = decay * decay;  // of E K with K = [1 0; −k 1]
    CHECK(std::abs(E11 * E22 - E12 * E21 - det) < 1e-14);
    const auto kicked = [&](const std::string& act) {
        return temporary("kicked.toml", fmt::format(R"toml(
[coordinates]
x = {{ initial = 0, rate = 0 }}
[[particle]]
name = "m"
mass = 2
position = ["x", 0]
[forces]
x = "-2*(4*x + 0.1*x')"
[[event]]
name = "kick"
when = "cos(pi*t)"
{}
[simulation]
period = 1
)toml",
                                                    act));
    };
    for (const char* const act : {"rates = { x = \"x' - 0.9*x\" }", "impulses = { x = \"-1.8*x\" }"}) {
        CAPTURE(act);
        check_trace(multipliers(kicked(act)).first, trace, det, 1e-7);
        const Json exponents = json_of(
            {"stability", kicked(act), "--at", "x=1", "--exponents", "all", "--duration", "400", "--json"});
        const double larger = std::log(
            std::abs(std::complex<double>(trace / 2) + std::sqrt(std::complex<double>(trace * trace / 4 - det))));
        CHECK(std::abs(exponents["exponents"][0].get<double>() - larger) < 0.01);
        CHECK(std::abs(exponents["sum"].get<double>() - std::log(det)) < 1e-6);
    }
    // The speed at the lowest point becomes v exp(−π c/w) twice in a period, and grows by 0.3 once.
    const auto clock = [](double rate, double period) {
        return temporary("clock.toml", fmt::format(R"toml(
[coordinates]
x = {{ initial = 0.1, rate = {} }}
[[particle]]
name = "m"
mass = 2
position = ["x", 0]
[forces]
x = "-2*(4*x + 0.1*x')"
[[event]]
name = "escapement"
when = "x"
direction = "up"
rates = {{ x = "x' + 0.3" }}
[simulation]
period = {}
)toml",
                                                   rate, period));
    };
    const double T = 2 * std::numbers::pi / w;
    const auto [found, all] = multipliers(clock(1.1, 3.1));
    REQUIRE(found.size() == 2);
    CHECK(std::abs(found[0] - 1.0) < 1e-7);
    CHECK(std::abs(found[1] - std::exp(-c * T)) < 1e-7);
    CHECK(std::abs(all["period"].get<double>() - T) < 1e-7);
    CHECK(all["verdict"] == "asymptotically stable");
}

// Each impact takes e² of an area in the plane of x and x', and the damping exp(−c t).
TEST_CASE("periods: multipliers and exponents of an oscillator with a stop have the product that areas have") {
    const std::string text = R"toml(
[coordinates]
x = { initial = 0.3, rate = 0.2 }
[[particle]]
name = "m"
mass = 1
position = ["x", 0]
[forces]
x = "-x - 0.3*x^3 - 0.2*x' + 1.2*cos(1.3*t)"
[[unilateral]]
name = "stop"
gap = "0.6 - x"
restitution = 0.7
[simulation]
period = "2*pi/1.3"
tolerance = 1e-10
)toml";
    const std::string scene = temporary("stop.toml", text);
    const auto [found, all] = multipliers(scene);
    const double T = 2 * std::numbers::pi / 1.3;
    std::string start;
    std::vector<std::string> words{"simulate", scene, "--duration", fmt::format("{:.17g}", T), "--json"};
    for (const auto& [name, value] : all["start"].items())
        words.insert(words.end(), {"--at", fmt::format("{}={:.17g}", name, value.get<double>())});
    const Json motion = json_of(words);
    const auto impacts = static_cast<double>(motion["contacts"].size());
    CHECK(impacts > 0);
    CHECK(std::abs(motion["final"]["coordinates"]["x"].get<double>() - all["start"]["x"].get<double>()) < 1e-7);
    const double product = std::exp(-0.2 * T) * std::pow(0.7, 2 * impacts);
    CHECK(std::abs(found[0] * found[1] - product) < 1e-7);
    const Json exponents = json_of(
        {"stability", scene, "--exponents", "all", "--duration", fmt::format("{:.17g}", 60 * T), "--json"});
    CHECK(std::abs(exponents["sum"].get<double>() - std::log(product) / T) < 0.01);
}

TEST_CASE("periods: with impacts what has no multipliers is refused with the reason") {
    const auto scene = [](double restitution, const std::string& more) {
        return temporary("rests.toml", fmt::format(R"toml(gravity = [0, "-9.81"]
[coordinates]
y = {{ initial = 1 }}
[[particle]]
name = "ball"
mass = 2
position = [0, "y"]
[[unilateral]]
name = "table"
gap = "y"
restitution = {}
{}
[simulation]
period = 1
)toml",
                                                   restitution, more));
    };
    const Run rests = run({"stability", scene(0, "")});
    CHECK(rests.exit >= 3);
    CHECK_MESSAGE(rests.err.find("contact 'table'") != std::string::npos, rests.err);
    const Run other = run({"stability", scene(0.8, "[inputs]\nF = \"sin(5*t)\"\n[forces]\ny = \"F\"\n")});
    CHECK(other.exit == 3);
    CHECK_MESSAGE(other.err.find("do not have the period") != std::string::npos, other.err);
}

}  // namespace commands_saltation
