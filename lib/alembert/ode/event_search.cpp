// SPDX-License-Identifier: MIT
// The search for zeros of one event in a piece of a step (event_watch.hpp).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "alembert/base/tolerances.hpp"
#include "alembert/ode/event_watch.hpp"

namespace alembert {
namespace {

constexpr double bend = 2;  ///< a function that approaches zero may later fall this many times as steeply
constexpr double no_place = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double EventWatch::value(const StepView& step, int index, double theta) {
    const double t = step.start + theta * (step.end - step.start);
    step.interpolate(theta, state_.data());
    rhs_(t, state_.data(), rate_.data());
    ++evaluations_;
    events_(t, state_.data(), rate_.data(), out_.data());
    return out_[static_cast<std::size_t>(index)];
}

/// Goes through the points of the piece and the turning points between them and records where the sign changes.
/// Values that are zero to rounding are zero, so that rounding makes two zeros of none. Points where the event is
/// not a number are skipped.
void EventWatch::look_at_piece(const StepView& step, const Piece& piece, int index, std::vector<Crossing>& found) {
    const auto k = static_cast<std::size_t>(index);
    theta_.clear();
    g_.clear();
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const Sample& sample = samples_[piece[i]];
        theta_.push_back(sample.theta);
        g_.push_back(sample.value[k]);
        slope_five_[i] = sample.slope[k];
    }
    band_ = NAN;
    middle_ = piece[2];
    set_zeros(step, index, is_flat(step, piece, index));
    width_.assign(g_.size(), 0);
    for (const Turn& turn : turning_points(step, index)) {
        const auto after = std::upper_bound(theta_.begin(), theta_.end(), turn.theta);
        const auto place = after - theta_.begin();
        g_.insert(g_.begin() + place, turn.value);
        width_.insert(width_.begin() + place, turn.width);
        theta_.insert(after, turn.theta);
    }
    int& last_sign = sign_[k];
    if (g_[0] == 0 && piece[0] == 0 && step.start == run_start_ && !events_.list[k].at_once) last_sign = 0;
    std::size_t left = 0;
    for (std::size_t i = 1; i < g_.size(); ++i) {
        if (std::isnan(g_[i])) continue;
        const int now = side_of(g_[i]);
        if (now == 0 && last_sign != 0 && g_[left] != 0) {
            record(step, {.index = index, .theta = theta_[i], .direction = -last_sign, .width = width_[i]}, found);
            last_sign = 0;
        } else if (now != 0) {
            if (last_sign * now < 0) {
                const double theta = locate(step, index, {theta_[left], g_[left], theta_[i], g_[i]});
                record(step, {.index = index, .theta = theta, .direction = now}, found);
            }
            last_sign = now;
        }
        left = i;
    }
}

/// Values at points of the piece that are zero to rounding become zero, where bounds tell how large rounding is.
void EventWatch::set_zeros(const StepView& step, int index, bool is_flat) {
    largest_ = 0;
    for (const double g : g_) largest_ = std::max(largest_, std::isnan(g) ? 0 : std::abs(g));
    if (is_flat) std::fill(g_.begin(), g_.end(), 0);
    if (!events_.bounds.has(index)) return;
    for (double& g : g_)
        if (std::abs(g) <= band(step, index)) g = 0;
}

/// Values up to this size are zero in the piece.
double EventWatch::band(const StepView& step, int index) {
    constexpr double of_terms = 4;
    if (std::isnan(band_))
        band_ = std::max(zero_size(step, samples_[middle_], index), of_terms * tolerance::epsilon * largest_);
    return band_;
}

/// The time of a zero, and whether it counts, follow from the rest.
void EventWatch::record(const StepView& step, Crossing zero, std::vector<Crossing>& found) {
    if (std::isnan(zero.theta)) return;
    const double length = step.end - step.start;
    zero.time = zero.theta == 1 ? step.end : step.start + zero.theta * length;
    zero.width *= length;
    const Event& event = events_.list[static_cast<std::size_t>(zero.index)];
    if (!event.at_once && zero.time - run_start_ <= simultaneous(step.start, step.end)) return;
    zero.counts = event.direction == 0 || event.direction == zero.direction;
    found.push_back(zero);
    if (stops(found.back())) stop_ = std::min(stop_, zero.theta);
}

/// The places between points of the same sign at which g has the other sign, or touches zero.
std::vector<EventWatch::Turn> EventWatch::turning_points(const StepView& step, int index) {
    const std::size_t points = theta_.size();
    std::vector<Turn> found;
    const auto add = [&](const Turn& turn) {
        if (!std::isnan(turn.theta)) found.push_back(turn);
        return !std::isnan(turn.theta);
    };
    for (std::size_t i = 0; i + 1 < points; ++i) add(turns_between(step, index, i));
    if (!found.empty()) return found;
    add(at_the_end(step, index, 0, 1));
    for (std::size_t i = 0; i + 2 < points; ++i)
        if (add(between(step, index, &theta_[i], &g_[i]))) ++i;
    add(at_the_end(step, index, points - 1, points - 2));
    return found;
}

/// Between two neighbouring points of the same sign: does g fall towards zero from both, so steeply that the
/// tangents, below which no function that is convex towards zero lies, meet on the other side?
EventWatch::Turn EventWatch::turns_between(const StepView& step, int index, std::size_t left) {
    const int side = side_of(g_[left]);
    const double a = side * g_[left], b = side * g_[left + 1], width = theta_[left + 1] - theta_[left];
    const double fall = -side * slope_five_[left], rise = side * slope_five_[left + 1];
    if (side == 0 || !(b > 0) || !(fall > 0) || !(rise > 0)) return {};
    const double share =
        (a - b + rise * width) / ((fall + rise) * width);  // of the width, where the tangents meet
    const double meet = a - fall * std::clamp(share, 0.0, 1.0) * width;
    constexpr double may_be_zero = 1e-6;  // of the values beside: only then the band is worth an evaluation
    if (!(meet <= 0) && !(meet < may_be_zero * std::max(a, b) && meet <= band(step, index))) return {};
    return lowest(step, index, {theta_[left], g_[left], theta_[left + 1], g_[left + 1]},
                  theta_[left] + std::clamp(share, 0.1, 0.9) * width);
}

/// Whether the piece is so short that only a kink, a jump or a pole can be the reason.
bool EventWatch::is_near_kink(const StepView& step) const {
    return (theta_.back() - theta_.front()) * (step.end - step.start) < 16 * ahead(step);
}

/// Between the two points of a gap, `from` being an end of the piece: does g approach zero from there steeply
/// enough, and come back?
EventWatch::Turn EventWatch::at_the_end(const StepView& step, int index, std::size_t from, std::size_t to) {
    const int side = side_of(g_[from]);
    if (side == 0 || side_of(g_[to]) != side || side * g_[to] < side * g_[from]) return {};
    const double a = theta_[from], b = theta_[to], outside = 2 * a - b;
    double slope = slope_five_[from];
    if (is_near_kink(step) && outside >= 0 && outside <= 1)  // slopes are differences that may go beyond the kink
        slope = (g_[from] - value(step, index, outside)) / (a - outside);
    if (side * g_[from] + bend * side * slope * (b - a) >= 0) return {};
    return lowest(step, index, from < to ? Bracket{a, g_[from], b, g_[to]} : Bracket{b, g_[to], a, g_[from]},
                  (a + b) / 2);
}

/// For three neighbouring points of the same sign: a place between them where g has the other sign, or is zero. It
/// is searched for where g is nearest to zero, and only if a parabola through the points comes near zero or a line
/// through two of them meets zero before the third.
EventWatch::Turn EventWatch::between(const StepView& step, int index, const double* theta, const double* g) {
    const int side = side_of(g[1]);
    if (side == 0 || side_of(g[0]) * side < 0 || side_of(g[2]) != side) return {};
    const double before = (g[1] - g[0]) / (theta[1] - theta[0]), after = (g[2] - g[1]) / (theta[2] - theta[1]);
    const double half_curvature = (after - before) / (theta[2] - theta[0]);
    const double slope = before + half_curvature * (theta[1] - theta[0]);
    const double vertex = theta[1] - slope / (2 * half_curvature);
    if (!(half_curvature * side > 0) || vertex <= theta[0] || vertex >= theta[2]) return {};
    const double parabola = side * (g[1] - slope * slope / (4 * half_curvature));
    const double nearest = std::min({side * g[0], side * g[1], side * g[2]}),
                 farthest = std::max(side * g[0], side * g[2]);
    const bool turns_back =
        side * g[1] < side * g[0] && side * g[1] < side * g[2] && side * g[1] < bend * (farthest - side * g[1]);
    if (parabola > nearest / 2 && !turns_back) return {};
    return lowest(step, index, {theta[0], g[0], theta[2], g[2]}, vertex);
}

/// Golden-section search for the place where g is nearest to zero, until g has the other sign there. It ends
/// without a place as soon as the values show that no function convex towards zero can have one.
EventWatch::Turn EventWatch::lowest(const StepView& step, int index, const Bracket& of, double middle) {
    auto [left, g_left, right, g_right] = of;
    constexpr double golden = 0.6180339887498949;
    constexpr int enough = 4, usual = 40, most = 80;
    constexpr double next_to_zero = 1e-11;  // of the values beside: only what comes so near may touch zero
    const int side = side_of(g_right);
    g_left *= side, g_right *= side;
    const double near = next_to_zero * std::max(g_left, g_right);
    double a = middle, g_a = side * value(step, index, a);
    for (int i = 0; i < most && g_a > 0; ++i) {
        const double fall = (g_left - g_a) / (a - left), rise = (g_right - g_a) / (right - a);
        if (i >= enough && g_a > fall * (right - a) && g_a > rise * (a - left)) break;
        if (i >= usual && g_a > near) break;
        const double b = a - left > right - a ? a - (1 - golden) * (a - left) : a + (1 - golden) * (right - a);
        if (b == a || b == left || b == right) break;
        const double g_b = side * value(step, index, b);
        const bool is_lower = g_b < g_a;
        const bool moves_right = (b < a) == is_lower;  // the right end of the bracket
        (moves_right ? right : left) = is_lower ? a : b;
        (moves_right ? g_right : g_left) = is_lower ? g_a : g_b;
        if (is_lower) a = b, g_a = g_b;
    }
    constexpr double held = std::numeric_limits<double>::min();  // the value of what is held off zero
    if (g_a == held) return {};
    if (std::abs(g_a) > band(step, index) && std::abs(g_a) <= near)
        band_ = std::max(band_, noise(step, index, a, side * g_a));
    if (std::abs(g_a) <= band(step, index)) return touch(step, index, of, a);
    return g_a <= 0 ? Turn{a, side * g_a} : Turn();
}

/// Four times how far rounding moves values at places that are a few rounding errors away from `theta`.
double EventWatch::noise(const StepView& step, int index, double theta, double here) {
    double most = 0;
    for (const double places : {-3, -1, 1, 2}) {
        const double beside =
            theta + 8 * places * tolerance::epsilon * std::max(1.0, std::abs(step.end) / (step.end - step.start));
        most = std::max(most, std::abs(value(step, index, beside) - here));
    }
    return 4 * most;
}

/// The middle of the places around `at` at which g is zero to rounding. They are no new zero if they reach to an
/// end of the bracket; but at the end of the piece, where the next one will not find them.
EventWatch::Turn EventWatch::touch(const StepView& step, int index, const Bracket& of, double at) {
    constexpr int halvings = 40;
    const double zero = band(step, index);
    const bool reaches_end = of.right == theta_.back() && std::abs(of.g_right) <= zero;
    if (std::abs(of.g_left) <= zero || (std::abs(of.g_right) <= zero && !reaches_end)) return {};
    const auto end = [&](double outside) {
        double inside = at;
        for (int i = 0; i < halvings; ++i) {
            const double middle = (inside + outside) / 2;
            (std::abs(value(step, index, middle)) <= zero ? inside : outside) = middle;
        }
        return inside;
    };
    const double first = end(of.left);
    if (reaches_end) return {.theta = of.right, .value = 0, .width = of.right - first};
    const double last = end(of.right);
    return {.theta = (first + last) / 2, .value = 0, .width = (last - first) / 2};
}

/// The zero between two points of different signs, as θ; not a number if it is a pole.
double EventWatch::locate(const StepView& step, int index, const Bracket& of) {
    const auto& [left, g_left, right, g_right] = of;
    double b = left, g_b = g_left;    // the newest point
    double a = right, g_a = g_right;  // the other side of the zero
    const double least = 4 * tolerance::epsilon * std::max(1.0, std::abs(step.end) / (step.end - step.start));
    const double highest = std::max(std::abs(g_left), std::abs(g_right));  // a pole rises above both
    double part = 0.5;
    for (int i = 0; i < 100; ++i) {
        const double next = b + part * (a - b);
        const double g_next = value(step, index, next);
        const bool same_side = side_of(g_next) == side_of(g_b);
        const double c = same_side ? b : a,
                     g_c = same_side ? g_b : g_a;  // the point that drops out of the bracket
        if (!same_side) a = b, g_a = g_b;
        b = next, g_b = g_next;
        const double width = std::abs(a - b);
        const double best = std::abs(g_b) < std::abs(g_a) ? b : a;
        if (g_b == 0) return b;
        if (width <= 2 * least) return std::min(std::abs(g_a), std::abs(g_b)) > highest ? no_place : best;

        const double xi = (b - a) / (c - a);
        const double phi = (g_b - g_a) / (g_c - g_a);
        part = 0.5;
        if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)  // inverse quadratic interpolation is safe
            part =
                g_b / (g_a - g_b) * g_c / (g_a - g_c) + (c - b) / (a - b) * g_b / (g_c - g_b) * g_a / (g_c - g_a);
        part = std::clamp(part, least / width, 1 - least / width);
    }
    return b;
}

}  // namespace alembert
