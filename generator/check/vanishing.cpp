// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/vanishing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace alembert {

void LeftToChance::add(double chance, const ExactState& state) {
    failure += chance;
    missed += state.branches > 1 ? std::log2(1 - 1 / state.branches) : 2 * wanted_failure;
    ++states;
}

double chance_at(const ExactState& state, double degree, const ModularValues& values) {
    return std::log2(degree) + values.conditions + state.conditions - state.field;
}

int states_needed(const Program& p, const std::vector<int>& roots, const ExactStates& states) {
    const std::vector<int> needed = p.needed(roots);
    const auto has = [&](std::initializer_list<Op> ops) {
        return std::any_of(needed.begin(), needed.end(), [&](int id) {
            return std::find(ops.begin(), ops.end(), p[id].op) != ops.end() && !p[p[id].args[0]].is_number();
        });
    };
    if (states.motions.has_sides() || has({Op::abs, Op::sign, Op::min, Op::max})) return states_of_sides;
    return has({Op::sqrt}) ? states_of_roots : 1;
}

std::optional<bool> vanishes_at(ExactStates& states, const Program& p, int root, double& failure) {
    const std::array<int, 1> roots{root};
    const int least = states_needed(p, {root}, states);
    const bool rest = states.motions.where() == Motions::At::rest;
    LeftToChance left;
    failure = 0;
    for (std::size_t s = 0;; ++s) {
        const ExactState* const state = states.get(s);
        if (state == nullptr || s > most_states)
            return left.states >= std::min(least, states_of_roots) && (left.is_small() || rest)
                       ? std::optional(true)
                       : std::nullopt;
        const auto at = evaluate_mod(p, state->point, roots);
        if (!at) continue;
        if (!at->value[root].is_zero()) return false;
        const double degree = std::max(1.0, at->degree[root]) * std::max(1.0, state->degree);
        const double chance = chance_at(*state, degree, *at);
        if (chance > -1) return std::nullopt;
        left.add(chance, *state);
        failure = left.failure;
        if (left.is_small() && left.states >= least && (!rest || left.states >= states_of_rest)) return true;
    }
}

std::optional<bool> vanishes_with_some_signs(ExactStates& states, const Program& p, int root, double& failure) {
    constexpr std::size_t most_roots = 4;
    const std::array<int, 1> roots{root};
    LeftToChance left;
    for (std::size_t s = 0; s < most_states && states.get(s) != nullptr; ++s) {
        const ExactState& state = *states.get(s);
        const auto plain = evaluate_mod(p, state.point, roots);
        if (!plain) continue;
        const std::vector<Prime> rooted = plain->rooted;
        if (rooted.empty() || rooted.size() > most_roots) return std::nullopt;
        const unsigned choices = 1U << rooted.size();
        bool is_zero = false;
        for (unsigned choice = 0; choice < choices && !is_zero; ++choice) {
            ModularPoint point = state.point;
            for (std::size_t r = 0; r < rooted.size(); ++r)
                if (((choice >> r) & 1U) != 0) point.negative_roots.push_back(rooted[r]);
            const auto at = evaluate_mod(p, point, roots);
            is_zero = at && at->value[root].is_zero();
        }
        if (!is_zero) return false;
        const double degree = choices * std::max(1.0, plain->degree[root]) * std::max(1.0, state.degree);
        const double chance = chance_at(state, degree, *plain);
        if (chance > -1) return std::nullopt;
        left.add(chance, state);
        failure = left.failure;
        if (left.is_small()) return true;
    }
    return std::nullopt;
}

bool vanishes_at_two(ExactStates& states, const Program& p, int root) {
    std::size_t wanted = states.motions.where() == Motions::At::rest ? 8 : 2;
    if (depends_on_sides(p, {root}) || states.motions.has_sides()) wanted = 20;
    for (std::size_t s = 0, usable = 0; usable < wanted; ++s) {
        const ExactState* const state = states.get(s);
        if (state == nullptr || s > 60) return false;
        if (state->branches > 1) wanted = std::max<std::size_t>(wanted, 8);
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

bool depends_on_sides(const Program& p, const std::vector<int>& roots) {
    const std::vector<int> needed = p.needed(roots);
    return std::any_of(needed.begin(), needed.end(), [&](int id) {
        const Op op = p[id].op;
        if (p[id].depends == 0) return false;  // a number
        return op == Op::sign || op == Op::abs || op == Op::min || op == Op::max ||
               (op == Op::sqrt && !p[p[id].args[0]].is_number());
    });
}

bool is_smooth(const Program& p, int root) {
    const std::vector<int> needed = p.needed(std::array{root});
    return std::all_of(needed.begin(), needed.end(), [&](int id) {
        switch (p[id].op) {
            case Op::number:
            case Op::pi:
            case Op::variable:
            case Op::sum:
            case Op::product:
            case Op::sin:
            case Op::cos:
            case Op::tan:
            case Op::atan:
            case Op::sinh:
            case Op::cosh:
            case Op::tanh:
            case Op::exp:
                return true;
            default:
                return p[id].depends == 0;  // a number
        }
    });
}

bool has_long_numbers(const Program& p, const std::vector<int>& roots) {
    constexpr int short_enough = 20;
    const auto is_long = [](const Rational& r) {
        return cln::integer_length(cln::numerator(r)) > short_enough ||
               cln::integer_length(cln::denominator(r)) > short_enough;
    };
    const std::vector<int> needed = p.needed(roots);
    return std::any_of(needed.begin(), needed.end(), [&](int id) {
        const Node& node = p[id];
        return is_long(node.number) || std::any_of(node.coefficients.begin(), node.coefficients.end(), is_long) ||
               std::any_of(node.exponents.begin(), node.exponents.end(),
                           [&](int e) { return std::abs(e) >> short_enough != 0; });
    });
}

bool is_identity(const Program& p, int root) {
    if (depends_on_sides(p, {root}) || has_long_numbers(p, {root})) return false;
    constexpr int points = 3;
    constexpr std::uint64_t tries = 60;
    int usable = 0;
    for (std::uint64_t seed = 1; seed <= tries && usable < points; ++seed) {
        const auto at = evaluate_mod(p, {.seed = seed}, std::array{root});
        if (!at) continue;
        if (!at->value[root].is_zero()) return false;
        ++usable;
    }
    return usable == points;
}

}  // namespace alembert
