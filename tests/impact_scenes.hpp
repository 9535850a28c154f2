// SPDX-License-Identifier: MIT
#pragma once

/// Scenes that are struck, with marks such as {m} to be filled in, and `impact --json` as a function.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "json.hpp"
#include "program.hpp"

namespace alembert::test {

inline Json impact_of(const std::string& text) {
    return json_of({"impact", temporary("struck.toml", text)});
}

inline double number(const Json& json) {
    return json.get<double>();
}

/// "{v}" in a scene.
inline std::string filled(std::string text, const std::vector<std::pair<std::string, double>>& values) {
    for (const auto& [name, value] : values) {
        const std::string mark = "{" + name + "}";
        for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark))
            text.replace(at, mark.size(), fmt::format("{:.17g}", value));
    }
    return text;
}

inline const std::string slanting_rod = R"toml(
[parameters]
m = {m}
l = {l}
v = {v}
e = {e}
alpha = {alpha}
[coordinates]
y = { initial = "l/2*sin(alpha)", rate = "-v" }
theta = { initial = "alpha" }
[[frame]]
name = "R"
rotate = [["z", "-theta"]]
[[body]]
name = "rod"
mass = "m"
inertia = "m*l^2/12"
frame = "R"
position = [0, "y"]
[[unilateral]]
name = "table"
gap = "y - l/2*sin(theta)"
restitution = "e"
)toml";

/// A rod on a pin as a free body with the pin as constraints, struck at h below the pin.
inline const std::string pinned_rod = R"toml(
gravity = [0, 9.81]
[parameters]
m = 3
l = 1.2
S = 2
h = "{h}"
tau = {tau}
[inputs]
F = "S/tau*(1-cos(2*pi*t/tau))"
[coordinates]
x = { initial = "l/2*sin(0.4)" }
y = { initial = "l/2*cos(0.4)" }
theta = 0.4
[[frame]]
name = "R"
rotate = [["z", "-theta"]]
[[body]]
name = "rod"
mass = "m"
frame = "R"
inertia = "m*l^2/12"
position = ["x", "y"]
[[point]]
name = "P"
from = "rod"
offset = [0, "h - l/2"]
axes = "R"
[[constraint]]
name = "pin_x"
holonomic = "x - l/2*sin(theta)"
[[constraint]]
name = "pin_y"
holonomic = "y - l/2*cos(theta)"
)toml";

inline const std::string double_pendulum = R"toml(
gravity = [0, "-g"]
[parameters]
g = 9.81
m1 = 1.3
m2 = 2
l1 = 1.1
l2 = 0.5
w1 = 1
w2 = -2
[coordinates]
theta1 = { initial = 0.3, rate = "w1" }
theta2 = { initial = 1.1, rate = "w2" }
[[particle]]
name = "A"
mass = "m1"
position = ["l1*sin(theta1)", "-l1*cos(theta1)"]
[[particle]]
name = "B"
mass = "m2"
position = ["l1*sin(theta1)+l2*sin(theta2)", "-l1*cos(theta1)-l2*cos(theta2)"]
)toml";

inline const std::string lock = R"toml(
[[constraint]]
name = "lock"
nonholonomic = "theta1' - theta2'"
)toml";

}  // namespace alembert::test
