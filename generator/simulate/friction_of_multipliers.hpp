// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Dry friction whose normal force is a multiplier, in the form that a projection needs where the constraints
/// nearly lose rank (alembert/ode/projection.hpp).
///
///     const FrictionAt friction = friction_of_multipliers(switched.program, symbols);
///     projection.guarded(rhs, values, friction(values));

#include <functional>
#include <mutex>
#include <vector>

#include "alembert/ode/projection.hpp"
#include "program/program.hpp"

namespace alembert {

/// For given parameters: those of the scene, followed by those that a run holds (program/switches.hpp).
using FrictionAt = std::function<ForcesOfMultipliers(const std::vector<double>& values)>;

/// By interpretation; what it gives is empty if there is no such friction. Both arguments must outlive the result.
/// Threads that interpret a program hold the lock `symbols`.
FrictionAt friction_of_multipliers(const Program& program, std::recursive_mutex& symbols);

}  // namespace alembert
