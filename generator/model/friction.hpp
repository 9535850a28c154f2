// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Refuses dry friction whose normal force is a multiplier, for computations that do not support such loads.
///
///     need_given_normal_forces(mechanism, "linearize");

#include <string_view>

#include "model/mechanism.hpp"

namespace alembert {

/// Throws ModelError with the friction's name if there is one. `who` names the computation in the message.
void need_given_normal_forces(const Mechanism& m, std::string_view who);

}  // namespace alembert
