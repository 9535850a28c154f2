// SPDX-License-Identifier: MIT
// Whether five samples of a piece of a step show all that an event does there (event_watch.hpp).
#include <algorithm>
#include <cmath>

#include "alembert/base/tolerances.hpp"
#include "alembert/ode/event_watch.hpp"

namespace alembert {

/// Whether look_at_piece finds all zeros of an event in the piece.
bool EventWatch::shows_all(const StepView& step, const Piece& piece, const FivePoints& points, int index) {
    if (is_flat(step, piece, index)) return true;
    if (!events_.bounds.has(index)) return describes(step, piece, points, index);
    if (is_bounded(step, piece, points, index)) return true;
    if (!describes(step, piece, points, index)) return false;
    const auto k = static_cast<std::size_t>(index);
    double largest = 0;
    for (const std::size_t i : piece)  // what has no value at any of them may have one between
        largest = std::max(largest, std::isnan(samples_[i].value[k]) ? HUGE_VAL : std::abs(samples_[i].value[k]));
    if (!(largest > 64 * rounding(step, index))) return true;
    left_[k] -= 4;
    return left_[k] < 0;
}

namespace {

double product(const FiveNumbers& a, const FiveNumbers& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4];
}

}  // namespace

/// The bounds of an event on some gaps of a piece. All derivatives are with respect to θ.
class EventWatch::BoundsOfPiece {
public:
    BoundsOfPiece(const EventWatch& watch, const StepView& step, const Piece& piece, const FivePoints& points)
        : watch_(watch), step_(step), piece_(piece), points_(points), length_(step.end - step.start) {}

    Bounds operator()(int index, std::size_t gap, std::size_t gaps) {
        gap_ = gap, gaps_ = gaps;
        const FiveNumbers& theta = points_.places();
        const auto of_state = [this](int component) { return state(static_cast<std::size_t>(component)); };
        const auto of_rate = [this](int component) { return rate(static_cast<std::size_t>(component)); };
        const Interval time =
            widened(step_.start + theta[gap] * length_, step_.start + theta[gap + gaps] * length_);
        return watch_.events_.bounds.of(
            index,
            {.time = {time, {length_, length_}, {}}, .state = std::cref(of_state), .rate = std::cref(of_rate)});
    }

private:
    FiveNumbers derivative(const FiveNumbers& y) const {
        FiveNumbers result;
        for (int i = 0; i < 5; ++i) result[static_cast<std::size_t>(i)] = product(points_.slope_factors(i), y);
        return result;
    }

    Interval between(const FiveNumbers& y, const FiveNumbers& slope, double margin) const {
        const FiveNumbers& theta = points_.places();
        const auto in_gap = [&](std::size_t i) {
            return cubic_range(y[i], slope[i], y[i + 1], slope[i + 1], theta[i + 1] - theta[i], margin);
        };
        Interval all = in_gap(gap_);
        for (std::size_t i = gap_ + 1; i < gap_ + gaps_; ++i) all = hull(all, in_gap(i));
        return all;
    }

    FiveNumbers rates(std::size_t component) const {
        FiveNumbers result;
        for (std::size_t i = 0; i < 5; ++i) result[i] = length_ * watch_.samples_[piece_[i]].rate[component];
        return result;
    }

    Bounds state(std::size_t component) const {
        FiveNumbers y;
        for (std::size_t i = 0; i < 5; ++i) y[i] = watch_.samples_[piece_[i]].state[component];
        const FiveNumbers first = rates(component), second = derivative(first), third = derivative(second);
        return {between(y, first, margins[0]), between(first, second, margins[1]),
                between(second, third, margins[2])};
    }

    Bounds rate(std::size_t component) const {
        const FiveNumbers y = rates(component), first = derivative(y), second = derivative(first);
        const auto [low, high] = std::minmax_element(second.begin(), second.end());
        const double more = margins[2] * (*high - *low);
        return (1 / length_) * Bounds{between(y, first, margins[0]), between(first, second, margins[1]),
                                      widened(*low - more, *high + more)};
    }

    static constexpr double margins[] = {0.05, 0.1, 0.25};  ///< of values, first and second derivatives
    const EventWatch& watch_;
    const StepView& step_;
    const Piece& piece_;
    const FivePoints& points_;
    double length_;
    std::size_t gap_ = 0, gaps_ = 0;
};

/// Whether all samples have one sign, and bounds show that the event keeps it; or whether it has no value at all.
bool EventWatch::stays_away(const StepView& step, const Piece& piece, const FivePoints& points, int index) const {
    if (!events_.bounds.has(index)) return false;
    const auto side = [&](std::size_t i) { return side_of(samples_[i].value[static_cast<std::size_t>(index)]); };
    const int first = side(piece[0]);
    const auto is_missing = [&](std::size_t i) {
        return std::isnan(samples_[i].value[static_cast<std::size_t>(index)]);
    };
    if (std::all_of(piece.begin(), piece.end(), is_missing))
        return BoundsOfPiece(*this, step, piece, points)(index, 0, 4).nowhere;
    if (first == 0 || !std::all_of(piece.begin(), piece.end(), [&](std::size_t i) { return side(i) == first; }))
        return false;
    const Interval value = BoundsOfPiece(*this, step, piece, points)(index, 0, 4).value;
    return first > 0 ? value.low > 0 : value.high < 0;
}

/// Whether the bounds of an event show between each two points that it has no zero, or at most one, or at most two
/// as a convex or concave function has.
bool EventWatch::is_bounded(const StepView& step, const Piece& piece, const FivePoints& points, int index) const {
    const auto k = static_cast<std::size_t>(index);
    BoundsOfPiece bounds(*this, step, piece, points);
    for (std::size_t gap = 0; gap < 4; ++gap) {
        const Sample &a = samples_[piece[gap]], &b = samples_[piece[gap + 1]];
        const Bounds g = bounds(index, gap, 1);
        if (std::isnan(a.value[k]) || std::isnan(b.value[k])) {  // where it ends, there may be a zero before
            if (g.nowhere) continue;
            return false;
        }
        const double w = b.theta - a.theta, bend = g.second.size();
        const double beside = std::min(std::abs(a.value[k]), std::abs(b.value[k]));
        const bool same_side = side_of(a.value[k]) * side_of(b.value[k]) > 0;
        if (same_side && (g.value.has_sign() || beside > bend * w * w / 8)) continue;
        if (g.first.has_sign() || g.second.has_sign()) continue;
        if (a.slope[k] * b.slope[k] > 0 && std::abs(a.slope[k] + b.slope[k]) > bend * w) continue;
        return false;
    }
    return true;
}

/// Whether the five samples show all zeros of an event: where it may be zero, the interpolation error is small
/// compared with the values and slopes around that place. An interpolation error that may be rounding says
/// nothing.
bool EventWatch::describes(const StepView& step, const Piece& piece, const FivePoints& points, int index) {
    constexpr double of_values = 0.05, of_slopes = 0.2, beside_zero = 0.2;
    const auto k = static_cast<std::size_t>(index);
    const double width = points.places()[4] - points.places()[0];
    double least = HUGE_VAL, largest = 0, steepest = 0, zero = 0;
    for (std::size_t i = 0; i < 5; ++i) {
        const Sample& sample = samples_[piece[i]];
        g_five_[i] = sample.value[k];
        slope_five_[i] = sample.slope[k];
        least = std::min(least, std::abs(g_five_[i]));
        largest = std::max(largest, std::abs(g_five_[i]));
        steepest = std::max(steepest, std::abs(slope_five_[i]));
        zero += 0 * (g_five_[i] + slope_five_[i]);
    }
    if (zero != 0) return std::all_of(g_five_.begin(), g_five_.end(), [](double g) { return std::isnan(g); });
    const InterpolationError interpolation_error = points.interpolation_error(g_five_, slope_five_);
    double allowed = of_values * largest, allowed_slope = of_slopes * steepest;
    for (std::size_t i = 0; i < 4; ++i) {
        if (side_of(g_five_[i]) * side_of(g_five_[i + 1]) > 0) continue;
        const double beside = std::max(std::abs(g_five_[i]), std::abs(g_five_[i + 1]));
        allowed = std::min(allowed, beside_zero * beside);
        least = 0;
    }
    if (least > 0) {  // away from zero
        allowed = std::max(allowed, least / 2);
        allowed_slope = std::max(allowed_slope, 4 * least / width);
    }
    if (interpolation_error.value <= allowed && interpolation_error.slope <= allowed_slope) return true;
    const double noise = rounding(step, index) * (16 + width * (step.end - step.start) / ahead(step));
    return interpolation_error.value <= allowed + noise &&
           interpolation_error.slope <= allowed_slope + 8 * noise / width;
}

/// Whether all samples are zero but for rounding, which no division of the piece makes clearer.
bool EventWatch::is_flat(const StepView& step, const Piece& piece, int index) {
    const auto k = static_cast<std::size_t>(index);
    double largest = 0;
    int turns = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const double here = samples_[piece[i]].value[k];
        if (std::isnan(here)) return false;
        largest = std::max(largest, std::abs(here));
        turns += i > 0 && side_of(here) != side_of(samples_[piece[i - 1]].value[k]);
    }
    const Sample& middle = samples_[piece[2]];
    if (events_.bounds.has(index)) return largest <= zero_size(step, middle, index);
    return turns > 1 && largest <= noise(step, index, middle.theta, middle.value[k]);
}

/// The most that rounding of the state and of each operation can make of an event at a sample.
double EventWatch::zero_size(const StepView& step, const Sample& sample, int index) {
    constexpr double beyond_doubt = 16;
    if (events_.bounds.has(index)) {
        const auto about = [](double x) { return Bounds{widened(x, x, 2 * tolerance::epsilon), {}, {}}; };
        const auto of_state = [&](int i) { return about(sample.state[static_cast<std::size_t>(i)]); };
        const auto of_rate = [&](int i) { return about(sample.rate[static_cast<std::size_t>(i)]); };
        const Interval value = events_.bounds
                                   .of(index, {.time = about(step.start + sample.theta * (step.end - step.start)),
                                               .state = std::cref(of_state),
                                               .rate = std::cref(of_rate)})
                                   .value;
        if (std::isfinite(value.high - value.low)) return value.high - value.low;
    }
    return beyond_doubt * rounding_at(step, sample)[static_cast<std::size_t>(index)];
}

/// The change of an event's value in the middle of the step by a rounding error in each component of the state.
double EventWatch::rounding(const StepView& step, int index) {
    if (rounding_.empty()) rounding_ = rounding_at(step, samples_[3]);
    return rounding_[static_cast<std::size_t>(index)];
}

/// The same at a sample, of all events.
std::vector<double> EventWatch::rounding_at(const StepView& step, const Sample& sample) {
    const double t = step.start + sample.theta * (step.end - step.start);
    for (std::size_t n = 0; n < ahead_.size(); ++n)
        ahead_[n] = sample.state[n] * (1 + (n % 2 == 0 ? 2 : -2) * tolerance::epsilon);
    rhs_(t, ahead_.data(), ahead_rate_.data());
    ++evaluations_;
    events_(t * (1 + 2 * tolerance::epsilon), ahead_.data(), ahead_rate_.data(), out_.data());
    std::vector<double> result = out_;
    for (std::size_t k = 0; k < result.size(); ++k) {
        result[k] = std::abs(result[k] - sample.value[k]);
        if (std::isnan(result[k])) result[k] = 0;
    }
    return result;
}

}  // namespace alembert
