// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Claims that are compared with the same law, and what is found once for all of them.
///
///     AskedTogether together(now, {0, 2, 3});
///     together.states->get(0)        // the first exact state at which they are compared

#include <map>
#include <memory>

#include "check/comparison.hpp"

namespace alembert {

/// Claims that share open names, as linear systems for these names (open_rows.hpp).
struct JudgedGroup {
    OpenRows rows;
    std::optional<OpenJudgement> judged;
};

/// Those of these claims that are combinations of the equations and the constraints, proved; vacuous where there
/// is no state of rest. They need no state that obeys the constraints, which may be hard to find.
std::map<std::size_t, CheckedClaim> combinations_among(Comparison& now, const std::vector<std::size_t>& claims);

struct AskedTogether {
    AskedTogether(Comparison& now, std::vector<std::size_t> claims);
    ~AskedTogether() { now.on_own_branch = nullptr; }
    AskedTogether(const AskedTogether&) = delete;
    AskedTogether& operator=(const AskedTogether&) = delete;

    Comparison& now;
    const std::vector<std::size_t> claims;
    std::map<std::size_t, CheckedClaim> combinations = {};  ///< decided without states
    /// Those of all other claims; null if they need none. Perhaps none was found.
    ExactStates* states = nullptr;
    std::map<std::vector<std::size_t>, JudgedGroup> groups = {};
    std::vector<CheckedClaim> solutions = {};  ///< once one of the claims at "solution" was asked

private:
    ExactStates& states_for(const Basis::Wanted& wanted, std::unique_ptr<ExactStates>& made);
    ExactStates* usable(const std::vector<std::size_t>& here, bool stays, int most_halves,
                        std::unique_ptr<ExactStates>& made);
    bool can_be_evaluated(const std::vector<std::size_t>& here, ExactStates& at) const;
    void keep_assumed(ExactStates& at) const;

    std::unique_ptr<ExactStates> made_, made_on_own_branch_;  ///< those that are not shared with other claims
};

}  // namespace alembert
