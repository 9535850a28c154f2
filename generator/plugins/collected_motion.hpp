// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A motion by an integrator of SUNDIALS, step by step, with the rows and events of the runtime's own methods.
///
///     CountedSystem system{.given = system, .options = options, .piece = piece};
///     const SteppedIntegrator by{.name = "cvode", .step = …, .state = …, …};
///     Trajectory motion = CollectedMotion(system, initial, by, events).go();

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "alembert/ode/event_watch.hpp"
#include "alembert/ode/integrate.hpp"
#include "alembert/ode/missed_feature_check.hpp"
#include "alembert/ode/recorder.hpp"

namespace alembert {

/// What a function that SUNDIALS calls returns if it fails.
inline constexpr int unrecoverable = -1, recoverable = 1;

inline bool is_finite(const double* values, std::size_t size) {
    return std::all_of(values, values + size, [](double x) { return std::isfinite(x); });
}

/// The right-hand side with a count of its calls, and everything else that SUNDIALS needs of the system.
struct CountedSystem {
    const System& given;
    const Options& options;
    const RunPiece& piece;
    const Rhs& rhs = given.rhs;
    long evaluations = 0;
    std::vector<double> moved = {};

    std::size_t size() const { return static_cast<std::size_t>(rhs.dimension); }
    bool is_over_budget() const { return evaluations >= options.budget; }
    int rate(double t, const double* y, double* out) {
        if (is_over_budget()) return unrecoverable;
        rhs(t, y, out);
        ++evaluations;
        return is_finite(out, size()) ? 0 : recoverable;
    }
};

/// One running integrator: a step, and states within it.
struct SteppedIntegrator {
    std::string name;
    /// From t on, to `latest` at the most; negative values are error flags of SUNDIALS.
    std::function<int(double& t, double latest)> step;
    std::function<int(double t)> restart;  ///< from a time in the last step
    std::function<const double*()> state;
    std::function<void(double t, double* state)> at;
    std::function<long()> steps, rejected;
    std::function<std::string(int flag)> meaning;
};

/// Rows and events of a run.
class CollectedMotion {
public:
    CollectedMotion(CountedSystem& system, const std::vector<double>& initial, const SteppedIntegrator& by,
                    const Events& events)
        : system_(system),
          by_(by),
          events_(events),
          watch_(events, system.rhs),
          places_(system.given.quick_places, system.rhs, terms_left_out * system.options.tolerance),
          end_(system.options.start + system.options.duration),
          grid_(grid_of(system.options, system.piece)),
          interval_(sample_interval(system.options)),
          next_(std::lround(std::floor((system.options.start - grid_) / interval_ + 1e-9)) + 1),
          recorder_(motion_, events, interval_),
          row_(initial),
          rate_(initial.size()) {
        motion_.dimension = system.rhs.dimension;
        motion_.names = system.rhs.names;
        recorder_.row(system.options.start, initial.data());
        look_at_rate(system.options.start, initial.data());
        if (has_events()) watch_.begin(system.options.start, initial.data(), rate_.data());
        tell(system.options.start, initial.data());
    }

    Trajectory go() && {
        double t = system_.options.start;
        while (t < end_ && motion_.ending == Ending::completed) {
            double reached = t;
            int flag = by_.step(reached, latest_after(t));
            if (flag >= 0 && places_.watches() && !is_clear(t, reached)) flag = go_back(t);
            if (flag < 0) {
                fail(t, flag);
                break;
            }
            if (clear_end_ > t) continue;
            finish_step(t, reached);
            t = reached;
            if (t >= end_ && motion_.ending == Ending::completed) recorder_.row(end_, row_.data());
        }
        const long evaluations = system_.evaluations + watch_.evaluations() + places_.evaluations();
        motion_.statistics = {.steps = steps_ + by_.steps(),
                              .rejected = rejected_ + by_.rejected(),
                              .evaluations = evaluations,
                              .work = evaluations,
                              .seconds = 0,
                              .method = by_.name};
        return std::move(motion_);
    }

private:
    bool has_events() const { return !events_.list.empty(); }

    /// The latest end of a step from t.
    double latest_after(double t) {
        const double clear = std::exchange(clear_end_, -HUGE_VAL);
        return std::min({end_, latest_end(system_.given.quick_times, t), clear > t ? clear : end_});
    }

    /// Whether the step has passed over nothing (quick_places.hpp); otherwise the next try ends at `clear_end_`.
    bool is_clear(double begin, double end) {
        std::vector<double> rate(system_.size()), end_rate(rate);
        const std::vector<double> state(by_.state(), by_.state() + system_.size());
        system_.rhs(begin, row_.data(), rate.data());
        system_.rhs(end, state.data(), end_rate.data());
        system_.evaluations += 2;
        const double part = places_.clear_part(
            {.start = begin,
             .end = end,
             .end_state = state.data(),
             .end_rate = end_rate.data(),
             .start_state = row_.data(),
             .start_rate = rate.data(),
             .interpolate = [&](double theta, double* out) { by_.at(begin + theta * (end - begin), out); }});
        const double shortest = 1024 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(begin));
        if (part == 1 || end - begin < shortest) return true;
        clear_end_ = begin + std::max(part * (end - begin), shortest / 2);
        return false;
    }

    int go_back(double t) {
        steps_ += by_.steps() - 1;
        rejected_ += by_.rejected() + 1;
        return by_.restart(t);
    }

    /// Adds the rows of the grid before a time, but not the last row of the run.
    void add_rows_before(double time) {
        for (;; ++next_) {
            const double at = grid_ + static_cast<double>(next_) * interval_;
            if (!(at < std::min(time, end_ - 1e-9 * interval_))) return;
            by_.at(at, row_.data());
            if (system_.given.project) system_.given.project(at, row_.data());
            recorder_.row(at, row_.data());
        }
    }

    /// Records what lies between two ends of steps.
    void finish_step(double begin, double end) {
        const std::vector<double> state(by_.state(), by_.state() + system_.size());
        look_at_rate(end, state.data());
        if (has_events()) {
            const std::vector<Crossing> crossings = watch_.look(
                {.start = begin,
                 .end = end,
                 .end_state = state.data(),
                 .end_rate = rate_.data(),
                 .interpolate = [&](double theta, double* out) { by_.at(begin + theta * (end - begin), out); }});
            const auto reach = [this](const Crossing& crossing) -> const std::vector<double>& {
                add_rows_before(crossing.time);
                by_.at(crossing.time, row_.data());
                return row_;
            };
            if (const std::optional<double> time = recorder_.crossings(crossings, begin, end, reach))
                return stop_at(*time);
        }
        add_rows_before(end);
        row_ = state;
        tell(end, row_.data());
    }

    /// The state there is in row_.
    void stop_at(double time) {
        look_at_rate(time, row_.data());
        tell(time, row_.data());
        recorder_.stop_at(time, row_.data());
    }

    void look_at_rate(double t, const double* state) {
        if (!system_.options.on_step && !has_events()) return;
        system_.rhs(t, state, rate_.data());
        ++system_.evaluations;
    }

    void tell(double t, const double* state) const {
        if (system_.options.on_step) system_.options.on_step(t, {state, rate_.size()}, rate_);
    }

    void fail(double t, int flag) {
        recorder_.last_row(t, row_.data());
        motion_.ending = Ending::failed;
        const bool budget = system_.is_over_budget();
        motion_.failure = Failure{
            .kind = budget ? FailureKind::budget_used_up : FailureKind::step_underflow,
            .message = budget
                           ? budget_is_used_up(system_.options.budget, t)
                           : fmt::format("{} gave up at t = {:.17g} with {}; loosen the tolerance, or take radau",
                                         by_.name, t, by_.meaning(flag)),
            .time = t,
            .state = row_};
    }

    CountedSystem& system_;
    const SteppedIntegrator& by_;
    const Events& events_;
    EventWatch watch_;
    PlaceWatch places_;
    double end_, clear_end_ = -HUGE_VAL;  ///< of the run; of the next step, if it is later than its start
    long steps_ = 0, rejected_ = 0;       ///< before the last restart
    double grid_, interval_;
    long next_;  ///< the number of the next row on the grid
    Trajectory motion_;
    Recorder recorder_;
    std::vector<double> row_, rate_;
};

}  // namespace alembert
