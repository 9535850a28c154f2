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

#include "analysis/exact/exact_states.hpp"
#include "check/claims.hpp"

namespace alembert {

/// All claims that share open names with claim k, through others too.
std::vector<std::size_t> group_of(const Scene& scene, const std::vector<ClaimForm>& forms, std::size_t k);

struct OpenRows {
    struct Row {
        std::size_t claim;
        int rest;                ///< the value of the row if all open names are zero
        std::vector<int> slope;  ///< the coefficient of each open name
        bool derived = false;    ///< whether the row is a time derivative of its claim
        bool last = false;       ///< whether it is the highest of these
    };
    Program program;
    std::vector<Row> list;

    /// The rest of each row, then its slopes.
    std::vector<int> roots() const;
};
OpenRows open_rows(const Claims& claims, const std::vector<ClaimForm>& forms,
                   const std::vector<std::size_t>& group);

struct OpenMatrix {
    std::vector<std::vector<Prime>> rows;  ///< slopes, then −rest
    double chance = 0;                     ///< log₂ of the chance that what it says is wrong
};
/// Nothing if the rows cannot be evaluated.
std::optional<OpenMatrix> open_matrix(const OpenRows& rows, const ExactState& state);
/// At the state of that number; nothing where there is none.
std::optional<OpenMatrix> open_matrix(const OpenRows& rows, ExactStates& states, std::size_t number);

int rank_of(std::vector<std::vector<Prime>> rows, std::size_t columns);

/// Is there a solution?
bool consistent(const std::vector<std::vector<Prime>>& rows);

/// Does the last row of claim k raise the rank of all other rows except those of `without`? Then it only
/// determines an open name.
bool pins(const OpenRows& rows, const OpenMatrix& at, const std::set<std::size_t>& without, std::size_t k);

/// The smallest sets of claims without which the others can be satisfied; if there are several, their union.
std::set<std::size_t> culprits(const OpenRows& rows, const OpenMatrix& at, const std::vector<std::size_t>& group);

/// Which claims of the group are wrong: at some state, no choice of what they leave open satisfies them together.
struct OpenJudgement {
    std::set<std::size_t> wrong;
    double failure = 0;       ///< log₂ of the chance that those not in `wrong` are wrong
    OpenMatrix first;         ///< at one of the states
    bool is_complete = true;  ///< false if too few states were found for what is not in `wrong`
};
/// Nothing where it could not be evaluated at enough states.
std::optional<OpenJudgement> judge(const OpenRows& rows, const std::vector<std::size_t>& group,
                                   ExactStates& states);

}  // namespace alembert
