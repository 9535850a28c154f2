// SPDX-License-Identifier: MIT
#pragma once

/// Writes the rows and events of a run into its trajectory.
///
///     Recorder recorder(motion, events, interval);
///     recorder.row(t, state);
///     const auto reach = [&](const Crossing& c) { rows_before(c.time); return state_at(c.time); };
///     if (const std::optional<double> time = recorder.crossings(found, begin, end, reach))
///         recorder.stop_at(*time, state_at(*time));
///
/// The trajectory and the events must live as long as the recorder.

#include <cmath>
#include <optional>
#include <vector>

#include "alembert/ode/events.hpp"
#include "alembert/ode/trajectory.hpp"

namespace alembert {

class Recorder {
public:
    /// `interval`: seconds between rows.
    Recorder(Trajectory& motion, const Events& events, double interval)
        : motion_(motion), events_(events), interval_(interval) {}

    void row(double time, const double* state) {
        motion_.times.push_back(time);
        motion_.states.insert(motion_.states.end(), state, state + motion_.dimension);
    }

    /// The row at which a run ends, unless it is there already.
    void last_row(double time, const double* state) {
        if (motion_.times.back() < time) row(time, state);
    }

    /// Records the zeros of a step that count, up to the first event that stops the run, with all that are
    /// simultaneous with it. `reach(crossing)` gives the state there. Returns the time at which the run stops.
    template <typename Reach>
    std::optional<double> crossings(const std::vector<Crossing>& found, double step_start, double step_end,
                                    const Reach& reach) {
        for (std::size_t k = 0; k < found.size(); ++k) {
            if (!found[k].counts) continue;
            const std::vector<double>& state = reach(found[k]);
            note(found[k], state);
            if (!event_of(found[k]).stop) continue;
            const double at_once = simultaneous(step_start, step_end);
            for (std::size_t j = 0; j < found.size(); ++j) {
                if (std::abs(found[j].time - found[k].time) > at_once) continue;
                if (j > k && found[j].counts) note(found[j], state);
                motion_.last_zeros.push_back({.event = found[j].index,
                                              .direction = found[j].direction,
                                              .counts = found[j].counts,
                                              .touches = found[j].width > 0,
                                              .width = found[j].width});
            }
            return found[k].time;
        }
        return std::nullopt;
    }

    /// Ends the run at an event. A row just before it, which cannot be told from it, gives way to it.
    void stop_at(double time, const double* state) {
        if (motion_.rows() > 1 && motion_.times.back() > time - 1e-9 * interval_) {
            motion_.times.pop_back();
            motion_.states.resize(motion_.states.size() - static_cast<std::size_t>(motion_.dimension));
        }
        last_row(time, state);
        motion_.ending = Ending::stopped_by_event;
    }

private:
    const Event& event_of(const Crossing& crossing) const {
        return events_.list[static_cast<std::size_t>(crossing.index)];
    }
    void note(const Crossing& crossing, const std::vector<double>& state) {
        motion_.events.push_back({.index = crossing.index,
                                  .name = event_of(crossing).name,
                                  .time = crossing.time,
                                  .state = state,
                                  .width = crossing.width});
    }

    Trajectory& motion_;
    const Events& events_;
    double interval_;
};

}  // namespace alembert
