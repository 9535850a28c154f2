// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The multipliers of a mechanism.
///
///     z.depends(event.value, multipliers_of(mechanism))    // whether an event looks at forces of constraints

#include "model/mechanism.hpp"

namespace alembert {

/// Those of the constraints, then of those that follow from others, then of unilateral contacts.
std::vector<GiNaC::symbol> multipliers_of(const Mechanism& mechanism);

}  // namespace alembert
