// SPDX-License-Identifier: GPL-2.0-or-later
// What a scene says and does not mean, as its mechanism shows: each mistake beside the scene without it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>

#include "analysis/derive/start_check.hpp"
#include "analysis/state/prepared.hpp"

namespace state_warnings {

using namespace alembert;

namespace {

/// "12 no_effect P; 20 no_length A; "
std::string told(Scene scene) {
    std::string result;
    scene.on_warning = [&](const Warning& warning) {
        for (const Diagnostic& one : warning.parts)
            // That two tops here are thinner than any body is told rightly.
            if (one.kind != "unused" && one.message.find("triangle inequality") == std::string::npos)
                result += fmt::format("{} {} {}; ", one.place.line, one.kind, one.name);
    };
    prepared(std::move(scene));
    return result;
}

std::string told(const std::string& text) {
    return told(parse_scene(text, "warned.toml"));
}

std::string at_start(const std::string& text) {
    std::string result;
    for (const Diagnostic& one : warnings_of_start(prepared(parse_scene(text, "started.toml")).mechanism, {}))
        result += fmt::format("{} {}; ", one.place.line, one.kind);
    return result;
}

const std::string pendulum = R"toml(gravity = [0, "-g"]
[parameters]
g = 9.81
m = 1
l = 2
[inputs]
F = "3 + sin(t)"
[coordinates]
x = 0.3
theta = 0.5
[[particle]]
name = "cart"
mass = "m"
position = ["x", 0]
[[particle]]
name = "bob"
mass = "m"
from = "cart"
position = ["l*sin(theta)", "-l*cos(theta)"]
[[frame]]
name = "rod"
rotate = [["z", "theta"]]
)toml";

std::string force(const std::string& at, const std::string& vector, const std::string& more = {}) {
    return pendulum + "[[force]]\nat = \"" + at + "\"\nvector = " + vector + "\n" + more;
}

}  // namespace

TEST_CASE("warnings: forces and torques along which nothing moves") {
    CHECK(told(force("cart", "[\"F\", 0]")).empty());
    CHECK(told(force("cart", "[0, \"F\"]")) == "23 no_effect cart; ");
    CHECK(told(force("cart", "[0, 5]")) == "23 no_effect cart; ");
    CHECK(told(force("cart", "[0, 0]")).empty());
    CHECK(told(force("bob", "[0, \"F\"]")).empty());
    // Along the rod the cart still moves; where it does not, nothing does.
    CHECK(told(force("bob", "[0, \"F\"]", "axes = \"rod\"\n")).empty());
    const std::string held = R"toml([coordinates]
theta = 0.5
[[particle]]
name = "bob"
mass = 1
position = ["2*sin(theta)", "-2*cos(theta)"]
[[frame]]
name = "rod"
rotate = [["z", "theta"]]
[[force]]
at = "bob"
axes = "rod"
)toml";
    CHECK(told(held + "vector = [0, \"7\"]\n") == "10 no_effect bob; ");
    CHECK(told(held + "vector = [\"7\", 0]\n").empty());
    // A force across the velocity does no work and yet bends the path.
    CHECK(told("[coordinates]\nx = 0\ny = 0\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", "
               "\"y\"]\n[[force]]\nat = \"P\"\nvector = [\"2*y'\", \"-2*x'\"]\n")
              .empty());
    const std::string wheel = R"toml([coordinates]
phi = 0
[[frame]]
name = "A"
rotate = [["z", "phi"]]
[[body]]
name = "wheel"
mass = 1
inertia = [1, 1, 2]
frame = "A"
position = [0, 0, 0]
[[torque]]
on = "A"
)toml";
    CHECK(told(wheel + "vector = [3, 0, 0]\n") == "12 no_effect A; ");
    CHECK(told(wheel + "vector = [0, 0, 3]\n").empty());
}

TEST_CASE("warnings: masses and inertias in other units than their neighbours") {
    const auto pair = [](const std::string& m, const std::string& inertia) {
        return "gravity = [0, -9.81]\n[coordinates]\nx = 0\nphi = 0.2\n[[frame]]\nname = \"A\"\nrotate = [[\"z\", "
               "\"phi\"]]\n[[particle]]\nname = \"P\"\nmass = " +
               m +
               "\nposition = [\"x\", 0]\n[[body]]\nname = \"B\"\nmass = 0.2\nframe = \"A\"\ninertia = " + inertia +
               "\nposition = [\"x + 0.1*sin(phi)\", \"-0.1*cos(phi)\"]\n";
    };
    CHECK(told(pair("0.5", "0.002")).empty());
    CHECK(told(pair("1500", "0.002")).empty());
    CHECK(told(pair("5e5", "0.002")) == "9 suspicious_number P; ");
    CHECK(told(pair("0.5", "2000")) == "16 suspicious_number B; ");  // kg mm²
    CHECK(told(pair("0.5", "20")).empty());
}

TEST_CASE("warnings: springs without a length that start stretched") {
    const auto spring = [](const std::string& position, const std::string& more) {
        return "[coordinates]\nx = 0.3\ny = 1\n[[particle]]\nname = \"P\"\nmass = 1\nposition = " + position +
               "\n[[spring]]\nbetween = [\"O\", \"P\"]\nstiffness = 40\n" + more;
    };
    CHECK(told(spring("[\"x\", 0]", "")).empty());
    CHECK(told(spring("[\"x\", \"y\"]", "")).empty());  // isotropic in the plane
    CHECK(told(spring("[\"y*sin(x)\", \"-y*cos(x)\"]", "")) == "8 no_length O; ");
    CHECK(told(spring("[\"y*sin(x)\", \"-y*cos(x)\"]", "length = 0\n")).empty());
    CHECK(told(spring("[\"y*sin(x)\", \"-y*cos(x)\"]", "length = 0.5\n")).empty());
}

TEST_CASE("warnings: initial values that break a constraint or a contact are told where equations are shown") {
    const auto start = [](const std::string& y, const std::string& rule) {
        return "[coordinates]\nx = 0.6\ny = " + y +
               "\n[[particle]]\nname = \"P\"\nmass = 1\nposition = [\"x\", \"y\"]\n" + rule;
    };
    const std::string rod = "[[constraint]]\nname = \"rod\"\nholonomic = \"x^2 + y^2 = 1\"\n";
    CHECK(at_start(start("0.8", rod)).empty());
    CHECK(at_start(start("0.9", rod)) == "9 initial_values; ");
    CHECK(at_start(start("{ guess = 0.9 }", rod)).empty());
    const std::string floor = "[[unilateral]]\nname = \"floor\"\ngap = \"y\"\n";
    CHECK(at_start(start("0", floor)).empty());
    CHECK(at_start(start("-0.1", floor)) == "9 initial_values; ");
}

TEST_CASE("warnings: no scene here gives a false alarm") {
    int scenes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(ALEMBERT_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        CAPTURE(entry.path().string());
        Scene scene = read_scene(entry.path().string());
        if (scene.polynomial) continue;
        ++scenes;
        const std::string text = told(std::move(scene));
        for (const char* kind : {"no_effect", "no_length", "suspicious_number"})
            CHECK_MESSAGE(text.find(kind) == std::string::npos, text);
    }
    CHECK(scenes > 150);
}

}  // namespace state_warnings
