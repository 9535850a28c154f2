// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/hybrid_variation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "alembert/base/error.hpp"
#include "base/language/libraries.hpp"
#include "base/language/say.hpp"
#include "program/event_code.hpp"
#include "program/lower/quick_times.hpp"
#include "simulate/sides.hpp"

namespace alembert {

namespace {

constexpr double at_once = 1e-10;  // of the time
constexpr double unsure = 1e3;     // errors of this many tolerances are reckoned with
constexpr double rounding = 1e-13;

double same_time(double t) {
    return at_once * std::max(1.0, std::abs(t));
}

}  // namespace

bool HybridVariation::is_needed(const Mechanism& m, const Program& program, const std::vector<int>& by) {
    return m.has_kicks() || !m.unilateral.empty() || jumps_along_motion(program, by);
}

HybridVariation::HybridVariation(const Derived& d, const Program& program, std::vector<int> by, const Start& start,
                                 DerivativeWishes wishes)
    : by_(std::move(by)),
      size_(2 * d.mechanism.q.size() + d.mechanism.states.size()),
      first_side_(program.parameters.size()),
      parameters_(start.parameters) {
    if (const std::string why = Saltation::obstacle(d.mechanism); !why.empty()) throw ModelError(why);
    if (jumps_along_motion(program, by_)) {
        if (auto found = switched(program)) switched_ = std::make_shared<const Switched>(std::move(*found));
        if (!switched_ || !d.mechanism.speeds.empty())
            throw ModelError(say(
                "the accelerations jump where the argument of a 'sign' is zero or a table has a corner, and "
                "derivatives with them; write a smooth function in its place, or take interpolation = \"cubic\""));
        parameters_.resize(switched_->program.parameters.size(), 1);
        side_names_ = names_of_sides(program, *switched_);
    }
    auto derivatives = derivatives_of(d, switched_ ? switched_->program : program, wishes);
    if (!derivatives)
        throw ModelError(say("the equations of this scene are too large to be differentiated, or singular"));
    program_ = std::move(derivatives->program);
    saltation_.emplace(d.mechanism, switched_, by_);
}

void HybridVariation::refuse(const std::string& why, double t, const std::vector<double>& y) const {
    throw IntegrationError(say("derivatives along the motion: {}", why), t,
                           {y.begin(), y.begin() + static_cast<std::ptrdiff_t>(size_)});
}

std::vector<double> HybridVariation::rate_at(double t, const std::vector<double>& state) const {
    return Variation<double>(program_, parameters_, by_).rate_at(t, state);
}

bool HybridVariation::jumps_at(const JumpInstant& side, double t, const std::vector<double>& state) const {
    constexpr double same = 1e-9;  // of a rate: |g| and its like have no jump where g is nearly zero
    std::vector<double> turned = parameters_;
    turned[first_side_ + static_cast<std::size_t>(side.index)] *= -1;
    const std::vector<double> f = rate_at(t, state),
                              other = Variation<double>(program_, turned, by_).rate_at(t, state);
    for (std::size_t i = 0; i < size_; ++i)
        if (std::abs(f[i] - other[i]) > same * std::max(1.0, std::abs(f[i]))) return true;
    return false;
}

std::vector<double> HybridVariation::all_at(double t, const std::vector<double>& state) const {
    std::vector<double> all = rate_at(t, state);
    for (const JumpInstant& one : watched()) all.push_back(saltation_->value(one, {t, parameters_}, state).value);
    return all;
}

double HybridVariation::size_of(const Jet<double>& value, const std::vector<double>& state) const {
    double size = 0;
    for (std::size_t i = 0; i < size_; ++i)
        size += std::abs(value.derivative(i)) * std::max(1.0, std::abs(state[i]));
    return size;
}

std::vector<JumpInstant> HybridVariation::watched() const {
    std::vector<JumpInstant> result = saltation_->watched();
    for (std::size_t k = 0; switched_ && k < switched_->functions.size(); ++k)
        result.push_back({.kind = JumpInstant::Kind::side, .index = static_cast<int>(k), .name = side_names_[k]});
    return result;
}

void HybridVariation::begin(const JumpInstants& instants, double t, const std::vector<double>& y,
                            const Wishes& wishes) {
    instants_ = instants.list;
    using Kind = JumpInstant::Kind;
    if (!switched_)  // signs that change no rate where they change
        std::erase_if(instants_,
                      [](const JumpInstant& one) { return one.kind == Kind::side || one.kind == Kind::holding; });
    next_ = 0;
    last_ = {};
    steps_ = evaluations_ = 0;
    const std::vector<double> state(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(size_));
    for (std::size_t k = 0; switched_ && k < switched_->functions.size(); ++k) {
        const JumpInstant side{.kind = JumpInstant::Kind::side, .index = static_cast<int>(k)};
        const double value = saltation_->value(side, {t, parameters_}, state).value;
        const int told = k < instants.sides.size() ? instants.sides[k] : 0;
        parameters_[first_side_ + k] = told != 0 ? told : value < 0 ? -1 : 1;
    }
    const std::vector<double> f = rate_at(t, state);
    for (const JumpInstant& one : watched()) {
        const Jet<double> h = saltation_->value(one, {t, parameters_}, state);
        const double size = size_of(h, state), error = std::max(rounding, wishes.tolerance) * size;
        if (!(std::abs(h.value) <= error)) continue;
        if (one.kind == JumpInstant::Kind::side && !jumps_at(one, t, state)) continue;
        const std::string what = one.kind == JumpInstant::Kind::event    ? say("event '{}'", one.name)
                                 : one.kind == JumpInstant::Kind::impact ? say("the gap of contact '{}'", one.name)
                                                                         : one.name;
        const double speed = saltation_->speed(h, f);
        const auto moves = [&](std::size_t c) {
            const double* const column = y.data() + size_ * (c + 1);
            if (std::abs(saltation_->change(h, column, c)) > rounding * size) return true;
            if (std::abs(speed) > error) return false;
            constexpr double little = 1e-6;
            std::vector<double> beside = state;
            for (std::size_t i = 0; i < size_; ++i) beside[i] += little * column[i];
            const Jet<double> other = saltation_->value(one, {t, parameters_}, beside);
            return std::abs(saltation_->speed(other, rate_at(t, beside)) - speed) > rounding * size;
        };
        bool any = false;
        for (std::size_t c = 0; size_ * (c + 1) < y.size(); ++c) any = any || moves(c);
        if (any)
            refuse(say("{} is at its zero where the motion begins, t = {:.6g}, so that derivatives to both sides "
                       "differ",
                       what, t),
                   t, y);
    }
}

void HybridVariation::go(double from, double until, std::vector<double>& y, const Wishes& wishes) {
    double now = from;
    for (; next_ < instants_.size() && instants_[next_].time <= until; ++next_) {
        const JumpInstant& instant = instants_[next_];
        if (instant.kind == JumpInstant::Kind::closing || instant.kind == JumpInstant::Kind::holding)
            refuse(say("from t = {:.6g} on {} stays at its zero or leaves it, and the equations are others",
                       instant.time, instant.name),
                   instant.time, y);
        integrate_to(now, instant.time, y, wishes);
        now = instant.time;
        if (passes_smoothly(instant, y)) continue;
        if (last_ && instant.time - last_->time <= same_time(instant.time))
            refuse(say("'{}' and '{}' happen at one instant, t = {:.6g}, where derivatives to both sides differ",
                       last_->name, instant.name, instant.time),
                   instant.time, y);
        pass(instant, y, wishes);
        last_ = instant;
    }
    integrate_to(now, until, y, wishes);
}

void HybridVariation::integrate_to(double from, double until, std::vector<double>& y, const Wishes& wishes) {
    if (!(until > from)) return;
    const Variation<double> variation(program_, parameters_, by_);
    const std::size_t columns = y.size() / size_ - 1;
    Rhs both = make_rhs(static_cast<int>(y.size()), [&](double t, const double* x, double* rate) {
        if (wishes.tell) wishes.tell(t);
        variation(t, x, rate, columns);
    });
    both.names = wishes.names;
    JumpWatch jumps(program_, parameters_);
    before_.clear();
    const System system{.rhs = both,
                        .quick_times = wishes.finds_pulses ? quick_times(program_, parameters_, from, until)
                                                           : std::vector<InputTimeScale>(),
                        .quick_places = {quick_places_code(program_, Kinks::watched), parameters_}};
    const Trajectory motion =
        integrate(system, y,
                  {.method = Method::dop853,
                   .start = from,
                   .duration = until - from,
                   .tolerance = wishes.tolerance,
                   .longest_step = wishes.longest_step,
                   .sample = until - from,
                   .budget = wishes.budget,
                   .when_stiff = Method::radau,
                   .on_step = [&](double t, std::span<const double> state, std::span<const double> rate) {
                       jumps(t, state.data());
                       look_for_grazing(t, state, rate, wishes);
                   }});
    steps_ += motion.statistics.steps;
    evaluations_ += motion.statistics.evaluations;
    if (motion.failure)
        throw IntegrationError(
            say("derivatives along the motion: {}", translated_from_library(motion.failure->message)),
            motion.failure->time, motion.failure->state);
    y.assign(motion.final_state().begin(), motion.final_state().end());
}

/// What has next to no speed when it comes to its zero, beside what the speed is within the error of its time.
bool HybridVariation::is_grazed(const JumpInstant& instant, const Saltation::At& at,
                                const std::vector<double>& state, const std::vector<double>& f,
                                double tolerance) const {
    const Jet<double> h = saltation_->value(instant, at, state);
    const double speed = saltation_->speed(h, f);
    if (!(std::abs(speed) > 0) || !std::isfinite(speed)) return true;
    const double error = unsure * std::max(tolerance, rounding) * size_of(h, state) / std::abs(speed),
                 beside = std::max(error, rounding * std::max(1.0, std::abs(at.t)));
    constexpr std::array<int, 2> sides{-1, 1};
    return std::any_of(sides.begin(), sides.end(), [&](int side) {
        std::vector<double> there = state;
        for (std::size_t i = 0; i < size_; ++i) there[i] += side * beside * f[i];
        const Saltation::At then{at.t + side * beside, at.parameters};
        const double other = saltation_->speed(saltation_->value(instant, then, there), rate_at(then.t, there));
        return !(std::abs(std::abs(other) - std::abs(speed)) <= std::abs(speed) / 2);
    });
}

/// A function such as |g|, whose sign changes no rate where it changes: it takes the side to which g goes.
bool HybridVariation::passes_smoothly(const JumpInstant& instant, const std::vector<double>& y) {
    if (instant.kind != JumpInstant::Kind::side) return false;
    const std::vector<double> state(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(size_));
    if (jumps_at(instant, instant.time, state)) return false;
    const Jet<double> g = saltation_->value(instant, {instant.time, parameters_}, state);
    double& side = parameters_[first_side_ + static_cast<std::size_t>(instant.index)];
    const double speed = saltation_->speed(g, rate_at(instant.time, state));
    side = speed > 0 ? 1 : speed < 0 ? -1 : -side;
    return true;
}

void HybridVariation::pass(const JumpInstant& instant, std::vector<double>& y, const Wishes& wishes) {
    const std::vector<double> before(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(size_));
    const double t = instant.time;
    const std::vector<double> f = rate_at(t, before);
    const Saltation::Jump jump = saltation_->jump(instant, {t, parameters_}, before);
    if (is_grazed(instant, {t, parameters_}, before, f, wishes.tolerance))
        refuse(say("'{}' is only grazed at t = {:.6g}: it passes its zero with next to no speed, and there are no "
                   "derivatives beyond",
                   instant.name, t),
               t, before);
    std::vector<double> after;
    for (const Jet<double>& one : jump.after) after.push_back(one.value);
    if (instant.kind == JumpInstant::Kind::side)
        parameters_[first_side_ + static_cast<std::size_t>(instant.index)] *= -1;
    else
        take_sides(t, after);
    saltation_->carry(jump, f, rate_at(t, after), y);
}

/// Of the functions that are clearly on a side: what an event sets may take them to another one.
void HybridVariation::take_sides(double t, const std::vector<double>& state) {
    for (std::size_t k = 0; switched_ && k < switched_->functions.size(); ++k) {
        const Jet<double> g = saltation_->value({.kind = JumpInstant::Kind::side, .index = static_cast<int>(k)},
                                                {t, parameters_}, state);
        if (std::abs(g.value) > unsure * rounding * size_of(g, state))
            parameters_[first_side_ + k] = g.value < 0 ? -1 : 1;
    }
}

/// A value that turns back within a step, so near to its zero that the motion may as well pass it.
void HybridVariation::look_for_grazing(double t, std::span<const double> y, std::span<const double> rate,
                                       const Wishes& wishes) {
    const std::vector<double> state(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(size_)),
        f(rate.begin(), rate.begin() + static_cast<std::ptrdiff_t>(size_));
    const std::vector<JumpInstant> all = watched();
    std::vector<Seen> now;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Jet<double> h = saltation_->value(all[k], {t, parameters_}, state);
        now.push_back({h.value, saltation_->speed(h, f)});
        if (!before_.empty() && before_[k].speed * now[k].speed < 0 && before_[k].value * now[k].value > 0)
            look_between(all[k], t, state, wishes);
    }
    before_ = std::move(now);
    before_time_ = t;
    before_state_ = state;
}

void HybridVariation::look_between(const JumpInstant& instant, double t, const std::vector<double>& state,
                                   const Wishes& wishes) {
    constexpr int most = 40;
    constexpr double beside = 1e-7;  // of the time: how well a zero is known at which a value turns
    const Variation<double> variation(program_, parameters_, by_);
    const Rhs alone = make_rhs(static_cast<int>(size_),
                               [&](double at, const double* x, double* rate) { variation(at, x, rate, 0); });
    double low = before_time_, high = t;
    std::vector<double> from = before_state_;
    const auto seen = [&](double at, const std::vector<double>& x) {
        const Jet<double> h = saltation_->value(instant, {at, parameters_}, x);
        return std::pair(h, saltation_->speed(h, rate_at(at, x)));
    };
    const double sign = seen(low, from).second;
    std::vector<double> nearest = state;
    double nearest_time = t;
    for (int round = 0; round < most && high - low > rounding * std::max(1.0, std::abs(t)); ++round) {
        const double middle = (low + high) / 2;
        const Trajectory motion = integrate(
            alone, from,
            {.start = low, .duration = middle - low, .tolerance = wishes.tolerance, .sample = middle - low});
        if (motion.failure) return;
        nearest.assign(motion.final_state().begin(), motion.final_state().end());
        nearest_time = middle;
        if (seen(middle, nearest).second * sign > 0)
            low = middle, from = nearest;
        else
            high = middle;
    }
    // Where it is passed at this very time, `is_grazed` decides.
    const auto is_passed = [&](const JumpInstant& one) {
        return one.kind == instant.kind && one.index == instant.index &&
               std::abs(one.time - nearest_time) <= beside * std::max(1.0, std::abs(t));
    };
    if ((last_ && is_passed(*last_)) || (next_ < instants_.size() && is_passed(instants_[next_]))) return;
    const Jet<double> h = seen(nearest_time, nearest).first;
    if (std::abs(h.value) > unsure * std::max(wishes.tolerance, rounding) * size_of(h, nearest)) return;
    if (instant.kind == JumpInstant::Kind::side && !jumps_at(instant, nearest_time, nearest)) return;
    refuse(say("'{}' nearly comes to its zero at t = {:.6g} and turns back, so that a motion beside this one may "
               "pass "
               "it",
               instant.name, nearest_time),
           nearest_time, nearest);
}

}  // namespace alembert
