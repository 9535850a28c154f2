// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Dimensions by the units in the scene. Finds terms of a claim whose dimension differs from that of the others.
///
///     m*x'' + k*v = 0      // k in N/m, v in m/s: "k*v"

#include <optional>
#include <string>

#include "model/mechanism.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// The first term, inside a sum or of a whole side, whose dimension differs from that of most terms of its sum, as
/// the claim writes it; if there are only two terms, the later one. Nothing if all terms agree as far as units are
/// given: a name without a unit may have any dimension. A unit outside the SI is a dimension of its own.
std::optional<std::string> term_of_wrong_unit(const Claim& claim, const Mechanism& mechanism);

/// The SI unit of an expression of the scene: "kg*m/s^2". An angle is a number; positions
/// are in m. Nothing for a number, and where the
/// units of the names in it do not tell, contradict each other or are outside the SI.
std::optional<std::string> si_unit_of(const Expression& expression, const Mechanism& mechanism);

}  // namespace alembert
