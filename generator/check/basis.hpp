// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What all claims about one mechanism share: its equations with multipliers, derived once, and the exact states
/// that obey them, each of which is computed once however many claims are compared with the equations there.
///
///     Basis basis(bound.mechanism, bound.equations);
///     basis.states({.spoken = {0}, .halvings = 1}).get(2);       // the third, with the reaction of a contact

#include <compare>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/exact/exact_states.hpp"
#include "check/missing_terms.hpp"
#include "model/formalism/equations.hpp"

namespace alembert {

class Basis {
public:
    /// `driven`: what rates in mechanism and equations are counted from (model/formalism/driven.hpp).
    Basis(const Mechanism& mechanism, Equations equations, GiNaC::exmap driven = {});
    Basis(const Basis&) = delete;
    Basis& operator=(const Basis&) = delete;

    const Equations equations;
    const Mechanism mechanism;  ///< with a table of intermediate symbols that has those of the equations too
    const GiNaC::exmap driven;

    /// Which states of which equations.
    struct Wanted {
        /// Positions in Mechanism::undetermined() of the reactions that are in the equations.
        std::vector<std::size_t> spoken = {};
        bool is_any_motion = false;  ///< the equations that every motion obeys (any_motion)
        Motions::At at = Motions::At::motion;
        int halves = 0, halvings = 0;
        Motions::Positions positions = Motions::Positions::solved;
        bool knows_own_branch = false, stays_on_own_branch = false;
        auto operator<=>(const Wanted&) const = default;
    };
    ExactStates& states(const Wanted& wanted);
    /// States of the same kind of another mechanism, which nothing else shares.
    std::unique_ptr<ExactStates> own_states(const Wanted& wanted, const Mechanism& of);

    /// The equations with the reactions of these constraints.
    Equations with_multipliers(const std::vector<std::size_t>& undetermined) const;

    /// Where the terms of such equations are kept once they are known; they are those that a reader sees.
    std::optional<EquationTerms>& terms(const std::vector<std::size_t>& undetermined, bool is_any_motion) {
        return terms_[{undetermined, is_any_motion}];
    }

    /// The scene's own branch of the constraints, if these have branches.
    const std::optional<OwnBranch>& own_branch();

private:
    std::map<Wanted, std::unique_ptr<ExactStates>> states_;
    std::map<std::pair<std::vector<std::size_t>, bool>, std::optional<EquationTerms>> terms_;
    std::optional<std::optional<OwnBranch>> own_branch_;
};

/// Equations that every motion obeys that the constraints allow: q'' = w + Aᵀλ, A q'' = γ with any w. What follows
/// from them alone is kinematics. For w stand the symbols q'' themselves, since exact states choose values for
/// them before they solve.
Equations any_motion(Equations equations, const Mechanism& mechanism);

}  // namespace alembert
