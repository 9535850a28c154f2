// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "analysis/motions.hpp"

namespace alembert {

/// Exact states one after the other, made when first asked for; null once no more are found.
class ExactStates {
public:
    ExactStates(const Mechanism& m, const Equations& e, Motions::At at, int halves, int halvings) : motions(m, e, at, halves, halvings) {}

    const ExactState* get(std::size_t k) {
        while (made_.size() <= k && unlucky_ < most_unlucky && motions.obstacle().empty()) {
            if (auto state = motions.at(++seed_))
                made_.push_back(std::move(*state));
            else
                ++unlucky_;
        }
        return k < made_.size() ? &made_[k] : nullptr;
    }

    const Motions motions;

private:
    static constexpr int most_unlucky = 4000;
    std::vector<ExactState> made_;
    std::uint64_t seed_ = 0;
    int unlucky_ = 0;
};

}  // namespace alembert
