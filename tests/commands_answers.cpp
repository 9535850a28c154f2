// SPDX-License-Identifier: MIT
// What people expect of an answer: the equilibrium near the start, shapes of modes in real numbers, no rounding in
// place of a zero, quotients in lowest terms. The numbers are compared with closed forms.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>

#include "program.hpp"
#include "scenes.hpp"

namespace commands_answers {

using Json = nlohmann::json;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

Json asked(const std::vector<std::string>& words, int exit = 0) {
    const auto result = run(words);
    CAPTURE(result.err);
    REQUIRE(result.exit == exit);
    return Json::parse(result.out);
}

constexpr const char* pendulum =
    "[coordinates]\nx = { initial = 0.5, rate = 0.3 }\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"-cos(x)\"\n";

}  // namespace

TEST_CASE("stability, linearize: a start that is no equilibrium leads to the one near it, which is told") {
    const std::string scene = temporary("pendulum.toml", pendulum);
    const Json near = asked({"stability", scene, "--json"});
    CHECK(near["verdict"] == "stable");
    CHECK(std::abs(near["reached"]["x"].get<double>()) < 1e-12);
    CHECK(near["reached"]["x'"] == 0);
    const auto text = run({"linearize", scene});
    CHECK(text.exit == 0);
    CHECK(text.out.find("The start is no equilibrium") != std::string::npos);
    // A state that was asked for is judged as it is.
    const auto given = run({"stability", scene, "--at", "x=0.5", "--at", "x'=0"});
    CHECK(given.exit == 3);
    CHECK(given.err.find("x'' = -0.479426") != std::string::npos);
    const std::string falls =
        temporary("falls.toml", "[coordinates]\nx = 0.5\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"x\"\n");
    CHECK(run({"stability", falls}).exit == 3);
    // The equilibrium above is unstable, and the start is nearer to it.
    const std::string above = temporary("above.toml", std::string(pendulum).replace(29, 3, "3.0"));
    const Json judged = asked({"stability", above, "--json"}, 1);
    CHECK(judged["reached"]["x"].get<double>() == doctest::Approx(std::numbers::pi));
}

TEST_CASE("stability: modes whose coordinates pass zero together have a real shape, those of a chain are sines") {
    std::string scene = "[coordinates]\n", kinetic, potential = "(x1^2";
    constexpr int n = 3;
    for (int k = 1; k <= n; ++k) {
        const std::string x = "x" + std::to_string(k), next = "x" + std::to_string(k + 1);
        scene += x + " = 0\n";
        kinetic += (k > 1 ? " + " : "") + x + "'^2/2";
        potential += k < n ? " + (" + next + "-" + x + ")^2" : " + " + x + "^2)/2";
    }
    scene += "[energy]\nkinetic = \"" + kinetic + "\"\npotential = \"" + potential + "\"\n";
    const Json modes = asked({"stability", temporary("chain.toml", scene), "--json"})["modes"];
    REQUIRE(modes.size() == n);
    for (const Json& mode : modes) {
        const double omega = mode["eigenvalue"][1];
        const int which = static_cast<int>(std::lround(2 * (n + 1) * std::asin(omega / 2) / std::numbers::pi));
        double largest = 0;
        for (int k = 1; k <= n; ++k)
            largest = std::max(largest, std::abs(std::sin(which * k * std::numbers::pi / (n + 1))));
        const double sign = mode["shape"]["x1"].get<double>() > 0 ? 1 : -1;
        for (int k = 1; k <= n; ++k)
            CHECK(sign * mode["shape"]["x" + std::to_string(k)].get<double>() ==
                  doctest::Approx(std::sin(which * k * std::numbers::pi / (n + 1)) / largest).epsilon(1e-9));
    }
    // With damping that is not in proportion the coordinates do not pass zero together.
    scene += "[dissipation]\nrayleigh = \"x1'^2/10\"\n";
    const Json damped = asked({"stability", temporary("damped.toml", scene), "--json"});
    CHECK(damped["modes"].size() == n);
    for (const Json& mode : damped["modes"]) CHECK(!mode.contains("shape"));
}

// Three masses in a ring of springs: of the double eigenvalue 3 every shape without a sum is one.
TEST_CASE(
    "stability: of an eigenvalue that is there twice the vectors are shown that leave out most, and no others") {
    const std::string ring = temporary("ring.toml", R"toml(
[coordinates]
x1 = 0
x2 = 0
x3 = 0
[energy]
kinetic = "(x1'^2 + x2'^2 + x3'^2)/2"
potential = "((x2 - x1)^2 + (x3 - x2)^2 + (x1 - x3)^2)/2"
)toml");
    std::vector<Json> shapes;
    const Json all = asked({"linearize", ring, "--json"});
    for (const Json& mode : all["modes"])
        if (std::abs(mode["eigenvalue"][1].get<double>() - std::sqrt(3.0)) < 1e-9) shapes.push_back(mode["shape"]);
    REQUIRE(shapes.size() == 2);
    const std::vector<std::array<double, 3>> expected{{1, 0, -1}, {0, 1, -1}};
    for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t i = 0; i < 3; ++i)
            CHECK(shapes[k]["x" + std::to_string(i + 1)].get<double>() ==
                  doctest::Approx(expected[k][i]).epsilon(1e-12));
}

TEST_CASE("stability: a molecule that nothing holds has a mode in which all atoms go alike") {
    std::vector<Json> zero;
    const Json all = asked({"linearize", source_path("scenes/textbook/triatomic_molecule.toml"), "--json"});
    for (const Json& mode : all["modes"])
        if (std::abs(mode["eigenvalue"][1].get<double>()) < 1e-6) zero.push_back(mode["shape"]);
    REQUIRE(zero.size() == 1);
    for (const char* atom : {"x1", "x2", "x3"})
        CHECK(zero[0][atom].get<double>() == doctest::Approx(1).epsilon(1e-8));
}

TEST_CASE("stability: the period of coefficients that are sines of t is found") {
    const auto scene = [](const std::string& factor) {
        return temporary(
            "swing.toml",
            "[parameters]\na = 1.2\nq = 0.3\nw = 2\n[coordinates]\nx = 0\n[energy]\nkinetic = \"x'^2/2\"\n"
            "potential = \"(a - 2*q*" +
                factor + ")*x^2/2\"\n");
    };
    const std::string mathieu = scene("cos(w*t)");
    const auto found = run({"stability", mathieu, "--json"});
    const auto given = run({"stability", mathieu, "--json", "--period", "3.14159265358979323846"});
    const Json own = Json::parse(found.out), asked_for = Json::parse(given.out);
    CHECK(found.exit == given.exit);
    CHECK(own["verdict"] == asked_for["verdict"]);
    CHECK(own["period"].get<double>() == doctest::Approx(std::numbers::pi).epsilon(1e-15));
    CHECK(own["period_found"] == true);
    CHECK(asked_for["period_found"] == false);
    CHECK(std::abs(own["floquet"][0][0].get<double>() - asked_for["floquet"][0][0].get<double>()) < 1e-9);
    const Json two = Json::parse(run({"stability", scene("(cos(w*t)+sin(3*w*t/2))"), "--json"}).out);
    CHECK(two["period"].get<double>() == doctest::Approx(2 * std::numbers::pi).epsilon(1e-15));
    const Json shifted = Json::parse(run({"stability", scene("cos(w*t+a)"), "--json", "--at", "w=4"}).out);
    CHECK(shifted["period"].get<double>() == doctest::Approx(std::numbers::pi / 2).epsilon(1e-15));
    // A parameter that depends on others
    const std::string dependent = temporary(
        "dependent.toml",
        "[parameters]\na = 1\nq = 0.1\nv = 3\nw = \"2*v\"\n[coordinates]\nx = 0\n[[particle]]\nname = "
        "\"P\"\nmass = 1\nposition = [\"x\", 0]\n[[force]]\nat = \"P\"\nvector = [\"-(a-2*q*cos(w*t))*x\", 0]\n");
    CHECK(asked({"stability", dependent, "--json"}, 0)["period"].get<double>() ==
          doctest::Approx(std::numbers::pi / 3).epsilon(1e-15));
    CHECK(run({"stability", scene("cos(t^2)")}).exit == 3);
    CHECK(run({"stability", scene("(cos(t)+cos(sqrt(2)*t))")}).exit == 3);
    CHECK(run({"stability", scene("t*cos(t)")}).exit == 3);
}

TEST_CASE("stability: squares of parameters are no conditions") {
    for (const char* const name :
         {"textbook/foucault_pendulum", "textbook/double_pendulum_joints", "stability/gyroscopic"}) {
        CAPTURE(name);
        const auto result = run({"stability", source_path(std::string("scenes/") + name + ".toml"), "--json"});
        const Json conditions = Json::parse(result.out)["conditions"];
        CHECK(!conditions.empty());
        for (const Json& condition : conditions) {
            CAPTURE(condition.get<std::string>());
            CHECK(!std::regex_search(condition.get<std::string>(),
                                     std::regex("(^|[*])[A-Za-z]\\w*\\^2([*][A-Za-z0-9]+)* > 0")));
        }
    }
}

// The pendulum of length l with a spring and a damper, by its angle and by x and y with a rod: the conditions are
// those of m l^2 s^2 + c l^2 s + (m g + k l) l, and the sign of the second decides about the verdict.
TEST_CASE("stability: conditions in the parameters with a constraint") {
    const std::string scene = temporary(
        "rod.toml",
        "gravity = [0, \"-g\"]\n[parameters]\nm = 1\nl = 2\ng = 9\nc = 0.1\nk = 3\n[coordinates]\nx = 0\n"
        "y = { initial = \"-l\" }\n[[particle]]\nname = \"A\"\nmass = \"m\"\nposition = [\"x\", \"y\"]\n"
        "[[spring]]\nstiffness = \"k\"\nalong = \"x\"\nlength = 0\n[[damper]]\ndamping = \"c\"\nalong = \"x\"\n"
        "[[constraint]]\nname = \"rod\"\nholonomic = \"x^2 + y^2 = l^2\"\n");
    const Json conditions = asked({"stability", scene, "--json"})["conditions"];
    CHECK(conditions == Json{"c > 0", "(m*g+l*k)*l > 0"});
    CHECK(asked({"stability", scene, "--json", "--at", "k=-4"})["verdict"] == "asymptotically stable");
    CHECK(asked({"stability", scene, "--json", "--at", "k=-5"}, 1)["verdict"] == "unstable");
}

TEST_CASE("stability: conditions are those of the state that was asked for, however its number was typed") {
    const std::string scene = temporary(
        "turned.toml",
        "[parameters]\nm = 1\nl = 1.6\nT0 = 0.4\n[coordinates]\ntheta = { initial = -0.4 }\n[[particle]]\nname = "
        "\"P\"\n"
        "mass = \"m\"\nposition = [\"l*sin(theta)\", \"-l*cos(theta)\"]\n[forces]\ntheta = \"-T0*sin(theta)\"\n");
    for (const char* const at :
         {"theta=pi", "theta=-pi", "theta=180 deg", "theta=3*pi", "theta=2*atan(1) + pi/2"}) {
        CAPTURE(at);
        CHECK(asked({"stability", scene, "--json", "--at", at}, 1)["conditions"] == Json{"T0 < 0"});
    }
    CHECK(asked({"stability", scene, "--json", "--at", "theta=0"})["conditions"] == Json{"T0 > 0"});
    CHECK(asked({"stability", scene, "--json", "--at", "theta=-2*pi"})["conditions"] == Json{"T0 > 0"});
}

// About a minimum of the potential with c = 0 the roots are on the axis: the sign of the power decides.
TEST_CASE("stability and equilibrium: drag that is no linear damping decides by the energy") {
    const auto asked_of = [](const std::string& parameters, const std::string& forces) {
        const std::string scene =
            temporary("drag.toml",
                      "[parameters]\nm = 1\nk = 3\n" + parameters +
                          "\n[coordinates]\nx = 0\ny = 0\n[[particle]]\nname = \"P\"\nmass = \"m\"\n"
                          "position = [\"x\", \"y\"]\n[[spring]]\nstiffness = \"k\"\nalong = \"x\"\n[[spring]]\n"
                          "stiffness = \"2*k\"\nalong = \"y\"\n[forces]\n" +
                          forces + "\n");
        const Json rest = Json::parse(run({"equilibrium", scene, "--json"}).out)["equilibria"][0];
        const Json verdict = Json::parse(run({"stability", scene, "--json"}).out)["verdict"];
        return std::pair<std::string, std::string>(rest["stable"], verdict);
    };
    using Told = std::pair<std::string, std::string>;
    const std::string drag = "x = \"-c*norm(vel(P))*x'\"\ny = \"-c*norm(vel(P))*y'\"";
    CHECK(asked_of("c = 0.2", drag) == Told("yes", "stable"));
    CHECK(asked_of("c = -0.2", drag) == Told("undecided", "undecided"));
    CHECK(asked_of("b = -0.1\nc = \"-2*b\"", drag) == Told("yes", "stable"));
    CHECK(asked_of("c = -0.2", "x = \"c*abs(x')*x'\"\ny = \"c^3*y^2*y'\"") == Told("yes", "stable"));
    CHECK(asked_of("c = 0.2", "x = \"-c*abs(x')*x' - c*y*abs(x')\"\ny = \"-y'*max(0, abs(y') - 1)\"") ==
          Told("undecided", "undecided"));
    CHECK(asked_of("c = 0.2", "x = \"-c*abs(x')*x' - c*y'\"\ny = \"c*x' - y'*max(0, abs(y') - 1)\"") ==
          Told("yes", "stable"));
    CHECK(asked_of("c = 0.2", "x = \"-c*abs(x')*x' - c*y\"\ny = \"c*x\"") == Told("undecided", "undecided"));
    const std::string oscillator =
        temporary("oscillator.toml",
                  "[parameters]\nc = 1\n[coordinates]\nx = 0\n[energy]\nkinetic = \"x'^2/2\"\n"
                  "potential = \"x^2/2\"\n[forces]\nx = \"-c*abs(x')*x'\"\n");
    for (const auto& [at, word, verdict] :
         {std::array{"c=2", "yes", "stable"}, std::array{"c=-1/4", "no", "unstable"},
          std::array{"c=0", "yes", "stable"}}) {
        CAPTURE(at);
        CHECK(Json::parse(run({"equilibrium", oscillator, "--json", "--at", at}).out)["equilibria"][0]["stable"] ==
              word);
        CHECK(Json::parse(run({"stability", oscillator, "--json", "--at", at}).out)["verdict"] == verdict);
    }
    const auto pendulum = [](const std::string& sign) {
        return temporary(
            "pendulum.toml",
            "gravity = [0, \"-g\"]\n[parameters]\nm = 1\nl = 2\ng = 9.81\nc = 0.5\n[coordinates]\nth = 0\n"
            "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"l*sin(th)\", \"-l*cos(th)\"]\n[forces]\n"
            "th = \"" +
                sign + "c*abs(th')*th'\"\n");
    };
    for (const auto& [sign, word, verdict] :
         {std::array{"-", "yes", "stable"}, std::array{"", "no", "unstable"}}) {
        CAPTURE(sign);
        const std::string scene = pendulum(sign);
        const Json list = Json::parse(run({"equilibrium", scene, "--json"}).out)["equilibria"];
        REQUIRE(list.size() == 2);
        for (const Json& one : list)
            CHECK(one["stable"] == (std::abs(one["coordinates"]["th"].get<double>()) < 1 ? word : "no"));
        CHECK(Json::parse(run({"stability", scene, "--json"}).out)["verdict"] == verdict);
    }
}

TEST_CASE("derive --steps leads from positions to velocities, squares of speeds, T and d/dt, and check reads it") {
    const std::string scene = source_path("scenes/textbook/double_pendulum.toml");
    const std::string text = run({"derive", scene, "--steps"}).out;
    std::size_t last = 0;
    for (const char* const line :
         {"x_M1 = l1*sin(theta1)", "x_M1' = l1*theta1'*cos(theta1)", "v_M1^2 = l1^2*theta1'^2",
          "T of particle M1 = m1*l1^2*theta1'^2/2", "d/dt dT/d(theta1') = (m1+m2)*l1^2*theta1''"}) {
        CAPTURE(line);
        const std::size_t at = text.find(line);
        REQUIRE(at != std::string::npos);
        CHECK(at > last);
        last = at;
    }
    const Json read = asked({"check", scene, temporary("steps.txt", text), "--json"});
    int right = 0;
    for (const Json& line : read["lines"]) {
        CAPTURE(line["source"].get<std::string>());
        right += line["status"] == "right" ? 1 : 0;
        CHECK((line["status"] == "right" || line["status"] == "not_about_scene"));
    }
    CHECK(right > 25);
}

TEST_CASE("inertia: a rod has no moment about its axis, whichever way it lies") {
    const std::string scene = temporary(
        "rod.toml",
        "[coordinates]\na = 0.7\n[[frame]]\nname = \"B\"\nrotate = [[\"z\", \"a\"]]\n[[body]]\nname = \"rod\"\n"
        "mass = 3\nframe = \"B\"\nposition = [0, 0, 0]\ninertia = { xx = 0, yy = 0.1, zz = 0.1 }\n");
    const Json inertia = asked({"inertia", scene, "--json"});
    for (const Json& one : inertia["principal"]) {
        const double moment = one["moment"];
        CHECK((moment == 0 || moment == doctest::Approx(0.1)));
    }
}

TEST_CASE("derive: a sum that stands above and below a fraction line is cancelled") {
    const std::string scene = temporary("parabola.toml",
                                        "[parameters]\nm = 1\nk = 2\np = 1\nl0 = 0.1\n[coordinates]\nx = "
                                        "0.5\n[[particle]]\nname = \"P\"\nmass = \"m\"\n"
                                        "position = [\"x\", \"x^2/(2*p)\"]\n[[spring]]\nbetween = [\"O\", "
                                        "\"P\"]\nstiffness = \"k\"\nlength = \"l0\"\n");
    const std::string text = run({"derive", scene}).out;
    CHECK(text.find("k*(2*p^2+x^2)*x ") != std::string::npos);
    CHECK(text.find("(4*p^2+x^2)*x/(4*p^2+x^2)") == std::string::npos);
}

}  // namespace commands_answers
