// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/impact.hpp"

#include "algebra/notation/latex.hpp"
#include "algebra/notation/text.hpp"
#include "base/language/say.hpp"
#include "present/report/page.hpp"
#include "present/report/shown_unit.hpp"

namespace alembert {

namespace {

std::string equality(const ReadableEquation& e) {
    return text(e.lhs) + " = " + text(e.rhs);
}

/// (name, impulse) of all constraints, then of the closed contacts.
std::vector<std::pair<std::string, double>> reactions(const Impact& hit, const Mechanism& m) {
    std::vector<std::pair<std::string, double>> result;
    for (std::size_t k = 0; k < m.constraints.size(); ++k)
        result.emplace_back(m.constraints[k].name, hit.numbers.bilateral[static_cast<Eigen::Index>(k)]);
    for (std::size_t k = 0; k < hit.contacts.size(); ++k)
        result.emplace_back(m.unilateral[hit.contacts[k]].gap.name,
                            hit.numbers.contact[static_cast<Eigen::Index>(k)]);
    return result;
}

void add_formulas(std::string& page, const Impact& hit, const Mechanism& m) {
    if (!hit.equations.empty()) {
        say_on(page, "Equations of the impact (x' is a rate after, x'(-) before{}):\n",
               hit.conditions.empty() ? "" : say("; multipliers are the impulses of reactions"));
        for (const ReadableEquation& e : hit.equations) put(page, "  {}\n", equality(e));
        for (const auto& [name, condition] : hit.conditions)
            put(page, "  {}    ({})\n", equality(condition), name);
        put(page, "\n");
    }
    if (!hit.solution.empty()) {
        say_on(page, "Solution where the scene starts:\n");
        for (int i = 0; i < m.size(); ++i) put(page, "  {}' = {}\n", m.q[i].get_name(), text(hit.solution[i]));
        for (const auto& [name, value] : hit.reactions) say_on(page, "  impulse of {} = {}\n", name, text(value));
        if (hit.energy_loss) say_on(page, "  T before - T after = {}\n", text(*hit.energy_loss));
        put(page, "\n");
    }
    if (!hit.silence.empty()) say_on(page, "Not shown in symbols: {}.\n\n", hit.silence);
}

void add_numbers(std::string& page, const Impact& hit, const Mechanism& m) {
    for (const std::string& name : hit.imposed)
        say_on(page, "The rates before break constraint '{}'; it is imposed suddenly, and plastically.\n", name);
    if (hit.numbers.collisions > 1)
        say_on(page, "{} collisions follow each other in the same instant.\n", hit.numbers.collisions);
    for (std::size_t k = 0; k < hit.contacts.size(); ++k)
        say_on(page, "Contact '{}' {}.\n", m.unilateral[hit.contacts[k]].gap.name,
               hit.numbers.stays_closed[k] ? say("stays closed") : say("opens"));
    put(page, "{:<16}{:>24}{:>24}{:>24}\n", "", say("value"), say("rate before"), say("rate after"));
    for (int i = 0; i < m.size(); ++i) {
        const ShownUnit unit(m.shown_units[static_cast<std::size_t>(i)]);
        put(page, "{:<16}{:>24.16g}{:>24.16g}{:>24.16g}\n", unit.label(m.q[i].get_name()),
            unit.value(hit.start.q[i]), unit.value(hit.start.qdot[i]), unit.value(hit.numbers.after[i]));
    }
    for (const auto& [name, value] : reactions(hit, m))
        say_on(page, "{:<16}{:>24.16g}    (impulse of the reaction)\n", name, value);
    for (const std::string& line : hit.adjusted) say_on(page, "adjusted {}\n", line);
    say_on(page, "\nT before = {:.16g}\nT after = {:.16g}\n", hit.kinetic_before, hit.kinetic_after);
    if (!m.impulses.empty()) say_on(page, "work of the impulses = {:.16g}\n", hit.numbers.work);
    if (hit.floors != 0) say_on(page, "work of moving constraints = {:.16g}\n", hit.floors);
    say_on(page, "lost in constraints and contacts = {:.16g}\n", hit.numbers.loss);
}

}  // namespace

Json as_json(const Struck& struck) {
    const Impact& hit = struck.hit;
    const Mechanism& m = struck.mechanism;
    Json result;
    const auto by_name = [&](const auto& value) {
        Json object = Json::object();
        for (int i = 0; i < m.size(); ++i) object[m.q[i].get_name()] = value(i);
        return object;
    };
    result["time"] = hit.start.t;
    result["coordinates"] = by_name([&](int i) { return hit.start.q[i]; });
    result["before"] = by_name([&](int i) { return hit.start.qdot[i]; });
    result["after"] = by_name([&](int i) { return hit.numbers.after[i]; });
    result["solution"] =
        hit.solution.empty() ? Json::object() : by_name([&](int i) { return text(hit.solution[i]); });
    result["reactions"] = Json::object();
    for (const auto& [name, value] : reactions(hit, m)) result["reactions"][name] = value;
    result["reactions_solution"] = Json::object();
    for (const auto& [name, value] : hit.reactions) result["reactions_solution"][name] = text(value);
    result["equations"] = Json::array();
    for (const ReadableEquation& e : hit.equations)
        result["equations"].push_back({{"text", equality(e)}, {"latex", latex(e.lhs) + " = " + latex(e.rhs)}});
    result["conditions"] = Json::object();
    for (const auto& [name, condition] : hit.conditions) result["conditions"][name] = equality(condition);
    result["contacts"] = Json::array();
    for (std::size_t k = 0; k < hit.contacts.size(); ++k)
        result["contacts"].push_back({{"name", m.unilateral[hit.contacts[k]].gap.name},
                                      {"stays_closed", bool(hit.numbers.stays_closed[k])}});
    result["imposed"] = hit.imposed;
    result["collisions"] = hit.numbers.collisions;
    result["kinetic_before"] = hit.kinetic_before;
    result["kinetic_after"] = hit.kinetic_after;
    result["energy_loss"] = hit.kinetic_before - hit.kinetic_after;
    if (hit.energy_loss) result["energy_loss_solution"] = text(*hit.energy_loss);
    result["work_of_impulses"] = hit.numbers.work;
    result["work_of_moving_constraints"] = hit.floors;
    result["loss_in_constraints"] = hit.numbers.loss;
    if (!hit.adjusted.empty()) result["adjusted"] = hit.adjusted;
    if (!hit.silence.empty()) result["note"] = hit.silence;
    return result;
}

std::string as_text(const Struck& struck) {
    std::string page;
    if (!struck.scene.title.empty()) put(page, "{}\n\n", struck.scene.title);
    if (struck.hit.nothing_happens)
        page += say(
            "Nothing is struck: no impulses, every constraint is obeyed, no closed contact approaches. The rates "
            "stay as they are.\n\n");
    else
        add_formulas(page, struck.hit, struck.mechanism);
    add_numbers(page, struck.hit, struck.mechanism);
    return page;
}

}  // namespace alembert
