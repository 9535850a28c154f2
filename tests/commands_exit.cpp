// SPDX-License-Identifier: MIT
// The contract of the command line: exit codes, JSON fields, and the contents of each stream.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "scenes.hpp"

namespace commands_exit {

using alembert::test::is_sanitized;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using Json = nlohmann::json;

namespace {

const std::string pendulum = R"toml(
gravity = [0, "g"]
[parameters]
m = 2.0
l = 1.5
g = 9.81
[coordinates]
theta = { initial = 0.3, rate = 0.1 }
[[particle]]
name = "P"
mass = "m"
position = ["l*sin(theta)", "l*cos(theta)"]
[simulation]
duration = 2
)toml";

}  // namespace

TEST_CASE("commands: eval gives the pendulum's closed form, with --at for state and parameters") {
    const std::string scene = temporary("pendulum.toml", pendulum);
    const auto run_at = run({"eval", scene, "--json", "--at", "theta=0.5", "theta'=2", "l=2"});
    REQUIRE(run_at.exit == 0);
    const Json result = Json::parse(run_at.out);
    CHECK(result["accelerations"]["theta"].get<double>() ==
          doctest::Approx(-9.81 / 2 * std::sin(0.5)).epsilon(1e-15));
    CHECK(result["kinetic"].get<double>() == doctest::Approx(0.5 * 2 * 4 * 4).epsilon(1e-15));
    CHECK(result["potential"].get<double>() == doctest::Approx(-2 * 9.81 * 2 * std::cos(0.5)).epsilon(1e-15));
    for (const char* key : {"time", "coordinates", "rates", "accelerations", "speeds", "speed_rates",
                            "multipliers", "kinetic", "potential", "energy", "residuals", "outputs"})
        CHECK_MESSAGE(result.contains(key), key);
}

TEST_CASE("commands: simulate writes the CSV on the sample grid and the JSON of commands.md") {
    const std::string scene = temporary("pendulum.toml", pendulum);
    const std::string csv = scene + ".csv";
    const auto result = run({"simulate", scene, "--json", "-o", csv, "--sample", "0.3"});
    REQUIRE(result.exit == 0);
    const Json json = Json::parse(result.out);
    for (const char* key :
         {"final", "method", "steps", "rejected", "evaluations", "energy_drift", "constraint_drift", "seconds"})
        CHECK_MESSAGE(json.contains(key), key);
    CHECK(json["final"]["time"] == 2.0);
    CHECK(json["energy_drift"].get<double>() < 1e-9);
    CHECK_FALSE(json.contains("work_balance"));
    std::ifstream file(csv);
    std::string line;
    std::getline(file, line);
    CHECK(line == "t,theta,theta',energy");
    int rows = 0;
    std::string last;
    while (std::getline(file, line)) {
        ++rows;
        last = line;
    }
    CHECK(rows == 8);  // 0, 0.3 … 1.8, and 2
    CHECK(last.starts_with("2,"));
}

TEST_CASE("commands: a mistake in the scene is exit 3 with its place, an unknown formalism or file too") {
    const std::string broken = temporary("broken.toml", pendulum + "\n[outputs]\nx = \"l*sin(thetta)\"\n");
    const auto result = run({"derive", broken});
    CHECK(result.exit == 3);
    CHECK(result.out.empty());
    CHECK(result.err.find("broken.toml:17:12: unknown name 'thetta'") != std::string::npos);
    CHECK(result.err.find("did you mean 'theta'?") != std::string::npos);
    CHECK(run({"derive", "no/such/scene.toml"}).exit == 3);
    const std::string scene = temporary("pendulum.toml", pendulum);
    CHECK(run({"derive", scene, "--by", "newton"}).exit == 3);
    CHECK(run({"eval", scene, "--at", "thetta=1"}).exit == 3);
    CHECK(run({"eval", scene, "--at", "theta=1x"}).exit == 3);
    CHECK(run({"simulate", scene, "--tolerance", "-1"}).exit == 3);
    CHECK(run({"simulate", scene, "--method", "rk4"}).exit == 3);  // no step
    CHECK(run({"fly", scene}).exit == 3);
    CHECK(run({}).exit == 0);  // a call for help
    CHECK(run({"--version"}).exit == 0);
    CHECK(run({"--help"}).exit == 0);
}

TEST_CASE("commands: a singular mass matrix is exit 4 and names the combination of rates") {
    const std::string scene = temporary("singular.toml", R"toml(
[coordinates]
x = 0.1
y = 0.2
[energy]
kinetic = "(x' + y')^2/2"
potential = "x^2 + y^2"
)toml");
    for (const char* verb : {"eval", "simulate"}) {
        const auto result = run({verb, scene});
        CHECK(result.exit == 4);
        CHECK(result.err.find("x' - y'") != std::string::npos);
    }
    const std::string massless = temporary("massless.toml", R"toml(
[coordinates]
x = 0.1
[[particle]]
name = "P"
mass = 0
position = ["x", 0]
)toml");
    const auto result = run({"eval", massless});
    CHECK(result.exit == 4);
    CHECK(result.err.find("nothing has inertia along x'") != std::string::npos);

    const std::string free = temporary("free.toml", R"toml(
[coordinates]
x = 0.1
z = 0
[[particle]]
name = "P"
mass = 1
position = ["x", "0*z"]
[[constraint]]
name = "c"
holonomic = "x = 0.1 + t^2"
)toml");
    const auto beside = run({"eval", free});
    CHECK(beside.exit == 4);
    CHECK(beside.err.find("nothing has inertia along z'") != std::string::npos);  // nor does the constraint
}

// Cranks of length 1, pins 2 apart, a coupler of 2: the linkage is flat at a = b = c = 0, where the first row,
// (-sin a, sin b, -2 sin c), is zero.
TEST_CASE("commands: constraints that lose rank at a pose are named, and not reported as a division by zero") {
    const auto scene = [](const std::string& more) {
        return temporary("flat.toml", R"toml(
[coordinates]
a = { initial = 0, rate = 1 }
b = { initial = 0, rate = 1 }
c = 0
[[particle]]
name = "A"
mass = 1
position = ["cos(a)", "sin(a)"]
[[particle]]
name = "C"
mass = 1
position = ["cos(a) + cos(c)", "sin(a) + sin(c)"]
[[constraint]]
name = "along"
holonomic = "cos(a) + 2*cos(c) = cos(b) + 2"
[[constraint]]
name = "across"
holonomic = "sin(a) + 2*sin(c) = sin(b)"
)toml" + more);
    };
    const std::string massless = scene("[simulation]\nduration = 1\n");  // b has no inertia
    const auto result = run({"eval", massless});
    CHECK(result.exit == 4);
    CHECK(result.err.find("constraint 'along' has no row left at a = 0, ") != std::string::npos);
    CHECK(result.err.find(" = 0, and the rank of the constraints drops from 2 to 1 there") != std::string::npos);
    CHECK(result.err.find("division") == std::string::npos);
    // The linkage moves on as a parallelogram and turns at constant speed, also with a mass on that crank.
    for (const std::string& file :
         {massless, scene("[[particle]]\nname = \"B\"\nmass = 1\nposition = [\"2 + cos(b)\", "
                          "\"sin(b)\"]\n[simulation]\nduration = 1\n")}) {
        const auto motion = run({"simulate", file, "--json"});
        REQUIRE(motion.exit == 0);
        CHECK(std::abs(Json::parse(motion.out)["final"]["coordinates"]["b"].get<double>() - 1) < 1e-9);
    }
}

TEST_CASE("commands: a value that is not a number is traced to its term, and a run that fails keeps its results") {
    const std::string scene = temporary("fall.toml", R"toml(
[coordinates]
r = { initial = 1.0 }
[energy]
kinetic = "r'^2/2"
potential = "-1/r^2"
[simulation]
duration = 10
)toml");
    const std::string csv = scene + ".csv";
    const auto result = run({"simulate", scene, "--json", "-o", csv});
    CHECK(result.exit == 4);
    const Json json = Json::parse(result.out);
    CHECK(json["completed"] == false);
    // The fall to the centre takes t = r₀²/√2 from rest: ½ r'² = 1/r² − 1/r₀².
    CHECK(json["final"]["time"].get<double>() == doctest::Approx(1 / std::sqrt(2)).epsilon(1e-3));
    CHECK(std::filesystem::file_size(csv) > 100);
    const auto at_centre = run({"eval", scene, "--at", "r=0"});
    CHECK(at_centre.exit == 4);
    CHECK(at_centre.err.find("division by zero") != std::string::npos);
    CHECK(at_centre.err.find("[energy] potential") != std::string::npos);
}

TEST_CASE("commands: a folder that cannot be written gives exit 5, and no incomplete file remains") {
    const std::string scene = temporary("pendulum.toml", pendulum);
    CHECK(run({"simulate", scene, "-o", "/no/such/folder/x.csv"}).exit == 5);
    const std::string file = temporary("occupied", "");
    CHECK(run({"emit", scene, "-o", file + "/inside"}).exit == 5);
}

TEST_CASE("commands: names that are C++ keywords, Greek letters and our own temporaries work") {
    const std::string scene = temporary("names.toml", R"toml(
gravity = [0, "g"]
[parameters]
double = 1.5
g = 9.81
Real = 2.0
k0 = 0.5
[coordinates]
I = 0.3
θ = { initial = 0.2, rate = 0.1 }
lambda = 0.1
z0 = 0.4
[[particle]]
name = "new"
mass = "double"
position = ["I + lambda", "θ"]
[[particle]]
name = "int"
mass = "Real"
position = ["lambda*cos(z0)", "lambda*sin(z0) + 2", "k0*θ"]
[[particle]]
name = "M00"
mass = 1
position = ["I", "z0"]
[simulation]
duration = 0.5
)toml");
    const auto derived = run({"derive", scene});
    CHECK(derived.exit == 0);
    CHECK(derived.out.find("θ''") != std::string::npos);
    const auto evaluated = run({"eval", scene, "--json"});
    REQUIRE(evaluated.exit == 0);
    CHECK(Json::parse(evaluated.out)["accelerations"].contains("I"));
    const auto simulated = run({"simulate", scene, "--json"});
    REQUIRE(simulated.exit == 0);
    CHECK(Json::parse(simulated.out)["energy_drift"].get<double>() < 1e-9);
    CHECK(run({"derive", scene, "--format", "latex"}).out.find("\\theta") != std::string::npos);
}

TEST_CASE("commands: the text of a derived equation is a valid claim, in textbook scenes") {
    using namespace alembert::test;
    for (const std::string& file : every_third(scenes_in("scenes/textbook"), 0)) {
        CAPTURE(file);
        const auto derived = run({"derive", file, "--json"});
        REQUIRE(derived.exit == 0);
        std::ifstream in(file);
        std::string text((std::istreambuf_iterator<char>(in)), {});
        const Json json = Json::parse(derived.out);
        for (const Json& equation : json["equations"])
            text += "\n[[claim]]\nequation = \"" + equation["text"].get<std::string>() + "\"\n";
        const auto again = run({"derive", temporary("claimed.toml", text)});
        CHECK(again.exit == 0);
        CHECK(again.err.empty());
    }
}

TEST_CASE("commands: every broken scene is refused with exit 3 by every verb, within 200 MB") {
    for (const std::string& file : alembert::test::scenes_in("tests/broken"))
        for (const char* verb : {"derive", "eval", "simulate"}) {
            CAPTURE(file);
            const auto result = run({verb, file});
            CHECK(result.exit == 3);
            CHECK(result.out.empty());
            CHECK(result.err.find(".toml:") != std::string::npos);
            if (!is_sanitized) CHECK(result.megabytes < 200);
        }
}

TEST_CASE("commands: parameters that are chained powers are refused or computed, not expanded") {
    std::string scene = "[parameters]\np0 = 1.00001\n";
    for (int k = 1; k <= 5; ++k) scene += "p" + std::to_string(k) + " = \"p" + std::to_string(k - 1) + "^64\"\n";
    scene += "[coordinates]\nx = 1\n[[particle]]\nname = \"P\"\nmass = \"p3\"\nposition = [\"x\", 0]\n";
    const std::string file = temporary("chained.toml", scene);
    const auto result = run({"eval", file, "--json"});
    CHECK(result.exit == 3);  // p5 is beyond double range
    CHECK(result.err.find("p5") != std::string::npos);
    if (!is_sanitized) CHECK(result.megabytes < 200);
    scene.replace(scene.find("p5 = \"p4^64\""), 12, "p5 = \"p4/2^9\"");
    CHECK(run({"emit", temporary("chained.toml", scene), "-o", file + "-d", "--fold"}).exit == 0);
}

}  // namespace commands_exit
