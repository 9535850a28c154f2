// SPDX-License-Identifier: MIT
#pragma once

/// Scenes as functional mock-up units, and the motions that `simulate` gives of them.
///
///     const Unit unit = exported(scene, 2);
///     difference(one, simulated(scene, 3));

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "fmu_master.hpp"
#include "json.hpp"
#include "shell.hpp"

namespace alembert::test {

inline std::string file_name(const std::string& name) {
    static int count = 0;
    return fmt::format("{}/{}", temporary_folder(fmt::format("units-{}", count++)), name);
}

inline Unit exported(const std::string& scene, int fmi) {
    const std::string file = file_name("unit.fmu");
    const auto made = run({"fmu", scene, "-o", file, "--fmi", std::to_string(fmi), "--json"});
    REQUIRE_MESSAGE(made.exit == 0, made.err);
    return Unit(contents(file), Json::parse(made.out)["token"], fmi);
}

inline Json simulated(const std::string& scene, double end) {
    return json_of({"simulate", scene, "--duration", fmt::format("{}", end), "--tolerance", "1e-12"})["final"];
}

/// The largest difference of coordinates and rates, relative to max(1, |x|).
inline double difference(const Instance& one, const Json& final) {
    double worst = 0;
    for (const auto& [name, value] : final["coordinates"].items()) {
        const double x = value, v = final["rates"][name];
        worst = std::max({worst, std::abs(one.get(name) - x) / std::max(1.0, std::abs(x)),
                          std::abs(one.get("der(" + name + ")") - v) / std::max(1.0, std::abs(v))});
    }
    return worst;
}

}  // namespace alembert::test
