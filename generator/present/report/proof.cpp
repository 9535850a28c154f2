// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/proof.hpp"

#include <cmath>
#include <cstdlib>

#include "base/language/say.hpp"
#include "present/report/page.hpp"
#include "present/report/shown_unit.hpp"

namespace alembert {

namespace {

/// The unit of each component.
std::vector<Shown> units_of(const Proof& proof) {
    const Mechanism& m = proof.mechanism;
    std::vector<Shown> result(m.shown_units.begin(), m.shown_units.end());
    if (m.speeds.empty())
        result.insert(result.end(), m.shown_units.begin(), m.shown_units.end());
    else
        for (const auto& speed : m.speeds) result.push_back(speed.shown);
    for (const auto& state : m.states) result.push_back(state.shown);
    result.resize(proof.names.size());
    return result;
}

/// "0.84321837 ± 3.2e-13": what is printed, with what it may differ from all of the interval.
std::string text_of(const Interval& x, const Shown& shown) {
    const ShownUnit unit(shown);
    const double low = unit.value(x.low), high = unit.value(x.high), middle = low / 2 + high / 2;
    const std::string printed = fmt::format("{:.15g}", middle);
    const double written = std::strtod(printed.c_str(), nullptr);
    const double rounding = 4e-16 * std::max(std::abs(low), std::abs(high));
    return fmt::format("{} ± {:.1e}", printed, 1.06 * (std::max(high - written, written - low) + rounding));
}

}  // namespace

Json as_json(const Proof& proof) {
    Json rows = Json::array();
    for (const ProvedRow& row : proof.motion.rows) {
        Json low = Json::array(), high = Json::array();
        for (const Interval& x : row.box) low.push_back(x.low), high.push_back(x.high);
        rows.push_back({{"time", row.t}, {"low", std::move(low)}, {"high", std::move(high)}});
    }
    Json result{{"complete", proof.motion.complete},
                {"proved_until", proof.motion.reached},
                {"steps", proof.motion.steps},
                {"names", proof.names},
                {"rows", std::move(rows)}};
    if (!proof.motion.complete) result["reason"] = proof.motion.why;
    if (Json units = si_units(proof.mechanism); !units.empty()) result["units"] = std::move(units);
    return Json{{"proof", std::move(result)}};
}

std::string as_text(const Proof& proof) {
    const ProvedMotion& motion = proof.motion;
    const std::vector<Shown> units = units_of(proof);
    std::vector<std::string> labels;
    for (std::size_t i = 0; i < proof.names.size(); ++i) {
        const bool is_rate = proof.names[i].ends_with('\'');
        labels.push_back(is_rate && !units[i].unit.empty()
                             ? proof.names[i] + " [" + ShownUnit(units[i]).text({}, 1) + "]"
                             : ShownUnit(units[i]).label(proof.names[i]));
    }
    std::string page = say("proved: at t = {} each value lies within the bound that stands beside it ({})\n",
                           fmt::format("{}", motion.rows.back().t), shown_count(motion.steps, to_say("step")));
    const std::size_t width = column_for(labels, 12);
    for (std::size_t i = 0; i < labels.size(); ++i)
        put(page, "{:<{}}{}\n", labels[i], width, text_of(motion.rows.back().box[i], units[i]));
    if (!motion.complete) say_on(page, "not proved after t = {:.6g}: {}\n", motion.reached, motion.why);
    return page;
}

}  // namespace alembert
