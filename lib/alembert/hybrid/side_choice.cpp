// SPDX-License-Identifier: MIT
#include "alembert/hybrid/side_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "alembert/hybrid/sliding_field.hpp"
#include "alembert/hybrid/switching_scales.hpp"

namespace alembert {

namespace {

constexpr std::size_t directions = 48;  // tried all around, to find those in which a pair may begin to slide
constexpr int most_places = 60;         // in which a zero is looked for
constexpr int most_turns = 30;          // over several pairs that begin to slide together
constexpr double last_turn = 1e-14;     // a sweep that turns no direction by more was the last one
constexpr double at_bound = 1e-9;       // how near to its bound a share counts as at it, relative to it
constexpr double sticks_surely = 1e-6;  // the margin above which nothing else is tried
constexpr double held_back = 1e-9;      // ġ relative to what it would be alone, if others that stick hold it

/// Changes the sides of a function or of a pair.
void set_side(FilippovMode& sides, int k, int side) {
    sides[static_cast<std::size_t>(k)] = side;
    if (sides.is_pair(k)) sides[static_cast<std::size_t>(k) + 1] = side;
}

struct ValueAt {
    double x, value;
};

/// A zero of a function between two places at which its signs differ, by false position in the Illinois form
/// (Dowell & Jarratt, BIT 11 (1971) 168).
double zero_between(const std::function<double(double)>& function, ValueAt low, ValueAt high) {
    int stays = 0;  // the end that the last place left as it was: -1 the low one, 1 the high one
    for (int n = 0; n < most_places && low.value != 0 && high.value != 0; ++n) {
        double x = (low.x * high.value - high.x * low.value) / (high.value - low.value);
        if (!(x > low.x && x < high.x)) x = (low.x + high.x) / 2;
        if (x == low.x || x == high.x) break;
        const ValueAt middle{x, function(x)};
        const bool is_low = (middle.value > 0) == (low.value > 0);
        (is_low ? low : high) = middle;
        if (stays == (is_low ? 1 : -1)) (is_low ? high : low).value /= 2;
        stays = is_low ? 1 : -1;
    }
    return std::abs(low.value) < std::abs(high.value) ? low.x : high.x;
}

/// δ with which what rounding leaves of a velocity does not reverse the direction.
double least_smoothing(double speed) {
    return std::max(8 * speed, 1e-150);  // δ is not zero, nor is its square
}
/// δ with which a velocity does not change the direction.
double large_smoothing(double speed) {
    return speed > 0 ? 1e15 * speed : 1;
}

/// begin_to_slide for several pairs, whose directions depend on each other.
void begin_to_slide_together(const FilippovSystem& system, FilippovMode& sides, const std::vector<int>& pairs,
                             double t, const std::vector<double>& state) {
    if (pairs.size() == 1) begin_to_slide(system, sides, pairs[0], t, state);
    if (pairs.size() <= 1) return;
    SlidingField at(system, sides, static_cast<int>(state.size()));
    at.evaluate(t, state.data());
    const auto smoothing = [&](int k) -> double& {
        return sides.slides[static_cast<std::size_t>(k / 2)].smoothing;
    };
    for (const int k : pairs) smoothing(k) = large_smoothing(at.velocity(k).norm());
    double turned = 1;
    for (int sweep = 0; sweep < most_turns && turned > last_turn; ++sweep) {
        turned = 0;
        for (const int k : pairs) {
            const FilippovMode::Slide before = sides.slides[static_cast<std::size_t>(k / 2)];
            begin_to_slide(system, sides, k, t, state);
            const FilippovMode::Slide& slide = sides.slides[static_cast<std::size_t>(k / 2)];
            turned = std::max(turned, std::hypot(slide.along - before.along, slide.across - before.across));
            smoothing(k) = large_smoothing(at.velocity(k).norm());
        }
    }
    for (const int k : pairs) smoothing(k) = least_smoothing(at.velocity(k).norm());
}

class SideJudge {
public:
    SideJudge(const FilippovSystem& system, const FilippovMode& sides, const std::vector<int>& open, double t,
              const std::vector<double>& state)
        : system_(system), t_(t), state_(state), stands_(sides.size()) {
        for (const int k : open) stands_[static_cast<std::size_t>(k)] = stands_still(system, sides, k, t, state);
    }

    /// Chooses the directions of pairs that begin to slide.
    void direct(FilippovMode& sides, const std::vector<int>& open) const {
        std::vector<int> pairs;
        for (const int k : open)
            if (sides.is_pair(k) && sides[static_cast<std::size_t>(k)] != 0) pairs.push_back(k);
        begin_to_slide_together(system_, sides, pairs, t_, state_);
    }

    /// How consistent a choice is. In a consistent one every g moves to its chosen side and every α lies between
    /// −1 and 1.
    SideChoice judged(const FilippovMode& sides, const std::vector<int>& open,
                      const std::vector<int>& resting) const {
        SlidingField at(system_, sides, static_cast<int>(state_.size()));
        at.evaluate(t_, state_.data());
        at.find_bounds(t_, state_.data());
        SideChoice choice{.sides = sides, .margin = HUGE_VAL, .jumps = false};
        const auto allow = [&](double margin) {
            choice.margin = std::min(choice.margin, std::isfinite(margin) ? margin : -HUGE_VAL);
        };
        for (const int k : resting) allow(1 - at.share(k) / at.bound(k));
        for (const int k : open) {
            if (sides.is_pair(k)) {
                allow(margin_of_pair(at, k));
                continue;
            }
            FilippovMode one = sides, other = sides;
            for (const int still : resting)
                one[still] = other[still] = 1;  // no σ of theirs changes their own rates
            one[k] = 1;
            other[k] = -1;
            double up = slope_of(one, k), down = slope_of(other, k);
            if (!std::isfinite(up) || !std::isfinite(down)) {  // others that stick cannot hold against a side
                up = slope_alone(sides, k, 1);
                down = slope_alone(sides, k, -1);
            }
            const double size = std::abs(up) + std::abs(down);
            if (size == 0 && !stands_[static_cast<std::size_t>(k)] && size_alone(sides, k) == 0) {
                // Nothing pushes it yet, on either side, as |x'| at the start of a slow push: where it goes later
                // tells.
                const double later = slope_later(one, k), beside = slope_later(other, k);
                if (later * beside > 0) {
                    allow(sides[k] * later > 0 ? 1 : -HUGE_VAL);
                    continue;
                }
            }
            double margin;
            if (size <= held_back * size_alone(sides, k)) {  // others that stick hold it
                allow(sides[k] == 0 ? 1 - at.share(k) / at.bound(k) : 0);
                continue;
            }
            const bool jump = std::abs(up - down) > 1e-9 * size;
            choice.jumps = choice.jumps || jump;
            if (sides[k] != 0)
                margin = size > 0 ? sides[k] * decisive(at, k) / size : 0;
            else if (!jump || up > down)
                margin = -HUGE_VAL;  // there is nothing to slide along, or the motion is repelled from it
            else
                margin = 1 - at.share(k) / at.bound(k);
            if (sides[k] != 0 && jump && up < down && can_stick(sides, k)) margin = -HUGE_VAL;
            allow(margin);
        }
        return choice;
    }

private:
    double margin_of_pair(const SlidingField& at, int k) const {
        if (at.sides()[static_cast<std::size_t>(k)] == 0)
            return at.resists(k) ? 1 - at.share(k) / at.bound(k) : -HUGE_VAL;
        if (can_stick(at.sides(), k)) return -HUGE_VAL;
        FilippovMode back = at.sides();
        FilippovMode::Slide& slide = back.slides[static_cast<std::size_t>(k / 2)];
        const Eigen::Vector2d e(slide.along, slide.across);
        slide = {-e[0], -e[1], slide.smoothing};
        SlidingField other(system_, back, static_cast<int>(state_.size()));
        other.evaluate(t_, state_.data());
        const double size = at.acceleration(k).norm() + other.acceleration(k).norm();
        return size > 0 ? at.acceleration(k).dot(e) / size : -HUGE_VAL;
    }

    /// Friction with a static coefficient above the kinetic one begins to slide only where that is overcome.
    bool can_stick(FilippovMode sides, int k) const {
        if (!system_.bounds) return false;
        set_side(sides, k, 0);
        SlidingField at(system_, sides, static_cast<int>(state_.size()));
        at.evaluate(t_, state_.data());
        at.find_bounds(t_, state_.data());
        return at.bound(k) > 1 && at.share(k) <= at.bound(k);
    }

    double slope_of(const FilippovMode& sides, int k) const {
        SlidingField at(system_, sides, static_cast<int>(state_.size()));
        at.evaluate(t_, state_.data());
        return decisive(at, k);
    }

    /// The same a moment later.
    double slope_later(const FilippovMode& sides, int k) const {
        const double moment = 1e-7 * std::max(1.0, std::abs(t_));
        SlidingField at(system_, sides, static_cast<int>(state_.size()));
        at.evaluate(t_, state_.data());
        std::vector<double> then = state_;
        for (std::size_t i = 0; i < then.size(); ++i) then[i] += moment * at.rate()[i];
        at.evaluate(t_ + moment, then.data());
        return at.slope(k);
    }

    /// The rate that decides to which side a function goes.
    double decisive(const SlidingField& at, int k) const {
        return stands_[static_cast<std::size_t>(k)] ? at.push(k) : at.slope(k);
    }

    /// The decisive rate at a side of the function while nothing else sticks.
    double slope_alone(FilippovMode sides, int k, int side) const {
        for (int& other : sides.of) other = other == 0 ? 1 : other;
        sides[static_cast<std::size_t>(k)] = side;
        return slope_of(sides, k);
    }

    double size_alone(const FilippovMode& sides, int k) const {
        return std::abs(slope_alone(sides, k, -1)) + std::abs(slope_alone(sides, k, 1));
    }

    const FilippovSystem& system_;
    double t_;
    const std::vector<double>& state_;
    std::vector<bool> stands_;  ///< functions of positions that stand still
};

}  // namespace

std::vector<double> FilippovSystem::sigma(const FilippovMode& sides) const {
    std::vector<double> all;
    for (std::size_t c = 0; c < sides.slides.size(); ++c) {
        const bool slides = sides[2 * c] != 0;
        all.push_back(slides ? 1 : 0);
        all.push_back(slides ? sides.slides[c].smoothing : 1);
    }
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const bool of_pair = sides.is_pair(static_cast<int>(k)) && sides[k] != 0;
        const FilippovMode::Slide* const slide = of_pair ? &sides.slides[k / 2] : nullptr;
        all.push_back(slide ? (k % 2 == 0 ? slide->along : slide->across) : sides[k]);
    }
    return all;
}

FilippovMode FilippovSystem::start() const {
    return {.of = std::vector<int>(static_cast<std::size_t>(count()), 1),
            .slides = std::vector<FilippovMode::Slide>(static_cast<std::size_t>(pairs))};
}

double begin_to_slide(const FilippovSystem& system, FilippovMode& sides, int pair, double t,
                      const std::vector<double>& state) {
    FilippovMode::Slide& slide = sides.slides[static_cast<std::size_t>(pair / 2)];
    SlidingField here(system, sides, static_cast<int>(state.size()));
    here.evaluate(t, state.data());
    const double speed = here.velocity(pair).norm();
    double rate = 0;  // v'·d
    const auto across = [&](double angle) {
        slide = {std::cos(angle), std::sin(angle), large_smoothing(speed)};
        SlidingField there(system, sides, static_cast<int>(state.size()));
        there.evaluate(t, state.data());
        const Eigen::Vector2d e(slide.along, slide.across), a = there.acceleration(pair);
        rate = a.dot(e);
        return e[0] * a[1] - e[1] * a[0];
    };
    constexpr double turn = 6.283185307179586476925;
    std::array<double, directions> all;  // each is asked once, so that rounding hides no change of sign
    for (std::size_t i = 0; i < directions; ++i) all[i] = across(turn * static_cast<double>(i) / directions);
    double best = -HUGE_VAL, direction = 0;
    for (std::size_t i = 0; i < directions; ++i) {
        const double low = all[i], high = all[(i + 1) % directions];
        if ((low > 0) == (high > 0)) continue;
        const double width = turn / directions, first = width * static_cast<double>(i);
        const double zero = zero_between(across, {first, low}, {first + width, high});
        across(zero);
        if (rate > best) {
            best = rate;
            direction = zero;
        }
    }
    slide = {std::cos(direction), std::sin(direction), least_smoothing(speed)};
    return best;
}

std::vector<int> give_way(const FilippovSystem& system, FilippovMode& sides, int pair, double t,
                          const std::vector<double>& state) {
    SlidingField at(system, sides, static_cast<int>(state.size()));
    at.evaluate(t, state.data());
    at.find_bounds(t, state.data());
    std::vector<int> pairs;
    bool falls = false;  // whether friction is less once they slide
    for (const int k : at.sliding()) {
        if (!sides.is_pair(k) || k % 2 == 1) continue;
        if (k != pair && !(at.shares_are_free() && at.share(k) >= (1 - at_bound) * at.bound(k))) continue;
        pairs.push_back(k);
        falls = falls || at.bound(k) > 1;
    }
    for (const int k : pairs) {
        set_side(sides, k, 1);
        const Eigen::Vector2d against = Eigen::Vector2d(at.sign(k), at.sign(k + 1)).normalized();
        sides.slides[static_cast<std::size_t>(k / 2)] = {against[0], against[1],
                                                         least_smoothing(at.velocity(k).norm())};
    }
    // Several with equal coefficients begin to slide without a jump, and against the forces that held them.
    if (pairs.size() == 1 || falls) begin_to_slide_together(system, sides, pairs, t, state);
    return pairs;
}

std::vector<SideChoice> side_choices(const FilippovSystem& system, FilippovMode sides,
                                     const std::vector<int>& open, double t, const std::vector<double>& state,
                                     const std::vector<int>& resting) {
    const SideJudge judge(system, sides, open, t, state);
    for (const int k : resting) sides[k] = 0;
    // In a plane what can stick sticks, and no direction of sliding has to be looked for.
    if (std::all_of(open.begin(), open.end(), [&](int k) { return sides.is_pair(k); })) {
        FilippovMode still = sides;
        for (const int k : open) set_side(still, k, 0);
        const SideChoice all_stick = judge.judged(still, open, resting);
        if (all_stick.margin > sticks_surely) return {all_stick};
    }
    std::vector<SideChoice> found;
    std::size_t count = 1;
    for (const int k : open) count *= sides.is_pair(k) ? 2 : 3;
    for (std::size_t code = 0; code < count; ++code) {
        std::size_t rest = code;
        for (const int k : open) {
            const std::size_t kinds = sides.is_pair(k) ? 2 : 3;
            set_side(sides, k, static_cast<int>(rest % kinds) - (kinds == 3 ? 1 : 0));
            rest /= kinds;
        }
        judge.direct(sides, open);
        found.push_back(judge.judged(sides, open, resting));
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const SideChoice& a, const SideChoice& b) { return a.margin > b.margin; });
    return found;
}

bool are_ambiguous(const std::vector<SideChoice>& choices) {
    return choices.size() > 1 && choices[1].is_clear() && choices[0].jumps;
}

std::vector<double> consistent_signs(const FilippovSystem& system, const std::function<double(int k)>& still,
                                     double t, const double* y, int dimension, FilippovMode* found) {
    FilippovMode sides = system.start();
    std::vector<double> none(static_cast<std::size_t>(dimension)), g(system.numbers());
    for (int k = 0; k < system.count(); ++k) {  // a function may contain the signs of those before it
        const auto at = static_cast<std::size_t>(k);
        system.values(t, y, system.sigma(sides).data(), none.data(), g.data());
        if (!sides.is_pair(k)) {
            const bool is_zero = std::abs(g[at]) <= still(k);
            const bool goes =
                is_zero && system.is_positional(k) && !stands_still(system, sides, k, t, {y, y + dimension});
            sides[at] = is_zero && !goes ? 0 : g[goes ? sides.size() + at : at] > 0 ? 1 : -1;
            continue;
        }
        const double speed = std::hypot(g[at], g[at + 1]);
        set_side(sides, k, speed <= std::max(still(k), still(k + 1)) ? 0 : 1);
        if (sides[at] != 0) sides.slides[at / 2] = {g[at] / speed, g[at + 1] / speed, 0};
        ++k;
    }
    if (found) *found = sides;
    for (bool again = true; again;) {
        again = false;
        SlidingField at(system, sides, dimension);
        at.evaluate(t, y);
        at.find_bounds(t, y);
        for (std::size_t i = 0; i < at.sliding().size() && !again; ++i) {
            const int k = at.sliding()[i];
            const double alpha = at.sign(k);
            const bool is_pair = sides.is_pair(k);
            if (is_pair && k % 2 == 1) continue;
            const bool holds = is_pair ? at.resists(k) : at.steepness(i) < 0;
            if (holds && at.share(k) <= at.bound(k) * (1 + 1e-9)) continue;
            set_side(sides, k, is_pair ? 1 : holds ? (alpha > 0 ? 1 : -1) : (at.push(k) < 0 ? -1 : 1));
            if (is_pair) begin_to_slide(system, sides, k, t, {y, y + dimension});
            again = true;
        }
        if (!again) return at.sigma();
    }
    return {};
}

}  // namespace alembert
