// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What is wrong with a claim that fails: the nearest right equation, and the slip that was probably made.
///
///     const Diagnosis found = diagnose({.scene = scene, .claims = claims, .law = law, .forms = forms, .wrong =
///     {},
///                                       .claim = 2, .in_motion = true, .at_impact = false}, states);
///     found.likely->kind       // "sign"

#include <optional>
#include <set>

#include "check/claims.hpp"
#include "check/slip.hpp"
#include "exact/exact_states.hpp"

namespace alembert {

struct Diagnosis {
    std::string reason;      ///< in words; may be empty
    std::string difference;  ///< claim − nearest right equation, term by term
    std::string nearest;     ///< that right equation
    std::optional<Slip> likely;
};

/// The claim in question, and the others.
struct WrongClaim {
    const Scene& scene;
    Claims& claims;
    const Equations& law;                 ///< those that it was held against
    const std::vector<ClaimForm>& forms;  ///< of all claims
    const std::set<std::size_t>&
        wrong;          ///< other claims known to be wrong, of those that share open names with it
    std::size_t claim;  ///< which
    bool in_motion, at_impact;
};

/// `states`: those at which the claim was held against the equations.
Diagnosis diagnose(const WrongClaim& asked, ExactStates& states);

}  // namespace alembert
