// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What each term of a claim would have to be for the claim to hold: from values at exact states.
///
///     needed_factors(claim, edits, words, m, arithmetic)
///     // p_phi = m*l^2*phi'*sin(theta)  →  the factor sin(theta) once more
///
/// If a term is multiplied by ρ, left − right is (a + bρ)/(1 + cρ) as a rule; ρ is found from the values at ρ = 1,
/// 2, 3 and confirmed at 4. It is recognized if it is a number times powers of parameters, and perhaps a sine, a
/// cosine, a coordinate or a rate (check/steady_factor.hpp).

#include "check/claim_arithmetic.hpp"
#include "check/edits.hpp"

namespace alembert {

std::vector<Edit> needed_factors(const Claim& claim, const Edits& edits, const ClaimWords& words,
                                 const Mechanism& mechanism, ClaimArithmetic& arithmetic);

}  // namespace alembert
