// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/vanishing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace alembert {

double chance_of_another_branch(const ExactState& state) {
    return state.branches > 1 ? std::log2(1 - 1 / state.branches) : 2 * wanted_failure;
}

std::optional<bool> vanishes_at(ExactStates& states, const Program& p, int root, double& failure) {
    const std::array<int, 1> roots{root};
    failure = 0;
    double missed = 0;  // log₂ of the probability that no state was on some branch
    int usable = 0;
    const bool rest = states.motions.where() == Motions::At::rest;
    for (std::size_t s = 0;; ++s) {
        const ExactState* const state = states.get(s);
        if (state == nullptr || s > most_states)
            return usable > 0 && ((failure <= wanted_failure && missed <= wanted_failure) || rest)
                       ? std::optional(true)
                       : std::nullopt;
        const auto at = evaluate_mod(p, state->point, roots);
        if (!at) continue;
        ++usable;
        if (!at->value[root].is_zero()) return false;
        const double degree = std::max(1.0, at->degree[root]) * std::max(1.0, state->degree);
        const double chance = std::log2(degree) + at->conditions + state->conditions - state->field;
        if (chance > -1) return std::nullopt;
        failure += chance;
        missed += chance_of_another_branch(*state);
        if (failure <= wanted_failure && missed <= wanted_failure && (!rest || usable >= states_of_rest))
            return true;
    }
}

bool vanishes_at_two(ExactStates& states, const Program& p, int root) {
    std::size_t wanted = states.motions.where() == Motions::At::rest ? 8 : 2;
    for (std::size_t s = 0, usable = 0; usable < wanted; ++s) {
        const ExactState* const state = states.get(s);
        if (state == nullptr || s > 30) return false;
        if (state->branches > 1) wanted = 8;
        const auto at = evaluate_mod(p, state->point, std::array<int, 1>{root});
        if (!at) continue;
        if (!at->value[root].is_zero()) return false;
        ++usable;
    }
    return true;
}

bool depends_on_shares(ExactStates& states, const Program& p, int root) {
    for (std::size_t s = 0; s < 24 && states.get(s) != nullptr; ++s) {
        const std::optional<ModularPoint>& other = states.get(s)->other_shares;
        if (!other) return false;
        const auto at = evaluate_mod(p, *other, std::array<int, 1>{root});
        if (at && !at->value[root].is_zero()) return true;
    }
    return false;
}

}  // namespace alembert
