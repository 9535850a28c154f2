// SPDX-License-Identifier: MIT
#include "alembert/hybrid/hybrid_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "alembert/base/tolerances.hpp"
#include "alembert/hybrid/automaton.hpp"
#include "alembert/hybrid/held_guard.hpp"
#include "alembert/ode/disturbance.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int most_events_at_once = 100;

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
          now_{.t = options.start, .state = std::move(initial)} {}

    HybridMotion go() {
        result_.statistics.method = name(options_.method);
        Halt none;
        if (count_ > 0) settle_into({}, {}, none);
        if (!result_.failure) run_modes(*this, options_);
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

    MotionState& now() { return now_; }

    /// The phase that begins, until a contact changes or an event kicks.
    Mode enter(Options rest, RunPiece piece) {
        mode_ = &modes_(closed_);
        const System& system = mode_->system;
        if (system.project) system.project(now_.t, now_.state.data());
        if (count_ > 0) {  // so that no short contact is missed
            const double short_enough = options_.duration / 200;
            rest.longest_step = rest.longest_step > 0 ? std::min(rest.longest_step, short_enough) : short_enough;
        }
        if (!system.with_series) rest.when_cheaper = {};
        rest.on_step = mode_->on_step;
        Mode mode{.system = system,
                  .guards = in_phases_ ? watched(*mode_) : mode_->events,
                  .own = count_,
                  .run = &mode_->events,
                  .options = std::move(rest),
                  .piece = std::move(piece)};
        if (mode_->switching)
            mode.integrate = [switching = mode_->switching](
                                 const System& abilities, const std::vector<double>& initial,
                                 const Options& options, const Events& events, const RunPiece& part) {
                return alembert::integrate(*switching, abilities, initial, options, events, part);
            };
        return mode;
    }

    void collect(Trajectory motion) {
        add_up(motion.statistics);
        result_.ending = motion.ending;
        result_.failure = motion.failure;
        result_.events.insert(result_.events.end(), motion.events.begin(), motion.events.end());
        motion.times.shrink_to_fit();
        motion.states.shrink_to_fit();
        result_.phases.push_back({.closed = closed_, .motion = std::move(motion)});
    }

    /// An event that stops the run takes precedence over a contact at the same instant.
    bool next_mode(const Hit& hit) {
        Halt halt = halt_of(hit);
        for (const int k : halt.kicks) halt.stops = is_last(k) || halt.stops;
        if (halt.contact < 0 && halt.kicks.empty()) return false;
        if (mode_->system.project)  // dense output obeys the constraints only approximately
            mode_->system.project(now_.t, now_.state.data());
        if (halt.contact >= 0 && is_stuck(halt.contact)) return false;
        std::vector<int> touched;
        std::optional<int> released;
        if (halt.contact >= 0 && contains(closed_, halt.contact))
            released = halt.contact;
        else if (halt.contact >= 0)
            touched = {halt.contact};
        settle_into(touched, released, halt);
        if (result_.failure) return false;
        if (halt.stops) result_.phases.push_back({.closed = closed_, .motion = one_row()});
        return !halt.stops;
    }

    std::string changes() const {
        if (!in_phases_) return {};
        return fmt::format(", with {} impacts and changes of contact{}", result_.contacts.size(),
                           kicks_ == 0 ? "" : fmt::format(" and {} kicks of events", kicks_));
    }

private:
    /// The reason why a phase has ended.
    struct Halt {
        int contact = -1;                   ///< a contact that has closed or opened
        std::vector<int> kicks = {};        ///< events whose impulses act
        std::vector<LastZero> passed = {};  ///< all events of the scene that are zero, each listed once
        bool stops = false;                 ///< whether the run ends here
    };

    Halt halt_of(const Hit& hit) const {
        Halt halt{
            .contact = hit.guards.empty() ? -1 : hit.guards.front(), .passed = hit.passed, .stops = hit.stops};
        for (const LastZero& zero : hit.passed)
            if (zero.counts && contacts_.kicks.has(static_cast<std::size_t>(zero.event)))
                halt.kicks.push_back(zero.event);
        if (halt.stops && halt.kicks.empty()) halt.contact = -1;
        return halt;
    }

    bool is_first() const { return result_.phases.empty(); }

    /// Whether this zero of a counted event ends the run.
    bool is_last(int event) {
        const int last = contacts_.kicks.last_of(static_cast<std::size_t>(event));
        return last > 0 && ++met_[event] >= last;
    }

    /// Puts what the events of the instant set into `rates`, adds to `halt` those whose values that takes past
    /// zero, and returns the sum of all impulses, each of which is also kept in the record of its event.
    VectorXd act(Halt& halt, const std::vector<double>& before, std::vector<double>& rates) {
        struct Round {
            std::vector<int> events;
            std::vector<double> before;
        };
        std::vector<Round> rounds;
        for (std::vector<int> next = halt.kicks; !next.empty();) {
            rounds.push_back({next, rates});
            const std::vector<double>& from = rounds.back().before;
            if (contacts_.kicks.set)
                if (const auto why = contacts_.kicks.set(next, now_.t, from.data(), rates.data())) {
                    fail(FailureKind::endless_kicks, *why);
                    return {};
                }
            next = taken_past_zero(halt, from, rates);
        }
        if (rates != before && contacts_.kicks.on_set) contacts_.kicks.on_set(now_.t, before.data(), rates.data());
        VectorXd sum;
        for (const Round& round : rounds) {
            const Impulses given =
                contacts_.kicks.impulses(round.events, now_.t, round.before.data(), rates.data());
            if (given.refusal) {
                fail(FailureKind::endless_kicks, *given.refusal);
                return {};
            }
            for (std::size_t i = 0; i < given.list.size(); ++i) {
                const VectorXd& one = given.list[i];
                if (one.size() == 0) continue;
                if (EventRecord* const record = last_record(round.events[i]))
                    record->impulse.assign(one.begin(), one.end());
                sum = sum.size() > 0 ? VectorXd(sum + one) : one;
            }
        }
        return sum;
    }

    /// States that are set may open closed contacts, and change the velocities that constraints want: rates then
    /// jump without an impulse of an event.
    VectorXd follow_set(const std::vector<double>& rates, VectorXd impulse) {
        constexpr double negligible = 1e-12;
        const Situation here = contacts_.situation(now_.t, rates.data());
        const Index n = here.f.size();
        if (n == 0) return impulse;
        const Eigen::Map<const VectorXd> q(rates.data(), n), u(rates.data() + n, n);
        const VectorXd slack = negligible_gaps(here, q, tolerance_);
        std::erase_if(closed_, [&](int k) { return here.contacts.value[k] > slack[k]; });
        const Situation::Rows& rows = here.bilateral;
        const VectorXd off = rows.rows * u + rows.offset,
                       size = rows.rows.cwiseAbs() * u.cwiseAbs() + rows.offset.cwiseAbs();
        const bool holds = (off.array().abs() <= negligible * size.array()).all();
        return impulse.size() > 0 || holds ? impulse : VectorXd(VectorXd::Zero(n));
    }

    /// The values of the scene's events in a mode.
    std::vector<double> event_values(const ContactMode& mode, double t, const std::vector<double>& state) const {
        std::vector<double> rate(state.size()), value(mode.events.list.size());
        mode.system.rhs(t, state.data(), rate.data());
        mode.events(t, state.data(), rate.data(), value.data());
        value.resize(value.size() - contacts_.names.size());
        return value;
    }

    /// Those that kick among the events whose values have passed zero because states were set. Each is told like
    /// any other, and happens once in an instant.
    std::vector<int> taken_past_zero(Halt& halt, const std::vector<double>& from, const std::vector<double>& to) {
        constexpr double negligible = 1e-9;  // of the jump: values of constraints are zero to rounding
        std::vector<int> result;
        if (from == to) return result;
        const std::vector<double> state = as_integrated(contacts_.kicks, now_.t, to),
                                  old = event_values(*mode_, now_.t, as_integrated(contacts_.kicks, now_.t, from)),
                                  value = event_values(*mode_, now_.t, state);
        for (std::size_t k = 0; k < value.size(); ++k) {
            const double zero = negligible * std::abs(value[k] - old[k]);
            const double beyond = old[k] > 0 ? -value[k] : value[k];
            const bool passes =
                std::abs(old[k]) > zero && (contacts_.kicks.is_of_modes(k) ? beyond >= -zero : beyond > zero);
            const auto is_it = [k](const LastZero& known) { return known.event == static_cast<int>(k); };
            const auto before = std::find_if(halt.passed.begin(), halt.passed.end(), is_it);
            if (!passes || (before != halt.passed.end() && before->counts)) continue;
            if (before != halt.passed.end()) halt.passed.erase(before);  // it passed the other way
            const Event& event = mode_->events.list[k];
            LastZero here{.event = static_cast<int>(k), .direction = old[k] > 0 ? -1 : 1};
            here.counts = event.direction == 0 || event.direction == here.direction;
            halt.passed.push_back(here);
            if (!here.counts) continue;
            const EventRecord record{.index = here.event, .name = event.name, .time = now_.t, .state = state};
            result_.events.push_back(record);
            result_.phases.back().motion.events.push_back(record);
            halt.stops = halt.stops || event.stop || is_last(here.event);
            if (!contacts_.kicks.has(k)) continue;
            halt.kicks.push_back(here.event);
            result.push_back(here.event);
        }
        return result;
    }

    /// For an event whose value is known along the motion alone, because it holds multipliers.
    PassedZero passed_along(std::size_t event) const {
        constexpr double little = 1e-9;  // of the duration
        const double h = std::max(little * options_.duration, 64 * tolerance::epsilon * std::abs(now_.t));
        const ContactMode& next = modes_(closed_);
        std::vector<double> later = now_.state, rate(now_.state.size());
        next.system.rhs(now_.t, now_.state.data(), rate.data());
        for (std::size_t i = 0; i < later.size(); ++i) later[i] += h * rate[i];
        const double value = event_values(next, now_.t, now_.state)[event],
                     then = event_values(next, now_.t + h, later)[event], change = then - value;
        PassedZero result{.slope = change / h, .size = std::abs(change / h) * options_.duration};
        if (std::abs(value) > 2 * std::abs(change)) return result;  // it has jumped
        if (change == 0)
            result.band = 2 * std::abs(value);
        else
            result.side = then > 0 ? 1 : -1, result.hold = h;
        return result;
    }

    void tell_gains(const std::vector<int>& kicks, const std::vector<double>& before, const VectorXd& struck) {
        const Eigen::Map<const VectorXd> u(before.data() + struck.size(), struck.size());
        for (const int k : kicks)
            if (EventRecord* const record = last_record(k); record && !record->impulse.empty())
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
            contacts_.kicks.passed(now_.t, before.data(), after.data(), acceleration);
        for (const PassedZero& zero : zeros) passed_.push_back(zero.is_zero ? zero : PassedZero());
        for (const LastZero& zero : halt.passed) {
            const auto k = static_cast<std::size_t>(zero.event);
            const PassedZero passed = zeros[k].size < 0 ? passed_along(k) : zeros[k];
            passed_[k] = passed;
            if (!contains(halt.kicks, zero.event)) continue;
            ++kicks_;
            const std::string& name = mode_->events.list[k].name;
            if (const auto endless =
                    series_[zero.event].add(name, now_.t, zero, passed, tolerance_, options_.duration))
                return fail(FailureKind::endless_kicks, *endless);
        }
    }

    void settle_into(const std::vector<int>& touched, const std::optional<int>& released, Halt& halt) {
        const std::vector<double> before =
            mode_ ? in_rates(contacts_.kicks, mode_->system.rhs, now_.t, now_.state) : now_.state;
        const std::vector<double> integrated = now_.state;
        std::vector<double> rates = before;
        VectorXd impulse = act(halt, before, rates);
        if (result_.failure) return;
        if (rates != before) impulse = follow_set(rates, std::move(impulse));
        ContactTransition settled = settle(contacts_,
                                           {.t = now_.t,
                                            .tolerance = tolerance_,
                                            .closed = closed_,
                                            .resting = resting_,
                                            .touched = touched,
                                            .released = released,
                                            .impulse = impulse},
                                           rates);
        now_.state = mode_ ? as_integrated(contacts_.kicks, now_.t, rates) : rates;
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
        for (const int k : halt.kicks)
            if (contacts_.kicks.refusal)
                if (const auto why = contacts_.kicks.refusal(k, now_.t, before.data(), rates.data()))
                    return fail(FailureKind::endless_kicks, *why);
        if (options_.disturbed.seed != 0 && mode_) be_late_after(integrated);
        tell_gains(halt.kicks, before, settled.struck);
        go_from(halt, before, rates, settled.acceleration);
    }

    /// What the next phase is off by, because the time at which it begins is rounded (disturbance.hpp).
    void be_late_after(const std::vector<double>& before) {
        std::vector<double> rate_before(now_.state.size()), rate_after(now_.state.size());
        mode_->system.rhs(now_.t, before.data(), rate_before.data());
        modes_(closed_).system.rhs(now_.t, now_.state.data(), rate_after.data());
        std::vector<bool> jumped;
        for (std::size_t i = 0; i < now_.state.size(); ++i) jumped.push_back(before[i] != now_.state[i]);
        now_.late = late_by_rounding(options_.disturbed.seed, {.t = now_.t,
                                                               .number = jumps_++,
                                                               .before = rate_before,
                                                               .after = rate_after,
                                                               .jumped = std::move(jumped)});
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

    /// The mode's events, prepared for a phase: those of contacts stop it, and so do those that kick.
    Events watched(const ContactMode& mode) const {
        const std::size_t scene = mode.events.list.size() - contacts_.names.size();
        std::vector<Event> list = mode.events.list;
        for (std::size_t k = 0; k < scene; ++k) {
            if (!contacts_.kicks.has(k)) continue;
            list[k].stop = true;
            list[k].at_once = !is_first();
        }
        std::vector<HeldGuard> held;
        for (const PassedZero& zero : passed_) held.push_back(held_from(now_.t, zero));
        if (count_ == 0) return with_guards_held(mode.events, std::move(list), held);
        held.resize(list.size());
        std::vector<double> rate(now_.state.size()), value(mode.events.list.size());
        mode.system.rhs(now_.t, now_.state.data(), rate.data());
        mode.events(now_.t, now_.state.data(), rate.data(), value.data());
        const Situation here = contacts_.situation(now_.t, now_.state.data());
        const Index n = here.f.size();
        const Eigen::Map<const VectorXd> q(now_.state.data(), n), u(now_.state.data() + n, n),
            acceleration(rate.data() + n, n);
        const VectorXd speed = gap_rates(here, u), still = negligible_rates(here, u);
        const VectorXd sizes = negligible_gaps(here, q, 1), slack = tolerance_ * sizes;

        for (int k = 0; k < count_; ++k) {
            list[scene + k].stop = list[scene + k].at_once = true;
            HeldGuard& watch = held[scene + k];
            if (contains(closed_, k)) {
                const double uncertain = 10 * tolerance_ * reaction_scale(here, acceleration, k);
                if (value[scene + k] <= uncertain)
                    watch.bound = 2 * std::max(uncertain, -value[scene + k]) + std::numeric_limits<double>::min();
            } else if (value[scene + k] <= slack[k]) {
                const double off = std::abs(value[scene + k]);
                const double fall = here.contacts.acceleration[k] - here.contacts.rows.row(k).dot(acceleration);
                const double rise = (2 * off + 16 * tolerance::epsilon * sizes[k]) / speed[k];
                if (speed[k] > still[k])
                    watch.until = now_.t + (fall > 0 ? std::min(rise, speed[k] / fall / 2)
                                                     : rise);  // a quarter of the flight
                else
                    watch.bound = contains(resting_, k) ? std::max(10 * slack[k], 2 * off)
                                                        : std::max(1e-12 * sizes[k], 2 * off);
            }
        }
        return with_guards_held(mode.events, std::move(list), held);
    }

    /// Whether contacts open and close again and again at the same time.
    bool is_stuck(int k) {
        events_at_once_ = now_.t - last_event_ > 1e-12 * std::abs(now_.t) ? 0 : events_at_once_ + 1;
        last_event_ = now_.t;
        if (events_at_once_ < most_events_at_once * (1 + count_)) return false;
        fail(FailureKind::no_contact_mode,
             fmt::format("no contact mode is consistent at t = {}: contact '{}' and others open and close "
                         "while the time does not advance; loosen the tolerance, or look at the gaps there",
                         now_.t, contacts_.names[k]));
        return true;
    }

    void fail(FailureKind kind, const std::string& message) {
        result_.failure = Failure{.kind = kind, .message = message, .time = now_.t, .state = now_.state};
    }

    Trajectory one_row() const {
        Trajectory row;
        row.dimension = static_cast<int>(now_.state.size());
        row.times = {now_.t};
        row.states = now_.state;
        return row;
    }

    const Contacts& contacts_;
    const ContactModes& modes_;
    const Options& options_;
    double tolerance_;
    int count_;
    bool in_phases_;  ///< whether anything makes rates jump
    MotionState now_;
    std::vector<int> closed_, resting_;
    const ContactMode* mode_ = nullptr;  ///< the mode of the last phase
    std::vector<PassedZero> passed_;     ///< for the scene's events, at the start of the next phase
    std::map<int, KickSeries> series_;   ///< the kicks of each event
    std::map<int, int> met_;             ///< how many zeros of each counted event there were
    long kicks_ = 0, jumps_ = 0;
    int events_at_once_ = 0;
    double last_event_ = -HUGE_VAL;
    HybridMotion result_;
};

}  // namespace

HybridMotion follow(const Contacts& contacts, const ContactModes& modes, std::vector<double> initial,
                    const Options& options) {
    return Following(contacts, modes, std::move(initial), options).go();
}

}  // namespace alembert
