// SPDX-License-Identifier: MIT
#pragma once

/// Scenes as functional mock-up units, and the motions that `simulate` gives of them.
///
///     const Unit unit = exported(scene, 2);
///     difference(one, simulated(scene, 3));
///     check_unit(scene, 3);                                  // in both kinds and versions, as `simulate`

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "files.hpp"
#include "fmu_master.hpp"
#include "json.hpp"
#include "shell.hpp"

namespace alembert::test {

inline std::string file_name(const std::string& name) {
    static int count = 0;
    return fmt::format("{}/{}", temporary_folder(fmt::format("units-{}", count++)), name);
}

/// Units of tests are compiled at -O0, in a third of the time, with the same numbers: sums stay in their order at
/// every level. `as_shipped` are compiled as users get them.
enum class Compiled { quickly, as_shipped };

/// While it exists, the program compiles at -O0.
class QuickCompiler {
public:
    QuickCompiler() {
        const char* const variable = std::getenv("CXX");
        if (variable != nullptr) before_ = variable;
        const std::string script = file_name("compiler");
        std::ofstream(script) << "#!/bin/sh\nexec " << (before_.empty() ? "g++" : before_) << " \"$@\" -O0\n";
        std::filesystem::permissions(script, std::filesystem::perms::owner_all);
        setenv("CXX", script.c_str(), 1);
    }
    QuickCompiler(const QuickCompiler&) = delete;
    QuickCompiler& operator=(const QuickCompiler&) = delete;
    ~QuickCompiler() {
        if (before_.empty())
            unsetenv("CXX");
        else
            setenv("CXX", before_.c_str(), 1);
    }

private:
    std::string before_;
};

inline Unit exported(const std::string& scene, int fmi, Compiled how = Compiled::quickly) {
    std::optional<QuickCompiler> quick;
    if (how == Compiled::quickly) quick.emplace();
    const std::string file = file_name("unit.fmu");
    const auto made = run({"fmu", scene, "-o", file, "--fmi", std::to_string(fmi), "--json"});
    REQUIRE_MESSAGE(made.exit == 0, made.err);
    return Unit(contents(file), Json::parse(made.out)["token"], fmi);
}

/// Start values by the names of the state: "x" and "der(x)".
using StartValues = std::map<std::string, double>;

inline Json simulated(const std::string& scene, double end, const StartValues& start = {}) {
    std::vector<std::string> words{"simulate",    scene,  "--duration", fmt::format("{}", end),
                                   "--tolerance", "1e-12"};
    for (const auto& [name, value] : start) {
        const bool is_rate = name.starts_with("der(");
        words.emplace_back("--at");
        words.push_back(fmt::format("{}={}", is_rate ? name.substr(4, name.size() - 5) + "'" : name, value));
    }
    return json_of(words)["final"];
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

/// The same with the scene's states.
inline double all_differences(const Instance& one, const Json& final) {
    double worst = difference(one, final);
    if (!final.contains("states")) return worst;
    for (const auto& [name, value] : final["states"].items()) {
        const double z = value;
        worst = std::max(worst, std::abs(one.get(name) - z) / std::max(1.0, std::abs(z)));
    }
    return worst;
}

/// Until `end`, which may lie beyond the end of the motion: in co-simulation with large steps and in model
/// exchange, by both versions of the interface.
inline void check_unit(const std::string& scene, double end, double allowed = 1e-7,
                       const StartValues& start = {}) {
    const Json final = simulated(scene, end, start);
    for (const int version : {2, 3}) {
        CAPTURE(version);
        const Unit unit = exported(scene, version);
        for (const int steps : {1, 7}) {
            CAPTURE(steps);
            Instance one(unit, true, 1e-10);
            for (const auto& [name, value] : start) one.set(name, value);
            one.begin();
            bool goes_on = true;
            for (int k = 0; k < steps && goes_on; ++k) goes_on = one.step(end * k / steps, end / steps);
            CHECK(goes_on == (final["time"].get<double>() > end - 1e-9));
            CHECK(all_differences(one, final) < allowed);
        }
        Instance exchanged(unit, false);
        for (const auto& [name, value] : start) exchanged.set(name, value);
        exchanged.begin();
        exchange(exchanged, end, 2000);
        CHECK(all_differences(exchanged, final) < allowed);
    }
}

}  // namespace alembert::test
