// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace alembert::test {

/// A plate on three rows, of which the third follows from the others.
inline const std::string redundant_plate = R"toml(
[parameters]
R = 0.5
[coordinates]
x = { initial = 0, rate = -0.5 }
y = 0
phi = { initial = 0.2, rate = 1 }
[[frame]]
name = "D"
rotate = [["z", "phi"]]
[[body]]
name = "disc"
mass = 2
frame = "D"
position = ["x", "y"]
inertia = 0.25
[[constraint]]
name = "rail"
nonholonomic = "x' + R*phi'"
[[constraint]]
name = "again"
nonholonomic = "2*x' + 2*R*phi' + y'"
[[constraint]]
name = "height"
nonholonomic = "3*y'"
[[force]]
at = "disc"
vector = ["-2*x + 3", 1]
)toml";

}  // namespace alembert::test
