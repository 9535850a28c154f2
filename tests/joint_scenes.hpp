// SPDX-License-Identifier: MIT
#pragma once

/// The beginning of the scenes in tests of joints, and what each of their bodies has.

namespace alembert::test {

inline const char* const base = R"(
gravity = [1, -2, -9.81]
[parameters]
h = 0.7
)";

inline const char* const masses = R"(
mass = 2
inertia = { xx = 0.4, yy = 0.5, zz = 0.6, xy = 0.01, yz = -0.02, zx = 0.03 }
)";

}  // namespace alembert::test
