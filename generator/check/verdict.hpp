// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verdict on one claim.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/assumption.hpp"

namespace alembert {

/// The mistake that was probably made.
/// `kind` as in commands.md: sign factor lost_dot missing_term extra_term swapped_trig wrong_argument wrong_arm
/// wrong_row wrong_unit unknown.
struct Slip {
    std::string kind = "unknown";
    std::string term = {};       ///< as the claim writes it; for a missing term, as it should be
    std::string repair = {};     ///< the corrected claim
    std::string should_be = {};  ///< what `term` should be; empty if `kind` says it
    std::string written = {};    ///< what stands in the term and should not: "sin", "l^2", a factor
    std::string meant = {};      ///< what should stand there instead, or a factor that is missing
    std::string also = {};       ///< a second term whose sign is wrong too
};

/// The slip in words: "the sign of m*g".
std::string words_of(const Slip& slip);

enum class Verdict { proved, refuted, undecided, vacuous };

/// Another branch of the constraints, on which the claim is otherwise.
struct OtherBranch {
    Verdict verdict = Verdict::undecided;  ///< proved or refuted
    std::vector<std::pair<std::string, std::string>>
        where{};  ///< a place on it; empty if none was found in numbers
    std::vector<std::pair<std::string, std::string>> counterexample{};  ///< a state there, if the claim is refuted
};

/// A potential or an energy is right up to a constant, a Lagrangian up to the total time derivative of a function
/// F of coordinates and time: what is claimed is the quantity plus this constant, or plus F'.
struct UpTo {
    enum class Kind { constant, derivative } kind = Kind::constant;
    std::string text{};  ///< the constant, or F; empty if it was not found in a short form
};

struct CheckedClaim {
    Verdict verdict = Verdict::undecided;
    bool normal_form = false;  ///< proved by normal form
    bool kinematic = false;    ///< proved for every motion that the constraints allow, whatever the forces
    double failure = 0;        ///< log₂ of the probability that sampling is wrong
    std::string reason;        ///< the reason in words, if there is something to explain
    std::vector<std::pair<std::string, std::string>> counterexample;  ///< name → value, as typed
    std::string residual;                                             ///< lhs − rhs at the counterexample
    double residual_value = 0;
    std::string difference;  ///< claim − nearest right equation, term by term
    std::string nearest;     ///< that right equation
    std::optional<Slip> likely;
    std::optional<UpTo> up_to;  ///< of a claim that is proved
    std::optional<OtherBranch> other_branch;
    std::vector<Assumption> assumed;  ///< nothing for a verdict without conditions
    /// Of a refuted claim: on which sides it holds all the same, each with what must hold there together: "x > 0,
    /// y < 0".
    std::vector<std::string> holds_where;
};

/// The inequalities among its assumptions.
std::vector<std::string> conditions_of(const CheckedClaim& claim);

}  // namespace alembert
