// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How the state at the start depends on parameters and on initial values.
///
///     const std::vector<StartName> names{{"l1", StartName::Kind::parameter, 0}};
///     start_derivatives(mechanism, equations, start, names)[0]
///     // ∂(q, q')/∂l1; ∂(q, u)/∂l1 if the equations have speeds u
///
/// By a parameter the whole derivative is meant: values that the scene writes with it change. By an initial value,
/// all others are held. In both cases guesses follow so that the constraints hold: from f(q, p) = 0 and its rate,
/// with F the guesses that are not varied and H all other values,
///
///     ∂f/∂q_F δq_F = −∂f/∂q_H δq_H − ∂f/∂p δp,    ∂f'/∂q'_F δq'_F = −∂f'/∂q'_H δq'_H − ∂f'/∂q δq − ∂f'/∂p δp.

#include <string>
#include <vector>

#include "program/lower/start.hpp"

namespace alembert {

struct StartName {
    enum class Kind { parameter, coordinate, rate, speed, state };
    std::string name;
    Kind kind;
    std::size_t index;  ///< among the parameters, the coordinates, the rates or the scene's speeds
};

/// A column for each name; `start` is assembled (assemble.hpp). Throws ModelError if a value cannot vary by itself
/// because a constraint would break, or if the constraints do not determine the guesses.
std::vector<std::vector<double>> start_derivatives(const Mechanism& mechanism, const Equations& equations,
                                                   const Start& start, const std::vector<StartName>& names);

}  // namespace alembert
