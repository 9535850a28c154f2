// SPDX-License-Identifier: MIT
#pragma once

/// Scenes whose tree of links stands in positions alone.

namespace alembert::test {

/// A bead on a curve carries two spherical pendulums, one below the other, and a mass in polar coordinates.
inline const char* const on_curves = R"toml(gravity = [0, 0.3, "-g"]
[parameters]
g = 9.81
l = 0.7
r = 0.4
[coordinates]
s = 0.3
a = 0.4
b = -0.2
c = 0.7
d = 0.5
e = 0.9
f = 0.6
[[particle]]
name = "bead"
mass = 2
position = ["s", "s^2/3", "r*sin(s)"]
[[particle]]
name = "P"
mass = 1.3
position = ["s + l*sin(a)*cos(b)", "s^2/3 + l*sin(a)*sin(b)", "r*sin(s) - l*cos(a)"]
[[particle]]
name = "Q"
mass = 0.7
from = "P"
position = ["l*sin(c)*cos(d)", "l*sin(c)*sin(d)", "-l*cos(c)"]
[[particle]]
name = "R"
mass = 0.6
from = "bead"
position = ["e*cos(f + 0.3)", 0, "-e*sin(f + 0.3)"]
[[damper]]
between = ["P", "R"]
damping = 0.2
[[spring]]
between = ["O", "Q"]
stiffness = 3
)toml";

}  // namespace alembert::test
