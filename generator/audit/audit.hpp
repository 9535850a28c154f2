// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a scene's constraints are worth: kinds, rank, integrability, the initial state.
///
///     const Audit audit = audit_of(mechanism);
///     audit.constraints[0].integral          // x − r·φ, of x' − r·φ' = 0
///     audit.degrees_of_freedom               // independent rates: n − rank
///
/// Rank and redundancy are those that the equations of motion use: at states that obey the constraints, with the
/// scene's parameters (redundancy.hpp). Integrability is exact, for generic parameters (integrability.hpp).
/// `exact_rank` says whether exact arithmetic on the constraint variety has found the same independent
/// constraints.

#include <array>

#include "audit/integrability.hpp"
#include "audit/singular_poses.hpp"
#include "notation/phrase.hpp"

#include "state/prepared.hpp"

namespace alembert {

struct AuditedConstraint {
    std::string name;
    bool holonomic = true;           ///< as declared
    bool rheonomic = false;          ///< t occurs, and not only in how it is written
    std::optional<bool> integrable;  ///< together with the others; true of holonomic ones
    std::optional<bool> alone;
    std::optional<Phrase> integral;  ///< constant along every motion; zero, for holonomic ones
    bool redundant = false;
    std::array<double, 2> residual{0, 0};  ///< of position and velocity, at the initial state
    std::vector<std::string> notes;
};

struct Adjusted {
    std::string name;  ///< x or x'
    double from = 0, to = 0;
};

struct Audit {
    std::vector<AuditedConstraint> constraints;
    int rank = 0, degrees_of_freedom = 0;
    /// Independent functions of q and t that all motions keep; n minus these is the dimension of where they lead.
    std::optional<int> integrals;
    bool exact_rank = false;
    std::optional<int> generic_rank;  ///< for general parameters, where exact points of the variety were found
    std::vector<int> contradictory;   ///< constraints that no state obeys together, as few as possible
    double failure = 0;  ///< log₂ of the chance that a "yes, integrable" is wrong; 0 where none is at stake
    /// Integrable combinations of constraints that are not: "left - right", and what it keeps.
    std::vector<std::pair<std::string, std::optional<Phrase>>> combinations;
    std::vector<Adjusted> adjusted;
    State<double> start;                       ///< after the adjustment
    std::vector<SingularPose> singular_poses;  ///< `among` counts all constraints
    std::vector<std::string> notes;
    /// Why the initial state does not do; `wrong`: the scene is wrong, otherwise the numbers failed.
    std::string problem;
    bool wrong = false;
};

Audit audit_of(const Mechanism& mechanism);

/// The whole verb: a scene with the audit of its constraints.
struct Audited : Prepared {
    Audit audit = {};
};

/// Throws SceneError for a mistake in the scene; contradictory constraints and an initial state that breaks them
/// are no exception here, but stand in `audit.problem`.
Audited audit(Scene scene);

}  // namespace alembert
