// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The claims of one mode as they are compared with the equations: what the parts of the check share.
///
///     Comparison now{.scene = scene, .basis = basis, .m = basis.mechanism, .e = basis.equations, .claims =
///     claims}; now.at = Claim::At::rest;                       // what the claims speak of that are compared now
///     decide(now, {2});                               // writes now.verdicts[2]

#include <optional>
#include <set>
#include <vector>

#include "analysis/exact/exact_states.hpp"
#include "check/basis.hpp"
#include "check/claims.hpp"
#include "check/counterexample.hpp"
#include "check/own_motion.hpp"
#include "check/verdict.hpp"

namespace alembert {

struct Comparison {
    const Scene& scene;
    Basis& basis;
    const Mechanism& m;
    const Equations& e;
    Claims& claims;
    std::vector<ClaimForm> forms = {};                 ///< of the claims of the scene
    std::vector<CheckedClaim> verdicts = {};           ///< likewise
    std::vector<std::vector<GiNaC::ex>> sheets = {};   ///< what is positive on the sheet of each claim
    std::vector<std::vector<GiNaC::ex>> domains = {};  ///< and where each has a meaning
    /// What is positive on the sheet of the scene and its claims, not of repairs that are tried.
    std::vector<GiNaC::ex> positive = {};
    std::vector<GiNaC::ex> assumed = {};  ///< of these, what the claims assume themselves
    OwnMotion own_motion{claims, e};
    std::optional<std::vector<GiNaC::ex>> own_factors = {};  ///< of constraints that are products, once asked for

    // For the claims that are compared now:
    Claim::At at = Claim::At::motion;      ///< motion, rest or impact
    Equations law = {};                    ///< the equations with the multipliers that these claims contain
    std::vector<std::size_t> spoken = {};  ///< positions of these multipliers in Mechanism::undetermined()
    bool is_any_motion = false;            ///< the law is that of every motion, as there are no masses
    std::optional<EquationTerms>* known = nullptr;  ///< of the law; made when it is first needed
    /// Exact states on the scene's own branch of the constraints, if there are several branches: claims are judged
    /// there.
    ExactStates* on_own_branch = nullptr;
    std::set<std::size_t> wrong = {};  ///< the wrong ones of claims that share open names

    /// From now on the sheet is that of these claims: a claim alone is not judged by what another one needs.
    void compare_on_sheet_of(const std::vector<std::size_t>& of);
    /// Whether the constraints have branches, and the claims are about the motion on the scene's own.
    bool knows_own_branch() { return at == Claim::At::motion && basis.own_branch().has_value(); }
};

/// Adds an expression that is positive to a list, if it is not there.
void add_positive(std::vector<GiNaC::ex>& list, const GiNaC::ex& positive);

/// Whether claims are about the scene's own branch of several. What a claim assumes may exclude that branch.
bool has_branches(Comparison& now);
Told told(Comparison& now);

/// How often angles must be halved for the residuals of these claims to be rational.
int halvings_in(const Comparison& now, const std::vector<std::size_t>& claims);

}  // namespace alembert
