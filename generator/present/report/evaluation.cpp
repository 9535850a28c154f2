// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/evaluation.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "present/report/page.hpp"
#include "present/report/shown_unit.hpp"

namespace alembert {

namespace {

Json object_of(const Evaluation::Named& values) {
    Json object = Json::object();
    for (const auto& [name, value] : values) object[name] = value;
    return object;
}

ShownUnit unit_of(const Evaluation& e, std::size_t coordinate) {
    return ShownUnit(e.mechanism.shown_units[coordinate]);
}

std::size_t widest_name(const Evaluation& e) {
    std::size_t width = 16;
    for (std::size_t i = 0; i < e.coordinates.size(); ++i)
        width = std::max(width, unit_of(e, i).label(e.coordinates[i]).size() + 1);
    for (std::size_t k = 0; k < e.states.size(); ++k)
        width = std::max(width, ShownUnit(e.mechanism.states[k].shown).label(e.states[k].first).size() + 1);
    for (const auto& [name, value] : e.multipliers) width = std::max(width, name.size() + 1);
    for (const JointLoad& load : e.joint_loads) width = std::max(width, load.joint.size() + 1);
    return width;
}

/// The name that `audit` gives to a mode of dry friction.
std::string mode_of(const Evaluation& e, const std::string& friction, int side) {
    const bool in_plane =
        std::any_of(e.mechanism.frictions.begin(), e.mechanism.frictions.end(),
                    [&](const Mechanism::Friction& f) { return f.name == friction && f.across; });
    return side == 0 ? say("stick") : in_plane ? say("slip") : side > 0 ? say("slip +") : say("slip -");
}

}  // namespace

Json as_json(const Evaluation& e, bool reactions) {
    Json result;
    result["time"] = e.time;
    result["coordinates"] = by_name(e.coordinates, e.q);
    result["rates"] = by_name(e.coordinates, e.rates);
    result["accelerations"] = by_name(e.coordinates, e.accelerations);
    result["speeds"] = e.speeds.empty() ? result["rates"] : object_of(e.speeds);
    result["speed_rates"] = e.speed_rates.empty() ? result["accelerations"] : object_of(e.speed_rates);
    if (!e.states.empty()) {
        result["states"] = object_of(e.states);
        result["state_rates"] = object_of(e.state_rates);
    }
    result["multipliers"] = object_of(e.multipliers);
    result["kinetic"] = e.kinetic;
    result["potential"] = e.potential;
    result["energy"] = e.energy;
    result["residuals"] = Json::object();
    for (const auto& [name, residual] : e.residuals) result["residuals"][name] = residual;
    if (e.closed) result["closed"] = *e.closed;
    for (const auto& [name, side] : e.frictions) result["friction"][name] = mode_of(e, name, side);
    if (!e.adjusted.empty()) result["adjusted"] = e.adjusted;
    result["outputs"] = object_of(e.outputs);
    if (!e.mass.empty()) {
        result["matrices"] = {{"M", e.mass}, {"C", e.coriolis}};
        if (!e.no_coriolis.empty()) result["matrices"]["C"] = nullptr;
    }
    if (Json units = si_units(e.mechanism); !units.empty()) result["units"] = std::move(units);
    if (!reactions) return result;
    result["reactions"] = Json::object();
    for (const Evaluation::Reaction& r : e.reactions) result["reactions"][r.constraint][r.coordinate] = r.force;
    result["joint_reactions"] = Json::object();
    for (const JointLoad& load : e.joint_loads)
        result["joint_reactions"][load.joint] = {{"force", load.force}, {"moment", load.moment}};
    result["normal_reactions"] = Json::object();
    for (const auto& [name, value] : e.normal_reactions) result["normal_reactions"][name] = value;
    return result;
}

std::string as_text(const Evaluation& e) {
    const std::size_t width = widest_name(e);
    std::string page;
    put(page, "t = {}\n\n{:<{}}{:>24}{:>24}{:>24}\n", e.time, "", width, say("value"), say("rate"),
        say("acceleration"));
    for (std::size_t i = 0; i < e.coordinates.size(); ++i) {
        const ShownUnit unit = unit_of(e, i);
        put(page, "{:<{}}{:>24.16g}{:>24.16g}{:>24.16g}\n", unit.label(e.coordinates[i]), width,
            unit.value(e.q[i]), unit.value(e.rates[i]), unit.value(e.accelerations[i]));
    }
    for (std::size_t k = 0; k < e.speeds.size() && k < e.speed_rates.size(); ++k) {
        const ShownUnit unit(e.mechanism.speeds[k].shown);
        put(page, "{:<{}}{:>24.16g}{:>24.16g}\n", unit.label(e.speeds[k].first), width,
            unit.value(e.speeds[k].second), unit.value(e.speed_rates[k].second));
    }
    for (std::size_t k = 0; k < e.states.size(); ++k) {
        const ShownUnit unit(e.mechanism.states[k].shown);
        put(page, "{:<{}}{:>24.16g}{:>24.16g}\n", unit.label(e.states[k].first), width,
            unit.value(e.states[k].second), unit.value(e.state_rates[k].second));
    }
    for (const auto& [name, value] : e.multipliers) put(page, "{:<{}}{:>24.16g}\n", name, width, value);
    for (const auto& [name, side] : e.frictions) say_on(page, "friction {}: {}\n", name, mode_of(e, name, side));
    for (const std::string& line : e.adjusted) say_on(page, "adjusted {}\n", line);
    put(page, "\nT = {:.16g}\nV = {:.16g}\nE = {:.16g}\n", e.kinetic, e.potential, e.energy);
    for (const auto& [name, value] : e.outputs) put(page, "{} = {:.16g}\n", name, value);
    for (const auto& [letter, rows] : {std::pair("M", &e.mass), std::pair("C", &e.coriolis)})
        for (std::size_t i = 0; i < rows->size(); ++i) {
            put(page, "{}{:<{}}", i == 0 ? "\n" : "", i == 0 ? letter : "", width);
            for (const double x : (*rows)[i]) put(page, "{:>24.16g}", x + 0.0);
            put(page, "\n");
        }
    if (!e.no_coriolis.empty()) put(page, "{}\n", e.no_coriolis);
    if (!e.joint_loads.empty()) page += say("\nJoints exert on their children, along the joint's axes:\n");
    for (const JointLoad& load : e.joint_loads)
        for (const auto& [what, v] :
             {std::pair(say("force"), &load.force), std::pair(say("moment"), &load.moment)})
            put(page, "{:<{}}{:<8}{:>24.16g}{:>24.16g}{:>24.16g}\n", load.joint, width, what, (*v)[0], (*v)[1],
                (*v)[2]);
    if (!e.normal_reactions.empty())
        page += say("\nThe ground presses bodies that roll with the normal reactions:\n");
    for (const auto& [name, value] : e.normal_reactions) put(page, "{} = {:.16g}\n", name, value);
    return page;
}

}  // namespace alembert
