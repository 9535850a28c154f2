// SPDX-License-Identifier: MIT
#include "alembert/hybrid/filippov_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "alembert/hybrid/automaton.hpp"
#include "alembert/hybrid/continuous_sides.hpp"
#include "alembert/hybrid/events_at_switch.hpp"
#include "alembert/hybrid/mode_guard.hpp"
#include "alembert/hybrid/side_choice.hpp"
#include "alembert/hybrid/sliding_field.hpp"
#include "alembert/hybrid/switching_scales.hpp"
#include "alembert/ode/disturbance.hpp"

namespace alembert {

namespace {

constexpr int most_undecided = 6;  // the most signs that may be undecided together: at most 3⁶ choices are tried
constexpr double most_gathered = 1e3;  // times the error of a step, which a motion has gathered at most
constexpr int most_in_one_place = 50;  // the most changes without an advance of time
constexpr int few_in_one_place = 4;    // after so many signs that change nothing wait until errors are left behind
constexpr double idle_share =
    1e-3;  // of what errors of the tolerance make of a function, which is idle up to that
constexpr double negative_normal = 1e-6;  // relative to the largest so far, beyond doubt

class SwitchedRun {
public:
    SwitchedRun(const FilippovSystem& system, const System& abilities, const std::vector<double>& initial,
                const Options& options, const Events& events, const RunPiece& piece)
        : system_(system),
          abilities_(abilities),
          options_(options),
          events_(events),
          piece_(piece),
          now_{.t = options.start, .state = initial, .late = piece.late},
          sizes_(std::make_shared<std::vector<double>>(static_cast<std::size_t>(system.count()))),
          normals_(std::make_shared<std::vector<double>>(static_cast<std::size_t>(system.count()))) {}

    Trajectory go() {
        if (begin() && begin_piece()) run_modes(*this, options_, piece_);
        return std::move(result_);
    }

    MotionState& now() { return now_; }

    /// The piece with the sides of now, until a sign changes.
    Mode enter(Options rest, RunPiece piece) {
        *undefined_ = HUGE_VAL;
        if (system_.before_step)
            system_.before_step(at_->sigma());  // the first step of the piece is projected too
        watched_ = mode_guards(*at_, {now_.t, options_.start + options_.duration}, *sizes_);
        for (ModeGuard& one : watched_)
            if (one.what == ModeGuard::What::normal) one.offset += moment().uncertain_normal(*at_, one.index);
        const bool slides = !at_->sliding().empty();
        System system = abilities_;
        system.rhs = right_hand_side();
        system.with_jacobian = {};
        system.with_series = {};
        rest.when_cheaper = {};  // the series of a piece is another one
        if (slides && needs_series(rest.method)) rest.method = Method::verner98;
        const auto has_smoothing = [](const FilippovMode::Slide& slide) { return slide.smoothing > 0; };
        if (std::any_of(sides_.slides.begin(), sides_.slides.end(), has_smoothing))
            rest.when_stiff = {};  // long steps of radau go wrong in the direction that δ bends at low speeds
        if (slides)
            system.project = [base = abilities_.project, sides = std::make_shared<SlidingField>(
                                                             system_, sides_, dimension())](double t, double* y) {
                if (base) base(t, y);
                sides->bring_back(t, y);
            };
        rest.on_step = [this](double t, std::span<const double> y, std::span<const double> rate) {
            if (system_.before_step) {
                if (!at_->sliding().empty()) at_->evaluate(t, y.data());
                system_.before_step(at_->sigma());
            }
            if (options_.on_step) options_.on_step(t, y, rate);
        };
        grid_ = *piece.grid;
        return {.system = std::move(system),
                .guards = with_watches(watched_),
                .own = static_cast<int>(watched_.size()),
                .run = &events_,
                .options = std::move(rest),
                .piece = std::move(piece)};
    }

    void collect(Trajectory part) {
        if (result_.times.empty())
            result_ = std::move(part);
        else
            append(result_, std::move(part), grid_, sample_interval(options_));
    }

    bool next_mode(const Hit& hit) {
        if (result_.ending != Ending::stopped_by_event) return false;
        if (hit.stops) {
            jump_at_end(hit);
            return false;
        }
        result_.ending = Ending::completed;
        result_.last_zeros.clear();
        const EventsAtSwitch events = events_here();
        if (options_.disturbed.seed == 0)
            return pass(watched_, hit.guards) && begin_piece() && !stops_by_event(events, hit);
        const std::vector<double> before = rate_here();
        if (!pass(watched_, hit.guards)) return false;
        const std::vector<double> after = rate_here();
        now_.late = late_by_rounding(options_.disturbed.seed,
                                     {.t = now_.t, .number = jumps_++, .before = before, .after = after});
        return begin_piece() && !stops_by_event(events, hit);
    }

    std::string changes() const { return {}; }

private:
    int dimension() const { return static_cast<int>(now_.state.size()); }
    SwitchingScales moment() const { return {system_, sides_, now_.t, now_.state, options_, *sizes_}; }
    double value_of(int k) const { return moment().value(k); }

    /// Determines the sides at the start.
    bool begin() {
        sides_ = system_.start();
        std::vector<int> open;
        bool is_defined = true;
        for (int k = 0; k < system_.count(); ++k) {  // a function may contain the signs of those before it
            const double g = value_of(k);
            is_defined = is_defined && std::isfinite(g);
            (*sizes_)[k] = std::abs(g);
            if (sides_.is_pair(k)) {
                if (k % 2 == 1 && !direct(k - 1, moment().still(k - 1))) open.push_back(k - 1);
            } else if (moment().is_zero(k, g))
                open.push_back(k);
            else
                sides_[k] = g > 0 ? 1 : -1;
        }
        result_.dimension = dimension();
        if (is_defined && (options_.duration == 0 || choose(open))) {
            for (int k = 0; system_.on_begin && k < system_.count(); k += sides_.is_pair(k) ? 2 : 1)
                if (sides_[k] != 0) system_.on_begin(change_of(k, ModeChange::Kind::leaving));
            return true;
        }
        if (!is_defined) fail_undefined();
        return false;
    }

    /// Lets a pair slide in the direction of its velocity; false if that is not above `least`.
    bool direct(int pair, double least) {
        const double v = value_of(pair), w = value_of(pair + 1), speed = std::hypot(v, w);
        if (!(speed > least)) return false;
        sides_[pair] = sides_[pair + 1] = 1;
        sides_.slides[pair / 2] = {v / speed, w / speed, 0};
        return true;
    }

    /// Updates the signs of functions that contain other signs, after some of these have changed.
    void follow_others(const std::vector<int>& decided) {
        for (int k = 0; k < system_.count(); ++k) {
            if (sides_[k] == 0 || sides_.is_pair(k) ||
                std::find(decided.begin(), decided.end(), k) != decided.end())
                continue;
            const double g = value_of(k);
            if (std::abs(g) > 1e-9 * (*sizes_)[k] && sides_[k] * g < 0) sides_[k] = -sides_[k];
        }
    }

    bool fail_undefined() {
        fail(fmt::format("a function whose sign is needed is not a number at t = {}", now_.t));
        result_.failure->kind = FailureKind::not_a_number;
        return false;
    }

    bool fail_negative(int k) { return fail(system_.refusal(k, now_.t, now_.state.data())); }

    /// Looks at the sides of now, with which the next piece begins; false if a normal force is negative.
    bool begin_piece() {
        SlidingField& at = at_.emplace(system_, sides_, dimension());
        at.evaluate(now_.t, now_.state.data());
        at.find_bounds(now_.t, now_.state.data());
        for (int k = 0; k < system_.count(); ++k) {
            (*normals_)[k] = std::max((*normals_)[k], std::abs(at.normal(k)));
            if (at.normal(k) < -std::max(negative_normal * (*normals_)[k], moment().uncertain_normal(at, k)))
                return fail_negative(k);
            if (sides_[k] != 0) (*sizes_)[k] = std::max((*sizes_)[k], std::abs(at.value(k)));
        }
        return true;
    }

    /// The rates with the sides of now.
    std::vector<double> rate_here() const {
        SlidingField now(system_, sides_, dimension());
        now.evaluate(now_.t, now_.state.data());
        return {now.rate().begin(), now.rate().end()};
    }

    /// What the events of the run are with the sides of now.
    EventsAtSwitch events_here() const {
        return {{.system = system_,
                 .sides = sides_,
                 .events = events_,
                 .t = now_.t,
                 .state = now_.state,
                 .duration = options_.duration}};
    }

    /// Records the events that pass zero where the sides change, or touch it. Whether one of them stops the run.
    bool stops_by_event(const EventsAtSwitch& before, const Hit& hit) {
        const EventsAtSwitch after = events_here();
        for (const LastZero& zero : jumps(system_, before, after))
            if (std::none_of(hit.passed.begin(), hit.passed.end(),
                             [&](const LastZero& z) { return z.event == zero.event; }))
                record(zero);
        for (LastZero& known : result_.last_zeros) {
            const auto k = static_cast<std::size_t>(known.event);
            if (before.earlier[k] * after.later[k] < 0)
                known.touches = false, known.width = 0;  // on one side only
        }
        for (const LastZero& zero : at_zero_ = zeros_here(before, after)) {
            for (LastZero& known : result_.last_zeros)
                known.touches = known.touches || (zero.touches && known.event == zero.event);
            if (zero.counts && !has_just_happened(zero.event)) record(zero);
        }
        return result_.ending == Ending::stopped_by_event;
    }

    void record(const LastZero& zero) {
        const Event& event = events_.list[static_cast<std::size_t>(zero.event)];
        result_.events.push_back({.index = zero.event, .name = event.name, .time = now_.t, .state = now_.state});
        result_.last_zeros.push_back(zero);
        if (event.stop) result_.ending = Ending::stopped_by_event;
    }

    /// Signs that change at the instant at which an event of the run ends it: forces jump there too, and the
    /// motion bends.
    void jump_at_end(const Hit& hit) {
        if (hit.guards.empty()) return;
        const EventsAtSwitch events = events_here();
        const FilippovMode before = sides_;
        if (pass(watched_, hit.guards)) {
            stops_by_event(events, hit);
        } else {  // what the event does may decide where the motion goes on
            sides_ = before;
            result_.failure.reset();
        }
        result_.ending = Ending::stopped_by_event;
    }

    /// Whether a function is kept at its zero.
    bool slides() const {
        for (std::size_t k = 0; k < sides_.size(); ++k)
            if (sides_.slides_at_zero(k)) return true;
        return false;
    }

    Rhs right_hand_side() const {
        if (!slides()) return system_.smooth(system_.sigma(sides_));
        const Rhs any = system_.smooth(system_.sigma(system_.start()));
        auto sides = std::make_shared<SlidingField>(system_, sides_, dimension());
        Rhs rhs = make_rhs(
            dimension(),
            [sides](double t, const double* y, double* rate) {
                sides->evaluate(t, y);
                std::copy(sides->rate().begin(), sides->rate().end(), rate);
            },
            any.extra);
        rhs.names = any.names;
        return rhs;
    }

    /// Whether an event is at a zero where the piece begins that has been told, if it counts.
    bool is_at_its_zero(int event) const {
        return std::any_of(at_zero_.begin(), at_zero_.end(), [&](const LastZero& z) { return z.event == event; });
    }

    /// Whether an event has its zero where the piece begins, and not only soon after.
    bool has_just_happened(int event) const {
        constexpr double same_instant = 1e-12;
        return std::any_of(result_.events.rbegin(), result_.events.rend(), [&](const EventRecord& one) {
            return one.index == event &&
                   now_.t - one.time <= 2 * one.width + same_instant * std::max(1.0, std::abs(now_.t));
        });
    }

    Events with_watches(const std::vector<ModeGuard>& watched) const {
        std::vector<Event> list = events_.list;
        for (std::size_t k = 0; k < list.size() && !result_.times.empty(); ++k)
            list[k].at_once = !is_at_its_zero(static_cast<int>(k)) &&
                              (list[k].at_once || !has_just_happened(static_cast<int>(k)));
        for (const ModeGuard& w : watched)
            list.push_back({.name = system_.names[w.index], .stop = true, .at_once = true, .direction = -1});
        auto sides = std::make_shared<SlidingField>(system_, sides_, dimension());
        const auto values = [this, watched, sides, undefined = undefined_, sizes = sizes_, normals = normals_](
                                double t, const double* y, const double* rate, double* out) {
            sides->evaluate(t, y);
            sides->find_bounds(t, y);
            if (!events_.list.empty()) {
                if (system_.before_step) system_.before_step(sides->sigma());
                events_(t, y, rate, out);
            }
            for (std::size_t k = 0; k < sizes->size(); ++k) {
                (*sizes)[k] = std::max((*sizes)[k], std::abs(sides->value(static_cast<int>(k))));
                (*normals)[k] = std::max((*normals)[k], std::abs(sides->normal(static_cast<int>(k))));
            }
            for (std::size_t i = 0; i < watched.size(); ++i) {
                const ModeGuard& w = watched[i];
                double& value = out[events_.list.size() + i];
                value = guard_value(w, t, *sides, *normals);
                if (!std::isnan(value)) continue;
                *undefined = std::min(*undefined, t);  // the run ends there if it comes so far
                value = -1;
            }
        };
        Events result = make_events(std::move(list), values);
        result.bounds = bounds_with(watched);
        return result;
    }

    /// While a function slides, its σ changes within a step, and bounds for one σ say nothing.
    EventBounds bounds_with(const std::vector<ModeGuard>& watched) const {
        if (slides()) return {};
        const int scene = static_cast<int>(events_.list.size());
        const auto one = [scene, watched](int k) { return watched[static_cast<std::size_t>(k - scene)]; };
        return {.exist =
                    [=, this](int k) {
                        if (k < scene) return events_.bounds.has(k);
                        return one(k).what == ModeGuard::What::side &&
                               system_.bounds_of_functions.has(one(k).index);
                    },
                .of =
                    [=, this](int k, const MotionBounds& motion) {
                        if (k < scene) return events_.bounds.of(k, motion);
                        const ModeGuard w = one(k);
                        Bounds of = w.sign * system_.bounds_of_functions.of(w.index, motion);
                        of.value = of.value + Interval{w.held.bound, w.held.bound};
                        return of;
                    }};
    }

    /// Decides how the motion goes on where the functions watched at `hit` have reached zero.
    bool pass(const std::vector<ModeGuard>& watched, const std::vector<int>& hit) {
        // A step may reach beyond the zero that ends it, to where another value is undefined.
        if (*undefined_ <= now_.t + 1e-12 * std::max(std::abs(now_.t), options_.duration)) return fail_undefined();
        since_change_ = now_.t - last_change_;
        in_one_place_ =
            since_change_ > 1e-13 * std::max(std::abs(now_.t), options_.duration) ? 0 : in_one_place_ + 1;
        last_change_ = now_.t;
        if (in_one_place_ > most_in_one_place)
            return fail(fmt::format("the sign of {} changes without end at t = {}: no side of it is consistent",
                                    system_.names[watched[hit.front()].index], now_.t));
        std::vector<int> open;
        bool gone = false;
        for (const int i : hit) {
            const ModeGuard& w = watched[i];
            if (w.what == ModeGuard::What::normal) return fail_negative(w.index);
            if (w.what == ModeGuard::What::bound) {  // α has reached a bound: the motion leaves to that side
                gone = true;
                if (!sides_.is_pair(w.index)) {
                    sides_[w.index] = w.sign < 0 ? 1 : -1;
                    tell(w.index, ModeChange::Kind::leaving);
                } else if (sides_[w.index] == 0) {  // it may have given way together with one before it
                    for (const int pair : give_way(system_, sides_, w.index, now_.t, now_.state)) {
                        seed(pair);
                        tell(pair, ModeChange::Kind::leaving);
                    }
                }
            } else if (w.what == ModeGuard::What::idle) {
                set_idle(w.index, 0);
                sides_[w.index] = w.sign < 0 ? 1 : -1;
                tell(w.index, ModeChange::Kind::leaving);
            } else if (w.what == ModeGuard::What::smoothing) {
                direct(w.index, 0);
            } else if (w.what == ModeGuard::What::turn && direct(w.index, moment().stopped(w.index))) {
                continue;
            } else if (std::find(open.begin(), open.end(), w.index) == open.end()) {
                open.push_back(w.index);
            }
        }
        if (!open.empty()) open_what_has_stopped(open);
        if (!open.empty() && !gone && come_to_rest(open)) return true;
        if (!open.empty() ||
            (gone && system_.bounds)) {  // a contact that has opened may change the normal forces of others
            for (int k = 0; k < system_.count(); ++k)
                if (sides_[k] == 0 && !(sides_.is_pair(k) && k % 2 == 1)) open.push_back(k);
            if (!choose(open)) return false;
        }
        std::vector<int> decided = open;
        for (const int i : hit) decided.push_back(watched[i].index);
        follow_others(decided);
        return true;
    }

    /// Adds the frictions that slide without a velocity: of the feet of a body that stops as a whole rounding may
    /// have let one go just before, or let it stop just after.
    void open_what_has_stopped(std::vector<int>& open, double times = 1) const {
        SlidingField here(system_, sides_, dimension());
        here.evaluate(now_.t, now_.state.data());
        for (int k = 0; k < system_.count(); k += sides_.is_pair(k) ? 2 : 1) {
            if (!sides_.is_pair(k) && !system_.bounds) continue;  // no friction
            const double speed = sides_.is_pair(k) ? here.velocity(k).norm() : std::abs(here.value(k));
            if (sides_[k] != 0 && std::find(open.begin(), open.end(), k) == open.end() &&
                speed <= times * moment().stopped(k) && (sides_.is_pair(k) || moment().brakes(k)))
                open.push_back(k);
        }
    }

    /// Lets the open functions and those that rest stay zero if they can: where friction stops a mass at the
    /// bottom of a groove |x|, sign(x) and sign(x') have changed ever faster.
    bool come_to_rest(const std::vector<int>& open) {
        const std::vector<int> still = swings_.at_rest(moment(), open, since_change_);
        if (still.empty() || open.size() + still.size() > most_undecided) return false;
        const SideChoice best = side_choices(system_, sides_, open, now_.t, now_.state, still)[0];
        if (!best.is_clear() || !rests(best, open)) return false;
        sides_ = best.sides;
        SlidingField here(system_, sides_, dimension());
        for (const int k : still) here.bring_to_zero(k, now_.t, now_.state.data());
        std::vector<int> all = open;
        all.insert(all.end(), still.begin(), still.end());
        for (const int k : as_declared(std::move(all))) tell(k, ModeChange::Kind::sliding);
        return true;
    }

    /// Rounding decides which of several functions that become zero at once is found first.
    static std::vector<int> as_declared(std::vector<int> functions) {
        std::sort(functions.begin(), functions.end());
        return functions;
    }

    static bool rests(const SideChoice& choice, const std::vector<int>& all) {
        return std::all_of(all.begin(), all.end(), [&](int k) { return choice.sides[k] == 0; });
    }
    bool can_all_rest(const std::vector<int>& all) const {
        if (all.size() > most_undecided) return false;
        const SideChoice best = side_choices(system_, sides_, all, now_.t, now_.state)[0];
        return best.is_clear() && rests(best, all);
    }

    /// Chooses sides for the open functions; the others keep theirs.
    bool choose(const std::vector<int>& open) {
        if (open.empty()) return true;
        const auto all_zeros = [](int) { return true; };
        if (open.size() > most_undecided) {
            if (const auto sides = continuous_sides(moment(), open)) return go_to(*sides, open, all_zeros);
            return fail(
                fmt::format("the signs of {} and {} others change together at t = {}, more than {} at once",
                            system_.names[open.front()], open.size() - 1, now_.t, most_undecided));
        }
        for (const int k : open) set_idle(k, 0);
        if (in_one_place_ > few_in_one_place && rates_are_continuous(moment(), open)) {
            FilippovMode stay = sides_;  // where they are below errors, their signs do not matter
            for (const int k : open) stay[k] = 0;
            return go_to(stay, open, all_zeros);
        }
        const std::vector<SideChoice> found = side_choices(system_, sides_, open, now_.t, now_.state);
        std::string names;
        for (const int k : open) names += (names.empty() ? "" : ", ") + system_.names[k];
        const bool exists = found[0].is_consistent(), is_ambiguous = are_ambiguous(found);
        if (!found[0].is_clear() || is_ambiguous)
            if (const auto sides = continuous_sides(moment(), open)) return go_to(*sides, open, all_zeros);
        if (!exists || !rests(found[0], open)) {
            std::vector<int> more = open;  // one that has stopped, too, may have gathered the errors of many steps
            open_what_has_stopped(more, most_gathered);
            if (more.size() > open.size() && (!exists || can_all_rest(more))) return choose(more);
        }
        if (!exists)
            return fail(
                fmt::format("at t = {} the sign of {} has no consistent side: the equations have no motion "
                            "that goes on from there",
                            now_.t, names));
        if (is_ambiguous)
            return fail(
                fmt::format("at t = {} the motion may go on to either side of {} = 0: the equations do not "
                            "say which; start close to that state instead",
                            now_.t, names));
        return go_to(found[0].sides, open, [this](int k) { return moment().changes_nothing(k); });
    }

    /// Goes to these sides. `changes_nothing(k)` says whether a function that stays at its zero is idle.
    template <typename ChangesNothing>
    bool go_to(const FilippovMode& sides, const std::vector<int>& open, const ChangesNothing& changes_nothing) {
        const FilippovMode before = sides_;
        sides_ = sides;
        if (const auto why = obstacle_behind(before, open)) {
            sides_ = before;
            return fail(*why);
        }
        for (const int k : open)
            if (sides_.is_pair(k) && sides_[k] != 0) seed(k);
        for (const int k : open)
            if (sides_[k] == 0 && !sides_.is_pair(k) && changes_nothing(k)) set_idle(k, moment().idle(k));
        for (const int k : as_declared(open))
            if (before[k] != sides_[k] &&
                (sides_[k] == 0 || !result_.times.empty()))  // at the start it has no side yet
                tell(k, sides_[k] == 0   ? ModeChange::Kind::sliding
                        : before[k] == 0 ? ModeChange::Kind::leaving
                                         : ModeChange::Kind::crossing);
        return true;
    }

    std::optional<std::string> obstacle_behind(const FilippovMode& before, const std::vector<int>& open) const {
        if (!system_.obstacle || result_.times.empty()) return std::nullopt;
        const std::vector<double> rate = rate_here();
        for (const int k : open)
            if (before[k] * sides_[k] < 0)
                if (auto why = system_.obstacle(k, now_.t, now_.state.data(), rate.data())) return why;
        return std::nullopt;
    }

    void set_idle(int k, double up_to) {
        sides_.idle_up_to.resize(sides_.size());
        sides_.idle_up_to[k] = up_to;
    }

    /// Gives a pair that begins to slide its δ (filippov_system.hpp).
    void seed(int pair) {
        double& smoothing = sides_.slides[pair / 2].smoothing;
        smoothing =
            std::max(smoothing, moment().speed(pair) * std::pow(std::max(options_.tolerance, 1e-13), 2.0 / 3));
    }

    void tell(int k, ModeChange::Kind kind) const {
        if (system_.on_change) system_.on_change(change_of(k, kind));
    }

    ModeChange change_of(int k, ModeChange::Kind kind) const {
        ModeChange change{.time = now_.t, .index = k, .kind = kind, .side = sides_[k], .direction = {}};
        if (sides_.is_pair(k) && sides_[k] != 0)
            change.direction = {sides_.slides[k / 2].along, sides_.slides[k / 2].across};
        return change;
    }

    bool fail(const std::string& message) {
        if (result_.times.empty()) {
            result_.times = {now_.t};
            result_.states = now_.state;
            result_.statistics.method = name(options_.method);
        }
        result_.ending = Ending::failed;
        result_.failure =
            Failure{.kind = FailureKind::no_side, .message = message, .time = now_.t, .state = now_.state};
        return false;
    }

    const FilippovSystem& system_;
    const System& abilities_;
    const Options& options_;
    const Events& events_;
    const RunPiece& piece_;
    MotionState now_;
    FilippovMode sides_;
    std::optional<SlidingField> at_ = {};  ///< the sides of now, at the start of the piece and then along it
    std::vector<ModeGuard> watched_ = {};  ///< the guards of the piece
    double grid_ = 0;
    std::shared_ptr<std::vector<double>> sizes_;                              ///< the largest |g_k| so far
    std::shared_ptr<std::vector<double>> normals_;                            ///< the largest normal forces
    std::shared_ptr<double> undefined_ = std::make_shared<double>(HUGE_VAL);  ///< when some g_k was NaN in a piece
    ChatterWatch swings_{sizes_->size()};
    long jumps_ = 0;  ///< in a disturbed run
    int in_one_place_ = 0;
    double last_change_ = -HUGE_VAL,
           since_change_ = HUGE_VAL;  ///< the time of the last change; from it to that before
    std::vector<LastZero> at_zero_;   ///< where the piece begins
    Trajectory result_;
};

}  // namespace

Trajectory integrate(const FilippovSystem& system, const System& abilities, const std::vector<double>& initial,
                     const Options& options, const Events& events, const RunPiece& piece) {
    return SwitchedRun(system, abilities, initial, options, events, piece).go();
}

Trajectory integrate(const FilippovSystem& system, const std::vector<double>& initial, const Options& options,
                     const Events& events) {
    return integrate(system, System{}, initial, options, events);
}

}  // namespace alembert
