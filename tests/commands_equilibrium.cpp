// SPDX-License-Identifier: MIT
// `equilibrium` as a user runs it, against closed forms.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_equilibrium {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

std::string textbook(const std::string& name) {
    return source_path("scenes/textbook/" + name + ".toml");
}

Json found(const std::string& scene, const std::vector<std::string>& more = {}) {
    return json_of({"equilibrium", scene}, more);
}

std::vector<double> values(const Json& result, const std::string& name) {
    std::vector<double> list;
    for (const Json& one : result["equilibria"]) list.push_back(one["coordinates"][name]);
    return list;
}

/// The special points of a kind, by parameter.
std::vector<double> points(const Json& result, const std::string& kind) {
    std::vector<double> list;
    for (const Json& one : result["points"])
        if (one["kind"] == kind) list.push_back(one["parameter"]);
    return list;
}

bool are_close(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!(std::abs(a[i] - b[i]) <= tolerance)) return false;
    return true;
}

/// A mass m = 1 on a line under `force`.
std::string on_a_line(const std::string& name, const std::string& force, const std::string& parameters = "") {
    return temporary(
        name, "[parameters]\nmu = 0.5\n" + parameters +
                  "[coordinates]\nx = 0.1\n[[particle]]\nname = \"P\"\nmass = \"1\"\nposition = [\"x\", 0]\n"
                  "[forces]\nx = \"" +
                  force + "\"\n");
}

}  // namespace

// sin θ (g − R Ω² cos θ) = 0.
TEST_CASE("equilibrium: a bead on a turning hoop has its four equilibria in closed form") {
    const Json hoop = found(textbook("rotating_hoop"));
    CHECK(hoop["complete"] == true);
    const double angle = std::acos(9.81 / (0.5 * 36));
    CHECK(are_close(values(hoop, "theta"), {-angle, 0, angle, M_PI}, 2e-15));
    const Json& list = hoop["equilibria"];
    CHECK(list[2]["exact"]["theta"] == "acos(g/(R*Omega^2))");
    CHECK(list[2]["where"] == Json{"abs(g/(R*Omega^2)) <= 1"});
    CHECK(list[2]["stable"] == "yes");
    CHECK(list[1]["stable"] == "no");
    CHECK(list[3]["stable"] == "no");
}

TEST_CASE("equilibrium: solutions that are not real at the parameters are named with their condition") {
    const Json slow = found(textbook("rotating_hoop"), {"--at", "Omega=2"});
    CHECK(are_close(values(slow, "theta"), {0, M_PI}, 0));
    CHECK(slow["equilibria"][0]["stable"] == "yes");
    REQUIRE(slow["absent"].size() == 2);
    CHECK(slow["absent"][1]["exact"]["theta"] == "acos(g/(R*Omega^2))");
}

// cos α = (m + M) g/(m l Ω²).
TEST_CASE("equilibrium: Watt's governor stands at its angle") {
    const double angle = std::acos(3 * 9.81 / (0.4 * 144));
    CHECK(are_close(values(found(textbook("watt_governor")), "alpha"), {-angle, 0, angle, M_PI}, 2e-15));
}

// cos θ = g/(l φ'²); the poles are equilibria in which φ does not matter.
TEST_CASE("equilibrium: a conical pendulum is a steady motion at the rate that is given") {
    const Json cone = found(textbook("spherical_pendulum"), {"--at", "phi'=5"});
    const double l = found(textbook("spherical_pendulum"), {"--at", "l=1", "--at", "phi'=5"})["equilibria"].size();
    CHECK(l == 4);
    CHECK(cone["cyclic"] == Json{"phi"});
    bool seen = false;
    for (const Json& one : cone["equilibria"])
        if (one.contains("exact") && one["exact"]["theta"] == "acos(g/(l*phi'^2))") {
            seen = true;
            CHECK(one["moving"] == Json{"phi"});
            CHECK(one["rates"]["phi"] == 5);
            CHECK(one["stable"] == "yes");
        }
    CHECK(seen);
    for (const Json& one : cone["equilibria"])  // the mass matrix is singular at a pole
        if (std::abs(std::sin(one["coordinates"]["theta"].get<double>())) < 1e-9)
            CHECK(one["stable"] == "undecided");
}

TEST_CASE("equilibrium: a double pendulum has four, of which one is stable") {
    const Json four = found(temporary("double.toml", R"toml(
gravity = [0, "-g"]
[parameters]
m1 = 1
m2 = 2
l1 = 0.5
l2 = 0.3
g = 9.81
[coordinates]
theta1 = 0.5
theta2 = -0.2
[[particle]]
name = "A"
mass = "m1"
position = ["l1*sin(theta1)", "-l1*cos(theta1)"]
[[particle]]
name = "B"
mass = "m2"
from = "A"
position = ["l2*sin(theta2)", "-l2*cos(theta2)"]
)toml"));
    CHECK(four["complete"] == true);
    CHECK(are_close(values(four, "theta1"), {0, 0, M_PI, M_PI}, 0));
    CHECK(are_close(values(four, "theta2"), {0, M_PI, 0, M_PI}, 0));
    CHECK(four["equilibria"][0]["stable"] == "yes");
    for (int k = 1; k < 4; ++k) CHECK(four["equilibria"][k]["stable"] == "no");
}

// r = l₀ ± m g/k.
TEST_CASE("equilibrium: coordinates that follow from others are substituted") {
    const Json two = found(textbook("elastic_pendulum"));
    CHECK(two["complete"] == true);
    CHECK(two["equilibria"].size() == 2);
    for (const Json& one : two["equilibria"]) CHECK(one["exact"].contains("r"));
}

// The heights of crank and rod grow with sin α: both assemblies have equilibria at α = ±π/2.
TEST_CASE("equilibrium: a slider-crank keeps its constraints, with multipliers") {
    const Json crank = found(textbook("slider_crank"));
    CHECK(are_close(values(crank, "alpha"), {-M_PI / 2, -M_PI / 2, M_PI / 2, M_PI / 2}, 1e-14));
    CHECK(crank["equilibria"][0]["stable"] == "yes");
    CHECK(crank["equilibria"][3]["stable"] == "no");
    CHECK(crank["equilibria"][0]["multipliers"].size() == 2);
    for (const Json& one : crank["equilibria"]) CHECK(one["residual"].get<double>() < 1e-14);
}

// T = c φ'.
TEST_CASE("equilibrium: a rate that friction determines is found") {
    const std::string rotor = temporary("rotor.toml", R"toml(
[parameters]
T = 3
c = 0.5
[coordinates]
phi = { initial = 0, rate = 1 }
[[frame]]
name = "R"
rotate = [["z", "phi"]]
[[particle]]
name = "P"
mass = 1
position = [1, 0]
axes = "R"
[forces]
phi = "T"
[[damper]]
along = "phi"
damping = "c"
)toml");
    const auto result = run({"equilibrium", rotor, "--json"});
    CAPTURE(result.err);
    REQUIRE(result.exit == 0);
    const Json one = Json::parse(result.out)["equilibria"][0];
    CHECK(one["rates"]["phi"].get<double>() == doctest::Approx(6).epsilon(1e-14));
    CHECK(one["moving"] == Json{"phi"});
}

/// A particle of mass 1 in a potential of these coordinates.
std::string in_potential(const std::string& name, const std::vector<std::string>& coordinates,
                         const std::string& potential) {
    std::string scene = "[coordinates]\n", position;
    for (const std::string& q : coordinates) {
        scene += q + " = " + (position.empty() ? "0.9" : "0.2") + "\n";
        position += (position.empty() ? "\"" : ", \"") + q + "\"";
    }
    return temporary(name, scene + "[[particle]]\nname = \"P\"\nmass = 1\nposition = [" + position +
                               "]\n[energy]\npotential = \"" + potential + "\"\n");
}

std::vector<Json> families(const Json& result) {
    std::vector<Json> list;
    for (const Json& one : result["equilibria"]) {
        CHECK(one.contains("family") == !one["isolated"].get<bool>());
        if (one.contains("family")) list.push_back(one);
    }
    return list;
}

// The roots of f(r) for r² = x² + y² are circles; r = 0 is isolated.
TEST_CASE("equilibrium: each continuum is shown once, with its dimension and the coordinates that choose in it") {
    const auto squared_radius = [](const Json& one) {
        return std::pow(one["coordinates"]["x"].get<double>(), 2) +
               std::pow(one["coordinates"]["y"].get<double>(), 2);
    };
    const Json ring = found(in_potential("ring.toml", {"x", "y"}, "(x^2 + y^2 - 1)^2"));
    REQUIRE(ring["equilibria"].size() == 2);
    REQUIRE(families(ring).size() == 1);
    CHECK(families(ring)[0]["family"] == Json{{"dimension", 1}, {"free", {"y"}}});
    CHECK(squared_radius(families(ring)[0]) == doctest::Approx(1).epsilon(1e-14));

    // dV/dr² is zero at r² = 1, 5/2 and 4.
    const Json rings = found(in_potential("rings.toml", {"x", "y"}, "((x^2 + y^2 - 1)*(x^2 + y^2 - 4))^2"));
    std::vector<double> squares;
    for (const Json& one : families(rings)) squares.push_back(squared_radius(one));
    std::sort(squares.begin(), squares.end());
    CHECK(are_close(squares, {1, 2.5, 4}, 1e-13));
    CHECK(rings["equilibria"].size() == 4);  // and the centre

    const Json sphere = found(in_potential("sphere.toml", {"x", "y", "z"}, "(x^2 + y^2 + z^2 - 1)^2"));
    REQUIRE(families(sphere).size() == 1);
    CHECK(families(sphere)[0]["family"]["dimension"] == 2);
    CHECK(families(sphere)[0]["family"]["free"].size() == 2);
}

TEST_CASE("equilibrium: a state whose derivative is singular, but which is alone, is isolated") {
    const Json quartic = found(in_potential("quartic.toml", {"x", "y"}, "x^4 + y^2"));
    REQUIRE(quartic["equilibria"].size() == 1);
    CHECK(quartic["equilibria"][0]["isolated"] == true);
    const Json two = found(in_potential("two.toml", {"x", "y"}, "(x^2 - 1)^2 + y^2"));
    CHECK(families(two).empty());
    CHECK(two["equilibria"].size() == 3);
}

TEST_CASE(
    "equilibrium: continua of steady motions: a ball on a turntable and on another one, sleds, a disc, a puck") {
    const auto family = [](const std::string& scene) {
        std::vector<Json> list;
        const Json all = found(textbook(scene));
        for (const Json& one : all["equilibria"]) {
            list.push_back(one.value("family", Json()));
            for (const auto& [name, rate] : one["rates"].items()) CHECK(std::abs(rate.get<double>()) < 100);
        }
        return list;
    };
    // Wherever the ball is, it may turn so that its place rests.
    CHECK(family("ball_on_turntable") == std::vector<Json>{{{"dimension", 2}, {"free", {"x", "y"}}}});
    // Here coordinates are given rates, and the axis of the turn is that of phi alone. Of its parts some meet only
    // where the ball rests, so that a way between them need not be found.
    for (const Json& part : family("turntable_ball"))
        CHECK(part == Json{{"dimension", 3}, {"free", {"x", "y", "theta"}}});
    // The blade may point anywhere but across x, in which it has to move: that leaves two arcs.
    for (const char* sled : {"sled", "sled_regular", "chaplygin_sleigh"}) {
        const std::vector<Json> arcs = family(sled);
        CHECK(arcs.size() == 2);
        for (const Json& arc : arcs) {
            CHECK(arc["dimension"] == 1);
            CHECK(arc["free"] == Json{"phi"});
            for (const char* const side : {"seen_from", "seen_to"})
                CHECK(std::abs(std::cos(arc[side].get<double>())) < 0.01);
        }
    }
    // A disc that rolls leans by what its rates ask for, upright or upside down.
    CHECK(family("rolling_disc_in_space") == std::vector<Json>(2));
    const Json puck = found(in_potential("puck.toml", {"x", "y"}, "0"));
    REQUIRE(puck["equilibria"].size() == 1);
    CHECK(puck["equilibria"][0]["isolated"] == true);
    CHECK(puck["cyclic"] == Json{"x", "y"});
}

// Ω² R = g.
TEST_CASE("equilibrium --follow: the hoop's pitchfork is where the angle begins") {
    const std::string csv = temporary("hoop.csv", ""), svg = temporary("hoop.svg", "");
    const Json hoop = found(textbook("rotating_hoop"), {"--follow", "Omega=0:10", "-o", csv, "--svg", svg});
    CHECK(are_close(points(hoop, "pitchfork"), {std::sqrt(9.81 / 0.5)}, 1e-10));
    CHECK(hoop["points"].size() == 1);
    CHECK(hoop["branches"].size() == 3);
    for (const Json& branch : hoop["branches"])
        for (const Json& point : branch["points"]) {
            if (point.contains("kind")) continue;
            const double theta = point["coordinates"]["theta"], rate = point["parameter"];
            CHECK(std::abs(std::sin(theta) * (9.81 - 0.5 * rate * rate * std::cos(theta))) < 1e-11);
            const bool hangs = std::abs(theta) < 1e-9 && rate < std::sqrt(9.81 / 0.5);
            const bool leans = std::abs(std::sin(theta)) > 1e-6;
            CHECK(point["stable"] == (hangs || leans ? "yes" : "no"));
        }
    std::ifstream table(csv);
    std::string first;
    std::getline(table, first);
    CHECK(first == "branch,Omega,theta,stable,kind");
    const std::string picture = alembert::test::contents(svg);
    CHECK(picture.starts_with("<svg"));
    CHECK(picture.find("stroke-dasharray") != std::string::npos);
}

// P = 2 k y (L/ℓ − 1) with ℓ² = a² + y²; dP/dy = 0 at ℓ³ = L a².
TEST_CASE("equilibrium --follow: von Mises' truss snaps through at its two folds") {
    const std::string truss = temporary("truss.toml", R"toml(
[parameters]
k = 100
a = 1
h = 0.6
L = "sqrt(a^2 + h^2)"
P = 0
[coordinates]
y = { initial = 0.6 }
[[particle]]
name = "top"
mass = 1
position = [0, "y"]
[[point]]
name = "left"
offset = ["-a", 0]
[[point]]
name = "right"
offset = ["a", 0]
[[spring]]
between = ["left", "top"]
stiffness = "k"
length = "L"
[[spring]]
between = ["right", "top"]
stiffness = "k"
length = "L"
[forces]
y = "-P"
)toml");
    const double L = std::sqrt(1.36), l = std::cbrt(L), y = std::sqrt(l * l - 1), P = 200 * y * (L / l - 1);
    const Json found_truss = found(truss, {"--follow", "P=-20:20"});
    CHECK(are_close(points(found_truss, "fold"), {-P, P}, 1e-10));
    CHECK(found_truss["branches"].size() == 1);
}

TEST_CASE("equilibrium --follow: curves that cross at an angle are transcritical") {
    const Json crossing = found(on_a_line("transcritical.toml", "mu*x - x^2 - x'"), {"--follow", "mu=-1:2"});
    CHECK(are_close(points(crossing, "transcritical"), {0}, 1e-10));
    CHECK(crossing["points"].size() == 1);
    CHECK(crossing["branches"].size() == 2);
}

TEST_CASE("equilibrium --follow: van der Pol's oscillator begins to swing where its damping changes sign") {
    const Json hopf = found(on_a_line("hopf.toml", "(mu - 3/10 - x^2)*x' - x"), {"--follow", "mu=-1:2"});
    CHECK(are_close(points(hopf, "hopf"), {0.3}, 1e-10));
    CHECK(hopf["points"].size() == 1);
}

// Masses 2 m and m, equal rods and springs: P l/k = 7/2 − √2 (Ziegler 1952).
TEST_CASE("equilibrium --follow: Ziegler's pendulum without damping flutters at its load") {
    const std::string ziegler = temporary("ziegler.toml", R"toml(
[parameters]
m = 1
l = 1
k = 1
P = 1
[coordinates]
a = 0
b = 0
[[particle]]
name = "A"
mass = "2*m"
position = ["l*cos(a)", "l*sin(a)"]
[[particle]]
name = "B"
mass = "m"
from = "A"
position = ["l*cos(b)", "l*sin(b)"]
[[spring]]
along = "a"
stiffness = "k"
[[spring]]
along = "b - a"
stiffness = "k"
[[force]]
at = "B"
vector = ["-P*cos(b)", "-P*sin(b)"]
)toml");
    const Json load = found(ziegler, {"--follow", "P=1:3"});
    CHECK(are_close(points(load, "hamiltonian hopf"), {3.5 - std::sqrt(2.0)}, 1e-10));
}

// 4 g = (c1 + c2) v.
TEST_CASE(
    "equilibrium: two bodies on one rod sink at their common speed, though one's coordinate stands in a "
    "constraint") {
    const std::string sinking = temporary("sinking.toml", R"toml(
gravity = [0, -9.81, 0]
[coordinates]
y1 = { initial = 1, rate = -1 }
y2 = { initial = 0, rate = -1 }
[[particle]]
name = "upper"
mass = 1
position = [0, "y1"]
[[particle]]
name = "lower"
mass = 3
position = [0, "y2"]
[[constraint]]
name = "rod"
holonomic = "y1 - y2 - 1"
[forces]
y1 = "-0.5*y1'"
y2 = "-1.5*y2'"
)toml");
    const Json one = found(sinking)["equilibria"].at(0);
    CHECK(one["rates"]["y1"].get<double>() == doctest::Approx(-4 * 9.81 / 2).epsilon(1e-14));
    CHECK(one["rates"]["y2"] == one["rates"]["y1"]);
    CHECK(one["stable"] == "yes");
}

// (a + l·sin θ)·Ω²·cos θ = g·sin θ has no closed form; its two roots are found by bisection.
TEST_CASE("equilibrium: an arm that a motor turns stands where the centrifugal force balances its weight") {
    const double a = 0.5, l = 0.3, Omega = 4, g = 9.81, pi = std::acos(-1.0);
    const auto force = [&](double x) {
        return (a + l * std::sin(x)) * Omega * Omega * std::cos(x) - g * std::sin(x);
    };
    const auto root = [&](double from, double to) {
        for (int k = 0; k < 100; ++k) (force((from + to) / 2) * force(from) > 0 ? from : to) = (from + to) / 2;
        return from;
    };
    const std::vector<double> expected{root(-pi, -pi / 2), root(0, pi / 2)};
    const std::string begin =
        "gravity = [0, 0, \"-g\"]\nparameters = { m = 1, a = 0.5, l = 0.3, Omega = 4, g = 9.81 }\n"
        "[coordinates]\nphi = { initial = 0, rate = \"Omega\" }\npsi = { initial = 0, rate = \"Omega/2\" }\n"
        "theta = 0.4\n[[frame]]\nname = \"A\"\nrotate = [[\"z\", \"phi\"]]\n"
        "[[particle]]\nname = \"bob\"\nmass = \"m\"\nposition = [\"a + l*sin(theta)\", 0, \"-l*cos(theta)\"]\n"
        "axes = \"A\"\n";
    for (const char* driven : {"[[constraint]]\nname = \"motor\"\nholonomic = \"phi = Omega*t\"\n"
                               "[[constraint]]\nname = \"gear\"\nholonomic = \"phi = 2*psi\"\n",
                               "[[constraint]]\nname = \"motor\"\nnonholonomic = \"phi' = Omega\"\n"
                               "[[constraint]]\nname = \"gear\"\nholonomic = \"phi = 2*psi\"\n",
                               "[[constraint]]\nname = \"motor\"\nholonomic = \"psi = Omega*t/2\"\n"
                               "[[constraint]]\nname = \"gear\"\nholonomic = \"phi = 2*psi\"\n"}) {
        CAPTURE(driven);
        const std::string scene = temporary("arm.toml", begin + driven);
        const Json result = found(scene);
        CHECK(are_close(values(result, "theta"), expected, 1e-12));
        for (const Json& one : result["equilibria"]) {
            CHECK(one["moving"] == Json{"phi", "psi"});
            const std::string at = "theta=" + std::to_string(one["coordinates"]["theta"].get<double>());
            CHECK(run({"eval", scene, "--at", at}).exit == 0);
        }
        REQUIRE(result["equilibria"].size() == 2);
        CHECK(result["equilibria"][0]["stable"] == "no");
        CHECK(result["equilibria"][1]["stable"] != "no");
    }
}

TEST_CASE("equilibrium: a pendulum hangs aslant on a carriage that is accelerated, and straight on an even one") {
    const std::string
        begin = "gravity = [0, \"-g\"]\nparameters = { m = 1, l = 1, g = 9.81, A = 2, v = 3 }\n[coordinates]\n",
        end =
            "theta = 0.1\n[[particle]]\nname = \"P\"\nmass = \"m\"\n"
            "position = [\"x + l*sin(theta)\", \"-l*cos(theta)\"]\n[[constraint]]\nname = \"c\"\n";
    const Json faster = found(temporary("faster.toml", begin + "x = 0\n" + end + "holonomic = \"x = A*t^2/2\"\n"));
    const double pi = std::acos(-1.0), aslant = -std::atan(2 / 9.81);
    CHECK(are_close(values(faster, "theta"), {aslant, pi + aslant}, 1e-12));
    CHECK(faster["equilibria"][0]["moving"] == Json{"x"});
    const Json even = found(
        temporary("even.toml", begin + "x = { initial = 0, rate = \"v\" }\n" + end + "holonomic = \"x = v*t\"\n"));
    CHECK(are_close(values(even, "theta"), {0, pi}, 1e-12));
}

TEST_CASE("equilibrium: a mass on two springs stands where two inputs put it") {
    const Json one = found(temporary("two_inputs.toml", R"toml(
[parameters]
m = 2
k = 50
g = 9.81
[inputs]
above = 0.4
below = "0.1 + 0*t"
[coordinates]
y = 0
[energy]
kinetic = "m*y'^2/2"
potential = "k*(y - above)^2/2 + k*(y - below)^2/2 + m*g*y - (y - above)^6"
)toml"));
    REQUIRE(!one["equilibria"].empty());
    for (const Json& each : one["equilibria"]) CHECK(each["state"] == "proved");
}

TEST_CASE("equilibrium: inputs without amplitude are not in the solution, and it is in lowest terms") {
    const Json half_car = found(temporary("half_car.toml", R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
M = 1200
J = 1800
a = 1.2
b = 1.5
k1 = 40000
k2 = 45000
kt = 200000
mu1 = 60
A0 = 0
[inputs]
r1 = "A0*sin(3*t)"
r2 = "A0*sin(3*t - 2)"
[coordinates]
z = 0
th = 0
z1 = 0
[[frame]]
name = "B"
rotate = [["z", "th"]]
[[body]]
name = "body"
mass = "M"
inertia = "J"
frame = "B"
position = [0, "z"]
[[particle]]
name = "wheel"
mass = "mu1"
position = ["a", "z1"]
[[spring]]
along = "z + a*th - z1"
stiffness = "k1"
[[spring]]
along = "z - b*th - r2"
stiffness = "k2"
[[spring]]
along = "z1 - r1"
stiffness = "kt"
)toml"));
    REQUIRE(half_car["equilibria"].size() == 1);
    const Json& exact = half_car["equilibria"][0]["exact"];
    CHECK(exact["z1"] == "-(M*b+(a+b)*mu1)*g/((a+b)*kt)");
    for (const auto& [name, value] : exact.items()) {
        CAPTURE(value.dump());
        CHECK(value.dump().size() < 300);
        CHECK(value.dump().find("A0") == std::string::npos);
    }
}

TEST_CASE("equilibrium: scenes without equilibria are refused, each with its reason") {
    const auto says = [](const std::vector<std::string>& args, int code, const std::string& words) {
        const auto result = run(args);
        CAPTURE(result.err);
        CHECK(result.exit == code);
        CHECK(result.err.find(words) != std::string::npos);
    };
    says({"equilibrium", on_a_line("push.toml", "2*mu")}, 3, "the force along x' is 1 at every state");
    says({"equilibrium", on_a_line("none.toml", "1 + x^2")}, 2, "This is no proof that there is none");
    const std::string driven =
        temporary("driven.toml",
                  "coordinates = { x = 0 }\n[[constraint]]\nname = \"c\"\nnonholonomic = \"x' = t\"\n"
                  "[energy]\nkinetic = \"x'^2/2\"\n");
    says({"equilibrium", driven}, 3, "the rate of x holds t");
    says({"equilibrium", textbook("linked_particles")}, 2, "This is no proof that there is none");
    says({"equilibrium", textbook("cart_pole")}, 3, "the input F changes with time");
    says({"equilibrium", textbook("bouncing_ball"), "--at", "y=0", "--at", "y'=0"}, 3, "is closed at this state");
    says({"equilibrium", textbook("rotating_hoop"), "--follow", "theta=0:1"}, 3, "as an unknown");
    says({"equilibrium", textbook("rotating_hoop"), "--follow", "Omega=1"}, 3, "expected NAME=FROM:TO");
    says({"equilibrium", textbook("rotating_hoop"), "--follow", "Omega=1:1"}, 3, "two different numbers");
    says({"equilibrium", textbook("rotating_hoop"), "--svg", "x.svg"}, 3, "expected --vary");
}

}  // namespace commands_equilibrium
