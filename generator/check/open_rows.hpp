// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Claims that leave names open, as linear systems for these names: B(state) μ = d(state) at an exact state.
///
///     const OpenRows rows = open_rows(claims, forms, {0, 2, 3});      // claims 0, 2 and 3 share names
///     // no choice satisfies them together
///     if (const auto at = open_matrix(rows, state); at && !consistent(at->rows)) …
///
/// An integral with constants contributes a row for itself and one for each time derivative that mechanics gives.

#include <optional>
#include <set>

#include "check/claims.hpp"
#include "exact/exact_states.hpp"

namespace alembert {

/// All claims that share open names with claim k, through others too.
std::vector<std::size_t> group_of(const Scene& scene, const std::vector<ClaimForm>& forms, std::size_t k);

struct OpenRows {
    struct Row {
        std::size_t claim;
        int rest;                ///< the row at open names zero
        std::vector<int> slope;  ///< by open name
        bool derived = false;    ///< a time derivative of its claim
        bool last = false;       ///< the highest of them
    };
    Program program;
    std::vector<Row> list;

    /// Of each row the rest, then the slopes.
    std::vector<int> roots() const;
};
OpenRows open_rows(const Claims& claims, const std::vector<ClaimForm>& forms,
                   const std::vector<std::size_t>& group);

struct OpenMatrix {
    std::vector<std::vector<Prime>> rows;  ///< slopes, then −rest
    double chance = 0;                     ///< log₂ of the chance that what it says is wrong
};
/// Nothing where the rows cannot be evaluated.
std::optional<OpenMatrix> open_matrix(const OpenRows& rows, const ExactState& state);
/// At the state of that number; nothing where there is none.
std::optional<OpenMatrix> open_matrix(const OpenRows& rows, ExactStates& states, std::size_t number);

int rank_of(std::vector<std::vector<Prime>> rows, std::size_t columns);

/// Is there a solution?
bool consistent(const std::vector<std::vector<Prime>>& rows);

/// Does the last row of claim k raise the rank of all the others but those of `without`? Then it only determines
/// something open.
bool pins(const OpenRows& rows, const OpenMatrix& at, const std::set<std::size_t>& without, std::size_t k);

/// The fewest claims without which the others can be satisfied; where there is a choice, all of them.
std::set<std::size_t> culprits(const OpenRows& rows, const OpenMatrix& at, const std::vector<std::size_t>& group);

/// Which claims of the group are wrong: at some state, no choice of what they leave open satisfies them together.
struct OpenJudgement {
    std::set<std::size_t> wrong;
    double failure = 0;  ///< log₂ of the chance that those not in `wrong` are wrong
    OpenMatrix first;    ///< at one of the states
};
/// Nothing where it could not be evaluated at enough states.
std::optional<OpenJudgement> judge(const OpenRows& rows, const std::vector<std::size_t>& group,
                                   ExactStates& states);

}  // namespace alembert
