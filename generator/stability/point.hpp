// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene's parameters and state as exactly as they are known: the scene's decimals and expressions, and what was
/// typed, are what they say; other numbers are doubles.

#include "lower/start.hpp"
#include "stability/expansion.hpp"
#include "stability/matrix.hpp"

namespace alembert {

using ExactOverrides = std::vector<std::pair<std::string, std::string>>;  ///< name, number as typed

struct ExactStart {
    CertainVector parameters;  ///< independent ones, as programs count them
    Certain t;
    CertainVector q, qdot, speeds;  ///< speeds: those of the scene with an initial value; others are 0
};

/// `start`: the same in doubles, assembled. Where both differ (guesses that were moved) the double is taken, with
/// a radius.
ExactStart exact_start(const Mechanism& mechanism, const Start& start, const ExactOverrides& exact_at);

/// Independent parameters alone.
CertainVector exact_parameters(const Mechanism& mechanism, const Start& start, const ExactOverrides& exact_at);

/// `exact` where it is the value in use, else that one with a radius.
Certain exact_or(const Certain& exact, double in_use);

}  // namespace alembert
