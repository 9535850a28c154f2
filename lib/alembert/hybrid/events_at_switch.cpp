// SPDX-License-Identifier: MIT
#include "alembert/hybrid/events_at_switch.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/hybrid/sliding_field.hpp"
#include "alembert/hybrid/zero_of_jump.hpp"

namespace alembert {

EventsAtSwitch::EventsAtSwitch(const Place& place) : t(place.t), list(place.events.list) {
    if (list.empty()) return;
    short_time = soon_after(t, place.duration);
    SlidingField field(place.system, place.sides, static_cast<int>(place.state.size()));
    field.evaluate(t, place.state.data());
    const std::vector<double> rate(field.rate().begin(), field.rate().end());
    const auto after = [&](double h) {
        std::vector<double> state = place.state, value(list.size());
        for (std::size_t i = 0; i < state.size(); ++i) state[i] += h * rate[i];
        field.evaluate(t + h, state.data());
        if (place.system.before_step) place.system.before_step(field.sigma());
        place.events(t + h, state.data(), field.rate().data(), value.data());
        return value;
    };
    earlier = after(-short_time);
    later = after(short_time);
    now = after(0);
}

std::vector<LastZero> jumps(const FilippovSystem& system, const EventsAtSwitch& before,
                            const EventsAtSwitch& after) {
    std::vector<LastZero> result;
    for (const int k : system.events_of_forces) {
        const auto i = static_cast<std::size_t>(k);
        const auto passed = zero_of_jump(k, after.list[i], before.now[i], after.now[i]);
        if (passed && passed->counts) result.push_back(*passed);
    }
    return result;
}

std::vector<LastZero> zeros_here(const EventsAtSwitch& before, const EventsAtSwitch& after) {
    constexpr double above_noise = 1e-2;
    const double uncertain = uncertain_time(after.t);
    std::vector<LastZero> result;
    for (std::size_t k = 0; k < after.now.size(); ++k) {
        const double coming = before.earlier[k], going = after.later[k], now = after.now[k],
                     beside = std::min(std::abs(coming), std::abs(going)), slope = beside / after.short_time;
        LastZero zero{.event = static_cast<int>(k), .direction = coming > 0 ? -1 : 1};
        const int wanted = after.list[k].direction;
        if (coming == 0 && before.now[k] == 0) {  // it leaves its zero, which it has reached before
            result.push_back(zero);
            continue;
        }
        if (!(std::abs(now) <= std::min(uncertain * slope, above_noise * beside))) continue;
        zero.touches = coming * going > 0;
        if (!zero.touches && now * coming > 0) continue;  // the next piece sees that it passes
        zero.counts = wanted == 0 || wanted == zero.direction;
        result.push_back(zero);
    }
    return result;
}

}  // namespace alembert
