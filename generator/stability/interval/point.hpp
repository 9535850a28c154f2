// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene's parameters and state as exactly as they are known. The decimals and expressions of the scene and
/// typed values are exact; other numbers are doubles.

#include "program/lower/start.hpp"
#include "stability/interval/expansion.hpp"
#include "stability/interval/matrix.hpp"

namespace alembert {

using ExactOverrides = std::vector<std::pair<std::string, std::string>>;  ///< name, number as typed

struct ExactStart {
    RealBallVector parameters;  ///< the independent parameters, in the order of programs
    RealBall t;
    RealBallVector q, qdot, speeds;  ///< `speeds` are those of the scene with an initial value; others are 0
    RealBallVector states;           ///< the scene's first-order states
};

/// Parameters and state of the equations of motion, in the order of their programs.
struct RealBallPoint {
    RealBallVector parameters = {}, q = {}, u = {};
    RealBall t = {};
    RealBallVector inputs = {};  ///< 3·input + order
};

/// The values of a program there.
State<Expansion> state_of(const RealBallPoint& at);

/// `start` is the same in doubles, assembled. If both differ (guesses that were moved), the double is used, with a
/// radius.
ExactStart exact_start(const Mechanism& mechanism, const Start& start, const ExactOverrides& exact_at);

/// The independent parameters only.
RealBallVector exact_parameters(const Mechanism& mechanism, const Start& start, const ExactOverrides& exact_at);

/// `exact` if it is the value in use, otherwise that value with a radius.
RealBall exact_or(const RealBall& exact, double in_use);

}  // namespace alembert
