// SPDX-License-Identifier: MIT
#include "alembert/switching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "alembert/run.hpp"
#include "alembert/switch_choice.hpp"
#include "alembert/switch_sides.hpp"
#include "alembert/switch_watch.hpp"
#include "alembert/tolerances.hpp"

namespace alembert {

namespace {

constexpr int most_undecided = 6;  // the most signs that may be undecided together, for which 3⁶ choices are tried
constexpr double most_gathered = 1e3;  // times the error of a step, which a motion has gathered at most
constexpr int most_in_one_place = 50;  // the most changes without an advance of time
// Margin within which a choice still counts as consistent, relative to the rates of g on both sides.
constexpr double slack = 1e-9;
constexpr double known = 1e-9;        // components of a state are known to this part of themselves, and times to
constexpr double known_time = 1e-12;  // this part of the run
constexpr double little = 1e-3;  // of what the load would give within the whole run: a sliding velocity before
                                 // anything has slid
// A second consistent choice with at least this margin makes the motion ambiguous.
constexpr double clear_margin = 1e-6;

class SwitchedRun {
public:
    SwitchedRun(const Switching& system, const std::vector<double>& initial, const Options& options,
                const Events& events)
        : system_(system),
          options_(options),
          events_(events),
          end_(options.start + options.duration),
          t_(options.start),
          state_(initial),
          sizes_(std::make_shared<std::vector<double>>(static_cast<std::size_t>(system.count()))),
          normals_(std::make_shared<std::vector<double>>(static_cast<std::size_t>(system.count()))) {}

    Trajectory go() {
        if (begin())
            while (piece()) {
            }
        return std::move(result_);
    }

private:
    int dimension() const { return static_cast<int>(state_.size()); }

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
                if (k % 2 == 1 && !direct(k - 1, still(k - 1))) open.push_back(k - 1);
            } else if (g == 0)
                open.push_back(k);
            else
                sides_[k] = g > 0 ? 1 : -1;
        }
        result_.dimension = dimension();
        if (is_defined && (options_.duration == 0 || choose(open))) return true;
        if (!is_defined) fail_undefined();
        return false;
    }

    double value_of(int k) const {
        SwitchSides here(system_, sides_, dimension());
        here.evaluate(t_, state_.data());
        return here.value(k);
    }

    /// |g| of a function, or of both of a pair.
    double length(const std::vector<double>& g, int k) const {
        return sides_.is_pair(k) ? std::hypot(g[k], g[k + 1]) : std::abs(g[k]);
    }

    /// Σ |∂g/∂y_i| size(y_i): how far a sliding velocity is off where the components of the state are off by these
    /// sizes.
    template <typename Size>
    double moved(int k, const Size& size) const {
        const std::vector<double> none(state_.size()), sigma = system_.sigma(sides_);
        std::vector<double> y = state_, here(2 * sides_.size()), there = here;
        system_.values(t_, y.data(), sigma.data(), none.data(), here.data());
        double sum = 0;
        for (std::size_t i = 0; i < y.size(); ++i) {
            const double off = size(y[i]), kept = y[i];
            if (off == 0) continue;
            y[i] += std::max(off, std::sqrt(tolerance::epsilon) * std::abs(kept));
            const double step = y[i] - kept;
            system_.values(t_, y.data(), sigma.data(), none.data(), there.data());
            for (std::size_t j = 0; j < there.size(); ++j) there[j] -= here[j];
            sum += length(there, k) * off / step;
            y[i] = kept;
        }
        return sum;
    }

    /// The sliding velocity that rounding may leave of none.
    double still(int k) const {
        return 4 * tolerance::epsilon * length(*sizes_, k) +
               moved(k, [](double y) { return 4 * tolerance::epsilon * std::abs(y); });
    }

    /// How far the k-th normal force is uncertain because the state and the time are.
    double uncertain_normal(const SwitchSides& now, int k) const {
        SwitchSides other(system_, sides_, dimension());
        std::vector<double> y = state_;
        const auto change = [&](double t) {
            other.evaluate(t, y.data());
            other.find_bounds(t, y.data());
            return std::abs(other.normal(k) - now.normal(k));
        };
        double sum = 0;
        for (double& x : y) {
            const double kept = x;
            x += std::sqrt(tolerance::epsilon) * std::abs(kept);
            if (x != kept) sum += known * std::abs(kept) / (x - kept) * change(t_);
            x = kept;
        }
        const double later = t_ + std::sqrt(tolerance::epsilon) * std::max(std::abs(t_), options_.duration);
        return sum + known_time * std::max(std::abs(t_), options_.duration) / (later - t_) * change(later);
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
        fail(fmt::format("a function whose sign is needed is not a number at t = {}", t_));
        result_.failure->kind = FailureKind::not_a_number;
        return false;
    }

    bool fail_negative(int k) { return fail(system_.refusal(k, t_, state_.data())); }

    /// Integrates until a sign changes; true if the motion goes on after that.
    bool piece() {
        SwitchSides now(system_, sides_, dimension());
        now.evaluate(t_, state_.data());
        now.find_bounds(t_, state_.data());
        for (int k = 0; k < system_.count(); ++k) {
            (*normals_)[k] = std::max((*normals_)[k], std::abs(now.normal(k)));
            if (now.normal(k) < -std::max(clear_margin * (*normals_)[k], uncertain_normal(now, k)))
                return fail_negative(k);
            if (sides_[k] != 0) (*sizes_)[k] = std::max((*sizes_)[k], std::abs(now.value(k)));
        }
        *undefined_ = HUGE_VAL;
        const std::vector<Watched> watched = watches(now, {t_, end_}, *sizes_);
        const std::size_t scene = events_.list.size();
        Options here = options_;
        here.start = t_;
        here.duration = end_ - t_ > 16 * tolerance::epsilon * std::abs(end_) ? end_ - t_ : 0;
        here.sample = sample_interval(options_);
        here.grid = options_.grid.value_or(options_.start);
        here.budget = std::max(1L, options_.budget - result_.statistics.evaluations);
        here.rhs_when_stiff = {};
        if (!now.sliding().empty() && needs_series(here.method)) here.method = Method::verner98;
        const auto has_grain = [](const SideSet::Slide& slide) { return slide.grain > 0; };
        if (std::any_of(sides_.slides.begin(), sides_.slides.end(), has_grain))
            here.when_stiff = {};  // the piece is short, and only its beginning is stiff
        if (!now.sliding().empty())
            here.project = [base = options_.project, sides = std::make_shared<SwitchSides>(
                                                         system_, sides_, dimension())](double t, double* y) {
                if (base) base(t, y);
                sides->bring_back(t, y);
            };
        here.on_step = [&](double t, std::span<const double> y, std::span<const double> rate) {
            if (system_.before_step) {
                if (!now.sliding().empty()) now.evaluate(t, y.data());
                system_.before_step(now.sigma());
            }
            if (options_.on_step) options_.on_step(t, y, rate);
        };
        Trajectory motion = integrate(right_hand_side(), state_, here, with_watches(watched));
        std::erase_if(motion.events, [&](const EventRecord& e) { return e.index >= static_cast<int>(scene); });
        const std::vector<LastZero> zeros = motion.last_zeros;
        std::erase_if(motion.last_zeros, [&](const LastZero& z) { return z.event >= static_cast<int>(scene); });
        join(std::move(motion), here);
        t_ = result_.times.back();
        const auto last = result_.final_state();
        state_.assign(last.begin(), last.end());
        if (result_.ending != Ending::stopped_by_event) return false;
        const auto stops = [&](const LastZero& z) {
            return z.event < static_cast<int>(scene) && z.counts && events_.list[z.event].stop;
        };
        if (std::any_of(zeros.begin(), zeros.end(), stops)) return false;
        result_.ending = Ending::completed;
        std::vector<int> hit;
        for (const LastZero& zero : zeros)
            if (zero.event >= static_cast<int>(scene)) hit.push_back(zero.event - static_cast<int>(scene));
        return pass(watched, hit);
    }

    Rhs right_hand_side() const {
        if (std::find(sides_.of.begin(), sides_.of.end(), 0) == sides_.of.end())
            return system_.smooth(system_.sigma(sides_));
        const Rhs any = system_.smooth(system_.sigma(system_.start()));
        auto sides = std::make_shared<SwitchSides>(system_, sides_, dimension());
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

    Events with_watches(const std::vector<Watched>& watched) const {
        std::vector<Event> list = events_.list;
        for (const Watched& w : watched)
            list.push_back({.name = system_.names[w.index], .stop = true, .at_once = true, .direction = -1});
        auto sides = std::make_shared<SwitchSides>(system_, sides_, dimension());
        const auto values = [this, watched, sides, undefined = undefined_, sizes = sizes_, normals = normals_](
                                double t, const double* y, const double* rate, double* out) {
            if (!events_.list.empty()) events_(t, y, rate, out);
            sides->evaluate(t, y);
            sides->find_bounds(t, y);
            for (std::size_t k = 0; k < sizes->size(); ++k) {
                (*sizes)[k] = std::max((*sizes)[k], std::abs(sides->value(static_cast<int>(k))));
                (*normals)[k] = std::max((*normals)[k], std::abs(sides->normal(static_cast<int>(k))));
            }
            for (std::size_t i = 0; i < watched.size(); ++i) {
                const Watched& w = watched[i];
                double& value = out[events_.list.size() + i];
                value = watched_value(w, *sides, *normals);
                if (t <= w.open_until) value = std::max(value, std::numeric_limits<double>::min());
                if (!std::isnan(value)) continue;
                *undefined = std::min(*undefined, t);  // the run ends there if it comes so far
                value = -1;
            }
        };
        return make_events(std::move(list), values);
    }

    /// Decides how the motion goes on where the functions watched at `hit` have reached zero.
    bool pass(const std::vector<Watched>& watched, const std::vector<int>& hit) {
        // A step may reach beyond the zero that ends it, to where another value is undefined.
        if (*undefined_ <= t_ + 1e-12 * std::max(std::abs(t_), options_.duration)) return fail_undefined();
        since_change_ = t_ - last_change_;
        in_one_place_ = since_change_ > 1e-13 * std::max(std::abs(t_), options_.duration) ? 0 : in_one_place_ + 1;
        last_change_ = t_;
        if (in_one_place_ > most_in_one_place)
            return fail(fmt::format("the sign of {} changes without end at t = {}: no side of it is consistent",
                                    system_.names[watched[hit.front()].index], t_));
        std::vector<int> open;
        bool gone = false;
        for (const int i : hit) {
            const Watched& w = watched[i];
            if (w.what == Watched::What::normal) return fail_negative(w.index);
            if (w.what == Watched::What::bound) {  // α has reached a bound: the motion leaves to that side
                gone = true;
                if (!sides_.is_pair(w.index)) {
                    sides_[w.index] = w.sign < 0 ? 1 : -1;
                    tell(w.index, SideChange::Kind::leaving);
                } else if (sides_[w.index] == 0) {  // it may have given way together with one before it
                    for (const int pair : give_way(system_, sides_, w.index, t_, state_)) {
                        seed(pair);
                        tell(pair, SideChange::Kind::leaving);
                    }
                }
            } else if (w.what == Watched::What::grain) {
                direct(w.index, 0);
            } else if (w.what == Watched::What::turn && direct(w.index, stopped(w.index))) {
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
        SwitchSides here(system_, sides_, dimension());
        here.evaluate(t_, state_.data());
        for (int k = 0; k < system_.count(); k += sides_.is_pair(k) ? 2 : 1) {
            if (!sides_.is_pair(k) && !system_.bounds) continue;  // no friction
            const double speed = sides_.is_pair(k) ? here.velocity(k).norm() : std::abs(here.value(k));
            if (sides_[k] != 0 && std::find(open.begin(), open.end(), k) == open.end() &&
                speed <= times * stopped(k) && (sides_.is_pair(k) || brakes(k)))
                open.push_back(k);
        }
    }

    /// Whether the sign of a function changes its own rate, as that of a sliding velocity does.
    bool brakes(int k) const {
        double slopes[2];
        for (const int side : {0, 1}) {
            SideSet sides = sides_;
            sides[k] = 2 * side - 1;
            SwitchSides at(system_, sides, dimension());
            at.evaluate(t_, state_.data());
            slopes[side] = at.slope(k);
        }
        return std::abs(slopes[1] - slopes[0]) > slack * (std::abs(slopes[0]) + std::abs(slopes[1]));
    }

    /// Functions that the tolerance does not tell from zero, or that do not come nearer to it from one change to
    /// the next, and that do not move either.
    std::vector<int> resting(const std::vector<int>& open) {
        SwitchSides here(system_, sides_, dimension());
        here.evaluate(t_, state_.data());
        std::vector<int> found;
        for (int k = 0; k < system_.count(); ++k) {
            if (sides_[k] == 0 || sides_.is_pair(k) || std::find(open.begin(), open.end(), k) != open.end())
                continue;
            const double size = std::abs(here.value(k));
            Swing& swing = swings_[static_cast<std::size_t>(k)];
            swing.most = std::max(swing.most, size);
            swing.rounds = size < 0.99 * swing.least ? 0 : swing.rounds + 1;
            swing.least = std::min(swing.least, size);
            const double little = std::max(options_.tolerance, 256 * tolerance::epsilon) * swing.most;
            const bool is_over = size <= little || (size <= 1e-6 * swing.most && swing.rounds >= 8);
            if (is_over && std::abs(here.slope(k)) * since_change_ <= size + little) found.push_back(k);
        }
        return found;
    }

    /// Lets the open functions and those that rest stay zero if they can: where friction stops a mass at the
    /// bottom of a groove |x|, sign(x) and sign(x') have changed ever faster.
    bool come_to_rest(const std::vector<int>& open) {
        const std::vector<int> still = resting(open);
        if (still.empty() || open.size() + still.size() > most_undecided) return false;
        const SideChoice best = side_choices(system_, sides_, open, t_, state_, still)[0];
        const auto moves = [&](int k) { return best.sides[k] != 0; };
        if (!(best.margin > clear_margin) || std::any_of(open.begin(), open.end(), moves)) return false;
        sides_ = best.sides;
        for (const int k : still) bring_to_zero(k);
        for (const auto* list : {&open, &still})
            for (const int k : *list) tell(k, SideChange::Kind::sliding);
        return true;
    }

    /// Moves the state to g = 0 along the gradient of g, which is found by differences.
    void bring_to_zero(int k) {
        const double g = value_of(k);
        std::vector<double> gradient(state_.size());
        double square = 0;
        for (std::size_t i = 0; i < state_.size(); ++i) {
            const double y = state_[i], step = 1e-7 * std::max(1.0, std::abs(y));
            state_[i] = y + step;
            gradient[i] = (value_of(k) - g) / step;
            square += gradient[i] * gradient[i];
            state_[i] = y;
        }
        if (square > 0)
            for (std::size_t i = 0; i < state_.size(); ++i) state_[i] -= g * gradient[i] / square;
    }

    /// Chooses sides for the open functions; the others keep theirs.
    bool choose(const std::vector<int>& open) {
        if (open.empty()) return true;
        if (open.size() > most_undecided)
            return fail(
                fmt::format("the signs of {} and {} others change together at t = {}, more than {} at once",
                            system_.names[open.front()], open.size() - 1, t_, most_undecided));
        const std::vector<SideChoice> found = side_choices(system_, sides_, open, t_, state_);
        std::string names;
        for (const int k : open) names += (names.empty() ? "" : ", ") + system_.names[k];
        if (!(found[0].margin > -slack)) {
            std::vector<int> more = open;  // one that has stopped, too, may have gathered the errors of many steps
            open_what_has_stopped(more, most_gathered);
            if (more.size() > open.size()) return choose(more);
            return fail(
                fmt::format("at t = {} the sign of {} has no consistent side: the equations have no motion "
                            "that goes on from there",
                            t_, names));
        }
        if (found.size() > 1 && found[1].margin > clear_margin && found[0].jumps)
            return fail(
                fmt::format("at t = {} the motion may go on to either side of {} = 0: the equations do not "
                            "say which; start close to that state instead",
                            t_, names));
        const SideSet before = sides_;
        sides_ = found[0].sides;
        for (const int k : open)
            if (sides_.is_pair(k) && sides_[k] != 0) seed(k);
        for (const int k : open)
            if (before[k] != sides_[k] &&
                (sides_[k] == 0 || !result_.times.empty()))  // at the start it has no side yet
                tell(k, sides_[k] == 0   ? SideChange::Kind::sliding
                        : before[k] == 0 ? SideChange::Kind::leaving
                                         : SideChange::Kind::crossing);
        return true;
    }

    /// Gives a pair that begins to slide its δ (switching.hpp).
    void seed(int pair) {
        double& grain = sides_.slides[pair / 2].grain;
        grain = std::max(grain, speed(pair) * std::pow(std::max(options_.tolerance, 1e-13), 2.0 / 3));
    }

    /// The size of sliding velocities: the largest so far. Before anything has slid, that to which the load would
    /// bring the pair without friction in a small part of the run.
    double speed(int pair) const {
        double largest = system_.speed;
        for (int k = 0; sides_.is_pair(k); ++k) largest = std::max(largest, (*sizes_)[k]);
        if (system_.speed > 0) return largest;
        SideSet held = sides_;
        held[pair] = held[pair + 1] = 0;
        const std::vector<double> sigma = system_.sigma(held);  // α = 0
        std::vector<double> rate(state_.size()), g(2 * sides_.size());
        system_.rates(t_, state_.data(), sigma.data(), rate.data());
        system_.values(t_, state_.data(), sigma.data(), rate.data(), g.data());
        const std::size_t slope = sides_.size() + static_cast<std::size_t>(pair);
        return std::max(largest, little * options_.duration * std::hypot(g[slope], g[slope + 1]));
    }

    /// The sliding velocity below which a friction counts as having stopped: what the tolerance leaves of none.
    /// Steps hold the error of a component y below it times max(1, |y|), and a body hands errors on from one of
    /// its feet to the others.
    double stopped(int k) const {
        const double least = std::max(options_.tolerance, 1e-13);
        double largest = (*sizes_)[k];
        for (int other = 0; sides_.is_pair(k) && sides_.is_pair(other); ++other)
            largest = std::max(largest, (*sizes_)[other]);
        return least * largest + moved(k, [&](double y) { return least * std::max(1.0, std::abs(y)); }) + still(k);
    }

    void tell(int k, SideChange::Kind kind) const {
        if (!system_.on_change) return;
        SideChange change{.time = t_, .index = k, .kind = kind, .side = sides_[k], .direction = {}};
        if (sides_.is_pair(k) && sides_[k] != 0)
            change.direction = {sides_.slides[k / 2].along, sides_.slides[k / 2].across};
        system_.on_change(change);
    }

    bool fail(const std::string& message) {
        if (result_.times.empty()) {
            result_.times = {t_};
            result_.states = state_;
            result_.statistics.method = name(options_.method);
        }
        result_.ending = Ending::failed;
        result_.failure = Failure{.kind = FailureKind::no_side, .message = message, .time = t_, .state = state_};
        return false;
    }

    void join(Trajectory next, const Options& here) {
        const bool first = result_.times.empty();
        if (first) {
            result_ = std::move(next);
            return;
        }
        append(result_, std::move(next), *here.grid, here.sample);
    }

    const Switching& system_;
    const Options& options_;
    const Events& events_;
    double end_, t_;
    std::vector<double> state_;
    SideSet sides_;
    std::shared_ptr<std::vector<double>> sizes_;                              ///< the largest |g_k| so far
    std::shared_ptr<std::vector<double>> normals_;                            ///< the largest normal forces
    std::shared_ptr<double> undefined_ = std::make_shared<double>(HUGE_VAL);  ///< when some g_k was NaN in a piece
    /// How far a function is from zero where others change their signs: at most, at least, and since how many
    /// changes that has not become less.
    struct Swing {
        double most = 0, least = HUGE_VAL;
        int rounds = 0;
    };
    std::vector<Swing> swings_{sizes_->size()};
    int in_one_place_ = 0;
    double last_change_ = -HUGE_VAL,
           since_change_ = HUGE_VAL;  ///< the time of the last change; from it to that before
    Trajectory result_;
};

}  // namespace

Trajectory integrate(const Switching& system, const std::vector<double>& initial, const Options& options,
                     const Events& events) {
    return SwitchedRun(system, initial, options, events).go();
}

}  // namespace alembert
