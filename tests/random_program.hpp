// SPDX-License-Identifier: MIT
#pragma once

/// Programs of any length that no scene has, for what must hold for every program.
///
///     const Program p = random_program({.seed = 3, .count = 500, .calls = true, .inputs = 12});
///     const State<double> state = some_state(p, 3);

#include "program/interpret.hpp"

namespace alembert::test {

struct RandomProgram {
    unsigned seed;
    int count;   ///< steps, each of values made before
    bool calls;  ///< with sines, roots, powers and other functions
    int inputs;  ///< coordinates; as many accelerations are results, and 40 outputs
};

/// The values of its steps stay within ±1/2, so that they do not grow from step to step.
Program random_program(const RandomProgram& wish);

/// Coordinates, rates, accelerations and time in ±2, with the parameters of the program.
State<double> some_state(const Program& p, unsigned seed);

}  // namespace alembert::test
