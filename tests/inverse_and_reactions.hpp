// SPDX-License-Identifier: MIT
// What tests of inverse dynamics and of reactions share.
#pragma once

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace alembert::test {

using V3 = std::array<double, 3>;

/// With these values of coordinates (prime "") or rates ("'") …
inline void set(std::vector<std::string>& args, const Json& values, const std::string& prime) {
    for (const auto& [name, value] : values.items()) {
        args.emplace_back("--at");
        args.push_back(fmt::format("{}{}={:.17g}", name, prime, value.get<double>()));
    }
}

inline std::string with_forces(const std::string& text, const Json& loads) {
    std::string result = text + "\n[forces]\n";
    for (const auto& [name, value] : loads.items())
        result += fmt::format("{} = {:.17g}\n", name, value.get<double>());
    return result;
}

inline V3 three(const Json& v) {
    return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

inline void check_near(const V3& found, const V3& expected, double tolerance) {
    for (std::size_t k = 0; k < 3; ++k) {
        CAPTURE(k);
        CHECK(std::abs(found[k] - expected[k]) < tolerance);
    }
}

/// A body on a hinge about z; its mass centre at (0, -a, h) of the hinge where theta is 0.
inline const std::string pendulum = R"(gravity = [0, "-g", 0]
[parameters]
g = 9.81
a = 0.7
h = 0.2
[[body]]
name = "rod"
mass = 1.3
inertia = [0.4, 0.1, 0.35]
[[joint]]
name = "pin"
type = "revolute"
parent = "N"
child = "rod"
child_point = [0, "a", "-h"]
coordinates = { theta = { initial = 0.4, rate = 1.7 } }
)";

}  // namespace alembert::test
