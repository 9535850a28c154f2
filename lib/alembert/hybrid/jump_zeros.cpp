// SPDX-License-Identifier: MIT
#include "alembert/hybrid/jump_zeros.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/hybrid/zero_of_jump.hpp"

namespace alembert {

namespace {

std::vector<double> values(const ModeAt& here, double t) {
    std::vector<double> rate(here.state.size()), value(here.mode.events.list.size());
    here.mode.system.rhs(t, here.state.data(), rate.data());
    here.mode.events(t, here.state.data(), rate.data(), value.data());
    return value;
}

/// The values a short time later.
std::vector<double> values_soon(const ModeAt& here, double t, double duration) {
    const double h = soon_after(t, duration);
    std::vector<double> later = here.state, rate(here.state.size());
    here.mode.system.rhs(t, here.state.data(), rate.data());
    for (std::size_t i = 0; i < later.size(); ++i) later[i] += h * rate[i];
    return values({here.mode, later}, t + h);
}

}  // namespace

std::vector<LastZero> zeros_of_jump(const ImpulsiveEvents& kicks, const EventJump& jump) {
    std::vector<LastZero> result;
    const std::size_t events = kicks.events.size();
    const bool sets = jump.set != jump.before.state, forces = kicks.looks_at_forces();
    if (events == 0 || (!sets && !forces)) return result;
    const std::vector<double> old = values(jump.before, jump.t),
                              set = values({jump.before.mode, jump.set}, jump.t);
    std::vector<double> settled, later;
    if (forces) {
        settled = values(jump.after, jump.t);
        later = values_soon(jump.before, jump.t, jump.duration);
    }
    for (std::size_t k = 0; k < events; ++k) {
        const bool is_force = kicks.is_of_multipliers(k);
        if (!is_force && !sets) continue;
        const auto index = static_cast<int>(k);
        const Event& event = jump.before.mode.events.list[k];
        const auto passed =
            is_force
                ? zero_of_jump(index, event, old[k], settled[k],
                               {.rounding = 2 * std::abs(later[k] - old[k])})  // it has come to zero by itself
                : zero_of_jump(index, event, old[k], set[k], {.may_arrive = kicks.is_of_modes(k)});
        if (passed) result.push_back(*passed);
    }
    return result;
}

std::vector<LastZero> zeros_at(const ModeAt& here, std::size_t events, double t, double duration) {
    const double h = soon_after(t, duration);
    std::vector<double> earlier = here.state, rate(here.state.size());
    here.mode.system.rhs(t, here.state.data(), rate.data());
    for (std::size_t i = 0; i < earlier.size(); ++i) earlier[i] -= h * rate[i];
    const std::vector<double> before = values({here.mode, earlier}, t - h), now = values(here, t),
                              then = values_soon(here, t, duration);
    std::vector<LastZero> result;
    for (std::size_t k = 0; k < events; ++k) {
        const double slope = (then[k] - before[k]) / (2 * h);
        if (!(before[k] * then[k] < 0) || !(std::abs(now[k]) <= uncertain_time(t) * std::abs(slope))) continue;
        const int side = slope > 0 ? 1 : -1, wanted = here.mode.events.list[k].direction;
        result.push_back(
            {.event = static_cast<int>(k), .direction = side, .counts = wanted == 0 || wanted == side});
    }
    return result;
}

PassedZero zero_along(const ModeAt& here, std::size_t event, double t, double duration) {
    const double h = soon_after(t, duration), value = values(here, t)[event],
                 then = values_soon(here, t, duration)[event], change = then - value;
    PassedZero result{.slope = change / h, .size = std::abs(change / h) * duration};
    if (std::abs(value) > 2 * std::abs(change)) return result;  // it has jumped
    if (change == 0)
        result.band = 2 * std::abs(value);
    else
        result.side = then > 0 ? 1 : -1, result.hold = h;
    return result;
}

}  // namespace alembert
