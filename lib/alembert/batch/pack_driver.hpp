// SPDX-License-Identifier: MIT
#pragma once

/// Eight members of an ensemble side by side, from their starts to their ends; a member that has ended makes room
/// for the next. `integrate` for ensembles (ensemble.hpp) is made of this; call that function.
///
///     PackDriver(ensemble, options, source, PackExplicitRK<dop853_tableau>(module, dimension, extra)).go(width);
///
/// A step is a class with the members of PackExplicitRK (pack_explicit_rk.hpp). One that has `next_length(lane)`
/// chooses the length of the next step itself, and begins a lane with a step of no length (pack_taylor.hpp). Each
/// lane has the step control of driver.hpp and step_size.hpp. A lane in which something goes wrong (a rate that is
/// not finite, a step that underflows, the budget) is handed back with `again`: the member is then run by itself,
/// and that run reports what went wrong. So is a lane whose series does not tell how far it holds, and one in
/// which a long step has passed over something (missed_feature_check.hpp): a run by itself looks within its steps,
/// and repeats them.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "alembert/batch/ensemble.hpp"
#include "alembert/ode/energy_error.hpp"
#include "alembert/ode/missed_feature_check.hpp"
#include "alembert/ode/quick_places.hpp"
#include "alembert/ode/rhs.hpp"
#include "alembert/ode/running_extrema.hpp"
#include "alembert/ode/step_size.hpp"

namespace alembert {

/// Gives members to run and takes their results; several threads call it at once.
struct MemberSource {
    std::function<std::optional<Member>()> next;
    std::function<void(const Member&, const Outcome&, const std::vector<double>& state)> done;
    std::function<void(const Member&)> again;
    std::function<void()> breathe;  ///< called after each round of steps
};

template <class Step>
class PackDriver {
    static constexpr bool has_own_lengths = requires(const Step step) { step.next_length(0); };
    static constexpr bool chooses_by_estimate = !has_own_lengths && !Step::has_fixed_step;

    struct Lane {
        Member member;
        double h = 0, end = 0;
        bool was_foreseen = true;  ///< the end of the try before
        long count = 0;            ///< the number of fixed steps
        StepSize control{1};
        EnergyError energy_error{0, 0, false};
        RunningExtrema along;
        QuickPlaces places = {};
        Rhs rhs = {};  ///< of this member alone, if there are states within steps to look at
        std::vector<double> start_state = {}, start_rate = {};  ///< of a step that is to be looked into, or none
        bool is_suspect = false;                                ///< whether that step has next to no error
        Outcome outcome;
    };

public:
    PackDriver(const Ensemble& ensemble, const Options& options, const MemberSource& source, Step step)
        : ensemble_(ensemble),
          options_(options),
          source_(source),
          extra_(ensemble.work == Work::integrated ? 1 : 0),
          dimension_(ensemble.module.table().coordinates + ensemble.module.table().speeds + extra_),
          step_(std::move(step)),
          lane_(lanes),
          rate_(static_cast<std::size_t>(dimension_)),
          state_(static_cast<std::size_t>(dimension_)) {}

    /// `width` lanes are used, at most eight.
    void go(int width) && {
        for (int i = 0; i < width; ++i) refill(i);
        while (busy_ != 0) {
            for (int i = 0; i < lanes; ++i)
                while (is_busy(i) && !aim(i)) give_back(i);
            if (busy_ == 0) break;
            step_.attempt();
            const unsigned finished = accepted();
            if (finished != 0) finish(finished);
            settle(finished, finished != 0 ? accepted() : 0);
            source_.breathe();
        }
    }

private:
    static constexpr int order() {
        if constexpr (has_own_lengths)
            return 1;  // not used
        else
            return Step::estimate_order;
    }

    bool is_busy(int i) const { return (busy_ >> i & 1U) != 0; }

    /// Finishes the step in some lanes. In the others, which the step cannot leave out, the estimate stays: it
    /// must not depend on whether there is a lane to finish.
    void finish(unsigned finished) {
        const Lanes estimate = step_.error_norm;
        step_.finish();
        for (int i = 0; i < lanes; ++i)
            if ((finished >> i & 1U) == 0) step_.error_norm[i] = estimate[i];
    }

    unsigned accepted() const {
        unsigned good = 0;
        const double allowed = Step::has_fixed_step ? std::numeric_limits<double>::max() : options_.tolerance;
        for (int i = 0; i < lanes; ++i)
            if (is_busy(i) && step_.error_norm[i] <= allowed) good |= 1U << i;
        return good;
    }

    /// Sets the end of the lane's next step; false if the lane may not take one.
    bool aim(int i) {
        Lane& lane = lane_[i];
        const double t = step_.time[i];
        if (lane.outcome.evaluations + Step::most_evaluations > options_.budget) return false;
        if constexpr (has_own_lengths)
            if (step_.is_new(i)) return true;
        if constexpr (Step::has_fixed_step) {
            const long k = lane.outcome.steps + 1;
            step_.end[i] = k == lane.count ? lane.end : lane.member.start + static_cast<double>(k) * options_.step;
        } else {
            lane.h = std::min(lane.h, longest(lane.member));
            if (lane.h < 16 * std::numeric_limits<double>::epsilon() * std::abs(t) || t + lane.h == t)
                return false;
            const double h = within_quick_times(lane, t);
            const double reach = t + std::min(1.01 * h, longest(lane.member) * (1 + 1e-9));
            step_.end[i] = reach < lane.end ? t + h : lane.end;
        }
        return true;
    }

    double within_quick_times(const Lane& lane, double t) const {
        const std::vector<InputTimeScale>& quick = quick_times_of(lane.member);
        if (quick.empty()) return lane.h;
        return std::min(
            lane.h, std::max(latest_end(quick, t) - t, 64 * std::numeric_limits<double>::epsilon() * std::abs(t)));
    }

    double longest(const Member& member) const {
        return options_.longest_step > 0 ? options_.longest_step : member.duration;
    }

    /// Accepts or rejects the attempted step, lane by lane. `finished`: the lanes in which the estimate was small
    /// enough; `good`: those in which the end is good too.
    void settle(unsigned finished, unsigned good) {
        double length[lanes];
        for (int i = 0; i < lanes; ++i) length[i] = step_.end[i] - step_.time[i];
        const unsigned begun = new_lanes();
        if (good != 0) {
            if constexpr (!Step::has_fixed_step) note_starts(good, length);
            step_.advance(good);
            step_.energies(energy_);
        }
        for (int i = 0; i < lanes; ++i) {
            if (!is_busy(i)) continue;
            Lane& lane = lane_[i];
            const bool is_good = (good >> i & 1U) != 0, has_begun = (begun >> i & 1U) != 0,
                       was_finished = (finished >> i & 1U) != 0;
            lane.outcome.evaluations += Step::evaluations(was_finished);
            if (!is_good && (Step::has_fixed_step || has_begun)) {
                give_back(i);
                continue;
            }
            if constexpr (!Step::has_fixed_step) set_length(i, length[i], was_finished, is_good);
            if constexpr (has_own_lengths)
                if (is_good && step_.time[i] != lane.end && places_within(lane.h, lane.member.duration) > 1 &&
                    !step_.decays(i, lane.h)) {
                    give_back(i);
                    continue;
                }
            if constexpr (!Step::has_fixed_step)
                if (is_good && !has_begun && !passes_over_nothing(i, length[i])) {
                    give_back(i);
                    continue;
                }
            if (has_begun) continue;
            ++(is_good ? lane.outcome.steps : lane.outcome.rejected);
            if (!is_good) continue;
            note_energy(i);
            if (ensemble_.along) note_state(i, length[i]);
            if (step_.time[i] == lane.end) complete(i);
        }
    }

    /// Keeps the starts of the steps that are a good part of their runs and have next to no error, and of all
    /// where functions of the state may change fast.
    void note_starts(unsigned good, const double (&length)[lanes]) {
        for (int i = 0; i < lanes; ++i) {
            Lane& lane = lane_[i];
            lane.start_state.clear();
            lane.start_rate.clear();
            if ((good >> i & 1U) == 0 || (!ensemble_.place_code && !is_suspect(i, length[i]))) continue;
            lane.is_suspect = is_suspect(i, length[i]);
            for (int k = 0; k < dimension_; ++k) {
                lane.start_state.push_back(step_.state(k, i));
                lane.start_rate.push_back(step_.rate(k, i));
            }
        }
    }

    bool is_suspect(int i, double length) const {
        return chooses_by_estimate && !(step_.error_norm[i] > next_to_none * options_.tolerance) &&
               places_within(length, lane_[i].member.duration) > 1;
    }

    /// Of the step that ends where the lane is now: whether nothing is found within, where it is to be looked
    /// into. Only a straight step is, on which the states are known from the rates at its ends.
    bool passes_over_nothing(int i, double length) {
        Lane& lane = lane_[i];
        if (lane.start_state.empty()) return true;
        if (lane.rhs.call == nullptr)
            lane.rhs = make_rhs(ensemble_.module, lane.member.parameters, ensemble_.work);
        for (int k = 0; k < dimension_; ++k) {
            state_[static_cast<std::size_t>(k)] = step_.state(k, i);
            rate_[static_cast<std::size_t>(k)] = step_.rate(k, i);
        }
        const auto between = [&](double theta, double* state) {
            for (std::size_t k = 0; k < state_.size(); ++k) {
                const double change = rate_[k] - lane.start_rate[k];
                state[k] = lane.start_state[k] + theta * length * (lane.start_rate[k] + theta / 2 * change);
            }
        };
        const StepView stretch = {.start = step_.time[i] - length,
                                  .end = step_.time[i],
                                  .end_state = state_.data(),
                                  .end_rate = rate_.data(),
                                  .start_state = lane.start_state.data(),
                                  .start_rate = lane.start_rate.data(),
                                  .interpolate = between};
        if (ensemble_.place_code && !PlaceWatch(lane.places, lane.rhs, 0).is_mild(stretch)) return false;
        return !lane.is_suspect || is_clear(stretch, places_within(length, lane.member.duration), lane.rhs,
                                            options_.tolerance, lane.outcome.evaluations);
    }

    /// Those whose step is their first one, without length.
    unsigned new_lanes() const {
        unsigned begun = 0;
        if constexpr (has_own_lengths)
            for (int i = 0; i < lanes; ++i) begun |= step_.is_new(i) ? 1U << i : 0U;
        return begun;
    }

    /// That of the lane's next step, after one of the given length.
    void set_length(int i, double length, bool was_finished, bool is_good) {
        Lane& lane = lane_[i];
        const double ratio = step_.error_norm[i] / options_.tolerance;
        if constexpr (has_own_lengths) {
            lane.h = is_good ? step_.next_length(i) : step_.shorter_length(length, ratio);
            if (is_good && !lane.was_foreseen) lane.h = std::min(lane.h, 2 * length);  // it is still ahead
            lane.was_foreseen = !was_finished || step_.foresees_end(i);
        } else {
            const double wish =
                quick_times_of(lane.member).empty() ? 0 : lane.h;  // a step that had to be short is no forecast
            if (is_good)
                lane.h = std::max(lane.control.after_accepted(length, ratio), length < wish ? wish : 0);
            else
                lane.h = lane.control.after_rejected(length, ratio);
        }
    }

    void note_energy(int i) {
        lane_[i].energy_error.add({energy_[0][i], energy_[2][i], energy_[4][i]},
                                  extra_ == 1 ? step_.state(dimension_ - 1, i) : 0);
    }

    /// At the end of a step; where steps are as long as those of a series, also within.
    void note_state(int i, double length) {
        if constexpr (has_own_lengths)
            for (int piece = 1; piece < RunningExtrema::pieces_of_series; ++piece) {
                const double h = length * piece / RunningExtrema::pieces_of_series;
                const double t = step_.time[i] - (length - h);
                step_.within(i, h, state_);
                lane_[i].rhs(t, state_.data(), rate_.data());
                lane_[i].along(t, state_.data(), rate_.data());
            }
        for (int k = 0; k < dimension_; ++k) {
            state_[static_cast<std::size_t>(k)] = step_.state(k, i);
            rate_[static_cast<std::size_t>(k)] = step_.rate(k, i);
        }
        lane_[i].along(step_.time[i], state_.data(), rate_.data());
    }

    void complete(int i) {
        Lane& lane = lane_[i];
        std::vector<double> state;
        for (int k = 0; k < dimension_; ++k) state.push_back(step_.state(k, i));
        lane.outcome.time = step_.time[i];
        lane.outcome.energy_drift = lane.energy_error.energy();
        lane.outcome.work_balance = lane.energy_error.balance();
        if (ensemble_.along) lane.outcome.along = lane.along.values();
        source_.done(lane.member, lane.outcome, state);
        refill(i);
    }

    void give_back(int i) {
        source_.again(lane_[i].member);
        refill(i);
    }

    /// Puts the next member that can begin into the lane; if there is none, the lane stands still.
    void refill(int i) {
        busy_ &= ~(1U << i);
        step_.end[i] = step_.time[i];
        while (std::optional<Member> member = source_.next()) {
            Lane& lane = lane_[i];
            lane = {.member = *std::move(member),
                    .control = StepSize(std::max(1, order())),
                    .energy_error = EnergyError(0, 0, false),
                    .along = {},
                    .rhs = {},
                    .outcome = {}};
            if (!begin(i, lane)) {
                source_.again(lane.member);
                continue;
            }
            busy_ |= 1U << i;
            return;
        }
    }

    bool begin(int i, Lane& lane) {
        const Member& member = lane.member;
        const alembert_solver_table& table = ensemble_.module.table();
        const Rhs rhs = make_rhs(ensemble_.module, member.parameters, ensemble_.work);
        std::vector<double> state = member.state;
        state.resize(static_cast<std::size_t>(dimension_), 0.0);
        rhs(member.start, state.data(), rate_.data());
        for (int k = 0; k < dimension_ - extra_; ++k)
            if (!std::isfinite(rate_[k])) return false;
        lane.end = member.start + member.duration;
        if (member.duration == 0) return false;
        lane.outcome.evaluations = 1;
        if constexpr (has_own_lengths) {
            // by the series at the start
        } else if constexpr (Step::has_fixed_step) {
            lane.count = std::max(1L, std::lround(std::ceil(member.duration / options_.step * (1 - 1e-12))));
        } else {
            lane.h = options_.step;
            if (lane.h == 0) {
                lane.h = starting_step(rhs, {member.start, state.data(), rate_.data()}, options_.tolerance,
                                       Step::estimate_order, longest(member));
                ++lane.outcome.evaluations;
            }
        }
        if (ensemble_.along) {
            lane.along = RunningExtrema(table.coordinates, dimension_ - extra_);
            lane.along(member.start, state.data(), rate_.data());
            if constexpr (has_own_lengths) lane.rhs = rhs;
        }
        const std::vector<double> par = prepared(ensemble_.module, member.parameters);
        lane.places = {ensemble_.place_code, par};
        step_.put(i, member.start, state.data(), rate_.data(), par);
        double energy[4], jacobi = 0;
        table.energy(member.start, state.data(), rate_.data(), par.data(), energy, &jacobi);
        lane.energy_error.add({energy[0], energy[2], jacobi}, 0);
        return true;
    }

    const Ensemble& ensemble_;
    const Options& options_;
    const MemberSource& source_;
    int extra_, dimension_;
    Step step_;
    std::vector<Lane> lane_;
    std::vector<double> rate_, state_;
    Lanes energy_[5];
    unsigned busy_ = 0;  ///< bit i: lane i has a member
};

}  // namespace alembert
