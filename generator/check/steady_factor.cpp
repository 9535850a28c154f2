// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/steady_factor.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace alembert {

namespace {

Prime raised(Prime x, int exponent) {
    return exponent < 0 ? x.inverse().power(static_cast<std::uint64_t>(-exponent))
                        : x.power(static_cast<std::uint64_t>(exponent));
}

/// As n/d with small n and d.
std::optional<std::pair<int, int>> small_fraction(Prime x) {
    constexpr std::uint64_t largest = 240;
    for (int d = 1; d <= 48; ++d) {
        const Prime n = x * Prime(d);
        if (n.bits() <= largest) return std::pair(static_cast<int>(n.bits()), d);
        if ((-n).bits() <= largest) return std::pair(-static_cast<int>((-n).bits()), d);
    }
    return std::nullopt;
}

}  // namespace

int SteadyFactor::degree() const {
    int sum = 0;
    for (const auto& [which, exponent] : powers) sum += std::abs(exponent);
    return sum;
}

// All products of at most three of the values to small powers; of two with equal ratios, the simpler one.
SteadyFactors::SteadyFactors(std::vector<Values> values) : values_(std::move(values)) {
    constexpr int highest = 2;
    constexpr std::size_t most_factors = 3, most_entries = 60000;
    std::vector<Prime> ratios;
    for (const Values& value : values_) ratios.push_back(value[1] * value[0].inverse());
    table_.emplace(Prime(1), Powers());
    std::vector<std::pair<Prime, Powers>> last{{Prime(1), {}}};
    for (std::size_t factors = 0; factors < most_factors; ++factors) {
        std::vector<std::pair<Prime, Powers>> next;
        for (const auto& [value, powers] : last)
            for (std::size_t j = powers.empty() ? 0 : powers.back().first + 1; j < ratios.size(); ++j)
                for (int e = -highest; e <= highest && table_.size() < most_entries; ++e) {
                    if (e == 0) continue;
                    Powers more = powers;
                    more.emplace_back(j, e);
                    const Prime product = value * raised(ratios[j], e);
                    table_.emplace(product, more);
                    next.emplace_back(product, std::move(more));
                }
        last = std::move(next);
    }
}

std::optional<SteadyFactor> SteadyFactors::of(const Values& value) const {
    if (value[0].is_zero()) return std::nullopt;
    const auto found = table_.find(value[1] * value[0].inverse());
    if (found == table_.end()) return std::nullopt;
    Values number = value;
    for (std::size_t s = 0; s < states; ++s)
        for (const auto& [which, exponent] : found->second) number[s] *= raised(values_[which][s], -exponent);
    const auto fraction = small_fraction(number[0]);
    if (!fraction || number[2] != number[0]) return std::nullopt;
    return SteadyFactor{fraction->first, fraction->second, found->second};
}

std::vector<TreePtr> times(const SteadyFactor& factor, const std::vector<TreePtr>& raised,
                           const std::vector<TreePtr>& of) {
    std::vector<TreePtr> result;
    const auto power = [&](std::size_t which, int exponent) {
        return exponent == 1 ? raised[which] : made(Tree::Kind::power, {raised[which], number_tree(exponent)});
    };
    const auto below = [](const TreePtr& tree) { return made(Tree::Kind::reciprocal, {tree}); };
    if (std::abs(factor.n) != 1) result.push_back(number_tree(std::abs(factor.n)));
    for (const auto& [which, exponent] : factor.powers)
        if (exponent > 0) result.push_back(power(which, exponent));
    const bool is_one = result.empty();
    if (factor.d != 1) result.push_back(below(number_tree(factor.d)));
    for (const auto& [which, exponent] : factor.powers)
        if (exponent < 0) result.push_back(below(power(which, -exponent)));
    if (is_one && (!result.empty() || of.empty())) result.insert(result.begin(), number_tree(1));
    result.insert(result.end(), of.begin(), of.end());
    return factor.n < 0 ? negated_first(std::move(result)) : result;
}

}  // namespace alembert
