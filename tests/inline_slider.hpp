// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace alembert::test {

/// A crank A and a rod AB of length 1 and mass 1 at their ends; B slides along y = 0 and comes in with the
/// speed 1.7. With B at the pivot the rows of crank, rod and guide depend on each other. `coordinates` are lines
/// of that table.
inline std::string inline_slider(const std::string& coordinates = "") {
    return R"toml(
[coordinates]
xa = { guess = 0.5, rate_guess = -0.87 }
ya = { guess = 0.87, rate_guess = 0.5 }
xb = { initial = 1, rate = -1.7 }
yb = { guess = 0, rate_guess = 0 }
)toml" + coordinates +
           R"toml(
[[particle]]
name = "A"
mass = 1
position = ["xa", "ya"]
[[particle]]
name = "B"
mass = 1
position = ["xb", "yb"]
[[constraint]]
name = "crank"
holonomic = "xa^2 + ya^2 = 1"
[[constraint]]
name = "guide"
holonomic = "yb = 0"
[[constraint]]
name = "rod"
holonomic = "(xa - xb)^2 + (ya - yb)^2 = 1"
[simulation]
duration = 1
)toml";
}

}  // namespace alembert::test
