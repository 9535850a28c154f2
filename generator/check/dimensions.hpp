// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds terms of a claim whose dimension differs from that of the others, by the units in the scene.
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

}  // namespace alembert
