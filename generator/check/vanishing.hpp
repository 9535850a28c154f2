// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Is a value zero on every motion? Decided by exact evaluation modulo 2⁶¹ − 1 at random states.
///
///     double failure = 0;
///     vanishes_at(states, program, root, failure) == std::optional(true)      // proved, but for a chance of
///     2^failure
///
/// An identity of degree d that is false holds at a random point of GF(p) with a chance of at most d/p (Schwartz,
/// J. ACM 27 (1980) 701). Where the constraints have branches, states are taken until the chance that one of the
/// branches was never met is as small.

#include <optional>
#include <string>

#include "exact/exact_states.hpp"

namespace alembert {

constexpr double wanted_failure = -60;     ///< log₂ of the chance of an error that is small enough
constexpr int states_of_rest = 48;         ///< states at rest lie on branches that are not counted
constexpr std::size_t most_states = 1200;  ///< after these the question stays open

/// Is the node `root` zero at all states? Nothing where that cannot be told. `failure`: log₂ of the chance of an
/// error.
std::optional<bool> vanishes_at(ExactStates& states, const Program& program, int root, double& failure);

/// The same at two states, or at eight where constraints have branches or the states are those of rest: good
/// enough to find a repair, not to prove one.
bool vanishes_at_two(ExactStates& states, const Program& program, int root);

/// log₂ of the chance that a branch of the constraints is not the one of this state.
double chance_of_another_branch(const ExactState& state);

/// Does it vanish for the least reactions of constraints that depend on each other, and not for other reactions
/// with the same effect?
bool depends_on_shares(ExactStates& states, const Program& program, int root);

}  // namespace alembert
