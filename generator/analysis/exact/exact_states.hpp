// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <functional>

#include "analysis/exact/motions.hpp"

namespace alembert {

/// Exact states one after the other. Each is computed when it is first asked for; null if no more are found.
class ExactStates {
public:
    ExactStates(const Mechanism& m, const Equations& e, Motions::Sampling sampling, unsigned turned = 0)
        : motions(m, e, std::move(sampling)), turned_(turned) {}

    /// From now on only states at which this holds; `conditions` random values must be squares for it.
    void keep_where(std::function<bool(const ModularPoint&)> holds, double conditions) {
        holds_ = std::move(holds);
        conditions_ = conditions;
    }

    const ExactState* get(std::size_t k) {
        if (is_on_own_branch_ && k >= most_on_own_branch) return nullptr;  // each of them takes long
        while (made_.size() <= k && unusable_ < (is_on_own_branch_ ? most_failures : most_unusable) &&
               motions.obstacle().empty()) {
            if (auto state = is_on_own_branch_ ? motions.on_own_branch(++seed_) : motions.at(++seed_, turned_))
                keep(std::move(*state));
            else
                ++unusable_;
        }
        return k < made_.size() ? &made_[k] : nullptr;
    }

    /// From now on the states are those of the scene's own branch.
    void stay_on_own_branch() {
        is_on_own_branch_ = true;
        made_.clear();
        seed_ = 0;
        unusable_ = 0;
    }

    const Motions motions;

private:
    void keep(ExactState state) {
        if (holds_ && !holds_(state.point)) {
            ++unusable_;
            return;
        }
        state.conditions += conditions_;
        made_.push_back(std::move(state));
    }

    static constexpr int most_unusable = 4000, most_failures = 60;
    static constexpr std::size_t most_on_own_branch = 64;
    std::vector<ExactState> made_;
    std::function<bool(const ModularPoint&)> holds_;
    double conditions_ = 0;
    std::uint64_t seed_ = 0;
    unsigned turned_;  ///< as in Motions::at
    int unusable_ = 0;
    bool is_on_own_branch_ = false;
};

}  // namespace alembert
