// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Terms of a claim whose dimension is not that of the others, by the units that the scene gives.
///
///     m*x'' + k*v = 0      // k in N/m, v in m/s: "k*v"

#include <optional>
#include <string>

#include "model/mechanism.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// The first term, inside a sum or of a whole side, whose dimension differs from that of the most terms of its
/// sum, as the claim has it; the later one of two. Nothing where all agree as far as units are given: a name
/// without unit has any dimension. A unit that is not of the SI is a dimension of its own.
std::optional<std::string> term_of_wrong_unit(const Claim& claim, const Mechanism& mechanism);

}  // namespace alembert
