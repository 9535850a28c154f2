// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a student probably did wrong: the one small change that sets a claim right.
///
///     const auto slip = likely_slip(scene, claim, mechanism, equations, is_right);
///     slip->kind      // "sign"
///     slip->term      // "-m*g*sin(theta)", as the claim has it
///
/// Tried, in this order: a sign; sine for cosine; another argument; a dot (or a square) more; another length, or one more or
/// less; a number, another parameter or a power; a force that belongs into another equation; a term too many; a term that is
/// missing. The first change after which `is_right` says yes is the answer; it is asked a few hundred times at the most.

#include <functional>
#include <optional>

#include "formalism/equations.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// `kind` as in commands.md: sign factor lost_dot missing_term extra_term swapped_trig wrong_argument wrong_arm wrong_row unknown.
struct Slip {
    std::string kind = "unknown";
    std::string term;    ///< as the claim has it; of a missing one, as it should be
    std::string repair;  ///< the claim, set right
};

std::optional<Slip> likely_slip(const Claim& claim, const GiNaC::ex& residual, const Mechanism& mechanism, const Equations& equations,
                                const std::function<bool(const Claim&)>& is_right);

}  // namespace alembert
