// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/narrow_places.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/language/say.hpp"

namespace alembert {

namespace {

/// A function along one variable of the state, the others as at the start.
class AlongVariable {
public:
    AlongVariable(const std::vector<EventInstruction>& function, const std::vector<double>& parameters,
                  std::vector<double> state, double t)
        : function_(function), parameters_(parameters), state_(std::move(state)), t_(t) {}

    Interval values(int variable, const Interval& range) const {
        const auto state = [&](int k) {
            const double here = state_[static_cast<std::size_t>(k)];
            return Bounds{k == variable ? range : Interval{here, here}, {}, {}};
        };
        return bounds_of(function_, parameters_.data(),
                         {.time = {{t_, t_}, {}, {}}, .state = std::cref(state), .rate = {}})
            .value;
    }

    /// Whether somewhere within `reach` of the start, between two of many points, it may change by a good part of
    /// what it changes by in all.
    bool is_narrow(int variable, double reach) const {
        constexpr int pieces = 64;
        constexpr double good_part = 0.3;
        const double from = state_[static_cast<std::size_t>(variable)] - reach, width = 2 * reach / pieces;
        std::vector<Interval> all;
        Interval seen{HUGE_VAL, -HUGE_VAL};
        for (int k = 0; k < pieces; ++k) {
            const double a = from + k * width;
            const Interval at = values(variable, {a, a});
            if (!std::isfinite(at.low) || !std::isfinite(at.high)) continue;
            seen = hull(seen, at);
            all.push_back(values(variable, {a, a + width}));
        }
        return std::any_of(all.begin(), all.end(), [&](const Interval& piece) {
            const double change = piece.high - piece.low;
            return std::isfinite(change) && change > good_part * (seen.high - seen.low) &&
                   change > good_part * piece.size();
        });
    }

private:
    const std::vector<EventInstruction>& function_;
    const std::vector<double>& parameters_;
    std::vector<double> state_;
    double t_;
};

}  // namespace

void tell_narrow_places(Prepared& prepared, const Program& program, Kinks kinks, const State<double>& start,
                        double duration) {
    const std::shared_ptr<const EventCode> code = quick_places_code(program, kinks);
    if (!code) return;
    std::vector<double> state = start.q, parameters = start.parameters;
    state.insert(state.end(), start.qdot.begin(), start.qdot.end());
    parameters.resize(program.parameters.size(), 1.0);
    const std::size_t n = start.q.size();
    const bool is_any = std::any_of(code->events.begin(), code->events.end(), [&](const auto& function) {
        const AlongVariable along(function, parameters, state, start.t);
        return std::any_of(function.begin(), function.end(), [&](const EventInstruction& step) {
            if (step.op != EventInstruction::Op::state) return false;
            const auto k = static_cast<std::size_t>(step.index);
            const double way = k < n && k + n < state.size() ? std::abs(state[k + n]) * duration : 0;
            const double reach = std::max(std::abs(state[k]), way);
            return along.is_narrow(step.index, reach > 0 ? 2 * reach : 1);
        });
    });
    if (is_any)
        prepared.warn(
            "left_out",
            say("warning: a force changes fast in a narrow region of the motion, which steps of a program "
                "of its own may pass over; 'alembert simulate' and 'sweep' look for such places\n"));
}

}  // namespace alembert
