// SPDX-License-Identifier: MIT
#include "alembert/hybrid/hybrid_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "alembert/base/tolerances.hpp"
#include "alembert/ode/disturbance.hpp"
#include "alembert/ode/driver.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int most_events_at_once = 100;

/// How one contact is watched in a phase.
struct Watch {
    double bound = 0;               ///< the event occurs where the value falls to −bound
    double open_until = -HUGE_VAL;  ///< before this time the gap counts as open, whatever rounding says
};

/// The size of a reaction that would balance the other forces of the system.
double reaction_scale(const Situation& here, const VectorXd& acceleration, int k) {
    const VectorXd row = here.contacts.rows.row(k).cwiseAbs();
    const VectorXd force = here.f.cwiseAbs() + here.M.cwiseAbs() * acceleration.cwiseAbs();
    double size = 0;
    for (Index i = 0; i < row.size(); ++i)
        if (row[i] > 1e-9 * row.maxCoeff()) size = std::max(size, force[i]);
    return row.maxCoeff() > 0 ? size / row.maxCoeff() : 0;
}

class Following {
public:
    Following(const Contacts& contacts, const ContactModes& modes, std::vector<double> initial,
              const Options& options)
        : contacts_(contacts),
          modes_(modes),
          options_(options),
          tolerance_(std::max(options.tolerance, tolerance::finest_contacts)),
          count_(static_cast<int>(contacts.names.size())),
          in_phases_(count_ > 0 || contacts.kicks.any()),
          t_(options.start),
          state_(std::move(initial)) {}

    PhasedMotion go() {
        result_.statistics.method = name(options_.method);
        if (count_ > 0) settle_into({}, {}, {});
        while (!result_.failure) {
            const Halt halt = run_phase();
            if (halt.contact < 0 && halt.kicks.empty()) break;
            if (halt.contact >= 0 && is_stuck(halt.contact)) break;
            std::vector<int> touched;
            std::optional<int> released;
            if (halt.contact >= 0 && contains(closed_, halt.contact))
                released = halt.contact;
            else if (halt.contact >= 0)
                touched = {halt.contact};
            settle_into(touched, released, halt);
            if (!halt.stops || result_.failure) continue;
            result_.phases.push_back({.closed = closed_, .motion = one_row()});
            break;
        }
        if (result_.failure) {
            result_.ending = Ending::failed;
            if (result_.phases.empty()) result_.phases.push_back({.closed = {}, .motion = one_row()});
        }
        // A contact is brought to rest before its bounces would have ended, so its record may come after later
        // ones or after the end of the run.
        std::erase_if(result_.contacts, [&](const ContactEvent& e) { return e.time > result_.final_time(); });
        std::stable_sort(result_.contacts.begin(), result_.contacts.end(),
                         [](const ContactEvent& a, const ContactEvent& b) { return a.time < b.time; });
        return std::move(result_);
    }

private:
    /// The reason why a phase has ended.
    struct Halt {
        int contact = -1;                   ///< a contact that has closed or opened
        std::vector<int> kicks = {};        ///< events whose impulses act
        std::vector<LastZero> passed = {};  ///< all events of the scene that are zero, each listed once
        bool stops = false;                 ///< whether the run ends here
    };

    bool is_first() const { return result_.phases.empty(); }

    /// The sum of all impulses that act; each is also kept in the record of its event.
    VectorXd impulse_of(const std::vector<int>& kicks, const std::vector<double>& state) {
        VectorXd sum;
        for (const int k : kicks) {
            const VectorXd one = contacts_.kicks.impulse(k, t_, state.data());
            if (EventRecord* const record = last_record(k)) record->impulse.assign(one.begin(), one.end());
            sum = sum.size() > 0 ? VectorXd(sum + one) : one;
        }
        return sum;
    }

    void tell_gains(const std::vector<int>& kicks, const std::vector<double>& before, const VectorXd& struck) {
        const Eigen::Map<const VectorXd> u(before.data() + struck.size(), struck.size());
        for (const int k : kicks)
            if (EventRecord* const record = last_record(k))
                record->energy_gain =
                    Eigen::Map<const VectorXd>(record->impulse.data(), struck.size()).dot(u + struck) / 2 +
                    0.0;  // avoids −0
    }

    EventRecord* last_record(int event) {
        const auto found = std::find_if(result_.events.rbegin(), result_.events.rend(),
                                        [&](const EventRecord& e) { return e.index == event; });
        return found == result_.events.rend() ? nullptr : &*found;
    }

    /// Events whose zeros have just been passed are followed from the side to which they move.
    void go_from(const Halt& halt, const std::vector<double>& before, const std::vector<double>& after,
                 const VectorXd& acceleration) {
        passed_.clear();
        if (!contacts_.kicks.passed) return;
        const std::vector<PassedZero> zeros =
            contacts_.kicks.passed(t_, before.data(), after.data(), acceleration);
        for (const PassedZero& zero : zeros) passed_.push_back(zero.is_zero ? zero : PassedZero());
        for (const LastZero& zero : halt.passed) {
            const PassedZero& passed = zeros[static_cast<std::size_t>(zero.event)];
            passed_[static_cast<std::size_t>(zero.event)] = passed;
            if (!contains(halt.kicks, zero.event)) continue;
            ++kicks_;
            const std::string& name = mode_->events.list[static_cast<std::size_t>(zero.event)].name;
            if (const auto endless =
                    series_[zero.event].add(name, t_, zero, passed, tolerance_, options_.duration))
                return fail(FailureKind::endless_kicks, *endless);
        }
    }

    void settle_into(const std::vector<int>& touched, const std::optional<int>& released, const Halt& halt) {
        const std::vector<double> before = mode_ ? in_rates(contacts_.kicks, mode_->rhs, t_, state_) : state_;
        const std::vector<double> integrated = state_;
        std::vector<double> rates = before;
        Settled settled = settle(contacts_,
                                 {.t = t_,
                                  .tolerance = tolerance_,
                                  .closed = closed_,
                                  .resting = resting_,
                                  .touched = touched,
                                  .released = released,
                                  .impulse = impulse_of(halt.kicks, before)},
                                 rates);
        state_ = mode_ ? as_integrated(contacts_.kicks, t_, rates) : rates;
        for (const ContactEvent& event : settled.events) {
            const auto struck = [&](const ContactEvent& e) {
                return e.kind == ContactEvent::Kind::impact && e.contact == event.contact;
            };
            if (is_first() && event.kind == ContactEvent::Kind::rest &&
                std::none_of(settled.events.begin(), settled.events.end(), struck))
                continue;  // the contact was at rest already
            result_.contacts.push_back(event);
        }
        closed_ = std::move(settled.closed);
        resting_ = std::move(settled.resting);
        if (!settled.failure.empty())
            return fail(halt.kicks.empty() ? FailureKind::no_contact_mode : FailureKind::endless_kicks,
                        settled.failure);
        if (options_.disturbed.seed != 0 && mode_) be_late_after(integrated);
        tell_gains(halt.kicks, before, settled.struck);
        go_from(halt, before, rates, settled.acceleration);
    }

    /// What the next phase is off by, because the time at which it begins is rounded (disturbance.hpp).
    void be_late_after(const std::vector<double>& before) {
        std::vector<double> rate_before(state_.size()), rate_after(state_.size());
        mode_->rhs(t_, before.data(), rate_before.data());
        modes_(closed_).rhs(t_, state_.data(), rate_after.data());
        std::vector<bool> jumped;
        for (std::size_t i = 0; i < state_.size(); ++i) jumped.push_back(before[i] != state_[i]);
        late_ = late_by_rounding(options_.disturbed.seed, {.t = t_,
                                                           .number = jumps_++,
                                                           .before = rate_before,
                                                           .after = rate_after,
                                                           .jumped = std::move(jumped)});
    }

    /// Integrates until a contact changes or an event kicks.
    Halt run_phase() {
        const ContactMode& mode = modes_(closed_);
        mode_ = &mode;
        if (mode.project) mode.project(t_, state_.data());
        const double end = options_.start + options_.duration;
        Options here = options_;
        if (in_phases_) {
            here.start = t_;
            here.duration = end - t_ > 16 * tolerance::epsilon * std::abs(end) ? end - t_ : 0;
            here.sample = sample_interval(options_);
            here.grid = options_.start;
            if (count_ > 0) {  // so that no short contact is missed
                const double short_enough = options_.duration / 200;
                here.longest_step =
                    here.longest_step > 0 ? std::min(here.longest_step, short_enough) : short_enough;
            }
            here.budget = std::max(1L, options_.budget - result_.statistics.work);
        }
        here.disturbed.late = std::exchange(late_, {});
        here.project = mode.project;
        here.rhs_when_stiff = mode.rhs_when_stiff;
        if (!mode.rhs_when_cheaper) here.when_cheaper = {};
        here.rhs_when_cheaper = mode.rhs_when_cheaper;
        here.effort_of_series = mode.effort_of_series;
        here.on_method = mode.on_method;
        here.on_step = mode.on_step;
        here.by = mode.by;
        const Events events = in_phases_ ? watched(mode) : mode.events;
        Trajectory motion = mode.switching ? integrate(*mode.switching, state_, here, events)
                                           : integrate(mode.rhs, state_, here, events);
        add_up(motion.statistics);
        const Halt halt = halt_of(motion, mode);
        const int of_scene = static_cast<int>(mode.events.list.size()) - count_;
        std::erase_if(motion.events, [&](const EventRecord& e) { return e.index >= of_scene; });
        if (in_phases_ && motion.ending == Ending::completed) motion.times.back() = end;
        result_.ending = motion.ending;
        result_.failure = motion.failure;
        if (in_phases_ && motion.failure && motion.failure->kind == FailureKind::budget_used_up)
            result_.failure->message = fmt::format(
                "{} right-hand sides were not enough to come further than t = {}, with {} "
                "impacts and changes of contact{}; raise the budget, loosen the "
                "tolerance or shorten the duration",
                options_.budget, motion.failure->time, result_.contacts.size(),
                kicks_ == 0 ? "" : fmt::format(" and {} kicks of events", kicks_));
        result_.events.insert(result_.events.end(), motion.events.begin(), motion.events.end());
        t_ = motion.times.back();
        const auto last = motion.final_state();
        state_.assign(last.begin(), last.end());
        if ((halt.contact >= 0 || !halt.kicks.empty()) && mode.project)
            mode.project(t_, state_.data());  // dense output obeys the constraints only approximately
        motion.times.shrink_to_fit();
        motion.states.shrink_to_fit();
        result_.phases.push_back({.closed = closed_, .motion = std::move(motion)});
        return halt;
    }

    /// An event that stops the run takes precedence over a contact at the same instant.
    Halt halt_of(const Trajectory& motion, const ContactMode& mode) const {
        Halt halt;
        if (motion.ending != Ending::stopped_by_event) return halt;
        const int of_scene = static_cast<int>(mode.events.list.size()) - count_;
        for (const LastZero& zero : motion.last_zeros) {
            if (zero.event >= of_scene) {
                if (halt.contact < 0) halt.contact = zero.event - of_scene;
                continue;
            }
            const auto known = std::find_if(halt.passed.begin(), halt.passed.end(),
                                            [&](const LastZero& z) { return z.event == zero.event; });
            if (known == halt.passed.end())
                halt.passed.push_back(zero);
            else if (zero.counts)
                *known = zero;
            if (!zero.counts) continue;
            const auto k = static_cast<std::size_t>(zero.event);
            halt.stops = halt.stops || mode.events.list[k].stop;
            if (contacts_.kicks.has(k) && !contains(halt.kicks, zero.event)) halt.kicks.push_back(zero.event);
        }
        if (halt.stops && halt.kicks.empty()) halt.contact = -1;
        return halt;
    }

    void add_up(const Statistics& s) {
        Statistics& sum = result_.statistics;
        sum.steps += s.steps;
        sum.rejected += s.rejected;
        sum.evaluations += s.evaluations;
        sum.work += s.work;
        sum.seconds += s.seconds;
        sum.method = s.method;
        if (!sum.switched)
            sum.switched = s.switched;
        else if (s.switched)
            sum.later_switches.push_back(*s.switched);
        sum.later_switches.insert(sum.later_switches.end(), s.later_switches.begin(), s.later_switches.end());
    }

    /// The mode's events, prepared for a phase. The events of contacts are compared with their bounds and stop the
    /// phase; events that kick stop it too.
    Events watched(const ContactMode& mode) const {
        const std::size_t scene = mode.events.list.size() - contacts_.names.size();
        std::vector<Event> list = mode.events.list;
        for (std::size_t k = 0; k < scene; ++k) {
            if (!contacts_.kicks.has(k)) continue;
            list[k].stop = true;
            list[k].at_once = !is_first();
        }
        Events held = with_zeros_passed(mode.events, list, passed_, t_);
        if (count_ == 0) return held;
        std::vector<double> rate(state_.size()), value(mode.events.list.size());
        mode.rhs(t_, state_.data(), rate.data());
        mode.events(t_, state_.data(), rate.data(), value.data());
        const Situation here = contacts_.situation(t_, state_.data());
        const Index n = here.f.size();
        const Eigen::Map<const VectorXd> q(state_.data(), n), u(state_.data() + n, n),
            acceleration(rate.data() + n, n);
        const VectorXd speed = gap_rates(here, u), still = negligible_rates(here, u);
        const VectorXd sizes = negligible_gaps(here, q, 1), slack = tolerance_ * sizes;

        std::vector<Watch> watches(contacts_.names.size());
        for (int k = 0; k < count_; ++k) {
            list[scene + k].stop = list[scene + k].at_once = true;
            Watch& watch = watches[k];
            if (contains(closed_, k)) {
                const double uncertain = 10 * tolerance_ * reaction_scale(here, acceleration, k);
                if (value[scene + k] <= uncertain)
                    watch.bound = 2 * std::max(uncertain, -value[scene + k]) + std::numeric_limits<double>::min();
            } else if (value[scene + k] <= slack[k]) {
                const double off = std::abs(value[scene + k]);
                const double fall = here.contacts.acceleration[k] - here.contacts.rows.row(k).dot(acceleration);
                const double rise = (2 * off + 16 * tolerance::epsilon * sizes[k]) / speed[k];
                if (speed[k] > still[k])
                    watch.open_until =
                        t_ + (fall > 0 ? std::min(rise, speed[k] / fall / 2) : rise);  // a quarter of the flight
                else
                    watch.bound = contains(resting_, k) ? std::max(10 * slack[k], 2 * off)
                                                        : std::max(1e-12 * sizes[k], 2 * off);
            }
        }
        const EventBounds bounds = held.bounds;
        Events result = make_events(
            std::move(list),
            [base = std::move(held), watches, scene](double t, const double* y, const double* rates, double* out) {
                base(t, y, rates, out);
                for (std::size_t k = 0; k < watches.size(); ++k) {
                    double& g = out[scene + k];
                    g += watches[k].bound;
                    if (t <= watches[k].open_until) g = std::max(g, std::numeric_limits<double>::min());
                }
            });
        result.bounds = {.exist = bounds.exist, .of = [bounds, watches, scene](int k, const MotionBounds& motion) {
                             Bounds of = bounds.of(k, motion);
                             if (k < static_cast<int>(scene)) return of;
                             const double shift = watches[static_cast<std::size_t>(k) - scene].bound;
                             of.value = of.value + Interval{shift, shift};
                             return of;
                         }};
        return result;
    }

    /// Whether contacts open and close again and again at the same time.
    bool is_stuck(int k) {
        events_at_once_ = t_ - last_event_ > 1e-12 * std::abs(t_) ? 0 : events_at_once_ + 1;
        last_event_ = t_;
        if (events_at_once_ < most_events_at_once * (1 + count_)) return false;
        fail(FailureKind::no_contact_mode,
             fmt::format("no contact mode is consistent at t = {}: contact '{}' and others open and close "
                         "while the time does not advance; loosen the tolerance, or look at the gaps there",
                         t_, contacts_.names[k]));
        return true;
    }

    void fail(FailureKind kind, const std::string& message) {
        result_.failure = Failure{.kind = kind, .message = message, .time = t_, .state = state_};
    }

    Trajectory one_row() const {
        Trajectory row;
        row.dimension = static_cast<int>(state_.size());
        row.times = {t_};
        row.states = state_;
        return row;
    }

    const Contacts& contacts_;
    const ContactModes& modes_;
    const Options& options_;
    double tolerance_;
    int count_;
    bool in_phases_;  ///< whether anything makes rates jump
    double t_;
    std::vector<double> state_;
    std::vector<int> closed_, resting_;
    const ContactMode* mode_ = nullptr;  ///< the mode of the last phase
    std::vector<PassedZero> passed_;     ///< for the scene's events, at the start of the next phase
    std::map<int, KickSeries> series_;   ///< the kicks of each event
    std::vector<double> late_;           ///< of the next phase
    long kicks_ = 0, jumps_ = 0;
    int events_at_once_ = 0;
    double last_event_ = -HUGE_VAL;
    PhasedMotion result_;
};

}  // namespace

PhasedMotion follow(const Contacts& contacts, const ContactModes& modes, std::vector<double> initial,
                    const Options& options) {
    return Following(contacts, modes, std::move(initial), options).go();
}

}  // namespace alembert
