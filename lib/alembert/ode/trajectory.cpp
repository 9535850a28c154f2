// SPDX-License-Identifier: MIT
#include "alembert/ode/trajectory.hpp"

#include <cmath>

namespace alembert {

void append(Trajectory& first, Trajectory next, double grid, double sample) {
    const auto width = static_cast<std::size_t>(first.dimension);
    const double rows = (first.times.back() - grid) / sample;
    if (std::abs(rows - std::round(rows)) > 1e-9 && first.rows() > 1 && next.rows() > 1) {
        first.times.pop_back();
        first.states.resize(first.states.size() - width);
    }
    first.times.insert(first.times.end(), next.times.begin() + 1, next.times.end());
    first.states.insert(first.states.end(), next.states.begin() + static_cast<std::ptrdiff_t>(width),
                        next.states.end());
    first.events.insert(first.events.end(), next.events.begin(), next.events.end());
    first.statistics.steps += next.statistics.steps;
    first.statistics.rejected += next.statistics.rejected;
    first.statistics.evaluations += next.statistics.evaluations;
    first.statistics.work += next.statistics.work;
    if (!first.statistics.passed_place) first.statistics.passed_place = next.statistics.passed_place;
    std::vector<Switch>& later = first.statistics.later_switches;
    if (!first.statistics.switched)
        first.statistics.switched = next.statistics.switched;
    else if (next.statistics.switched)
        later.push_back(*next.statistics.switched);
    later.insert(later.end(), next.statistics.later_switches.begin(), next.statistics.later_switches.end());
    first.last_zeros = std::move(next.last_zeros);
    first.ending = next.ending;
    first.failure = std::move(next.failure);
}

}  // namespace alembert
