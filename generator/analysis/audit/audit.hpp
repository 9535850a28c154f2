// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// An audit of a scene's constraints: kinds, rank, integrability, the initial state.
///
///     const Audit audit = audit_of(mechanism);
///     audit.constraints[0].integral          // x − r·φ, of x' − r·φ' = 0
///     audit.degrees_of_freedom               // independent rates: n − rank
///
/// Rank and redundancy are those that the equations of motion use, at states that obey the constraints, with the
/// scene's parameters (redundancy.hpp). Integrability is exact, for generic parameters (integrability.hpp).
/// `exact_rank` says whether exact arithmetic on the constraint variety has found the same independent
/// constraints.

#include <array>

#include "algebra/notation/phrase.hpp"
#include "analysis/audit/integrability.hpp"
#include "analysis/audit/singular_poses.hpp"

#include "analysis/state/prepared.hpp"

namespace alembert {

struct AuditedConstraint {
    std::string name;
    bool holonomic = true;   ///< as the scene declares it
    bool rheonomic = false;  ///< whether the constraint depends on t, even after simplification
    std::optional<bool>
        integrable;  ///< whether it is integrable together with the others; true for holonomic ones
    std::optional<bool> alone;
    std::optional<Phrase>
        integral;  ///< a function that is constant along every motion; for holonomic constraints it is zero
    bool redundant = false;
    std::array<double, 2> residual{0, 0};  ///< residuals of position and velocity at the initial state
    std::vector<std::string> notes;
};

struct Adjusted {
    std::string name;  ///< x or x'
    double from = 0, to = 0;
};

struct Audit {
    std::vector<AuditedConstraint> constraints;
    int rank = 0, degrees_of_freedom = 0;
    /// The number of independent functions of q and t that are constant along all motions; n minus this number is
    /// the dimension of the set of positions that motions can reach.
    std::optional<int> integrals;
    bool exact_rank = false;
    std::optional<int> generic_rank;  ///< for general parameters, if exact points of the variety were found
    std::vector<int> contradictory;   ///< a smallest set of constraints that no state obeys together
    double failure = 0;  ///< log₂ of the probability that a "yes, integrable" is wrong; 0 if that is impossible
    /// Integrable combinations of constraints that are not integrable themselves: "left - right", and its
    /// integral.
    std::vector<std::pair<std::string, std::optional<Phrase>>> combinations;
    std::vector<Adjusted> adjusted;
    State<double> start;                       ///< the initial state after the adjustment of guesses
    std::vector<SingularPose> singular_poses;  ///< `among` counts all constraints
    /// Poses at which the coordinates fail, and not the mechanism; `among` counts coordinates.
    std::vector<SingularPose> description_poses;
    std::vector<std::string> notes;
    /// The reason why the initial state cannot be used; with `wrong` the scene is wrong, otherwise the computation
    /// failed.
    std::string problem;
    bool wrong = false;
};

Audit audit_of(const Mechanism& mechanism);

/// The whole verb: a scene with the audit of its constraints.
struct Audited : Prepared {
    Audit audit = {};
};

/// Throws SceneError for a mistake in the scene; contradictory constraints and an initial state that breaks them
/// are not reported as exceptions but in `audit.problem`.
Audited audit(Scene scene);

}  // namespace alembert
