// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include "base/language/say.hpp"
#include "present/report/page.hpp"
#include "present/report/stability_charts.hpp"

namespace alembert {

Json as_json(const LyapunovExponents& found) {
    Json result;
    result["exponents"] = found.exponents;
    result["spread"] = found.spread;
    result["duration"] = found.duration;
    result["interval"] = found.interval;
    result["dimensions"] = found.size;
    result["sum"] = found.sum ? Json(*found.sum) : Json();
    result["divergence"] = found.divergence ? Json(*found.divergence) : Json();
    result["estimates"] = Json::array();
    for (const LyapunovExponents::Row& row : found.rows)
        result["estimates"].push_back({{"time", row.time}, {"exponents", row.estimates}});
    return result;
}

std::string as_text(const LyapunovExponents& found) {
    std::string page;
    if (!found.title.empty()) put(page, "{}\n\n", found.title);
    say_on(page, "Lyapunov exponents over {:g} s, in floating point (a motion, no proof):\n\n{:>20}{:>28}\n",
           found.duration, say("exponent, 1/s"), say("moved in the second half by"));
    for (std::size_t k = 0; k < found.exponents.size(); ++k)
        put(page, "{:>20.8g}{:>28.2g}\n", found.exponents[k] + 0.0, found.spread[k]);
    if (found.sum) say_on(page, "\nTheir sum is {:.10g}", *found.sum + 0.0);
    if (found.sum && found.divergence) say_on(page, "; the mean divergence is {:.10g}", *found.divergence + 0.0);
    if (found.sum) page += "\n";
    page += say("\nEstimates until t:\n");
    for (const LyapunovExponents::Row& row : found.rows) {
        put(page, "{:>12.6g}", row.time);
        for (const double one : row.estimates) put(page, "{:>16.7g}", one + 0.0);
        page += "\n";
    }
    return page;
}

std::string as_csv(const LyapunovExponents& found) {
    std::string csv = "t";
    for (std::size_t k = 1; k <= found.exponents.size(); ++k) put(csv, ",exponent_{}", k);
    csv += "\n";
    for (const LyapunovExponents::Row& row : found.rows) {
        put(csv, "{}", row.time);
        for (const double one : row.estimates) put(csv, ",{}", one);
        csv += "\n";
    }
    return csv;
}

}  // namespace alembert
