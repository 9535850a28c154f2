// SPDX-License-Identifier: MIT
// What tests of functions for robots share.
#pragma once

#include <doctest/doctest.h>

#include <random>

#include "near.hpp"
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

}  // namespace alembert::test
