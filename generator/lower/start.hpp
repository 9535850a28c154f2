// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Numbers for a mechanism: the scene's own, with some of them replaced.
///
///     const Start start = start_of(mechanism, {{"theta1", 0.3}, {"theta1'", 1.0}, {"l1", 2.0}});

#include <string>
#include <utility>
#include <vector>

#include "lower/interpret.hpp"
#include "formalism/equations.hpp"

namespace alembert {

struct Start {
    std::vector<double> parameters;  ///< the independent ones, as Program counts them
    double t = 0;
    std::vector<double> q, qdot;
    std::vector<double> speeds;      ///< of the scene, where the rates follow from them; else empty
    double duration = 10;            ///< s; 10 where the scene is silent
    double tolerance = 1e-9, step = 0, sample = 0;

    State<double> state() const { return {.parameters = parameters, .t = t, .q = q, .qdot = qdot, .qddot = {}}; }
};

using Overrides = std::vector<std::pair<std::string, double>>;

/// The state as a program of these equations counts it: (q, q'), or (q, u).
State<double> state_of(const Start& start, const Mechanism& mechanism, const Equations& equations);

/// Initial values that depend on parameters follow the replaced ones. A name is a parameter's, a coordinate's, a
/// rate's (`theta1'`), a generalized speed's or `t`. Throws ModelError for any other, with the nearest known name, for a parameter that
/// is defined by others, and for a value that is not finite.
Start start_of(const Mechanism& mechanism, const Overrides& overrides = {});

}  // namespace alembert
