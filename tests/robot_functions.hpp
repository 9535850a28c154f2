// SPDX-License-Identifier: MIT
// What tests of functions for robots share.
#pragma once

#include <doctest/doctest.h>

#include <random>

#include "program/interpret.hpp"
#include "program/lower/robot_functions.hpp"
#include "scenes.hpp"

namespace alembert::test {

/// A random state with random accelerations.
inline State<double> random_motion(const Mechanism& m, std::mt19937_64& random) {
    State<double> state = random_state(start_of(m), random);
    for (int i = 0; i < m.size(); ++i)
        state.qddot.push_back(std::uniform_real_distribution<double>(-3, 3)(random));
    return state;
}

inline std::vector<double> values(const FunctionProgram& f, const State<double>& state) {
    const std::vector<double> all = interpret(f.program, state);
    std::vector<double> result;
    for (const int node : f.program.nodes_of(Group::function))
        result.push_back(all[static_cast<std::size_t>(node)]);
    return result;
}

/// To within `tolerance` of the largest value, or of 1.
inline void check_near(const std::vector<double>& one, const std::vector<double>& other,
                       double tolerance = 1e-10) {
    REQUIRE(one.size() == other.size());
    double size = 1;
    for (const double x : other) size = std::max(size, std::abs(x));
    for (std::size_t i = 0; i < one.size(); ++i) {
        CAPTURE(i);
        CHECK(std::abs(one[i] - other[i]) < tolerance * size);
    }
}

}  // namespace alembert::test
