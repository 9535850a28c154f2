// SPDX-License-Identifier: MIT
// Where equilibria meet, roundings decide nothing; what switches is no constant; branches are the same whichever
// way the parameter runs. What is right is known from the forces, which are written down.
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"

namespace commands_equilibria_meet {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

std::string pushed(const std::string& force, const std::string& more = "", double start = 0) {
    return temporary("pushed.toml",
                     fmt::format("[parameters]\np = 0.3\nk = 3.2\n[coordinates]\nx = {{ initial = {} }}\n"
                                 "[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", 0]\n"
                                 "[forces]\nx = \"{}\"\n{}",
                                 start, force, more));
}

}  // namespace

TEST_CASE("equilibrium, stability: a saddle-node is called stable from neither side") {
    int judgements = 0;
    for (const char* force : {"-(x + 0.4)^2", "(x - 0.3)^2", "(x - 0.3)^2 - x'/2", "-(x + 1.7)^2 - 0.01*x'",
                              "-x^3 - 1.5*x^2 + 0.72*x - 0.076", "x^3 - 4.3*x^2 + 5.95*x - 2.601 - 3*x'"})
        for (const double start : {-0.5, 0.2, 0.31, 1.6}) {
            CAPTURE(std::string(force));
            CAPTURE(start);
            const std::string scene = pushed(force, "", start);
            for (const Json& one : json_of({"equilibrium", scene, "--json"})["equilibria"]) {
                const double x = one["coordinates"]["x"];
                const bool is_double = std::min({std::abs(x + 0.4), std::abs(x - 0.3), std::abs(x + 1.7),
                                                 std::abs(x - 0.2), std::abs(x - 1.7)}) < 1e-3;
                if (is_double) CHECK(one["stable"] != "yes");
            }
            const auto judged = run({"stability", scene, "--json"});
            if (judged.exit == 3) continue;  // Newton's method reaches no state from there
            const Json verdict = Json::parse(judged.out);
            const double x = verdict["coordinates"]["x"];
            if (std::abs(x + 1.9) < 1e-3 || std::abs(x - 0.9) < 1e-3) continue;  // the simple roots
            CHECK(verdict["verdict"] != "stable");
            CHECK(verdict["verdict"] != "asymptotically stable");
            ++judgements;
        }
    CHECK(judgements > 10);
}

// The force is negative on both sides of x = √2, whatever digits are typed.
TEST_CASE("stability: a root that is typed as such is known to the digits of a double") {
    const std::string scene = pushed("-(x^2 - 2)^2 - x'");
    for (const char* at : {"x=sqrt(2)", "x=-sqrt(2)", "x=1.4142135623730951", "x=1.4142135623730950"}) {
        CAPTURE(std::string(at));
        const Json found = Json::parse(run({"stability", scene, "--at", at, "--json"}).out);
        CHECK(found["verdict"] != "stable");
        CHECK(found["verdict"] != "asymptotically stable");
    }
    const Json exact =
        Json::parse(run({"stability", pushed("(x - 0.3)^2 - x'/2"), "--at", "x=0.3", "--json"}).out);
    CHECK(exact["verdict"] == "unstable");
}

TEST_CASE("equilibrium: a verdict that rests on numbers says so") {
    const auto kinds = [](const Json& one) {
        std::vector<std::string> list;
        for (const Json& assumed : one["assumed"]) list.push_back(assumed["kind"]);
        return list;
    };
    const std::string well = pushed("x - x^3 - x'/2");
    for (const Json& one : json_of({"equilibrium", well, "--json"})["equilibria"]) {
        CHECK(one["stable"] != "undecided");
        CHECK(kinds(one) == std::vector<std::string>{"numbers"});
    }
    CHECK(run({"equilibrium", well}).out.find("Not proved of 1, 2, 3: ") != std::string::npos);
    const std::string fold = pushed("(x - 0.3)^2 - x'/2");  // where the first approximation does not decide
    for (const Json& one : json_of({"equilibrium", fold, "--json"})["equilibria"]) CHECK(kinds(one).empty());
    CHECK(run({"equilibrium", fold}).out.find("Not proved of") == std::string::npos);
}

TEST_CASE("equilibrium: a double or triple root is listed once") {
    for (const char* force : {"-(x - 0.2)^2*(x + 1.9)", "-x^3 - 1.5*x^2 + 0.72*x - 0.076",
                              "x^3 + 1.8*x^2 + 1.08*x + 0.216", "x^3 - 1.2*x^2 + 0.48*x - 0.064 - 0.5*x'"}) {
        CAPTURE(std::string(force));
        const Json found = json_of({"equilibrium", pushed(force), "--json"})["equilibria"];
        std::vector<double> roots;
        for (const Json& one : found) roots.push_back(one["coordinates"]["x"]);
        std::sort(roots.begin(), roots.end());
        for (std::size_t i = 1; i < roots.size(); ++i) CHECK(roots[i] - roots[i - 1] > 0.1);
        CHECK(roots.size() >= 1);
        CHECK(roots.size() <= 2);
    }
}

TEST_CASE("stability, equilibrium: what switches at a time is no constant") {
    for (const char* force : {"-x - 0.1*sign(5 - t)*x'", "-x - 0.5*sign(2*t - 50)*x'", "-max(1, t - 7)*x - x'"}) {
        CAPTURE(std::string(force));
        CHECK(run({"stability", pushed(force)}).exit == 3);
        CHECK(run({"equilibrium", pushed(force)}).exit == 3);
    }
}

TEST_CASE("equilibrium, stability: a force that is too flat to be seen nearby is there all the same") {
    for (const char* force : {"x^25", "-x^25", "k*x^31 - 0.1*x'", "x^21*exp(x)"}) {
        CAPTURE(std::string(force));
        const std::string scene = pushed(force);
        const Json found = json_of({"equilibrium", scene, "--json"});
        CHECK(found["cyclic"].empty());
        if (force[0] == '-') continue;  // at rest there it is stable
        for (const Json& one : found["equilibria"]) CHECK(one["stable"] != "yes");
        const Json judged = Json::parse(run({"stability", scene, "--json"}).out);
        CHECK(judged["verdict"] != "stable");
        CHECK(judged["verdict"] != "asymptotically stable");
    }
}

TEST_CASE("equilibrium: beyond a clearance is where a weight rests") {
    const Json found =
        json_of({"equilibrium", pushed("-9.81 - 100*max(0, x - 1) + 100*max(0, -x - 1)"), "--json"});
    REQUIRE(found["equilibria"].size() == 1);
    CHECK(double(found["equilibria"][0]["coordinates"]["x"]) == doctest::Approx(-1.0981));
}

TEST_CASE("equilibrium: branches are the same whichever way the parameter runs") {
    const std::string scene = pushed("(p - 0.2)*x - x^2");
    const Json up = json_of({"equilibrium", scene, "--vary", "p=-1.8:1.2", "--json"}),
               down = json_of({"equilibrium", scene, "--vary", "p=1.2:-1.8", "--json"});
    REQUIRE(up["branches"].size() == down["branches"].size());
    for (std::size_t k = 0; k < up["branches"].size(); ++k) CHECK(up["branches"][k] == down["branches"][k]);
    REQUIRE(up["points"].size() == 1);
    CHECK(double(up["points"][0]["parameter"]) == doctest::Approx(0.2));
}

TEST_CASE("stability: a kink that is differentiable does not hide where a root crosses") {
    const Json found = json_of({"stability", pushed("p*x - x' - x*abs(x)"), "--vary", "p=-0.5:2.3", "--json"});
    REQUIRE(found["crossings"].size() == 1);
    CHECK(std::abs(double(found["crossings"][0]["value"])) < 1e-6);
    CHECK(found["without_roots"] == 0);
}

TEST_CASE("equilibrium: a pitchfork is found once, where the stiffness of both branches vanishes") {
    for (const char* force : {"(p - 0.5)*x - x^3", "p*x - x^3", "(p + 0.4)*x - x^3"})
        for (const char* range : {"p=1.2:-0.9", "p=-0.9:1.2", "p=0.7:-1"}) {
            CAPTURE(std::string(force));
            CAPTURE(std::string(range));
            const Json found = json_of({"equilibrium", pushed(force), "--vary", range, "--json"});
            REQUIRE(found["points"].size() == 1);
            CHECK(found["points"][0]["kind"] == "pitchfork");
            const double at = std::string(force).find("0.5") != std::string::npos   ? 0.5
                              : std::string(force).find("0.4") != std::string::npos ? -0.4
                                                                                    : 0;
            CHECK(std::abs(double(found["points"][0]["parameter"]) - at) < 1e-6);
        }
}

TEST_CASE("equilibrium: where every state is one, the branches meet one family, from either side") {
    for (const char* range : {"p=-1:1", "p=1:-1", "p=0:1", "p=-2:0.3"}) {
        CAPTURE(std::string(range));
        const Json found = json_of({"equilibrium", pushed("p*sin(x)"), "--vary", range, "--json"});
        std::size_t families = 0;
        for (const Json& branch : found["branches"])
            if (branch.contains("family_at")) {
                ++families;
                CHECK(std::abs(branch["family_at"].get<double>()) < 1e-12);
            }
        CHECK(families == 1);
        CHECK(found["branches"].size() == 3);
        for (const Json& point : found["points"]) CHECK(point["kind"] == "family");
    }
}

TEST_CASE("equilibrium: a fork beside a family is a fork, however narrow the range is") {
    const Json found =
        json_of({"equilibrium", pushed("-p*((0.0005 - p)*x + x^3)"), "--vary", "p=-0.001:0.001", "--json"});
    bool has_fork = false;
    for (const Json& point : found["points"])
        has_fork = has_fork ||
                   (point["kind"] == "pitchfork" && std::abs(point["parameter"].get<double>() - 0.0005) < 1e-8);
    CHECK(has_fork);
}

// V = (x - a)^5/5 along the soft direction: the force is never positive there, so that every such rest is
// unstable, and Newton's method comes no nearer to it than 1e-4.
TEST_CASE("equilibrium, stability: a rest of high multiplicity is one, and unstable where its state is exact") {
    for (const auto& [a, slope] : {std::pair("0.5", "0.5"), std::pair("0.3", "2"), std::pair("-1.2", "1")}) {
        CAPTURE(a);
        const std::string scene = temporary(
            "flat.toml",
            fmt::format("[coordinates]\nx = \"{0} + 0.1\"\ny = 0.3\n[energy]\nkinetic = \"(x'^2 + y'^2)/2\"\n"
                        "potential = \"(x - ({0}))^5/5 + 0.9*(y - {1}*x)^2\"\n[forces]\n"
                        "x = \"-x'/2\"\ny = \"-y'/2\"\n",
                        a, slope));
        const Json found = json_of({"equilibrium", scene, "--json"});
        REQUIRE(found["equilibria"].size() == 1);
        CHECK(found["equilibria"][0]["stable"] == "no");
        CHECK(run({"stability", scene}).out.find("stable:") == std::string::npos);
    }
}

// Positive definite forms that are not convex: what grows beside such a minimum says nothing. And a sine of a
// coordinate that is no angle has a rest in each of its turns.
TEST_CASE(
    "equilibrium: strict minima of high degree are stable, and lists that lack turns are not called complete") {
    const auto of = [](const std::string& potential) {
        return json_of({"equilibrium",
                        temporary("V.toml",
                                  "[coordinates]\nx = 0.2\ny = 0.3\n[energy]\nkinetic = \"(x'^2 + "
                                  "y'^2)/2\"\npotential = \"" +
                                      potential + "\"\n"),
                        "--json"});
    };
    for (const char* potential :
         {"(x-0.3)^4+(y-0.7)^4-(x-0.3)^3*(y-0.7)", "((x-0.3)^2+(y-0.2)^2)^3/6-(x-0.3)^2*(y-0.2)^4"}) {
        const Json found = of(potential);
        REQUIRE(found["equilibria"].size() == 1);
        CHECK(found["equilibria"][0]["stable"] == "yes");
    }
    CHECK(of("(y - x/3)^2/2 + cos(x)")["complete"] == false);
    CHECK(of("(y - sin(x))^2/2 + cos(x)")["complete"] == true);
}

// A shaft with internal friction that turns faster than it swings: whirl grows (a classical result on rotors).
TEST_CASE("stability: dampers along turning axes may push, and the energy is no proof") {
    const std::string shaft =
        "[parameters]\nm = 1\nk = 1\nc = 0.2\nW = 3\n[coordinates]\nx = 0\ny = 0\n"
        "[[particle]]\nname = \"P\"\nmass = \"m\"\nposition = [\"x\", \"y\"]\n"
        "[energy]\npotential = \"k*(x^2 + y^2)/2\"\n"
        "[[frame]]\nname = \"R\"\nrotate = [[\"z\", \"W*t\"]]\n";
    const auto dampers = [](const std::string& damping) {
        std::string text;
        for (const char* axis : {"ex", "ey"})
            text += fmt::format("[[damper]]\nalong = \"dot(pos(P), {}(R))\"\ndamping = \"{}\"\n", axis, damping);
        return text;
    };
    const auto verdict = [&](const std::string& damping) {
        const auto found = run({"stability", temporary("shaft.toml", shaft + dampers(damping)), "--json"});
        return std::string(Json::parse(found.out)["verdict"]);
    };
    CHECK(verdict("c") == "unstable");
    CHECK(verdict("c*(x^2 + y^2)") == "undecided");
}

TEST_CASE("equilibrium, stability: that a state found in numbers is one is proved, or told") {
    const auto stability = [](const std::string& scene, const std::string& at) {
        return json_of({"stability", scene, "--at", at});
    };
    // cos x = x once, at 0.7390851332151606.
    const std::string scene = pushed("cos(x) - x", "", 0.7);
    const Json once = json_of({"equilibrium", scene})["equilibria"];
    REQUIRE(once.size() == 1);
    CHECK(once[0]["state"] == "proved");
    CHECK(std::abs(once[0]["coordinates"]["x"].get<double>() - 0.7390851332151606) < 1e-13);
    const Json there = json_of({"stability", scene});
    CHECK(there["verdict"] == "stable");
    CHECK(there["state"] == "proved");
    CHECK(there["assumed"].empty());
    CHECK(stability(pushed("-k*x"), "x=0")["state"] == "exact");

    // Not by a hair: no state of rest (the least force is 4e-30), and two that no double tells apart.
    for (const char* force : {"-((x^2 - 2)^2 + 4e-30)", "-((x^2 - 2)^2 - 4e-30) - x'/2"}) {
        CAPTURE(std::string(force));
        const std::string near = pushed(force, "", 1.4);
        const Json found = json_of({"equilibrium", near});
        for (const Json& one : found["equilibria"]) {
            CHECK(one["state"] != "proved");
            CHECK(one["stable"] == "undecided");
        }
        const auto told = run({"stability", near, "--json"});
        CHECK((told.exit == 2 || told.exit == 3));  // undecided, or no state of rest
    }

    // With constraints, and with signs that are decided in floating point.
    const std::string linkage =
        "[coordinates]\nx = { initial = 0.6 }\ny = { initial = -0.8 }\n[[particle]]\nname = \"P\"\nmass = 2\n"
        "position = [\"x\", \"y\"]\n[[point]]\nname = \"H\"\noffset = [1, 0]\n[[spring]]\nbetween = [\"P\", "
        "\"H\"]\nstiffness = 7\n"
        "length = 0.3\n[[constraint]]\nname = \"rod\"\nholonomic = \"x^2 + y^2 = 1\"\n";
    const Json held =
        json_of({"equilibrium", temporary("held.toml", "gravity = [0, -9.81]\n" + linkage)})["equilibria"];
    REQUIRE(held.size() >= 2);
    for (const Json& one : held) CHECK(one["state"] == "proved");
    const Json drag = stability(pushed("-k*x - x'*abs(x')"), "x=0");
    CHECK(drag["verdict"] == "stable");
    CHECK(drag["assumed"][0]["kind"] == "numbers");
}

}  // namespace commands_equilibria_meet
