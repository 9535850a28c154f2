// SPDX-License-Identifier: MIT
#pragma once

/// What the program prints with `--json`.
///
///     const Json end = json_of({"simulate", scene, "--duration", "3"})["final"];

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace alembert::test {

using Json = nlohmann::json;

/// `alembert ARGS… MORE… --json`, which must end with this code.
inline Json json_of(std::vector<std::string> args, const std::vector<std::string>& more = {}, int exit = 0) {
    args.insert(args.end(), more.begin(), more.end());
    if (std::find(args.begin(), args.end(), "--json") == args.end()) args.emplace_back("--json");
    const Run result = run(args);
    INFO(result.err);
    REQUIRE(result.exit == exit);
    return Json::parse(result.out);
}

inline Json simulated(const std::string& scene, const std::vector<std::string>& more = {}) {
    return json_of({"simulate", scene}, more);
}

/// The words are the scene and what follows it.
inline Json swept(const std::vector<std::string>& words, int exit = 0) {
    return json_of({"sweep"}, words, exit);
}

/// A value of an object in an object, as in number(end, "coordinates", "x").
inline double number(const Json& object, const char* group, const std::string& name) {
    return object[group][name].get<double>();
}

}  // namespace alembert::test
