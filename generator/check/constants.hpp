// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Constants of the motion in claims that are not linear in them: with m r² θ' = L as another claim,
/// m r'' − L²/(m r³) = … is read with the value of L that this claim gives.

#include <map>

#include "check/claims.hpp"
#include "check/verdict.hpp"

namespace alembert {

class GivenConstants {
public:
    /// Puts the constants into those of `forms`, the claims of the scene in its order, that are not linear in
    /// them. The value comes from a claim that is linear and leaves nothing else open.
    GivenConstants(const Scene& scene, Claims& claims, std::vector<ClaimForm>& forms);

    /// A claim into which constants were put says nothing if the claims that give them are not proved: it becomes
    /// undecided, with the reason.
    void withdraw(const Scene& scene, std::vector<CheckedClaim>& verdicts) const;

private:
    std::map<std::size_t, std::vector<std::size_t>> rests_on_;  ///< claim → claims that give constants in it
};

}  // namespace alembert
