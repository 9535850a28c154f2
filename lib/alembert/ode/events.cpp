// SPDX-License-Identifier: MIT
#include "alembert/ode/events.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace alembert {
namespace {

struct EmittedEvents {
    Module module;
    std::vector<double> par;
};

}  // namespace

double simultaneous(double start, double end) {
    return 1e-12 * std::max(std::abs(end), end - start);
}

double uncertain_time(double t) {
    return 1e-13 * std::max(1.0, std::abs(t));  // some hundred rounding errors
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

}  // namespace alembert
