// SPDX-License-Identifier: MIT
#pragma once

/// Functions that the tests of contacts share: a run with its events, a ball, a reader of rows.

#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"
#include "scenes.hpp"

namespace alembert::test {

using Json = nlohmann::json;

inline constexpr double g = 9.81;

inline Json simulated(const std::string& scene, const std::vector<std::string>& more = {}) {
    std::vector<std::string> args{"simulate", scene, "--json"};
    args.insert(args.end(), more.begin(), more.end());
    const auto result = run(args);
    CAPTURE(result.err);
    REQUIRE(result.exit == 0);
    return Json::parse(result.out);
}

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

inline std::vector<std::vector<double>> table_of(const std::string& file) {
    std::ifstream in(file);
    std::vector<std::vector<double>> rows;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::vector<double> row;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
        rows.push_back(row);
    }
    return rows;
}

}  // namespace alembert::test
