// SPDX-License-Identifier: MIT
#include "alembert/phases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "alembert/run.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double finest = 1e-13;  // tolerance that rounding allows
constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr int most_events_at_once = 100;

bool contains(const std::vector<int>& list, int k) {
    return std::find(list.begin(), list.end(), k) != list.end();
}

/// How one contact is watched in a phase.
struct Watch {
    double bound = 0;               ///< the event is where the value comes down to −bound
    double open_until = -HUGE_VAL;  ///< before, the gap is open, whatever rounding says
};

/// The size of a reaction beside the other forces of the system.
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
          tolerance_(std::max(options.tolerance, finest)),
          count_(static_cast<int>(contacts.names.size())),
          t_(options.start),
          state_(std::move(initial)) {}

    PhasedMotion go() {
        result_.statistics.method = name(options_.method);
        if (count_ > 0) settle_into({}, {});
        while (!result_.failure) {
            const int ended_by = run_phase();
            if (ended_by < 0 || is_stuck(ended_by)) break;
            if (contains(closed_, ended_by))
                settle_into({}, ended_by);
            else
                settle_into({ended_by}, {});
        }
        if (result_.failure) {
            result_.ending = Ending::failed;
            if (result_.phases.empty()) result_.phases.push_back({.closed = {}, .motion = one_row()});
        }
        // Bounces laid down before their time end after what came next, or after the run.
        std::erase_if(result_.contacts, [&](const ContactEvent& e) { return e.time > result_.final_time(); });
        std::stable_sort(result_.contacts.begin(), result_.contacts.end(),
                         [](const ContactEvent& a, const ContactEvent& b) { return a.time < b.time; });
        return std::move(result_);
    }

private:
    bool is_first() const { return result_.phases.empty(); }

    void settle_into(const std::vector<int>& touched, const std::optional<int>& released) {
        Settled settled = settle(contacts_,
                                 {.t = t_,
                                  .tolerance = tolerance_,
                                  .closed = closed_,
                                  .resting = resting_,
                                  .touched = touched,
                                  .released = released},
                                 state_);
        for (const ContactEvent& event : settled.events) {
            const auto struck = [&](const ContactEvent& e) {
                return e.kind == ContactEvent::Kind::impact && e.contact == event.contact;
            };
            if (is_first() && event.kind == ContactEvent::Kind::rest &&
                std::none_of(settled.events.begin(), settled.events.end(), struck))
                continue;  // it has been lying
            result_.contacts.push_back(event);
        }
        closed_ = std::move(settled.closed);
        resting_ = std::move(settled.resting);
        if (!settled.failure.empty()) fail(settled.failure);
    }

    /// Integrates until a contact changes, whose number it gives; −1: the run has ended.
    int run_phase() {
        const ContactMode& mode = modes_(closed_);
        if (mode.project) mode.project(t_, state_.data());
        const double end = options_.start + options_.duration;
        Options here = options_;
        if (count_ > 0) {
            here.start = t_;
            here.duration = end - t_;
            here.sample = sample_interval(options_);
            here.grid = options_.start;
            if (here.longest_step == 0)
                here.longest_step = options_.duration / 200;  // so that no short contact is passed over
            here.budget = std::max(1L, options_.budget - result_.statistics.evaluations);
        }
        here.project = mode.project;
        here.rhs_when_stiff = mode.rhs_when_stiff;
        here.on_step = mode.on_step;
        here.by = mode.by;
        const Events events = count_ > 0 ? watched(mode) : mode.events;
        Trajectory motion = integrate(mode.rhs, state_, here, events);
        add_up(motion.statistics);
        const int of_scene = static_cast<int>(mode.events.list.size()) - count_;
        int ended_by = -1;
        if (motion.ending == Ending::stopped_by_event && motion.events.back().index >= of_scene) {
            ended_by = motion.events.back().index - of_scene;
            motion.events.pop_back();
        }
        if (count_ > 0 && motion.ending == Ending::completed) motion.times.back() = end;
        result_.ending = motion.ending;
        result_.failure = motion.failure;
        if (count_ > 0 && motion.failure && motion.failure->kind == FailureKind::budget_used_up)
            result_.failure->message = fmt::format(
                "{} right-hand sides were not enough to come further than t = {:.17g}, with {} "
                "impacts and changes of contact; raise the budget (--budget), loosen the "
                "tolerance or shorten the duration",
                options_.budget, motion.failure->time, result_.contacts.size());
        result_.events.insert(result_.events.end(), motion.events.begin(), motion.events.end());
        t_ = motion.times.back();
        const auto last = motion.final_state();
        state_.assign(last.begin(), last.end());
        if (ended_by >= 0 && mode.project)
            mode.project(t_, state_.data());  // dense output has left the constraints a little
        motion.times.shrink_to_fit();
        motion.states.shrink_to_fit();
        result_.phases.push_back({.closed = closed_, .motion = std::move(motion)});
        return ended_by;
    }

    void add_up(const Statistics& s) {
        Statistics& sum = result_.statistics;
        sum.steps += s.steps;
        sum.rejected += s.rejected;
        sum.evaluations += s.evaluations;
        sum.seconds += s.seconds;
        sum.method = s.method;
        if (!sum.switched) sum.switched = s.switched;
    }

    /// The mode's events, those of the contacts held against their bounds and stopping the phase.
    Events watched(const ContactMode& mode) const {
        const std::size_t scene = mode.events.list.size() - contacts_.names.size();
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
        std::vector<Event> list = mode.events.list;
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
                const double rise = (2 * off + 16 * epsilon * sizes[k]) / speed[k];
                if (speed[k] > still[k])
                    watch.open_until =
                        t_ + (fall > 0 ? std::min(rise, speed[k] / fall / 2) : rise);  // a quarter of the flight
                else
                    watch.bound = contains(resting_, k) ? std::max(10 * slack[k], 2 * off)
                                                        : std::max(1e-12 * sizes[k], 2 * off);
            }
        }
        return make_events(std::move(list), [base = mode.events, watches, scene](
                                                double t, const double* y, const double* rates, double* out) {
            base(t, y, rates, out);
            for (std::size_t k = 0; k < watches.size(); ++k) {
                double& g = out[scene + k];
                g += watches[k].bound;
                if (t <= watches[k].open_until) g = std::max(g, std::numeric_limits<double>::min());
            }
        });
    }

    /// Contacts that open and close without the time moving on.
    bool is_stuck(int k) {
        events_at_once_ = t_ - last_event_ > 1e-12 * std::abs(t_) ? 0 : events_at_once_ + 1;
        last_event_ = t_;
        if (events_at_once_ < most_events_at_once * (1 + count_)) return false;
        fail(
            fmt::format("no contact mode is consistent at t = {:.17g}: contact '{}' and others open and close "
                        "without the time "
                        "moving on; loosen the tolerance, or look at the gaps there",
                        t_, contacts_.names[k]));
        return true;
    }

    void fail(const std::string& message) {
        result_.failure =
            Failure{.kind = FailureKind::no_contact_mode, .message = message, .time = t_, .state = state_};
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
    double t_;
    std::vector<double> state_;
    std::vector<int> closed_, resting_;
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
