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

#include "analysis/exact/exact_states.hpp"
#include "check/claims.hpp"
#include "check/missing_terms.hpp"
#include "check/slip.hpp"

namespace alembert {

struct Diagnosis {
    std::string reason;      ///< the reason in words; may be empty
    std::string difference;  ///< claim − nearest right equation, term by term
    std::string nearest;     ///< that right equation
    std::optional<Slip> likely;
    std::optional<ClaimForm> repaired;  ///< the claim into which it was corrected, for a look in numbers
};

/// The claim that is wrong, and the other claims.
struct WrongClaim {
    const Scene& scene;
    Claims& claims;
    const Equations& law;                 ///< the equations that the claim was compared with
    const std::vector<ClaimForm>& forms;  ///< the forms of all claims
    const std::set<std::size_t>&
        wrong;          ///< other claims known to be wrong, of those that share open names with it
    std::size_t claim;  ///< position of the wrong claim
    bool in_motion, at_impact;
    std::optional<EquationTerms>& known;  ///< of the law; made when it is first needed
    bool up_to_constant =
        false;  ///< whether it is right up to a constant; its states are then those of any motion
};

/// `states`: the states at which the claim was compared with the equations.
Diagnosis diagnose(const WrongClaim& asked, ExactStates& states);

}  // namespace alembert
