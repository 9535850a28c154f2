// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Do right claims say everything about the motion?

#include "check/claims.hpp"

namespace alembert {

/// With the constraints, and with what the claims leave open eliminated, do the forms `right` determine every
/// acceleration? Decided by ranks at an exact state.
bool fix_accelerations(const Claims& claims, const std::vector<const ClaimForm*>& right);

}  // namespace alembert
