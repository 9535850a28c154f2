// SPDX-License-Identifier: MIT
#include "alembert/ode/missed_feature_check.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace alembert {

bool is_clear(const StepView& step, int places, const Rhs& rhs, double tolerance, long& evaluations) {
    constexpr double straight = 0.1;  // tolerances: a bend that makes more is seen by the estimated error
    const double h = step.end - step.start;
    std::vector<double> state(static_cast<std::size_t>(rhs.dimension)), here(state.size());
    for (int i = 0; i < rhs.dimension - rhs.extra; ++i) {  // most steps end elsewhere than a straight one
        const double end = step.end_state[i], moved = h * (step.start_rate[i] + step.end_rate[i]) / 2;
        const double off = std::abs(end - step.start_state[i] - moved);
        if (!(off <= straight * tolerance * std::max(1.0, std::abs(end)))) return true;
    }
    if (is_steady(rhs, step.start_state, tolerance,
                  [&](int i) { return std::abs(step.end_state[i] - step.start_state[i]); }))
        return true;
    const auto keeps = [&](double theta) {
        step.interpolate(theta, state.data());
        rhs(step.start + theta * h, state.data(), here.data());
        ++evaluations;
        for (int i = 0; i < rhs.dimension - rhs.extra; ++i) {
            const double between = (1 - theta) * step.start_rate[i] + theta * step.end_rate[i];
            const double off = h * std::abs(here[static_cast<std::size_t>(i)] - between);
            if (!(off <= terms_left_out * tolerance * std::max(1.0, std::abs(step.end_state[i])))) return false;
        }
        return true;
    };
    for (int place = 1; place < places; ++place)
        if (!keeps(static_cast<double>(place) / places)) return false;
    return true;
}

}  // namespace alembert
