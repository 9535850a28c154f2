// SPDX-License-Identifier: MIT
#pragma once

/// Functions that the tests of contacts share: a run with its events, a ball, a reader of rows.

#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"
#include "tables.hpp"

namespace alembert::test {

inline constexpr double g = 9.81;

/// The contact events of one kind, and of one contact if it is named.
inline std::vector<Json> of_kind(const Json& motion, const std::string& kind, const std::string& name = "") {
    std::vector<Json> result;
    for (const Json& event : motion["contacts"])
        if (event["event"] == kind && (name.empty() || event["name"] == name)) result.push_back(event);
    return result;
}

inline double value(const Json& event, const char* key) {
    return event[key].get<double>();
}
inline double coordinate(const Json& motion, const char* q) {
    return motion["final"]["coordinates"][q].get<double>();
}
inline double rate(const Json& motion, const char* q) {
    return motion["final"]["rates"][q].get<double>();
}

/// A mass of 2 that falls from the height 1 on a floor.
inline std::string ball(double e, double duration, const std::string& more = "") {
    return temporary("ball.toml", fmt::format(R"toml(
gravity = [0, -9.81]
[coordinates]
y = 1
[[particle]]
name = "ball"
mass = 2
position = [0, "y"]
[[unilateral]]
name = "floor"
gap = "y"
restitution = {}
[simulation]
duration = {}
tolerance = 1e-12
{})toml",
                                              e, duration, more));
}

}  // namespace alembert::test
