// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Dry friction whose normal force is a multiplier, for those who know no such loads.
///
///     need_given_normal_forces(mechanism, "linearize");

#include <string_view>

#include "model/mechanism.hpp"

namespace alembert {

/// Throws ModelError with the friction's name where there is one; `who` is in the way.
void need_given_normal_forces(const Mechanism& m, std::string_view who);

}  // namespace alembert
