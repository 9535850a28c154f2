// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Do the right claims determine the motion completely?

#include "check/claims.hpp"

namespace alembert {

/// Do the forms `right`, together with the constraints, determine every acceleration after the open names of the
/// claims are eliminated? Ranks at an exact state decide this.
bool fix_accelerations(const Claims& claims, const std::vector<const ClaimForm*>& right);

}  // namespace alembert
