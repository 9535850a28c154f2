// SPDX-License-Identifier: MIT
#include "alembert/hybrid/impulsive_events.hpp"

#include <fmt/format.h>

#include <cmath>

namespace alembert {

namespace {

constexpr std::size_t most_kicks = 100;  // kicks of one event within `moment`
constexpr double moment = 1e-5;  // as a part of the duration: with kicks at that rate no budget would be enough
constexpr double short_flight = 1e-3;  // a time between two kicks is short if it is below this part of the longest
constexpr double lost_in_time = 1e-11;
constexpr double finest_way = 1e-12,
                 coarsest_way = 1e-6;  // bounds on the way of an event's value between kicks, relative to its size
// times between kicks that shrink by one ratio, down to a part of the longest, have a limit
constexpr double same_ratio = 0.01, endless_flight = 1e-8;
constexpr int enough_alike = 8;
constexpr std::size_t most_shown = 10;

}  // namespace

std::vector<double> in_rates(const ImpulsiveEvents& kicks, const Rhs& rhs, double t,
                             const std::vector<double>& state) {
    if (!kicks.speeds) return state;
    const auto n = static_cast<std::ptrdiff_t>(kicks.coordinates);
    std::vector<double> rate(state.size()), result(state.begin(), state.begin() + n);
    rhs(t, state.data(), rate.data());
    result.insert(result.end(), rate.begin(), rate.begin() + n);
    const auto s = static_cast<std::ptrdiff_t>(kicks.speeds(t, result.data()).size());
    result.insert(result.end(), state.begin() + n + s, state.end());
    return result;
}

std::vector<double> as_integrated(const ImpulsiveEvents& kicks, double t, const std::vector<double>& rates) {
    if (!kicks.speeds) return rates;
    const auto n = static_cast<std::ptrdiff_t>(kicks.coordinates);
    const std::vector<double> speeds = kicks.speeds(t, rates.data());
    std::vector<double> state(rates.begin(), rates.begin() + n);
    state.insert(state.end(), speeds.begin(), speeds.end());
    state.insert(state.end(), rates.begin() + 2 * n, rates.end());
    return state;
}

HeldGuard held_from(double start, const PassedZero& passed) {
    if (passed.side == 0) return {.band = passed.band};
    return {.side = passed.side, .until = start + passed.hold, .band = passed.band};
}

std::optional<std::string> KickSeries::add(const std::string& name, double t, const LastZero& zero,
                                           const PassedZero& passed, double tolerance, double duration) {
    times_.push_back(t);
    if (times_.size() < 2) return std::nullopt;
    const double flight = t - times_[times_.size() - 2], way = std::clamp(tolerance, finest_way, coarsest_way);
    longest_ = std::max(longest_, flight);
    const bool is_lost =
        flight < short_flight * longest_ &&
        (std::abs(passed.slope) * flight < way * passed.size || flight < lost_in_time * std::abs(t));
    lost_ = is_lost ? lost_ + 1 : 0;
    const double ratio = flight / last_flight_;
    alike_ = ratio < 1 && std::abs(ratio - last_ratio_) < same_ratio ? alike_ + 1 : 0;
    last_flight_ = flight, last_ratio_ = ratio;
    const bool has_limit = alike_ >= enough_alike && flight < endless_flight * longest_;
    const bool is_wrong = is_lost && passed.slope * zero.direction < 0;  // rounding decides the sign
    const bool is_crowd =
        times_.size() > most_kicks && t - times_[times_.size() - 1 - most_kicks] <= moment * duration;
    if (!is_wrong && !is_crowd && !has_limit && lost_ < 2) return std::nullopt;
    const std::size_t shown = std::min(times_.size(), most_shown);
    return fmt::format(
        "the impulses of event '{}' follow each other without end before t = {:.10g}: the last {} came within "
        "{:.3g} s; what bounces and comes "
        "to rest is a [[unilateral]] with its restitution; an impulse that is not to follow itself needs a "
        "'direction' or another 'when'",
        name, t, shown, t - times_[times_.size() - shown]);
}

}  // namespace alembert
