// SPDX-License-Identifier: MIT
#pragma once

/// Mechanisms and their equations, for tests of formalisms.
///
///     const Mechanism m = textbook("chaplygin_sleigh");
///     equations_of(m, routh(m));                                   // "m*x'' = …\n…"
///     group(lowered(m, routh(m)), state, Group::acceleration);

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "algebra/notation/text.hpp"
#include "analysis/state/prepared.hpp"
#include "present/report/derivation.hpp"
#include "program/interpret.hpp"
#include "program/lower/lower.hpp"
#include "scenes.hpp"

namespace alembert::test {

inline Mechanism from_text(const std::string& scene) {
    return build(parse_scene(scene, "scene.toml"));
}

inline Mechanism textbook(const std::string& name) {
    return prepared(read_scene(source_path("scenes/textbook/" + name + ".toml"))).mechanism;
}

/// The equations and the kinematics as `derive` shows them, one in each line.
inline std::string equations_of(const Mechanism& m, const Equations& equations) {
    const Derivation shown = derivation_of(m, equations);
    std::string result;
    for (const ReadableEquation& e : shown.equations) result += text(e.lhs) + " = " + text(e.rhs) + "\n";
    for (const auto& [rate, value] : shown.kinematics) result += text(rate) + " = " + text(value) + "\n";
    return result;
}

inline Program lowered(const Mechanism& m, const Equations& equations) {
    return lower(m, equations, energy_of(m));
}

inline std::vector<double> group(const Program& program, const State<double>& state, Group name) {
    const std::vector<double> value = interpret(program, state);
    std::vector<double> result;
    for (const int id : program.nodes_of(name)) result.push_back(value[static_cast<std::size_t>(id)]);
    return result;
}

/// The largest difference over the largest size.
inline double relative_distance(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double worst = 0, size = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        worst = std::max(worst, std::abs(a[i] - b[i]));
        size = std::max(size, std::abs(b[i]));
    }
    return worst / size;
}

/// The scenes of scenes/benchmark/trees with their accelerations at the start, which were computed elsewhere.
struct ReferenceTree {
    std::string name;
    std::vector<double> accelerations;
    Mechanism mechanism() const {
        return prepared(read_scene(source_path("scenes/benchmark/trees/" + name + ".toml"))).mechanism;
    }
};

inline std::vector<ReferenceTree> reference_trees() {
    std::ifstream file(source_path("tests/reference/trees.txt"));
    std::vector<ReferenceTree> result;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream words(line);
        ReferenceTree tree;
        words >> tree.name;
        for (double a = 0; words >> a;) tree.accelerations.push_back(a);
        result.push_back(tree);
    }
    return result;
}

}  // namespace alembert::test
