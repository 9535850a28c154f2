// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How the end of a motion depends on the values at its start and on parameters.
///
///     const Run run = simulate(scene, {.duration = 3, .sensitivity = {"theta1", "l1"}});
///     run.sensitivity->values[0][1];      // ∂(theta1 at the end)/∂l1
///
/// The variational equations Φ' = ∂f/∂x Φ + ∂f/∂p are integrated together with the motion by dop853, under the
/// control of the errors of both (Hairer, Nørsett & Wanner, Solving ODEs I, §I.14). The time of the end is held.
/// By a parameter the whole derivative is meant, that of a run with another value: initial values that the scene
/// writes with it change too.

#include <string>
#include <vector>

#include "derive/derived.hpp"
#include "lower/start.hpp"

namespace alembert {

struct Sensitivity {
    double time = 0;                          ///< of the end, in s
    std::vector<std::string> of, by;          ///< names of the components at the end, and of what is varied
    std::vector<std::vector<double>> values;  ///< [of][by], in the scene's units
    long steps = 0, evaluations = 0;
};

class Sensitivities {
public:
    /// `program` is that of `derived`; the arguments must outlive the object. Throws ModelError for names that the
    /// scene does not have or that follow from others, and for a scene whose motion is not smooth, that has
    /// constraints, or whose derivatives are too long.
    Sensitivities(const Derived& derived, const Program& program, const Start& start,
                  const std::vector<std::string>& names);

    /// At the time `end`. Throws IntegrationError if the equations cannot be integrated to it.
    Sensitivity at(double end, double tolerance, long budget) const;

private:
    Program program_;
    Start start_;
    std::vector<double> state_;  ///< at the start
    std::vector<std::string> of_, names_;
    std::vector<int> parameters_;               ///< the position of the parameter of each name, or −1
    std::vector<std::vector<double>> columns_;  ///< the derivative of the state at the start by each name
};

}  // namespace alembert
