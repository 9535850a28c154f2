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

/// Two wheels on one axle, which may not slip along it: one of these two rows follows from the other.
inline const std::string redundant_wheels = R"toml(
[parameters]
M = 5
J = 0.25
mw = 0.3
r = 0.1
h = 0.25
T1 = 0.2
T2 = 0.3
[coordinates]
x = 0
y = 0
th = { initial = 0.3, rate = 0.1 }
w1 = { rate_guess = 0 }
w2 = { rate_guess = 0 }
[[frame]]
name = "C"
rotate = [["z","th"]]
[[frame]]
name = "WL"
parent = "C"
rotate = [["y","w1"]]
[[frame]]
name = "WR"
parent = "C"
rotate = [["y","w2"]]
[[body]]
name = "cart"
mass = "M"
frame = "C"
inertia = [0.1,0.2,"J"]
position = ["x","y","r"]
[[body]]
name = "left"
mass = "mw"
frame = "WL"
from = "cart"
position = [0,"h",0]
axes = "C"
shape = { disc = "r", axis = "y" }
inertia = "from shape"
[[body]]
name = "right"
mass = "mw"
frame = "WR"
from = "cart"
position = [0,"-h",0]
axes = "C"
shape = { disc = "r", axis = "y" }
inertia = "from shape"
[[rolling]]
name = "rl"
body = "left"
contact = [0,0,"-r"]
[[rolling]]
name = "rr"
body = "right"
contact = [0,0,"-r"]
[[torque]]
on = "WL"
vector = [0,"T1",0]
axes = "C"
reaction = "C"
[[torque]]
on = "WR"
vector = [0,"T2",0]
axes = "C"
reaction = "C"
[simulation]
duration = 2
)toml";

}  // namespace alembert::test
