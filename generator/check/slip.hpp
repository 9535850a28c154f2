// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds the probable mistake of a student: the one small change that makes a claim right.
///
///     const Judge judge{.is_right = …, .vanishes = …, .absent = …};
///     const auto slip = likely_slip(claim, residual, mechanism, equations, judge);
///     slip->kind      // "sign"
///     slip->term      // "-m*g*sin(theta)", as the claim has it
///
/// The following changes are tried in this order: a sign; sine for cosine; another argument; a dot (or a square)
/// more; another length, or one more or less; a number, another parameter or a power; a term of the nearest
/// equation that is missing; a force that belongs to another equation; a term too many; any other term that is
/// missing (check/absent.hpp). The first change after which `is_right` is true is the answer, unless it only makes
/// its term vanish; `is_right` is called at most a few hundred times.

#include <functional>
#include <optional>

#include "formalism/equations.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// `kind` as in commands.md: sign factor lost_dot missing_term extra_term swapped_trig wrong_argument wrong_arm
/// wrong_row wrong_unit unknown.
struct Slip {
    std::string kind = "unknown";
    std::string term;    ///< as the claim writes it; for a missing term, as it should be
    std::string repair;  ///< the corrected claim
};

/// The questions that can be asked about modified claims.
struct Judge {
    std::function<bool(const Claim&)> is_right;
    std::function<bool(const Expression&)> vanishes;  ///< whether it is zero on every motion
    /// Multiples of `terms`, or of terms that are usual in mechanics if there are none, each of which may be
    /// missing on the left side of `claim`: "2*m" and "r'*phi'". The simplest first.
    std::function<std::vector<std::pair<std::string, std::string>>(const Claim& claim,
                                                                   std::vector<std::string> terms)>
        absent;
};

std::optional<Slip> likely_slip(const Claim& claim, const GiNaC::ex& residual, const Mechanism& mechanism,
                                const Equations& equations, const Judge& judge);

}  // namespace alembert
