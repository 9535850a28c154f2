// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds the probable mistake of a student: the smallest change in one place that makes a claim right.
///
///     const Judge judge{.is_right = …, .vanishes = …, .terms = …, .missing = …};
///     const auto found = likely_slip(claim, residual, mechanism, equations, judge);
///     found->slip.kind      // "sign"
///     found->slip.term      // "m*g*sin(theta)", as the claim has it
///     found->slip.repair    // "m*l*theta'' + m*g*sin(theta) = 0"
///
/// All changes (check/edits.hpp) are ordered by their size, from a sign to a whole term. The first after which
/// `is_right` is true is the answer, unless it only makes its term vanish. Nothing is sought in a claim that
/// is too long for all its changes (`Edits::complete`). Where a claim can be evaluated at exact
/// states, what each term would have to be there is computed too: a number, powers of parameters, a sine that is
/// missing. `is_right` is then asked about the few changes that make the claim hold at these states.

#include <functional>
#include <optional>

#include "check/missing_terms.hpp"
#include "check/verdict.hpp"
#include "model/formalism/equations.hpp"
#include "scene/scene.hpp"

namespace alembert {

class ClaimArithmetic;

/// A term that the claim may lack, to be added on the left, and how much there is in its coefficient.
struct MissingTerm {
    TreePtr tree;
    int effort = 0;
};

/// The questions that can be asked about modified claims.
struct Judge {
    std::function<bool(const Claim&)> is_right;
    std::function<bool(const Expression&)> vanishes;    ///< whether it is zero on every motion
    std::function<const EquationTerms&()> terms;        ///< what stands in the equations
    std::function<std::vector<MissingTerm>()> missing;  ///< the simplest first
    ClaimArithmetic* arithmetic = nullptr;              ///< of the claim; null if it cannot be evaluated
};

/// A slip, and the claim that is right without it.
struct Repair {
    Slip slip;
    Equality equation;
};
std::optional<Repair> likely_slip(const Claim& claim, const GiNaC::ex& residual, const Mechanism& mechanism,
                                  const Equations& equations, const Judge& judge);

}  // namespace alembert
