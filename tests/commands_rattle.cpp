// SPDX-License-Identifier: MIT
// `--method rattle` and `rattle8` on scenes, against dop853 on the same motion in other coordinates or by other
// equations; and the methods of SUNDIALS, `cvode` and `ida`, against dop853 too.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"
#include "tools.hpp"

namespace commands_rattle {

using alembert::test::has_part;
using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;

namespace {

Json simulated(const std::string& scene, const std::vector<std::string>& more) {
    return json_of({"simulate", scene, "--no-estimate"}, more);
}

std::string textbook(const std::string& name) {
    return source_path("scenes/textbook/" + name + ".toml");
}

/// The largest difference of coordinates and rates at the end.
double apart(const Json& a, const Json& b) {
    double worst = 0;
    for (const char* group : {"coordinates", "rates"})
        for (const auto& [name, value] : a["final"][group].items())
            worst = std::max(worst, std::abs(value.get<double>() - b["final"][group][name].get<double>()));
    return worst;
}

const char* const by_angle = R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
l = 1
[coordinates]
phi = "-pi/2"
[[particle]]
name = "bob"
mass = 1
position = ["l*sin(phi)", "-l*cos(phi)"]
[simulation]
duration = 10
)toml";

// In polar coordinates, M = diag(m, m r²), on an ellipse whose centre is moved about; with a damper, and a load
// that is no potential.
const char* const driven = R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
[coordinates]
r = { guess = 1, rate_guess = 0 }
phi = { initial = 0.3, rate = 1.5 }
[[point]]
name = "centre"
offset = ["0.1*sin(2*t)", 0]
[[particle]]
name = "bead"
mass = 2
from = "centre"
position = ["r*sin(phi)", "-r*cos(phi)"]
[[constraint]]
name = "ellipse"
holonomic = "r*(1 + 0.3*cos(phi)) = 1.3*(1 + 0.05*sin(t))"
[[damper]]
along = "r"
damping = 0.3
[forces]
phi = "0.5*cos(t) - 0.1*phi'"
[simulation]
duration = 3
)toml";

}  // namespace

TEST_CASE("rattle: the Cartesian pendulum keeps length and energy and is where the angle's equation puts it") {
    const std::string scene = source_path("scenes/benchmark/cartesian_pendulum.toml");
    const Json angle =
        simulated(temporary("angle.toml", by_angle), {"--tolerance", "1e-13", "--method", "dop853"});
    const double phi = angle["final"]["coordinates"]["phi"], rate = angle["final"]["rates"]["phi"];
    const auto error = [&](const Json& end) {
        const Json& q = end["final"]["coordinates"];
        const Json& u = end["final"]["rates"];
        return std::max({std::abs(q["x"].get<double>() - std::sin(phi)),
                         std::abs(q["y"].get<double>() + std::cos(phi)),
                         std::abs(u["x"].get<double>() - rate * std::cos(phi)),
                         std::abs(u["y"].get<double>() - rate * std::sin(phi))});
    };
    const auto runs = [&](const std::string& method, const std::string& step, const std::string& duration) {
        return simulated(scene, {"--method", method, "--step", step, "--duration", duration, "--sample", "10"});
    };
    const Json coarse = runs("rattle", "0.002", "10"), fine = runs("rattle", "0.001", "10"),
               high = runs("rattle8", "0.05", "10");
    CHECK(std::abs(std::log2(error(coarse) / error(fine)) - 2) < 0.1);
    CHECK(error(high) < 1e-8);
    CHECK(fine["method"] == "rattle");
    // There is no drift: after a hundred seconds the error is not larger than after ten.
    const Json longer = runs("rattle", "0.002", "200");
    CHECK(longer["energy_drift"].get<double>() < 1.01 * coarse["energy_drift"].get<double>());
    CHECK(longer["constraint_drift"].get<double>() < 1e-12);
    CHECK(runs("rattle8", "0.05", "200")["constraint_drift"].get<double>() < 1e-12);
}

TEST_CASE("rattle: linkages, whose mass matrix changes and whose loops are constraints, end where dop853 ends") {
    for (const std::string name : {"four_bar", "slider_crank"}) {
        const Json exact =
            simulated(textbook(name), {"--tolerance", "1e-13", "--method", "dop853", "--duration", "1"});
        const Json coarse =
            simulated(textbook(name), {"--method", "rattle", "--step", "0.001", "--duration", "1"});
        const Json fine = simulated(textbook(name), {"--method", "rattle", "--step", "0.0005", "--duration", "1"});
        const Json high = simulated(textbook(name), {"--method", "rattle8", "--step", "0.005", "--duration", "1"});
        INFO(name << " " << apart(coarse, exact) << " " << apart(fine, exact) << " " << apart(high, exact));
        CHECK(std::abs(std::log2(apart(coarse, exact) / apart(fine, exact)) - 2) < 0.1);
        CHECK(apart(high, exact) < 1e-8);
        CHECK(fine["constraint_drift"].get<double>() < 1e-12);
    }
}

TEST_CASE("rattle: moving constraints, dampers and loads keep the order, and the work balance with it") {
    const std::string scene = temporary("driven.toml", driven);
    const Json exact = simulated(scene, {"--tolerance", "1e-13", "--method", "dop853"});
    const Json coarse = simulated(scene, {"--method", "rattle", "--step", "0.002"}),
               fine = simulated(scene, {"--method", "rattle", "--step", "0.001"});
    CHECK(std::abs(std::log2(apart(coarse, exact) / apart(fine, exact)) - 2) < 0.1);
    CHECK(std::abs(std::log2(coarse["work_balance"].get<double>() / fine["work_balance"].get<double>()) - 2) <
          0.2);
    CHECK(apart(simulated(scene, {"--method", "rattle8", "--step", "0.05"}), exact) < 1e-8);
    // The power of the drive that moves the centre contains accelerations, and so does the row of the work in
    // radau's Jacobian.
    CHECK(apart(simulated(scene, {"--method", "radau", "--tolerance", "1e-11"}), exact) < 1e-8);
}

// With quaternions there is no inertia along e; L contains a term of the constraint there
// (alembert/ode/hamiltonian_system.hpp). sin b = 0.4 sin 7t, x = 0.2 cos 7t + 0.5 cos b. Rows of duration/200 fall
// on ends of steps up to rounding: steps of no length to there.
TEST_CASE(
    "rattle: a slider-crank without a degree of freedom goes where its drive takes it, with rows on its steps") {
    const std::string driven_crank = temporary("driven_crank.toml", R"toml(
gravity = [0, -9.81]
[coordinates]
phi = { initial = 0, rate = 7 }
beta = { guess = 0, rate_guess = 2.8 }
x = { guess = 0.7 }
[[particle]]
name = "pin"
mass = 1
position = ["0.2*cos(phi)", "0.2*sin(phi)"]
[[particle]]
name = "slider"
mass = 2
position = ["x", 0]
[[particle]]
name = "middle"
mass = 0.7
position = ["0.2*cos(phi) + 0.25*cos(beta)", "0.2*sin(phi) - 0.25*sin(beta)"]
[[constraint]]
name = "drive"
holonomic = "phi = 7*t"
[[constraint]]
name = "along"
holonomic = "x = 0.2*cos(phi) + 0.5*cos(beta)"
[[constraint]]
name = "across"
holonomic = "0.2*sin(phi) = 0.5*sin(beta)"
)toml");
    for (const auto& [method, step] : {std::pair{"rattle", "0.01"}, {"rattle", "0.001"}, {"rattle8", "0.01"}}) {
        const Json end = simulated(driven_crank, {"--duration", "5", "--method", method, "--step", step})["final"];
        const double b = std::asin(0.4 * std::sin(35)), rate = 0.4 * 7 * std::cos(35) / std::cos(b);
        CHECK(std::abs(end["coordinates"]["beta"].get<double>() - b) < 1e-12);
        CHECK(std::abs(end["coordinates"]["x"].get<double>() - (0.2 * std::cos(35) + 0.5 * std::cos(b))) < 1e-12);
        CHECK(std::abs(end["rates"]["beta"].get<double>() - rate) < 1e-11);
    }
}

TEST_CASE("rattle: a body turned by a quaternion spins according to Euler's equations") {
    const Json exact = simulated(textbook("free_body_quaternion"),
                                 {"--tolerance", "1e-13", "--method", "dop853", "--duration", "5"});
    const Json high = simulated(textbook("free_body_quaternion"),
                                {"--method", "rattle8", "--step", "0.05", "--duration", "5", "--by", "routh"});
    INFO(apart(high, exact));
    CHECK(apart(high, exact) < 1e-9);
    CHECK(high["constraint_drift"].get<double>() < 1e-12);
    CHECK(run({"simulate", textbook("free_body_quaternion"), "--method", "rattle", "--step", "0.1"})
              .err.find("generalized speeds") != std::string::npos);
}

TEST_CASE("rattle: constraints on rates are refused by name, and a step is required") {
    const auto sled = run({"simulate", textbook("sled"), "--method", "rattle", "--step", "0.01"});
    CHECK(sled.exit == 3);
    CHECK(sled.err.find("one of rates") != std::string::npos);
    CHECK(run({"simulate", textbook("cartesian_pendulum"), "--method", "rattle"}).exit == 3);
    CHECK(
        run({"sweep", textbook("cartesian_pendulum"), "--vary", "m=1:2:3", "--method", "rattle", "--step", "0.01"})
            .exit == 3);
}

TEST_CASE("sundials: cvode and ida end where dop853 ends, free, constrained, driven and stiff") {
    if (!has_part("alembert-sundials.so")) return;
    const std::string slider = textbook("slider_crank"), moved = temporary("driven.toml", driven);
    for (const std::string& scene : {textbook("double_pendulum"), textbook("cartesian_pendulum"), slider, moved,
                                     textbook("free_body_quaternion")}) {
        const Json exact = simulated(scene, {"--tolerance", "1e-13", "--method", "dop853", "--duration", "1"});
        for (const std::string method : {"cvode", "ida"}) {
            if (method == "ida" && scene == textbook("free_body_quaternion"))
                continue;  // speeds, and a constraint
            const Json result = simulated(scene, {"--tolerance", "1e-10", "--method", method, "--duration", "1"});
            INFO(scene << " " << method << " " << apart(result, exact) << " " << result["steps"]);
            CHECK(result["method"] == method);
            CHECK(apart(result, exact) < 1e-6);
            CHECK(result["constraint_drift"].get<double>() < 1e-9);
            CHECK(result["steps"].get<long>() > 20);
        }
    }
    const std::string flyball = source_path("scenes/benchmark/flyball_governor.toml");
    const Json exact = simulated(flyball, {"--tolerance", "1e-12", "--method", "radau"}),
               stiff = simulated(flyball, {"--tolerance", "1e-9", "--method", "cvode"});
    CHECK(apart(stiff, exact) < 1e-5);
    CHECK(stiff["evaluations"].get<long>() < 200000);
    CHECK(stiff.contains("jacobian_operations"));
}

TEST_CASE("sundials: rows fall on the grid, the error is estimated, and a used-up budget keeps the results") {
    if (!has_part("alembert-sundials.so")) return;
    const std::string scene = textbook("cartesian_pendulum"), file = temporary("rows.csv", "");
    const auto result =
        run({"simulate", scene, "--method", "cvode", "--duration", "1", "--sample", "0.25", "-o", file, "--json"});
    REQUIRE(result.exit == 0);
    CHECK(Json::parse(result.out)["error_estimate"]["value"].get<double>() < 1e-5);
    CHECK(std::filesystem::file_size(file) > 100);
    const auto small = run({"simulate", scene, "--method", "ida", "--budget", "100", "--no-estimate"});
    CHECK(small.exit == 4);
    CHECK(small.err.find("100 right-hand sides were not enough") != std::string::npos);
}

TEST_CASE("sundials: a program without the back end beside it says what to install") {
    const std::filesystem::path alone = temporary("alembert-alone", "");
    std::filesystem::copy_file(ALEMBERT_PROGRAM, alone, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::permissions(alone, std::filesystem::perms::owner_all);
    const std::string command = alone.string() + " simulate " + textbook("cartesian_pendulum") +
                                " --method cvode 2> " + alone.string() + ".err";
    const int status = std::system(command.c_str());
    CHECK(WEXITSTATUS(status) == 5);
    std::ifstream in(alone.string() + ".err");
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    CHECK(text.find("libsundials-dev") != std::string::npos);
    CHECK(run({"bench", textbook("cartesian_pendulum"), "--method", "cvode"}).exit == 3);
}

}  // namespace commands_rattle
