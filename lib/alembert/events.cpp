// SPDX-License-Identifier: MIT
#include "alembert/events.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "alembert/tolerances.hpp"

namespace alembert {
namespace {

constexpr int points = 5;      ///< number of points at which a step is examined, ends included
constexpr int most_looks = 8;  ///< the most repetitions of the search before an event that stops
constexpr std::array<double, points> places = {0, 0.25, 0.5, 0.75, 1};
constexpr double bend = 2;  ///< a function that approaches zero may later fall this many times as steeply

constexpr double no_place = std::numeric_limits<double>::quiet_NaN();

int sign(double g) {
    return (g > 0) - (g < 0);
}

struct EmittedEvents {
    Module module;
    std::vector<double> par;
};

double simultaneous(const Stretch& step) {
    return alembert::simultaneous(step.start, step.end);
}

/// Orders zeros by time, simultaneous ones as their events are declared.
void order(std::vector<Crossing>& found, const Stretch& step) {
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    for (std::size_t i = 1; i < found.size(); ++i)
        for (std::size_t j = i; j > 0 && found[j].index < found[j - 1].index &&
                                found[j].time - found[j - 1].time <= simultaneous(step);
             --j)
            std::swap(found[j], found[j - 1]);
}

}  // namespace

double simultaneous(double start, double end) {
    return 1e-12 * std::max(std::abs(end), end - start);
}

Events make_events(const Module& module, const std::vector<double>& values, const std::vector<bool>& stop,
                   const std::vector<int>& direction) {
    const alembert_solver_table& table = module.table();
    const auto count = static_cast<std::size_t>(table.events);
    if (!stop.empty() && stop.size() != count)
        throw std::invalid_argument(
            fmt::format("{} has {} events, {} stop flags were given", table.scene, count, stop.size()));
    if (!direction.empty() && direction.size() != count)
        throw std::invalid_argument(
            fmt::format("{} has {} events, {} directions were given", table.scene, count, direction.size()));
    Events events;
    for (std::size_t k = 0; k < count; ++k)
        events.list.push_back({.name = table.event_names[k],
                               .stop = !stop.empty() && stop[k],
                               .direction = direction.empty() ? 0 : direction[k]});
    events.context = std::make_shared<const EmittedEvents>(EmittedEvents{module, prepared(module, values)});
    events.call = [](const void* context, double t, const double* state, const double* rate, double* out) {
        const auto& emitted = *static_cast<const EmittedEvents*>(context);
        emitted.module.table().events_at(t, state, rate, emitted.par.data(), out);
    };
    return events;
}

EventWatch::EventWatch(const Events& events, const Rhs& rhs)
    : events_(events),
      rhs_(rhs),
      state_(static_cast<std::size_t>(rhs.dimension)),
      rate_(state_.size()),
      out_(events.list.size()),
      last_(out_.size()),
      slope_(out_.size()),
      first_slope_(out_.size()),
      ahead_(state_.size()),
      ahead_values_(out_.size()),
      sign_(out_.size()),
      grid_(points * out_.size()) {}

void EventWatch::begin(double t, const double* state, const double* rate) {
    run_start_ = t;
    if (last_.empty()) return;
    events_(t, state, rate, last_.data());
    std::transform(last_.begin(), last_.end(), sign_.begin(), sign);
    std::fill(slope_.begin(), slope_.end(), no_place);  // unknown until the length of the first step is known
}

/// The slopes follow from a difference along the tangent of the motion with y' held constant, which costs one
/// evaluation of the events. For an event that contains accelerations this is only the part of the slope that does
/// not come from their change.
void EventWatch::slopes_at(double t, const double* state, const double* rate, const std::vector<double>& values,
                           double length) {
    const double ahead = std::max(1e-6 * length, 64 * tolerance::epsilon * std::abs(t));
    for (std::size_t i = 0; i < ahead_.size(); ++i) ahead_[i] = state[i] + ahead * rate[i];
    events_(t + ahead, ahead_.data(), rate, ahead_values_.data());
    for (std::size_t k = 0; k < slope_.size(); ++k) slope_[k] = (ahead_values_[k] - values[k]) / ahead;
}

std::vector<Crossing> EventWatch::look(const Stretch& step) {
    if (last_.empty()) return {};
    const std::vector<double> value_before = last_, slope_before = slope_;
    const std::vector<int> sign_before = sign_;
    std::vector<Crossing> found = scan(step);
    const bool is_stopped = std::any_of(found.begin(), found.end(), [&](const Crossing& c) { return stops(c); });
    for (int round = 0; is_stopped && round < most_looks; ++round) {
        last_ = value_before;
        slope_ = slope_before;
        sign_ = sign_before;  // the signs at the end of the step do not matter any more, because the run ends here
        if (!look_again(step, found)) break;
    }
    return found;
}

/// Searches again before the first crossing that stops the run; true if that finds an earlier one that stops.
bool EventWatch::look_again(const Stretch& step, std::vector<Crossing>& found) {
    const auto stop = std::find_if(found.begin(), found.end(), [&](const Crossing& c) { return stops(c); });
    const Crossing first = *stop;
    if (first.theta <= 0) return false;
    Stretch part{
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
    std::erase_if(earlier, [&](const Crossing& c) {
        return std::any_of(found.begin(), found.end(), [&](const Crossing& known) {
            return known.index == c.index && std::abs(known.time - c.time) <= simultaneous(step);
        });
    });
    if (earlier.empty()) return false;
    found.insert(found.begin(), earlier.begin(), earlier.end());
    order(found, step);
    return std::any_of(earlier.begin(), earlier.end(), [&](const Crossing& c) { return stops(c); });
}

std::vector<Crossing> EventWatch::scan(const Stretch& step) {
    std::vector<Crossing> found;
    const std::size_t count = last_.size();
    std::copy(last_.begin(), last_.end(), grid_.begin());
    if (std::isnan(slope_[0])) {
        value(step, 0, 0);
        slopes_at(step.start, state_.data(), rate_.data(), last_, step.end - step.start);
    }
    first_slope_ = slope_;
    for (std::size_t i = 1; i + 1 < points; ++i) {
        value(step, 0, places[i]);
        std::copy(out_.begin(), out_.end(), grid_.begin() + static_cast<std::ptrdiff_t>(i * count));
    }
    events_(step.end, step.end_state, step.end_rate, last_.data());
    std::copy(last_.begin(), last_.end(), grid_.end() - static_cast<std::ptrdiff_t>(count));
    const double* const before =
        grid_.data() + (points - 2) * count;  // a function that moves away from zero has no zero here
    if (std::equal(last_.begin(), last_.end(), before,
                   [](double now, double then) { return std::abs(now) > std::abs(then); }))
        std::fill(slope_.begin(), slope_.end(), 0.0);
    else
        slopes_at(step.end, step.end_state, step.end_rate, last_, step.end - step.start);

    for (std::size_t k = 0; k < count; ++k) look_at_one(step, static_cast<int>(k), found);
    order(found, step);
    return found;
}

double EventWatch::value(const Stretch& step, int index, double theta) {
    const double t = step.start + theta * (step.end - step.start);
    step.interpolate(theta, state_.data());
    rhs_(t, state_.data(), rate_.data());
    ++evaluations_;
    events_(t, state_.data(), rate_.data(), out_.data());
    return out_[static_cast<std::size_t>(index)];
}

/// Goes through the points of the step and the turning points between them and records where the sign changes.
/// Points where the event is not a number are skipped.
void EventWatch::look_at_one(const Stretch& step, int index, std::vector<Crossing>& found) {
    const auto k = static_cast<std::size_t>(index);
    theta_.assign(places.begin(), places.end());
    g_.clear();
    for (std::size_t i = 0; i < points; ++i) g_.push_back(grid_[i * last_.size() + k]);
    for (const double turn : turning_points(step, index)) {
        const auto after = std::upper_bound(theta_.begin(), theta_.end(), turn);
        g_.insert(g_.begin() + (after - theta_.begin()), value(step, index, turn));
        theta_.insert(after, turn);
    }
    int& last_sign = sign_[k];
    std::size_t left = 0;
    for (std::size_t i = 1; i < g_.size(); ++i) {
        if (std::isnan(g_[i])) continue;
        const int now = sign(g_[i]);
        if (last_sign != 0 && now == 0) record(step, index, theta_[i], -last_sign, found);
        if (last_sign * now < 0)
            record(step, index, locate(step, index, theta_[left], g_[left], theta_[i], g_[i]), now, found);
        last_sign = now;
        left = i;
    }
}

void EventWatch::record(const Stretch& step, int index, double theta, int direction,
                        std::vector<Crossing>& found) const {
    if (std::isnan(theta)) return;
    const double time = theta == 1 ? step.end : step.start + theta * (step.end - step.start);
    const Event& event = events_.list[static_cast<std::size_t>(index)];
    if (event.at_once || time - run_start_ > simultaneous(step))
        found.push_back({.index = index,
                         .time = time,
                         .theta = theta,
                         .direction = direction,
                         .counts = event.direction == 0 || event.direction == direction});
}

/// The places between points of the same sign at which g has the other sign.
std::vector<double> EventWatch::turning_points(const Stretch& step, int index) {
    const auto k = static_cast<std::size_t>(index);
    const double length = step.end - step.start;
    std::vector<double> found;
    const auto add = [&](double theta) {
        if (!std::isnan(theta)) found.push_back(theta);
    };
    // Between the two ends of a quarter, `from` being an end of the step: does g approach zero from there steeply
    // enough, and come back?
    const auto at_the_end = [&](std::size_t from, std::size_t to, double slope) {
        const int side = sign(g_[from]);
        const double width = (theta_[to] - theta_[from]) * length;
        if (side == 0 || sign(g_[to]) != side || side * g_[from] + bend * side * slope * width >= 0 ||
            side * g_[to] < side * g_[from])
            return;
        const double a = theta_[from], b = theta_[to];
        add(from < to ? lowest(step, index, a, g_[from], (a + b) / 2, b, g_[to])
                      : lowest(step, index, b, g_[to], (a + b) / 2, a, g_[from]));
    };
    at_the_end(0, 1, first_slope_[k]);
    for (std::size_t i = 0; i + 2 < points; ++i) {
        const double turn = between(step, index, &theta_[i], &g_[i]);
        add(turn);
        if (!std::isnan(turn)) ++i;
    }
    at_the_end(points - 1, points - 2, slope_[k]);
    return found;
}

/// For three neighbouring points of the same sign: a place between them where g has the other sign. It is searched
/// for where g is nearest to zero, and only if a parabola through the points comes near zero or a line through two
/// of them meets zero before the third. Not a number if there is none.
double EventWatch::between(const Stretch& step, int index, const double* theta, const double* g) {
    const int side = sign(g[1]);
    if (side == 0 || sign(g[0]) * side < 0 || sign(g[2]) != side) return no_place;
    const double slope = (g[2] - g[0]) / (theta[2] - theta[0]);
    const double half = (theta[2] - theta[0]) / 2;
    const double curvature = (g[2] - 2 * g[1] + g[0]) / (half * half);
    const double vertex = theta[1] - slope / curvature;
    if (!(curvature * side > 0) || vertex <= theta[0] || vertex >= theta[2]) return no_place;
    const double parabola = side * (g[1] - slope * slope / (2 * curvature));
    const double nearest = std::min({side * g[0], side * g[1], side * g[2]}),
                 farthest = std::max(side * g[0], side * g[2]);
    const bool turns_back =
        side * g[1] < side * g[0] && side * g[1] < side * g[2] && side * g[1] < bend * (farthest - side * g[1]);
    if (parabola > nearest / 2 && !turns_back) return no_place;
    return lowest(step, index, theta[0], g[0], vertex, theta[2], g[2]);
}

/// Golden-section search for the place where g is nearest to zero, until g has the other sign there. The result is
/// not a number if no such place is found, or as soon as the values show that no function convex towards zero can
/// have one.
double EventWatch::lowest(const Stretch& step, int index, double left, double g_left, double middle, double right,
                          double g_right) {
    constexpr double golden = 0.6180339887498949;
    constexpr int enough = 4, most = 40;
    const int side = sign(g_right);
    g_left *= side, g_right *= side;
    double a = middle, g_a = side * value(step, index, a);
    for (int i = 0; i < most && g_a > 0; ++i) {
        const double fall = (g_left - g_a) / (a - left), rise = (g_right - g_a) / (right - a);
        if (i >= enough && g_a > fall * (right - a) && g_a > rise * (a - left)) return no_place;
        const double b = a - left > right - a ? a - (1 - golden) * (a - left) : a + (1 - golden) * (right - a);
        const double g_b = side * value(step, index, b);
        const bool is_lower = g_b < g_a;
        const bool moves_right = (b < a) == is_lower;  // the right end of the bracket
        (moves_right ? right : left) = is_lower ? a : b;
        (moves_right ? g_right : g_left) = is_lower ? g_a : g_b;
        if (is_lower) a = b, g_a = g_b;
    }
    return g_a <= 0 ? a : no_place;
}

/// The zero between two points of different signs, as θ; not a number if it is a pole.
double EventWatch::locate(const Stretch& step, int index, double left, double g_left, double right,
                          double g_right) {
    double b = left, g_b = g_left;    // the newest point
    double a = right, g_a = g_right;  // the other side of the zero
    const double least = 4 * tolerance::epsilon * std::max(1.0, std::abs(step.end) / (step.end - step.start));
    const double highest = std::max(std::abs(g_left), std::abs(g_right));  // a pole rises above both
    double part = 0.5;
    for (int i = 0; i < 100; ++i) {
        const double next = b + part * (a - b);
        const double g_next = value(step, index, next);
        const bool same_side = sign(g_next) == sign(g_b);
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
