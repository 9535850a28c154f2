// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Is a value zero on every motion? Decided by exact evaluation modulo 2⁶¹ − 1 at random states.
///
///     double failure = 0;
///     vanishes_at(states, program, root, failure) == std::optional(true)      // but for a chance of 2^failure
///
/// An identity of degree d that is false holds at a random point of GF(p) with a probability of at most d/p
/// (Schwartz, J. ACM 27 (1980) 701). Where the constraints have branches, states are added until the probability
/// that one of the branches was never met is as small.

#include <optional>
#include <string>

#include "analysis/exact/exact_states.hpp"

namespace alembert {

constexpr double wanted_failure = -60;     ///< log₂ of the probability of an error that is small enough
constexpr int states_of_sides = 60;        ///< where signs decide, each may be right by chance
constexpr int states_of_roots = 8;         ///< where square roots alone do
constexpr int states_of_rest = 48;         ///< number of states of rest: their branches are not counted
constexpr std::size_t most_states = 1200;  ///< after this many states the question stays undecided

/// Is the node `root` zero at all states? Returns nothing if that cannot be decided. `failure` is log₂ of the
/// probability of an error.
std::optional<bool> vanishes_at(ExactStates& states, const Program& program, int root, double& failure);

/// The least number of states, so that signs are not right by chance: one where there are none.
int states_needed(const Program& program, const std::vector<int>& roots, const ExactStates& states);

/// Is the node zero at all states for some choice of the signs of the square roots in it, of which there are at
/// most four? Nothing if that cannot be decided, or if there is no root.
std::optional<bool> vanishes_with_some_signs(ExactStates& states, const Program& program, int root,
                                             double& failure);

/// The same question at two states only, at eight if the constraints have branches or the states are states of
/// rest, or at twenty where signs decide. This is enough to find a correction, but not to prove it.
bool vanishes_at_two(ExactStates& states, const Program& program, int root);

/// Whether signs decide, of absolute values, smaller and larger ones or roots: Legendre's symbol takes their place
/// in exact arithmetic, and it knows no order. A root is the one of two that counts as positive: that of 9 is −3.
bool depends_on_sides(const Program& program, const std::vector<int>& roots);

/// Whether the node is analytic wherever it has a value, so that it is zero on all of a branch if it is so on a
/// part.
bool is_smooth(const Program& program, int root);

/// Whether numbers of more than twenty binary digits occur, by which a multiple of the prime may be made: what
/// vanishes in exact arithmetic then has to vanish in numbers too.
bool has_long_numbers(const Program& program, const std::vector<int>& roots);

/// Is the node zero whatever values the variables have? What holds because a parameter is positive is no identity.
bool is_identity(const Program& program, int root);

/// What states modulo the prime leave to chance, in log₂ of probabilities.
struct LeftToChance {
    double failure = 0;  ///< that what is zero at all of them is so by chance
    double missed = 0;   ///< that no state was on some branch of the constraints
    int states = 0;

    void add(double chance, const ExactState& state);
    bool is_small() const { return failure <= wanted_failure && missed <= wanted_failure; }
};
/// That values of this degree are zero at this state by chance.
double chance_at(const ExactState& state, double degree, const ModularValues& values);

/// When constraints depend on each other, does the node vanish for their least reactions, but not for other
/// reactions with the same effect?
bool depends_on_shares(ExactStates& states, const Program& program, int root);

}  // namespace alembert
