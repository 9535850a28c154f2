// SPDX-License-Identifier: MIT
#pragma once

/// The events of a module whose functions cease to be numbers along a motion, as √(1 − x) does at x = 1: from
/// there on nothing is found of them.
///
///     EndedEvents ended(table.events);
///     ended(table, par.data(), t, state, rate);      // at the end of each step, or at each row
///     for (const EndedEvents::One& one : ended.found()) …

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "alembert/native/abi.hpp"

namespace alembert {

class EndedEvents {
public:
    struct One {
        int event = 0;
        double last = 0, first_without = 0;  ///< the last time with a value, and the next one
    };

    /// Watches the first `events` of a module, which may have more.
    explicit EndedEvents(std::size_t events) : last_(events) {}

    void operator()(const alembert_solver_table& table, const double* par, double t, const double* state,
                    const double* rate) {
        if (last_.empty()) return;
        value_.assign(std::max(last_.size(), static_cast<std::size_t>(table.events)), 0);
        table.events_at(t, state, rate, par, value_.data());
        for (std::size_t k = 0; k < last_.size(); ++k) {
            const bool ends = std::isnan(value_[k]);
            if (ends && last_[k]) found_.push_back({static_cast<int>(k), *last_[k], t});
            last_[k] = ends ? std::nullopt : std::optional(t);
        }
    }

    const std::vector<One>& found() const { return found_; }

private:
    std::vector<std::optional<double>> last_;  ///< where each had a value
    std::vector<double> value_;
    std::vector<One> found_;
};

}  // namespace alembert
