// SPDX-License-Identifier: MIT
#include "alembert/ode/event_watch.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/tolerances.hpp"

namespace alembert {
namespace {

constexpr int most_looks = 8;   ///< the most repetitions of the search before an event that stops
constexpr int most_depth = 20;  ///< of halvings of a step
constexpr long most_evaluations = 20'000, for_each_zero = 400;     ///< of a step that is divided
constexpr long most_patience = 2'000, least_patience = 16;         ///< of a step, for what bounds alone demand
const FivePoints of_step({0, 0.23, 0.51, 0.77, 1});                ///< not equidistant: see five_points.hpp
constexpr std::array<double, 4> parts = {0.47, 0.54, 0.52, 0.45};  ///< where the gaps of a piece are divided

/// Orders zeros by time, simultaneous ones as their events are declared.
void order(std::vector<Crossing>& found, const StepView& step) {
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    for (std::size_t i = 1; i < found.size(); ++i)
        for (std::size_t j = i; j > 0 && found[j].index < found[j - 1].index &&
                                found[j].time - found[j - 1].time <= simultaneous(step.start, step.end);
             --j)
            std::swap(found[j], found[j - 1]);
}

}  // namespace

EventWatch::EventWatch(const Events& events, const Rhs& rhs)
    : events_(events),
      rhs_(rhs),
      state_(static_cast<std::size_t>(rhs.dimension)),
      rate_(state_.size()),
      out_(events.list.size()),
      ahead_(state_.size()),
      ahead_rate_(state_.size()),
      open_(most_depth + 1),
      patience_(out_.size(), most_patience),
      left_(out_.size()),
      sign_(out_.size()) {
    for (int k = 0; k < static_cast<int>(out_.size()); ++k) all_.push_back(k);
}

void EventWatch::begin(double t, const double* state, const double* rate) {
    run_start_ = t;
    if (all_.empty()) return;
    used_ = 0;
    length_ = 0;
    Sample& first = samples_[new_sample()];
    std::copy_n(state, state_.size(), first.state.begin());
    std::copy_n(rate, rate_.size(), first.rate.begin());
    events_(t, state, rate, first.value.data());
    std::transform(first.value.begin(), first.value.end(), sign_.begin(), side_of);
}

std::vector<Crossing> EventWatch::look(const StepView& step) {
    if (all_.empty()) return {};
    evaluations_before_ = evaluations_;
    const std::vector<int> sign_before = sign_;
    std::vector<Crossing> found = scan(step);
    if (step.ends_run) look_at_end(step, found);
    const bool is_stopped = std::any_of(found.begin(), found.end(), [&](const Crossing& c) { return stops(c); });
    for (int round = 0; is_stopped && round < most_looks; ++round) {
        sign_ = sign_before;  // the signs at the end of the step do not matter any more, because the run ends here
        if (!look_again(step, found)) break;
    }
    if (is_stopped) return found;
    std::swap(samples_[0], samples_[1]);
    samples_[0].theta = 0;
    length_ = step.end - step.start;
    return found;
}

/// Searches again before the first crossing that stops the run; true if that finds an earlier one that stops.
bool EventWatch::look_again(const StepView& step, std::vector<Crossing>& found) {
    const auto stop = std::find_if(found.begin(), found.end(), [&](const Crossing& c) { return stops(c); });
    const Crossing first = *stop;
    if (first.theta <= 0) return false;
    StepView part{
        .start = step.start,
        .end = first.time,
        .end_state = nullptr,
        .end_rate = nullptr,
        .interpolate = [&](double theta, double* state) { step.interpolate(theta * first.theta, state); }};
    std::vector<double> end_state(state_.size()), end_rate(state_.size());
    part.interpolate(1, end_state.data());
    rhs_(part.end, end_state.data(), end_rate.data());
    ++evaluations_;
    part.end_state = end_state.data();
    part.end_rate = end_rate.data();
    std::vector<Crossing> earlier = scan(part);
    for (Crossing& crossing : earlier) crossing.theta *= first.theta;
    const auto is_same = [&](const Crossing& a, const Crossing& b) {
        return a.index == b.index && std::abs(a.time - b.time) <=
                                         std::max(simultaneous(step.start, step.end), 2 * a.width + 2 * b.width);
    };
    std::erase_if(earlier, [&](Crossing& c) {
        const auto known =
            std::find_if(found.begin(), found.end(), [&](const Crossing& one) { return is_same(one, c); });
        if (known == found.end()) return false;
        c.width = known->width;
        if (known->theta > first.theta) *known = c;  // a touch has begun already
        return true;
    });
    order(found, step);
    if (earlier.empty()) return false;
    found.insert(found.begin(), earlier.begin(), earlier.end());
    order(found, step);
    return std::any_of(earlier.begin(), earlier.end(), [&](const Crossing& c) { return stops(c); });
}

/// Zeros that rounding puts a little beyond the end of the run are at its end.
void EventWatch::look_at_end(const StepView& step, std::vector<Crossing>& found) {
    const double later = ahead(step);
    for (std::size_t n = 0; n < ahead_.size(); ++n) ahead_[n] = step.end_state[n] + later * step.end_rate[n];
    events_(step.end + later, ahead_.data(), step.end_rate, out_.data());
    for (std::size_t k = 0; k < out_.size(); ++k) {
        const double here = samples_[1].value[k], slope = (out_[k] - here) / later;
        const int index = static_cast<int>(k);
        if (here * slope < 0 && std::abs(here) <= uncertain_time(step.end) * std::abs(slope) &&
            std::none_of(found.begin(), found.end(), [&](const Crossing& c) {
                return c.index == index && step.end - c.time <= simultaneous(step.start, step.end);
            }))
            record(step, {.index = index, .theta = 1, .direction = side_of(slope)}, found);
    }
}

/// Leaves the end of the step in the second sample.
std::vector<Crossing> EventWatch::scan(const StepView& step) {
    std::vector<Crossing> found;
    rounding_.clear();
    stop_ = HUGE_VAL;
    left_ = patience_;
    used_ = 1;
    Sample& first = samples_[0];
    if (length_ > 0)
        for (double& slope : first.slope) slope *= (step.end - step.start) / length_;
    length_ = step.end - step.start;
    Sample& last = samples_[new_sample()];
    last.theta = 1;
    std::copy_n(step.end_state, state_.size(), last.state.begin());
    std::copy_n(step.end_rate, rate_.size(), last.rate.begin());
    events_(step.end, step.end_state, step.end_rate, last.value.data());
    Piece whole{0, 2, 3, 4, 1};
    for (std::size_t i = 1; i < 4; ++i) whole[i] = sample_at(step, of_step.places()[i]);
    divide(step, whole, 0, all_, found);
    for (std::size_t k = 0; k < left_.size(); ++k)
        if (left_[k] <= 0) patience_[k] = std::max(least_patience, patience_[k] / 4);
    order(found, step);
    return found;
}

std::size_t EventWatch::new_sample() {
    if (used_ == samples_.size()) {
        const std::vector<double> motion(state_.size()), values(out_.size());
        samples_.push_back({.state = motion, .rate = motion, .value = values, .slope = values});
    }
    samples_[used_].has_slope = false;
    return used_++;
}

std::size_t EventWatch::sample_at(const StepView& step, double theta) {
    const std::size_t number = new_sample();
    Sample& sample = samples_[number];
    const double t = step.start + theta * (step.end - step.start);
    sample.theta = theta;
    step.interpolate(theta, sample.state.data());
    rhs_(t, sample.state.data(), sample.rate.data());
    ++evaluations_;
    events_(t, sample.state.data(), sample.rate.data(), sample.value.data());
    return number;
}

/// The time after a sample at which its slopes are measured.
double EventWatch::ahead(const StepView& step) const {
    return std::max(1e-6 * (step.end - step.start), 64 * tolerance::epsilon * std::abs(step.end));
}

/// The slopes at a sample follow from a difference along the tangent of the motion, on which y' changes as it does
/// from sample to sample; that costs one evaluation of the events.
void EventWatch::find_slopes(const StepView& step, const Piece& piece, const FivePoints& points) {
    const double length = step.end - step.start, later = ahead(step);
    const std::array<const double*, 5> rates = {samples_[piece[0]].rate.data(), samples_[piece[1]].rate.data(),
                                                samples_[piece[2]].rate.data(), samples_[piece[3]].rate.data(),
                                                samples_[piece[4]].rate.data()};
    for (int i = 0; i < 5; ++i) {
        Sample& sample = samples_[piece[static_cast<std::size_t>(i)]];
        if (sample.has_slope) continue;
        sample.has_slope = true;
        const FiveNumbers& factors = points.slope_factors(i);
        for (std::size_t n = 0; n < ahead_.size(); ++n) {
            ahead_[n] = sample.state[n] + later * sample.rate[n];
            double change = 0;
            for (std::size_t j = 0; j < 5; ++j) change += factors[j] * rates[j][n];
            ahead_rate_[n] = sample.rate[n] + later / length * change;
        }
        const double t = step.start + sample.theta * length + later;
        events_(t, ahead_.data(), ahead_rate_.data(), sample.slope.data());
        for (std::size_t k = 0; k < sample.slope.size(); ++k)
            sample.slope[k] = (sample.slope[k] - sample.value[k]) * (length / later);
    }
}

/// Looks at those of `events` which the five samples describe, and divides the piece for the others.
void EventWatch::divide(const StepView& step, const Piece& piece, int depth, const std::vector<int>& events,
                        std::vector<Crossing>& found) {
    const auto theta = [&](std::size_t i) { return samples_[piece[i]].theta; };
    if (theta(0) > stop_ + simultaneous(step.start, step.end) / (step.end - step.start)) return;
    const FivePoints points =
        depth == 0 ? of_step : FivePoints({theta(0), theta(1), theta(2), theta(3), theta(4)});
    const bool is_last =
        depth == most_depth ||
        evaluations_ - evaluations_before_ > most_evaluations + for_each_zero * static_cast<long>(found.size());
    std::vector<int>& open = open_[static_cast<std::size_t>(depth)];
    open.clear();
    for (const int k : events) {
        if (stays_away(step, piece, points, k)) {
            sign_[static_cast<std::size_t>(k)] = side_of(samples_[piece[0]].value[static_cast<std::size_t>(k)]);
            continue;
        }
        find_slopes(step, piece, points);
        if (is_last || shows_all(step, piece, points, k))
            look_at_piece(step, piece, k, found);
        else
            open.push_back(k);
    }
    if (open.empty()) return;
    const std::size_t used = used_;
    for (std::size_t half = 0; half < 4; half += 2) {
        Piece part;
        for (std::size_t i = 0; i < 3; ++i) part[2 * i] = piece[half + i];
        for (std::size_t i = 0; i < 2; ++i)
            part[2 * i + 1] =
                sample_at(step, theta(half + i) + parts[half + i] * (theta(half + i + 1) - theta(half + i)));
        divide(step, part, depth + 1, open, found);
        used_ = used;
    }
}

}  // namespace alembert
