// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The dimensions of coordinates, speeds and multipliers: those that the units give, and those that follow.
///
///     for (const ConcludedDimension& d : concluded_dimensions(scene))
///         d.name, d.dimension, d.is_given;         // "theta", 1, false: it stands in a sine
///
/// A position is in m, a mass in kg, the argument of a sine a number, all terms of a sum are alike: each says what
/// one name is where everything else in the expression is known, until nothing new follows. A multiplier times its
/// constraint is an energy, of a constraint of rates a power.

#include <optional>
#include <string>
#include <vector>

#include "scene/dimensions.hpp"

namespace alembert {

struct ConcludedDimension {
    std::string name;                    ///< theta, lambda_rod
    std::optional<Dimension> dimension;  ///< nothing if it does not follow
    bool is_given = false;               ///< by a unit
};

/// In the order coordinates, speeds, states, multipliers of constraints and of contacts; multipliers of rolling
/// are those along x, y and z. Joints that close loops are left out.
std::vector<ConcludedDimension> concluded_dimensions(const Scene& scene);

}  // namespace alembert
