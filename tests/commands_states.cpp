// SPDX-License-Identifier: MIT
// `[states]`, z' = an expression: in runs, derivations, claims, equilibria and code, compared with closed forms
// and with scipy.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <complex>

#include "edits.hpp"
#include "files.hpp"
#include "json.hpp"
#include "program.hpp"
#include "shell.hpp"

namespace commands_states {

using namespace alembert::test;

namespace {

/// The bristle of LuGre's friction without slip of its own: z' = x' − |x'| s0/fc z.
const char* const bristle = R"toml(
[parameters]
s0 = 100
fc = 1
[coordinates]
x = { initial = 0, rate = 1 }
[states]
z = { rate = "x' - abs(x')*s0/fc*z" }
[[particle]]
name = "p"
mass = 1
position = ["x", 0]
[forces]
x = "-s0*z"
)toml";

/// A cart that balances a pole by a PI-controller with damping; `more` acts on the cart besides.
std::string cart_pole(const std::string& start, const std::string& more) {
    return fmt::format(R"toml(
gravity = [0, "-g"]
[parameters]
M = 1
m = 0.2
l = 0.5
g = 9.81
kp = 40
kd = 8
ki = 20
k1 = 1
k2 = 3
[coordinates]
x = 0
th = {{ initial = {} }}
[states]
e = {{ rate = "th" }}
[[particle]]
name = "C"
mass = "M"
position = ["x", 0]
[[particle]]
name = "B"
mass = "m"
position = ["x + l*sin(th)", "l*cos(th)"]
[forces]
x = "kp*th + kd*th' + ki*e{}"
)toml",
                       start, more);
}

/// The armature of a motor that turns a load through a gear.
const char* const motor = R"toml(
[parameters]
L = 0.5
R = 2
K = 0.1
N = 10
J = 0.05
b = 0.2
tau = 0.3
U = 12
[coordinates]
th = { initial = 0, unit = "rad" }
[states]
i = { rate = "(U - R*i - K*N*th')/L", unit = "A", about = "current of the armature" }
[energy]
kinetic = "J*th'^2/2"
[forces]
th = "K*N*i - b*th' - tau"
[outputs]
slope = "i'"
[simulation]
duration = 2
tolerance = 1e-13
)toml";

double state(const Json& motion, const std::string& name) {
    return motion["final"]["states"][name].get<double>();
}

}  // namespace

// Numbers of scipy 1.17: DOP853, rtol 3e-14, steps of at most 0.05, and from one zero of x' to the next.
TEST_CASE("states: one without a rate keeps its value in equilibria, also where loads determine a rate") {
    const std::string scene = temporary("gear.toml", R"toml(
[parameters]
m = 2
k = 10
[coordinates]
x = 0.3
y = 0
[states]
gear = { initial = 1 }
F = { rate = "3*gear - F" }
[[particle]]
name = "p"
mass = "m"
position = ["x", "y"]
[forces]
x = "-k*x - x' + F"
y = "-2*y' - 5*gear"
[[event]]
name = "switch"
when = "x - 1"
set = { gear = 2 }
)toml");
    for (const double gear : {1.0, 2.0}) {
        const Json found = json_of({"equilibrium", scene, "--at", fmt::format("gear={}", gear)});
        REQUIRE(found["equilibria"].size() == 1);
        const Json& one = found["equilibria"][0];
        CHECK(one["coordinates"]["x"].get<double>() == doctest::Approx(0.3 * gear));
        CHECK(one["rates"]["y"].get<double>() == doctest::Approx(-2.5 * gear));
    }
}

TEST_CASE("states: the bristle of LuGre's friction moves as scipy says, by methods of all kinds") {
    const std::string scene = temporary("bristle.toml", bristle);
    for (const std::string method : {"auto", "dop853", "verner98", "taylor", "radau", "abm"}) {
        const Json motion = simulated(scene, {"--tolerance", "1e-13", "--method", method});
        INFO(method);
        const double allowed = method == "abm" ? 1e-9 : 3e-12;  // abm begins again with small steps at each kink
        CHECK(std::abs(number(motion["final"], "coordinates", "x") - 0.49991678838069553) < allowed);
        CHECK(std::abs(number(motion["final"], "rates", "x") + 0.004898300256619055) < allowed);
        CHECK(std::abs(state(motion, "z") + 9.520829200724168e-05) < allowed);
        CHECK(motion["work_balance"].get<double>() < 1e-9);
    }
}

// Numbers of scipy 1.17: DOP853, rtol 3e-14.
TEST_CASE("states: a PI-controlled cart-pole moves as scipy says, by methods of all kinds and by all formalisms") {
    const std::string scene = temporary("cart_pole.toml", cart_pole("0.1", ""));
    const auto holds = [](const Json& motion, double allowed) {
        CHECK(std::abs(number(motion["final"], "coordinates", "x") - 0.4528619405746948) < allowed);
        CHECK(std::abs(number(motion["final"], "coordinates", "th") + 3.7800224645767087e-06) < allowed);
        CHECK(std::abs(number(motion["final"], "rates", "x") - 0.0010323592843889773) < allowed);
        CHECK(std::abs(state(motion, "e") - 3.9863432050641655e-06) < allowed);
    };
    for (const std::vector<std::string>& how : {std::vector<std::string>{},
                                                {"--method", "taylor"},
                                                {"--method", "dopri5"},
                                                {"--method", "radau"},
                                                {"--method", "radau13"},
                                                {"--method", "gauss", "--step", "0.002"},
                                                {"--code", "compiled"},
                                                {"--by", "kane"},
                                                {"--by", "hamilton"},
                                                {"--by", "recursive"},
                                                {"--by", "maggi"}}) {
        std::vector<std::string> more = {"--no-estimate"};
        if (how.empty() || how[0] != "--method" || how[1] != "gauss")
            more.insert(more.end(), {"--tolerance", "1e-13"});
        more.insert(more.end(), how.begin(), how.end());
        INFO((how.empty() ? "" : how[1]));
        holds(simulated(scene, more), 1e-11);
    }
    CHECK(json_of({"check", scene, "--formalisms"})["verdict"] == "proved");
}

// x = exp(A t) x0 with 30 digits (mpmath): th, th' and i at t = 2.
TEST_CASE("states: a motor with a gear moves as its matrix exponential says") {
    const std::string scene = temporary("motor.toml", motor);
    const Json motion = simulated(scene);
    CHECK(std::abs(number(motion["final"], "coordinates", "th") - 15.0157174196814931) < 1e-11);
    CHECK(std::abs(number(motion["final"], "rates", "th") - 8.13996578051879929) < 1e-11);
    CHECK(std::abs(state(motion, "i") - 1.92799806878805937) < 1e-12);
    CHECK(motion["units"]["i"] == "A");
    const Json now = json_of({"eval", scene, "--at", "i=3", "--at", "th'=1"});
    CHECK(now["states"]["i"] == 3);
    CHECK(now["state_rates"]["i"] == doctest::Approx(10));  // (12 − 6 − 1)/0.5
    CHECK(now["outputs"]["slope"] == doctest::Approx(10));
    CHECK(now["accelerations"]["th"] == doctest::Approx(50));  // (3 − 0.2 − 0.3)/0.05
    // ∂/∂i of the end is exp(A t) applied to the unit vector of i, ∂/∂tau its integral: by differences of the
    // linear motion, which are exact but for the tolerance.
    const Json slopes = json_of({"simulate", scene, "--sensitivity", "tau,i"})["sensitivity"];
    REQUIRE(slopes["of"] == Json{"th", "th'", "i"});
    const Json more =
        simulated(temporary("more.toml", edited(motor, {{"unit = \"A\"", "initial = 1, unit = \"A\""}})));
    const Json heavier = simulated(temporary("heavier.toml", edited(motor, {{"tau = 0.3", "tau = 1.3"}})));
    const auto end = [](const Json& run) {
        return std::array{number(run["final"], "coordinates", "th"), number(run["final"], "rates", "th"),
                          state(run, "i")};
    };
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(slopes["values"][k][0].get<double>() - (end(heavier)[k] - end(motion)[k])) < 1e-9);
        CHECK(std::abs(slopes["values"][k][1].get<double>() - (end(more)[k] - end(motion)[k])) < 1e-9);
    }
}

TEST_CASE("states: a sweep has them at the end of each motion, packed or not") {
    const std::string scene = temporary("motor.toml", motor);
    const Json rows = swept({scene, "--vary", "i=0:2:3", "--along", "max"})["rows"];
    for (std::size_t k = 0; k < 3; ++k) {
        const Json alone = simulated(temporary(
            "one.toml", edited(motor, {{"unit = \"A\"", fmt::format("initial = {}, unit = \"A\"", k)}})));
        CHECK(std::abs(rows[k]["final"]["states"]["i"].get<double>() - state(alone, "i")) < 1e-11);
        CHECK(rows[k]["along"]["max_i"].get<double>() >= state(alone, "i"));
    }
}

TEST_CASE("states: a scene may have states alone") {
    const std::string scene = temporary("circuit.toml", R"toml(
[parameters]
R = 2
L = 0.5
U = 3
[states]
i = { rate = "(U - R*i)/L" }
q = { rate = "i", initial = 1 }
[[event]]
name = "half"
when = "i - U/R/2"
[[claim]]
equation = "L*i' + R*i = U"
)toml");
    const Json motion = simulated(scene, {"--duration", "1", "--tolerance", "1e-13"});
    CHECK(std::abs(state(motion, "i") - 1.5 * (1 - std::exp(-4.0))) < 1e-13);
    CHECK(std::abs(state(motion, "q") - 1 - 1.5 * (1 - (1 - std::exp(-4.0)) / 4)) < 1e-13);
    CHECK(std::abs(motion["events"][0]["time"].get<double>() - std::log(2) / 4) < 1e-13);
    CHECK(json_of({"check", scene})["claims"][0]["verdict"] == "proved");
}

TEST_CASE("states: derive prints their rates after the equations of motion, as claims and in LaTeX") {
    const std::string scene = temporary("motor.toml", motor);
    const Json shown = json_of({"derive", scene});
    CHECK(shown["states"] == Json{"i"});
    CHECK(shown["equations"][0]["text"] == "J*th'' = -b*th' + K*N*i - tau");
    const std::string rate = shown["state_rates"][0]["text"];
    const std::string claims =
        temporary("claims.txt", rate + "\n" + "L*i' = U - R*i + K*N*th'\n" + "(L*i)' + R*i + K*N*th' = U\n" +
                                    "L*i'' = -R*i' - K*N*th''\n" + "J*th'' = K*N*i - b*th' - tau\n");
    const Json checked = json_of({"check", scene, claims}, {}, 1)["claims"];
    const std::vector<std::string> verdicts = {"proved", "refuted", "proved", "proved", "proved"};
    for (std::size_t k = 0; k < verdicts.size(); ++k) CHECK(checked[k]["verdict"] == verdicts[k]);
    CHECK(checked[1]["counterexample"].contains("i"));
    const Run latex = run({"derive", scene, "--format", "latex", "--steps"});
    CHECK(latex.out.find("\\dot{i}") != std::string::npos);
    const Run chinese = run({"derive", scene, "--language", "zh"});
    CHECK(chinese.out.find("其中状态的变化率") != std::string::npos);
}

// M l s³ + kd s² + (kp − (M + m) g) s + ki for the angle alone, beside the cart's free speed: Hurwitz's
// determinant is kd (kp − (M + m) g) − M l ki.
TEST_CASE("states: a PI-controlled cart-pole has Hurwitz's conditions in its gains, and is unstable beyond them") {
    const std::string scene = temporary("still.toml", cart_pole("0", ""));
    const Json judged = json_of({"stability", scene});
    CHECK(judged["theorem"] == "Lyapunov-Malkin");
    std::string conditions;
    for (const Json& condition : judged["conditions"]) conditions += condition.get<std::string>() + "; ";
    INFO(conditions);
    CHECK(conditions.find("ki > 0") != std::string::npos);
    CHECK(conditions.find("kd > 0") != std::string::npos);
    // At the boundary of the third: kd (kp − 1.2·9.81) = M l ki with ki = 451.648.
    CHECK(run({"stability", scene, "--at", "ki=451.6"}).exit == 0);
    CHECK(run({"stability", scene, "--at", "ki=451.7"}).exit == 1);
    // With the integral of x: five roots, whose sum is −(kd − l k2)/(M l) and whose product is −g ki/(M l).
    const std::string held =
        temporary("position.toml", edited(cart_pole("0", " + k1*x + k2*x'"), {{"rate = \"th\"", "rate = \"x\""}}));
    const Json near = json_of({"stability", held, "--at", "ki=0.2"});
    CHECK(near["verdict"] == "asymptotically stable");
    CHECK(near["states"] == Json{"x", "th", "x'", "th'", "e"});
    CHECK(near["conditions"].size() == 5);
    std::complex<double> sum = 0, product = 1;
    for (const Json& value : near["eigenvalues"]) {
        const std::complex<double> root(value[0].get<double>(), value[1].get<double>());
        sum += root;
        product *= root;
    }
    CHECK(std::abs(sum + (8 - 0.5 * 3) / 0.5) < 1e-10);
    CHECK(std::abs(product + 9.81 * 0.2 / 0.5) < 1e-10);
}

// A state that holds a constant: the integral of the angle takes the load, e = load/ki.
TEST_CASE("states: an equilibrium has the values of the states that balance a load") {
    const char* const integral = R"toml(
[parameters]
J = 2
load = 3
kp = 5
kd = 4
ki = 1.5
[coordinates]
th = 0.2
[states]
e = { rate = "th" }
[energy]
kinetic = "J*th'^2/2"
[forces]
th = "load - kp*th - kd*th' - ki*e"
)toml";
    const std::string scene = temporary("held.toml", integral);
    const Json one = json_of({"equilibrium", scene})["equilibria"][0];
    CHECK(std::abs(one["coordinates"]["th"].get<double>()) < 1e-12);
    CHECK(std::abs(one["states"]["e"].get<double>() - 2) < 1e-12);
    CHECK(one["stable"] == "yes");
    // J s³ + kd s² + kp s + ki
    const Json judged =
        json_of({"stability", temporary("balanced.toml", edited(integral, {{"th = 0.2", "th = 0"},
                                                                           {"rate = \"th\"",
                                                                            "rate = \"th\", "
                                                                            "initial = \"load/ki\""}}))});
    CHECK(judged["verdict"] == "asymptotically stable");
    CHECK(judged["conditions"] == Json{"ki > 0", "kd > 0", "kp*kd - J*ki > 0"});
}

TEST_CASE("states: what they cannot be is refused where it stands") {
    const auto refusal = [](const std::string& text) {
        const Run result = run({"derive", temporary("wrong.toml", text)});
        CHECK(result.exit == 3);
        return result.err;
    };
    const std::string particle = "[[particle]]\nname = \"p\"\nmass = 1\nposition = [\"x\", \"z\"]\n";
    CHECK(refusal("[coordinates]\nx = 0\n[states]\nz = { rate = \"x'\" }\n" + particle)
              .find("make z a coordinate") != std::string::npos);
    CHECK(refusal("[coordinates]\nx = 0\n[states]\nz = { rate = \"x''\" }\n").find("accelerations") !=
          std::string::npos);
    CHECK(refusal("[coordinates]\nx = 0\n[states]\nz = { rate = \"w'\" }\nw = { rate = \"z'\" }\n" + particle)
              .find("determined by itself") != std::string::npos);
    CHECK(refusal("[coordinates]\nx = 0\n[states]\nz = 3\n").find("expected its rate") != std::string::npos);
    CHECK(refusal("[coordinates]\nx = 0\n[states]\nx = { rate = \"1\" }\n").find("is taken") != std::string::npos);
}

// Along its blade a sledge obeys m v' = F, whatever its turn: v = v0 + ∫F/m with F by the filter, F' = (F0 − F)/T.
TEST_CASE("states: they stand beside generalized speeds, constraints and moving constraints") {
    const std::string sledge = R"toml(
[coordinates]
x = 0
y = 0
phi = 0.2
[speeds]
v = { form = "x'*cos(phi) + y'*sin(phi)", initial = 1 }
w = { form = "phi'", initial = 0.5 }
[states]
F = { rate = "(3 - F)/0.3" }
[[constraint]]
name = "blade"
nonholonomic = "-x'*sin(phi) + y'*cos(phi)"
)toml";
    const std::string end = "[simulation]\nduration = 2\ntolerance = 1e-13\n";
    const std::string by_energy = temporary("sledge.toml", sledge + R"toml(
[energy]
kinetic = "x'^2 + y'^2 + 0.2*phi'^2"
[forces]
x = "F*cos(phi)"
y = "F*sin(phi)"
)toml" + end);
    const std::string by_body = temporary("sledge_body.toml", sledge + R"toml(
[[frame]]
name = "H"
rotate = [["z", "phi"]]
[[body]]
name = "sledge"
mass = 2
frame = "H"
inertia = 0.4
position = ["x", "y"]
[[force]]
at = "sledge"
vector = ["F", 0]
axes = "H"
)toml" + end);
    const double F = 3 * (1 - std::exp(-2 / 0.3)), v = 1 + (3 * 2 - 0.3 * F) / 2;
    for (const std::string& scene : {by_energy, by_body}) {
        const Json motion = simulated(scene);
        CHECK(std::abs(state(motion, "F") - F) < 1e-12);
        const double x = number(motion["final"], "rates", "x"), y = number(motion["final"], "rates", "y");
        CHECK(std::abs(std::hypot(x, y) - v) < 1e-11);
        CHECK(std::abs(number(motion["final"], "coordinates", "phi") - 1.2) < 1e-12);
        CHECK(json_of({"eval", scene})["state_rates"]["F"] == doctest::Approx(10));
        const Json row = swept({scene, "--vary", "F=0:1:2"})["rows"][0];
        CHECK(std::abs(row["final"]["states"]["F"].get<double>() - F) < 1e-11);
    }
    // On a rod that grows, r' = 0.1, without gravity: the angular momentum r² θ' stays, here 1·0.5.
    const std::string rod = temporary("rod.toml", R"toml(
[coordinates]
x = 1
y = 0
[states]
r = { rate = "0.1", initial = 1 }
[[particle]]
name = "p"
mass = 1
position = ["x", "y"]
[[constraint]]
name = "rod"
holonomic = "x^2 + y^2 = r^2"
[simulation]
duration = 2
tolerance = 1e-12
)toml");
    const Json grown = simulated(
        temporary("rod_rates.toml", edited(contents(rod), {{"x = 1\n", "x = { initial = 1, rate = 0.1 }\n"},
                                                           {"y = 0\n", "y = { initial = 0, rate = 0.5 }\n"}})));
    const double x = number(grown["final"], "coordinates", "x"), y = number(grown["final"], "coordinates", "y"),
                 p = x * number(grown["final"], "rates", "y") - y * number(grown["final"], "rates", "x");
    CHECK(std::abs(std::hypot(x, y) - 1.2) < 1e-10);
    CHECK(std::abs(p - 0.5) < 1e-10);
    CHECK(run({"audit", rod}).out.find("rheonomic") != std::string::npos);
}

TEST_CASE("states: a slip in a claim or in a derivation that holds them is found and named") {
    const std::string scene = temporary("motor.toml", motor);
    const std::string claims = temporary("slips.txt", "J*th'' = K*i - b*th' - tau\nJ*th'' = -b*th' - tau\n");
    const Json checked = json_of({"check", scene, claims}, {}, 1)["claims"];
    CHECK(checked[0]["likely"]["kind"] == "factor");
    CHECK(checked[1]["likely"]["kind"] == "missing_term");
    const std::string written =
        temporary("derivation.tex",
                  "The current obeys $L\\dot{i} = U - Ri + KN\\dot{\\theta}$. The shaft turns by "
                  "$J\\ddot{\\theta} = KNi - b\\dot{\\theta} - \\tau$.\n");
    const Json lines =
        json_of({"check", scene, written, "--letters", "\\theta=th", "--letters", "\\tau=tau"}, {}, 1);
    REQUIRE(lines["lines"].size() == 2);
    CHECK(lines["lines"][0]["status"] == "mistake");
    CHECK(lines["lines"][1]["status"] == "right");
}

// s³ + (D/m l²) s² + (P − m g l)/m l² s + I/m l²: Hurwitz's conditions. The gains need not be those of a stable
// motion, and an input from outside, which keeps its value, changes nothing.
TEST_CASE("states: a PID controller of an inverted pendulum has the conditions in its gains by Hurwitz") {
    const auto scene = [](const char* const D, const char* const more) {
        return temporary("pid.toml", fmt::format(R"toml(
[parameters]
m = 1
g = 9.81
l = 1
P = 30
I = 10
D = {}
{}
[coordinates]
theta = 0
[states]
e = {{ rate = "theta" }}
[energy]
kinetic = "m*l^2*theta'^2/2"
potential = "m*g*l*cos(theta)"
[forces]
theta = "-P*theta - I*e - D*theta' + u"
)toml",
                                                 D, more));
    };
    const Json conditions = Json::array({"m*I > 0", "m*D > 0", "P*D - m*g*l*D - m*I*l^2 > 0"});
    for (const char* const u : {"[inputs]\nu = { value = 0, given = \"outside\" }", "[inputs]\nu = \"2*w\"\nw = 0",
                                "[definitions]\nu = \"0\""}) {
        CHECK(json_of({"stability", scene("5", u)})["conditions"] == conditions);
        const Json unstable = json_of({"stability", scene("0.1", u)}, {}, 1);
        CHECK(unstable["verdict"] == "unstable");
        CHECK(unstable["conditions"] == conditions);
    }
}

// A cart with two poles has too many letters for its conditions; its coefficients, as a [polynomial], have the
// same roots.
TEST_CASE("states: where conditions are long in the parameters they are given in the polynomial's coefficients") {
    const std::string gains =
        "M = 2\nm = 0.5\nl = 0.8\nr = 0.6\nn = 0.4\ng = 9.81\nkp = 100\nkd = 20\nk1 = 4\nk2 = 8\nc = 3\n";
    const Json found =
        json_of({"stability", temporary("pid.toml", "gravity = [0, \"-g\"]\n[parameters]\n" + gains + R"toml(
[coordinates]
x = 0
theta = 0
phi = 0
[[particle]]
name = "cart"
mass = "M"
position = ["x", 0]
[[particle]]
name = "bob"
mass = "m"
from = "cart"
position = ["l*sin(theta)", "l*cos(theta)"]
[[particle]]
name = "load"
mass = "n"
from = "cart"
position = ["r*sin(phi)", "-r*cos(phi)"]
[forces]
x = "kp*theta + kd*theta' + k1*x + k2*x'"
phi = "-c*phi'"
)toml")});
    const std::size_t count = found["coefficients"].size();
    REQUIRE(count == 7);
    std::string list;
    for (std::size_t k = 0; k < count; ++k) {
        const std::string one = found["coefficients"][k].get<std::string>(), begin = fmt::format("a{} = ", k);
        REQUIRE(one.starts_with(begin));
        list += fmt::format("\"{}\", ", one.substr(begin.size()));
    }
    const Json same =
        json_of({"stability", temporary("polynomial.toml", "[parameters]\n" + gains +
                                                               "[polynomial]\ncoefficients = [" + list + "]\n")});
    REQUIRE(same["eigenvalues"].size() == found["eigenvalues"].size());
    for (std::size_t k = 0; k < same["eigenvalues"].size(); ++k)
        for (const int part : {0, 1})
            CHECK(std::abs(same["eigenvalues"][k][part].get<double>() -
                           found["eigenvalues"][k][part].get<double>()) < 1e-9);
    // Liénard's and Chipart's criterion, with Δ₃ by its determinant; then comes Δ₅.
    REQUIRE(found["conditions"].size() == 6);
    for (const char* const one :
         {"a6 > 0", "a4 > 0", "a2 > 0", "a1 > 0", "a0*a1*a5 - a0*a3^2 - a1^2*a4 + a1*a2*a3 > 0"})
        CHECK(std::find(found["conditions"].begin(), found["conditions"].end(), one) != found["conditions"].end());
}

TEST_CASE(
    "states: --at gives a state its start in every verb that integrates, and refuses what the scene has not") {
    const std::string scene = temporary("relaxes.toml", R"toml(
[parameters]
tau = 1
[states]
f = { rate = "-f/tau", initial = 0 }
[simulation]
duration = 2
)toml");
    const auto end = [&](const std::vector<std::string>& more) {
        std::vector<std::string> line{"simulate", scene, "--json"};
        line.insert(line.end(), more.begin(), more.end());
        return run(line);
    };
    const auto told = end({"--at", "f=3"});
    INFO(told.err);
    REQUIRE(told.exit == 0);
    CHECK(std::abs(Json::parse(told.out)["final"]["states"]["f"].get<double>() - 3 * std::exp(-2)) < 1e-10);
    CHECK(end({"--at", "foo=1"}).exit == 3);
    const Run held = run({"equilibrium", temporary("counter.toml", "[states]\nn = { initial = 3 }\n")});
    CHECK(held.exit == 0);
    CHECK(held.out.find("n = 3") != std::string::npos);
}

}  // namespace commands_states
