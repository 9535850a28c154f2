// SPDX-License-Identifier: MIT
// `method = "auto"`: what it chooses, what it says, and that the result is that of a method given by name.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "codegen/machine/can_run.hpp"
#include "files.hpp"
#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"
#include "shell.hpp"

namespace commands_method {

using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::run_shell;
using alembert::test::source_path;
using alembert::test::temporary;
using alembert::test::temporary_folder;

namespace {

const char* const oscillator = R"toml(
[coordinates]
x = 1
[energy]
kinetic = "x'^2/2"
potential = "x^2/2"
[simulation]
duration = 20
)toml";

// The eigenvalues are about -1e5 and -1; x follows sin(t) slowly.
const char* const stiff = R"toml(
[coordinates]
x = 0
[energy]
kinetic = "x'^2/2"
[forces]
x = "-1e5*x' - 1e5*(x - sin(t))"
[simulation]
duration = 20
)toml";

/// Chosen by counts alone, so that the method is the same on every machine.
Json simulated(const std::string& scene, const std::vector<std::string>& more) {
    return json_of({"simulate", scene, "--no-estimate", "--no-tuning"}, more);
}

/// The digits of the end and what led to them.
Json result_of(const Json& run) {
    return {run["final"], run["steps"], run["rejected"], run["energy_drift"]};
}

void check_choice(const std::vector<std::string>& options, const std::string& method, const std::string& because) {
    const Json result = simulated(temporary("oscillator.toml", oscillator), options);
    CHECK(result["method"] == method);
    CHECK(result["method_why"].get<std::string>().find(because) != std::string::npos);
    CHECK(std::abs(result["final"]["coordinates"]["x"].get<double>() - std::cos(20)) < 1e-3);
}

}  // namespace

TEST_CASE("auto: tolerance, step, structure and length choose the method, and the run says why") {
    check_choice({"--tolerance", "1e-4", "--code", "compiled"}, "rkn86", "the tolerance 0.0001");
    if (alembert::machine::can_run()) check_choice({"--tolerance", "1e-3"}, "taylor", "power series");
    check_choice({"--tolerance", "1e-5", "--code", "compiled"}, "rkn1210", "the tolerance 1e-05");
    if (alembert::machine::can_run()) check_choice({"--tolerance", "1e-5"}, "taylor", "power series");
    check_choice({"--tolerance", "1e-9", "--code", "compiled"}, "rkn1210", "the tolerance 1e-09");
    check_choice({"--tolerance", "1e-11"}, "taylor", "power series");
    check_choice({"--tolerance", "1e-14"}, "taylor", "power series");
    check_choice({"--step", "0.01"}, "rk4", "fixed step");
    check_choice({"--step", "0.001"}, "kahanli8", "20000 steps");
    const auto text = run({"simulate", temporary("oscillator.toml", oscillator), "--tolerance", "1e-4", "--code",
                           "compiled", "--no-estimate", "--no-tuning"});
    CHECK(text.out.find("method: rkn86, chosen for the tolerance 0.0001") != std::string::npos);
    // For a method given by name no reason is given.
    CHECK(!simulated(temporary("oscillator.toml", oscillator), {"--method", "dop853"}).contains("method_why"));
}

TEST_CASE("auto: a linkage takes dop853 longer than a body that a quaternion turns, and then fewer evaluations") {
    for (const auto& [scene, method] : {std::pair{"scenes/benchmark/four_bars_2.toml", "dop853"},
                                        std::pair{"scenes/textbook/heavy_top_joint.toml", "verner98"}})
        CHECK(simulated(source_path(scene),
                        {"--tolerance", "1e-8", "--duration", "0.1", "--code", "compiled"})["method"] == method);
    if (!alembert::machine::can_run()) return;
    const std::string linkage = source_path("scenes/gallery/rssr.toml");
    CHECK(simulated(linkage, {"--tolerance", "1e-7"})["method"] == "dop853");
    const Json chosen = simulated(linkage, {"--tolerance", "1e-9"}),
               stages = simulated(linkage, {"--tolerance", "1e-9", "--method", "dop853"});
    CHECK(chosen["method"] == "verner98");
    CHECK(chosen["evaluations"].get<long>() < 0.7 * static_cast<double>(stages["evaluations"].get<long>()));
    CHECK(chosen["energy_drift"].get<double>() < 1e-11);
}

TEST_CASE(
    "auto: bodies that attract each other take methods for accelerations of positions, at less than half of the "
    "evaluations") {
    const std::string planets = source_path("scenes/benchmark/outer_solar_system.toml");
    const std::vector<std::string> shorter = {"--duration", "20000", "--sample", "20000", "--no-tuning"};
    const auto of = [&](const std::string& tolerance, const std::vector<std::string>& more) {
        std::vector<std::string> words = {"--tolerance", tolerance};
        words.insert(words.end(), more.begin(), more.end());
        words.insert(words.end(), shorter.begin(), shorter.end());
        return simulated(planets, words);
    };
    const Json exact = of("1e-13", {"--method", "verner98"}), strict = of("1e-10", {}), loose = of("1e-4", {}),
               others = of("1e-10", {"--method", "verner98"});
    CHECK(loose["method"] == "rkn86");
    CHECK(strict["method"] == "rkn1210");
    CHECK(strict["evaluations"].get<long>() < others["evaluations"].get<long>() / 2);
    for (const auto& [name, x] : exact["final"]["coordinates"].items()) {
        CAPTURE(name);
        CHECK(std::abs(strict["final"]["coordinates"][name].get<double>() - x.get<double>()) < 1e-9);
        CHECK(std::abs(loose["final"]["coordinates"][name].get<double>() - x.get<double>()) < 1e-3);  // 8e-5
    }
    // With loads whose work is integrated, or events, others cost less.
    const std::string
        driven =
            temporary("driven.toml",
                      "[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"x^4/4\"\n[forces]\nx = "
                      "\"cos(t)\"\n[simulation]\nduration = 5\n"),
        watched = temporary("watched.toml",
                            "[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"x^4/4\"\n"
                            "[[event]]\nname = \"turn\"\nwhen = \"x'\"\n[simulation]\nduration = 5\n");
    for (const std::string& scene : {driven, watched})
        CHECK(simulated(scene, {"--tolerance", "1e-4", "--code", "compiled"})["method"] == "dop853");
}

TEST_CASE(
    "auto: in a scene without a power series, or one that is too long for it, tight tolerances take verner98") {
    const std::string kink = temporary("kink.toml",
                                       "[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\n[forces]\nx = "
                                       "\"-abs(x)*x\"\n[simulation]\nduration = 1\n");
    CHECK(simulated(kink, {"--tolerance", "1e-14"})["method"] == "verner98");
}

TEST_CASE(
    "auto: with forces that depend on rates, a long run with a fixed step does not use a symplectic method") {
    const std::string damped = temporary("damped.toml",
                                         "[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\n[forces]\nx = "
                                         "\"-x - 0.01*x'\"\n[simulation]\nduration = 20\n");
    CHECK(simulated(damped, {"--step", "0.001"})["method"] == "rk4");
}

TEST_CASE("auto: a stiff run goes on with radau and its emitted Jacobian, and ends where radau alone ends") {
    const std::string scene = temporary("stiff.toml", stiff);
    const Json result = simulated(scene, {"--tolerance", "1e-8"}),
               radau = simulated(scene, {"--tolerance", "1e-10", "--method", "radau"});
    REQUIRE(result.contains("switched"));
    CHECK(result["method"] == (alembert::machine::can_run() ? "taylor" : "verner98"));
    CHECK(result["switched"]["method"] == "radau");
    CHECK(result["switched"]["why"] == "stiff");
    CHECK(result["switched"]["time"].get<double>() < 1);
    // The eigenvalues are about -1e5 and -1.
    CHECK(std::abs(result["switched"]["largest_eigenvalue"].get<double>() / 1e5 - 1) < 0.1);
    CHECK(result.contains("jacobian_operations"));
    CHECK(result["evaluations"].get<long>() < 200000);  // dop853 alone: 20 s · 1e5/s / 6 steps of 12, 4 000 000
    CHECK(std::abs(result["final"]["coordinates"]["x"].get<double>() -
                   radau["final"]["coordinates"]["x"].get<double>()) < 1e-6);
    CHECK(std::abs(result["final"]["time"].get<double>() - 20) == 0);
    const auto text = run({"simulate", scene, "--tolerance", "1e-8", "--no-estimate", "--no-tuning"});
    CHECK(text.out.find("the system is stiff there") != std::string::npos);
}

// Two four-bars whose bars are all in a line in the course of the motion, where the rank of the constraints drops.
TEST_CASE("auto: where a linkage comes to lie flat, dop853 goes on and keeps the energy as if it had begun") {
    if (!alembert::machine::can_run()) return;
    const std::string scene = source_path("scenes/benchmark/four_bars_2.toml");
    for (const char* const tolerance : {"1e-10", "1e-11"}) {
        const Json result = simulated(scene, {"--tolerance", tolerance}),
                   stages = simulated(scene, {"--tolerance", tolerance, "--method", "dop853"});
        CHECK(result["method"] == "taylor");
        REQUIRE(result.contains("switched"));
        CHECK(result["switched"]["method"] == "dop853");
        CHECK(result["switched"]["why"] == "stuck");
        CHECK(result["final"]["time"] == stages["final"]["time"]);
        CHECK(result["energy_drift"].get<double>() < 2 * stages["energy_drift"].get<double>());
    }
}

// A bob on a spring of 1000 rad/s, whose steps are short though its series converges fast. With its drag
// accelerations do not depend on positions alone.
TEST_CASE("auto: where the first steps show that a series is faster, taylor goes on, and ends where dop853 ends") {
    if (!alembert::machine::can_run()) return;
    const std::string scene = temporary(
        "dragged.toml", alembert::test::contents(source_path("scenes/benchmark/stiff_spring_pendulum.toml")) +
                            "[forces]\nx = \"-1e-3*x'\"\ny = \"-1e-3*y'\"\n");
    const Json exact = simulated(scene, {"--tolerance", "1e-12"}),
               result = simulated(scene, {"--tolerance", "1e-4"}),
               before = simulated(scene, {"--tolerance", "1e-4", "--method", "dop853"});
    REQUIRE(result.contains("switched"));
    CHECK(result["switched"]["method"] == "taylor");
    CHECK(result["switched"]["why"] == "cheaper");
    CHECK(result["switched"]["time"].get<double>() < 1);
    CHECK(result["evaluations"].get<long>() < before["evaluations"].get<long>() / 5);
    for (const char* const name : {"x", "y"})
        CHECK(std::abs(result["final"]["coordinates"][name].get<double>() -
                       exact["final"]["coordinates"][name].get<double>()) < 1e-3);
    const auto text = run({"simulate", scene, "--tolerance", "1e-4", "--no-estimate", "--no-tuning"});
    CHECK(text.out.find("it is predicted to take less time") != std::string::npos);
    // A run that is too short to pay for the series keeps its method.
    CHECK(!simulated(scene, {"--tolerance", "1e-4", "--duration", "0.3"}).contains("switched"));
}

// The factors are two positive numbers. What is in the file is not believed if it has been changed.
TEST_CASE("auto: what steps take on this processor is measured once and kept, unless counts alone are asked for") {
    if (!alembert::machine::can_run()) return;
    const auto result = run_shell(R"sh(cd "$1"
        simulate() { XDG_CACHE_HOME=$PWD/$1 "$ALEMBERT" simulate "$2" --method auto --no-estimate --duration 1 $3 >out || exit; }
        simulate counts "$2" --no-tuning; ls counts/alembert 2>/dev/null | grep -c step_times
        simulate one "$2"; cp one/alembert/step_times* first
        head -n 1 first | awk '{ print NF, ($1 > 0), ($2 > 0) }'
        simulate one "$2"; cmp first one/alembert/step_times* && echo kept
        sed -i '1s/.*/1e9 1e-9/' one/alembert/step_times*; simulate one "$2"
        grep -c '^1e9' one/alembert/step_times*
        head -n 1 one/alembert/step_times* | awk '{ print NF, ($1 > 0), ($2 > 0) }'
        : >blocked; XDG_CACHE_HOME=$PWD/blocked HOME= "$ALEMBERT" simulate "$2" --method auto --no-estimate --duration 1 >out; echo $?)sh",
                                  {temporary_folder("step_times"), source_path("scenes/benchmark/kepler.toml")});
    CHECK(result.out == "0\n2 1 1\nkept\n0\n2 1 1\n0\n");
}

// Predicted to take 100 ms with AVX-512 and longer without, at a tolerance at which the choice is open.
TEST_CASE("auto: a long run tries methods, and that of the name which it tells has the same digits") {
    for (const auto& [file, duration] : {std::pair{"scenes/benchmark/kepler.toml", "20000"},
                                         std::pair{"scenes/gallery/furuta_joints.toml", "5000"}}) {
        CAPTURE(file);
        const std::vector<std::string> options = {"simulate", source_path(file), "--no-estimate", "--tolerance",
                                                  "1e-9",     "--duration",      duration};
        const Json result = json_of(options);
        CHECK(result["method_why"].get<std::string>().find("as the fastest of ") != std::string::npos);
        std::vector<std::string> again = options;
        again.insert(again.end(), {"--method", result["method"].get<std::string>()});
        if (!result.contains("switched")) CHECK(result_of(json_of(again)) == result_of(result));
    }
}

TEST_CASE("auto: without tuning a long run chooses by counts, the same every time, and a short one does so too") {
    const std::string scene = source_path("scenes/benchmark/kepler.toml");
    const Json once = simulated(scene, {"--duration", "2000"}), twice = simulated(scene, {"--duration", "2000"});
    CHECK(once["method_why"].get<std::string>().find("chosen for the tolerance") != std::string::npos);
    CHECK(once["method"] == twice["method"]);
    CHECK(result_of(once) == result_of(twice));
    const auto tuned = [&] { return json_of({"simulate", scene, "--no-estimate"}); };
    CHECK(tuned()["method_why"].get<std::string>().find("chosen for the tolerance") != std::string::npos);
    CHECK(result_of(tuned()) == result_of(tuned()));
}

// The trial begins on one side of the constraints, and takes none of the memory of the run with it.
TEST_CASE("auto: a trial with constraints and an account of work leaves both as they are") {
    for (const char* const file : {"scenes/textbook/four_bar.toml", "scenes/textbook/seismograph.toml"}) {
        CAPTURE(file);
        const std::vector<std::string> options = {"simulate", source_path(file), "--no-estimate", "--tolerance",
                                                  "1e-10",    "--duration",      "15000"};
        const Json result = json_of(options);
        CHECK(result["method_why"].get<std::string>().find("as the fastest of ") != std::string::npos);
        std::vector<std::string> again = options;
        again.insert(again.end(), {"--method", result["method"].get<std::string>()});
        if (result.contains("switched")) continue;
        const Json other = json_of(again);
        CHECK(result["final"] == other["final"]);
        for (const char* const drift : {"constraint_drift", "work_balance", "energy_drift"})
            CHECK(result.value(drift, Json()) == other.value(drift, Json()));
    }
}

TEST_CASE("auto: taylor too changes to radau where stiffness limits its steps") {
    const Json result = simulated(temporary("stiff.toml", stiff), {"--tolerance", "1e-13"});
    CHECK(result["method"] == "taylor");
    REQUIRE(result.contains("switched"));
    CHECK(result["switched"]["method"] == "radau");
    CHECK(result["evaluations"].get<long>() < 200000);
}

TEST_CASE(
    "no hang: stiff, singular and chattering scenes end within the budget with a result or a message, by every "
    "method") {
    const std::string chattering = temporary("chattering.toml",
                                             "[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\n[forces]\nx = "
                                             "\"-sign(x)-5*sign(x')\"\n[simulation]\nduration = 20\n");
    const std::string collision = temporary("collision.toml",
                                            "[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\npotential = "
                                            "\"-1/sqrt(x^2)\"\n[simulation]\nduration = 20\n");
    for (const std::string& scene : {chattering, collision, temporary("stiff.toml", stiff)})
        for (const std::string method : {"auto", "dop853", "taylor", "radau", "bdf"}) {
            const auto result = run({"simulate", scene, "--method", method, "--tolerance", "1e-13", "--budget",
                                     "30000", "--no-estimate"});
            INFO(scene << " " << method << " " << result.err);
            CHECK((result.exit == 0 || result.exit == 4 ||
                   (result.exit == 3 && method == "taylor" && scene == chattering)));
            if (result.exit != 0) CHECK(result.err.size() > 40);
        }
}

}  // namespace commands_method
