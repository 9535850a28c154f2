// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Do the right claims determine the motion completely?

#include "check/basis.hpp"
#include "check/claims.hpp"

namespace alembert {

struct Completeness {
    bool is_complete = false;
    int missing = 0;  ///< how many equations of motion are missing; 0 too where no state was found
    int freedom = 0;  ///< how many are needed beside the constraints
};

/// Do the forms `right`, together with the constraints, determine every acceleration after the open names of the
/// claims are eliminated? Ranks at an exact state decide this, one where they all hold if possible.
Completeness completeness(Basis& basis, const Claims& claims, const std::vector<const ClaimForm*>& right);

}  // namespace alembert
