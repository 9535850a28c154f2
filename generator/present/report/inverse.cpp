// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/inverse.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/language/say.hpp"
#include "present/report/page.hpp"
#include "present/report/shown_unit.hpp"

namespace alembert {

Json as_json(const InverseLoads& needed) {
    Json result;
    result["time"] = needed.time;
    result["coordinates"] = by_name(needed.coordinates, needed.q);
    result["rates"] = by_name(needed.coordinates, needed.rates);
    result["accelerations"] = by_name(needed.coordinates, needed.accelerations);
    result["loads"] = needed.given_in_speeds ? by_name(needed.speeds, needed.speed_loads)
                                             : by_name(needed.coordinates, needed.loads);
    if (!needed.speeds.empty()) {
        result["speeds"] = by_name(needed.speeds, needed.speed_values);
        result["speed_rates"] = by_name(needed.speeds, needed.speed_rates);
        result["coordinate_loads"] = by_name(needed.coordinates, needed.loads);
        if (!needed.speed_loads.empty()) result["speed_loads"] = by_name(needed.speeds, needed.speed_loads);
    }
    result["multipliers"] = Json::object();
    for (const auto& [name, value] : needed.multipliers) result["multipliers"][name] = value;
    return result;
}

std::string as_text(const InverseLoads& needed) {
    std::size_t width = 16;
    std::vector<std::string> labels;
    for (std::size_t i = 0; i < needed.coordinates.size(); ++i) {
        labels.push_back(ShownUnit(needed.mechanism.shown_units[i]).label(needed.coordinates[i]));
        width = std::max(width, labels[i].size() + 1);
    }
    for (const std::string& name : needed.speeds) width = std::max(width, name.size() + 1);
    std::string page;
    put(page, "t = {:.6g}\n\n{:<{}}{:>24}{:>24}{:>24}{:>24}\n", needed.time, "", width, say("value"), say("rate"),
        say("acceleration"), say("load"));
    for (std::size_t i = 0; i < needed.coordinates.size(); ++i) {
        const ShownUnit unit(needed.mechanism.shown_units[i]);
        put(page, "{:<{}}{:>24.16g}{:>24.16g}{:>24.16g}{:>24.16g}\n", labels[i], width, unit.value(needed.q[i]),
            unit.value(needed.rates[i]), unit.value(needed.accelerations[i]), needed.loads[i]);
    }
    if (!needed.speeds.empty())
        put(page, "\n{:<{}}{:>24}{:>24}{:>24}\n", "", width, say("value"), say("rate"), say("load"));
    for (std::size_t k = 0; k < needed.speeds.size(); ++k)
        put(page, "{:<{}}{:>24.16g}{:>24.16g}{:>24}\n", needed.speeds[k], width, needed.speed_values[k],
            needed.speed_rates[k],
            needed.speed_loads.empty() ? std::string("-") : fmt::format("{:.16g}", needed.speed_loads[k]));
    for (std::size_t k = 0; k < needed.multipliers.size(); ++k)
        put(page, "{}{} = {:.16g}\n", k == 0 ? "\n" : "", needed.multipliers[k].first,
            needed.multipliers[k].second);
    return page;
}

}  // namespace alembert
