// SPDX-License-Identifier: MIT
#pragma once

/// The repository's scenes and random states for them, for tests that hold for every scene.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "files.hpp"
#include "program/lower/start.hpp"
#include "sanitized.hpp"

namespace alembert::test {

/// All .toml files of a folder of the repository, sorted.
inline std::vector<std::string> scenes_in(const std::string& folder) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(source_path(folder)))
        if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
}

/// The text of a textbook scene.
inline std::string textbook_text(const std::string& name) {
    return contents(source_path("scenes/textbook/" + name + ".toml"));
}

/// Every third file, beginning with the one at `first`: for what takes long on each scene and is not bound to one.
/// The tests begin at different files, so that together they meet all scenes; with ALEMBERT_ALL_SCENES in the
/// environment each of them meets all. Under sanitizers a fourth of them is met.
inline std::vector<std::string> every_third(const std::vector<std::string>& files, std::size_t first) {
    if (std::getenv("ALEMBERT_ALL_SCENES") != nullptr) return files;
    std::vector<std::string> result;
    for (std::size_t k = first; k < files.size(); k += is_sanitized ? 12 : 3) result.push_back(files[k]);
    return result;
}

/// How many things a test that meets every third scene has to find at least, if it is `count` without sanitizers.
inline constexpr int at_least(int count) {
    return is_sanitized ? count / 4 : count;
}

/// A state with coordinates in ±π and rates in ±3, at a time in 0 … 10, with the scene's parameters.
inline State<double> random_state(const Start& start, std::mt19937_64& random) {
    std::uniform_real_distribution<double> turn(-M_PI, M_PI), rate(-3, 3), time(0, 10);
    State<double> state = start.state();
    state.t = time(random);
    for (double& q : state.q) q = turn(random);
    for (double& u : state.qdot) u = rate(random);
    return state;
}

}  // namespace alembert::test
