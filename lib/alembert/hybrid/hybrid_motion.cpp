// SPDX-License-Identifier: MIT
#include "alembert/hybrid/hybrid_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "alembert/base/tolerances.hpp"
#include "alembert/hybrid/automaton.hpp"
#include "alembert/hybrid/jump_zeros.hpp"
#include "alembert/hybrid/phase_guards.hpp"
#include "alembert/ode/disturbance.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int most_events_at_once = 100;  // of a contact, where each takes a few
constexpr double usual_rows = 200;        // of a run; what is shorter than the time between them is not seen
constexpr double same_instant = 1e-12;    // relative to the time, which Newton's method on dense output reaches

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
            const double short_enough = options_.duration / usual_rows;
            rest.longest_step = rest.longest_step > 0 ? std::min(rest.longest_step, short_enough) : short_enough;
        }
        if (!system.with_series) rest.when_cheaper = {};
        rest.on_step = mode_->on_step;
        Mode mode{.system = system,
                  .guards = in_phases_ ? guards() : mode_->events,
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
    Events guards() const {
        return phase_guards(contacts_, *mode_,
                            {.t = now_.t,
                             .state = now_.state,
                             .closed = closed_,
                             .resting = resting_,
                             .passed = passed_,
                             .tolerance = tolerance_,
                             .is_first = is_first()});
    }

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

    /// Puts what the events of a round set into `rates`. Returns the sum of their impulses, each of which is also
    /// kept in the record of its event.
    VectorXd act(const std::vector<int>& events, const std::vector<double>& before, std::vector<double>& rates) {
        const ImpulsiveEvents& kicks = contacts_.kicks;
        VectorXd sum;
        if (events.empty()) return sum;
        if (kicks.set)
            if (const auto why = kicks.set(events, now_.t, before.data(), rates.data())) return refuse(*why);
        if (rates != before && kicks.on_set) kicks.on_set(now_.t, before.data(), rates.data());
        const Impulses given = kicks.impulses(events, now_.t, before.data(), rates.data());
        if (given.refusal) return refuse(*given.refusal);
        for (std::size_t i = 0; i < given.list.size(); ++i) {
            const VectorXd& one = given.list[i];
            if (one.size() == 0) continue;
            if (EventRecord* const record = last_record(events[i])) record->impulse.assign(one.begin(), one.end());
            sum = sum.size() > 0 ? VectorXd(sum + one) : one;
        }
        return sum;
    }

    VectorXd refuse(const std::string& why) {
        fail(FailureKind::impossible_event, why);
        return {};
    }

    /// States that are set may open closed contacts, and change the velocities that constraints want: rates then
    /// jump without an impulse of an event.
    VectorXd follow_set(const std::vector<double>& rates, VectorXd impulse) {
        constexpr double negligible = 1e-12;  // a few hundred rounding errors of the terms
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

    /// The events that act in the next round of this instant, because what has happened in the last one has taken
    /// their values past zero. All that pass are told, and each counts once in an instant.
    std::vector<int> next_round(Halt& halt, const std::vector<LastZero>& zeros) {
        std::vector<int> result;
        for (const LastZero& zero : zeros) {
            const auto known = std::find_if(halt.passed.begin(), halt.passed.end(),
                                            [&](const LastZero& z) { return z.event == zero.event; });
            if (known != halt.passed.end() && known->counts) continue;
            if (known != halt.passed.end()) halt.passed.erase(known);  // it passed the other way
            halt.passed.push_back(zero);
            if (!zero.counts) continue;
            const auto k = static_cast<std::size_t>(zero.event);
            const Event& event = mode_->events.list[k];
            EventRecord record{.index = zero.event, .name = event.name, .time = now_.t, .state = now_.state};
            if (closed_ != result_.phases.back().closed) record.closed = closed_;
            result_.events.push_back(record);
            result_.phases.back().motion.events.push_back(record);
            halt.stops = halt.stops || event.stop || is_last(zero.event);
            if (!contacts_.kicks.has(k)) continue;
            halt.kicks.push_back(zero.event);
            result.push_back(zero.event);
        }
        return result;
    }

    /// The zeros of other events at the instant of an event: rounding may leave their values on the side from
    /// which they come.
    std::vector<LastZero> missed_zeros(const Halt& halt) const {
        std::vector<LastZero> result =
            zeros_at({*mode_, now_.state}, contacts_.kicks.events.size(), now_.t, options_.duration);
        const double just_now = now_.t - 1e-12 * std::max(1.0, std::abs(now_.t));
        std::erase_if(result, [&](const LastZero& zero) {
            const auto is_of = [&](const auto& one) { return one.event == zero.event; };
            const auto has_been = [&](const EventRecord& one) {
                return one.index == zero.event && one.time >= just_now;
            };
            return std::any_of(halt.passed.begin(), halt.passed.end(), is_of) ||
                   contacts_.kicks.is_of_multipliers(static_cast<std::size_t>(zero.event)) ||
                   std::any_of(result_.events.begin(), result_.events.end(), has_been);
        });
        return result;
    }

    /// Whether coordinates and rates are the same, whatever else was set.
    bool same_motion(const std::vector<double>& before, const std::vector<double>& after) const {
        const auto n = static_cast<std::ptrdiff_t>(acceleration_.size());
        return std::equal(before.begin(), before.begin() + 2 * n, after.begin());
    }

    /// The zeros at which the values of events are, and which what was set turns into the direction that counts
    /// for these: the motion grows through a zero to which it has fallen. Two events that turn each other back for
    /// ever are a failure.
    std::vector<LastZero> turned(const Halt& halt, const std::vector<double>& before,
                                 const std::vector<double>& after) {
        std::vector<LastZero> result;
        if (!contacts_.kicks.passed || before == after || !same_motion(before, after)) return result;
        const std::vector<PassedZero> zeros = passed_zeros(before, after);
        for (const LastZero& zero : halt.passed) {
            const auto k = static_cast<std::size_t>(zero.event);
            const int wanted = mode_->events.list[k].direction, side = zeros[k].side;
            if (wanted == 0 || side == 0 || zero.touches || contacts_.kicks.is_of_multipliers(k)) continue;
            if (side == wanted && !zero.counts) result.push_back({zero.event, side, true});
            if (side == -wanted && zero.counts) turned_back_.insert(zero.event);
            if (side != wanted || !zero.counts || !turned_back_.contains(zero.event)) continue;
            fail(FailureKind::endless_kicks,
                 fmt::format(
                     "event '{}' and others at t = {:.10g} set states that turn its value back and forth at "
                     "its zero without end; what slides along a zero is a force with sign(…), or a "
                     "[[friction]]",
                     mode_->events.list[k].name, now_.t));
        }
        return result;
    }

    /// What becomes of the zeros of events. Their rates tell it; an event that bends at its zero, as |x| − x/2
    /// does, has none there, and its value soon after tells.
    std::vector<PassedZero> passed_zeros(const std::vector<double>& before,
                                         const std::vector<double>& after) const {
        constexpr double above_rounding = 64 * tolerance::epsilon;
        std::vector<PassedZero> zeros = contacts_.kicks.passed(now_.t, before.data(), after.data(), acceleration_);
        for (std::size_t k = 0; k < zeros.size(); ++k) {
            if (!zeros[k].is_zero || zeros[k].side == 0 || contacts_.kicks.is_of_multipliers(k)) continue;
            const PassedZero soon = zero_along({modes_(closed_), now_.state}, k, now_.t, options_.duration);
            if (soon.slope == 0 && stays_at_zero(k)) {
                zeros[k].side = 0;
                zeros[k].band = tolerance::passed_zero * zeros[k].size;
            }
            if (soon.side * zeros[k].side >= 0 ||
                !(std::abs(soon.slope) * soon.hold > above_rounding * zeros[k].size))
                continue;
            zeros[k].side = soon.side;
            zeros[k].hold = soon.hold;
        }
        return zeros;
    }

    /// Whether the value of an event is zero, and stays so: a little later, and a thousandth of the run later.
    bool stays_at_zero(std::size_t event) const {
        constexpr double later = 1e6;
        return zero_along({modes_(closed_), now_.state}, event, now_.t, later * options_.duration).slope == 0;
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
    void go_from(const Halt& halt, const std::vector<double>& before, const std::vector<double>& after) {
        passed_.clear();
        if (!contacts_.kicks.passed) return;
        const std::vector<PassedZero> zeros = passed_zeros(before, after);
        for (const PassedZero& zero : zeros) passed_.push_back(zero.is_zero ? zero : PassedZero());
        for (const LastZero& zero : halt.passed) {
            const auto k = static_cast<std::size_t>(zero.event);
            PassedZero passed = contacts_.kicks.is_of_multipliers(k)
                                    ? zero_along({modes_(closed_), now_.state}, k, now_.t, options_.duration)
                                    : zeros[k];
            if (zero.width > 0 && same_motion(before, after)) {  // rounding decides nothing on a touch
                passed.side = -zero.direction;
                passed.hold = 2 * zero.width;
            }
            passed_[k] = passed;
            if (!contains(halt.kicks, zero.event)) continue;
            ++kicks_;
            const std::string& name = mode_->events.list[k].name;
            if (const auto endless =
                    series_[zero.event].add(name, now_.t, zero, passed, tolerance_, options_.duration))
                return fail(FailureKind::endless_kicks, *endless);
        }
    }

    /// Each round of events acts on what the one before has left, with its impacts and changes of contact.
    void settle_into(const std::vector<int>& touched, const std::optional<int>& released, Halt& halt) {
        const std::vector<double> integrated = now_.state;
        const std::vector<double> before =
            mode_ ? in_rates(contacts_.kicks, mode_->system.rhs, now_.t, now_.state) : now_.state;
        std::vector<double> rates = before;
        PhaseEnd end = ended();
        end.touched = touched;
        end.released = released;
        turned_back_.clear();
        if (mode_ && !halt.kicks.empty() && halt.contact < 0) next_round(halt, missed_zeros(halt));
        for (std::vector<int> events = halt.kicks;; end = ended()) {
            const std::vector<double> from = rates;
            const ContactMode* const old = mode_ ? &modes_(closed_) : nullptr;
            const std::vector<double> was = now_.state;
            std::vector<double> set;
            settle_round(events, std::move(end), rates, set);
            if (result_.failure) return;
            if (!old) break;
            std::vector<LastZero> zeros = zeros_of_jump(contacts_.kicks, {.t = now_.t,
                                                                          .before = {*old, was},
                                                                          .after = {modes_(closed_), now_.state},
                                                                          .set = set,
                                                                          .duration = options_.duration});
            for (const LastZero& zero : turned(halt, from, rates)) zeros.push_back(zero);
            if (result_.failure) return;
            events = next_round(halt, zeros);
            if (events.empty()) break;
        }
        if (options_.disturbed.seed != 0 && mode_) be_late_after(integrated);
        go_from(halt, before, rates);
    }

    PhaseEnd ended() const {
        return {.t = now_.t, .tolerance = tolerance_, .closed = closed_, .resting = resting_};
    }

    /// `set` becomes the state after what the events have set, before their impulses.
    void settle_round(const std::vector<int>& events, PhaseEnd end, std::vector<double>& rates,
                      std::vector<double>& set) {
        const std::vector<double> before = rates;
        end.impulse = act(events, before, rates);
        if (result_.failure) return;
        set = mode_ ? as_integrated(contacts_.kicks, now_.t, rates) : rates;
        if (rates != before) {
            end.impulse = follow_set(rates, std::move(end.impulse));
            end.closed = closed_;
        }
        ContactTransition settled = settle(contacts_, end, rates);
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
        acceleration_ = std::move(settled.acceleration);
        if (!settled.failure.empty())
            return fail(events.empty() ? FailureKind::no_contact_mode : FailureKind::impossible_event,
                        settled.failure);
        for (const int k : events)
            if (contacts_.kicks.refusal)
                if (const auto why = contacts_.kicks.refusal(k, now_.t, before.data(), rates.data()))
                    return fail(FailureKind::impossible_event, *why);
        tell_gains(events, before, settled.struck);
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
        if (!sum.passed_place) sum.passed_place = s.passed_place;
        if (!sum.switched)
            sum.switched = s.switched;
        else if (s.switched)
            sum.later_switches.push_back(*s.switched);
        sum.later_switches.insert(sum.later_switches.end(), s.later_switches.begin(), s.later_switches.end());
    }

    /// Whether contacts open and close again and again at the same time.
    bool is_stuck(int k) {
        events_at_once_ = now_.t - last_event_ > same_instant * std::abs(now_.t) ? 0 : events_at_once_ + 1;
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
    VectorXd acceleration_;              ///< q'' where the next phase begins
    std::vector<PassedZero> passed_;     ///< for the scene's events, at the start of the next phase
    std::map<int, KickSeries> series_;   ///< the kicks of each event
    std::map<int, int> met_;             ///< how many zeros of each counted event there were
    std::set<int> turned_back_;          ///< events of this instant whose values were turned where they came from
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
