// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/fmu/unit_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <kainjow/mustache.hpp>

#include "alembert/base/argument.hpp"
#include "alembert/base/inertia.hpp"
#include "analysis/state/inertia_check.hpp"
#include "codegen/emit/comment.hpp"
#include "codegen/emit/elementary.hpp"
#include "codegen/emit/numbers.hpp"
#include "codegen/emit/projection_text.hpp"
#include "codegen/emit/solver_functions.hpp"
#include "codegen/emit/standalone.hpp"
#include "codegen/emit/templates.hpp"
#include "codegen/emit/vocabulary.hpp"

namespace alembert {

namespace {

/// In the order of UnitVariable::Kind.
constexpr const char* kind_names[] = {
    "time_variable", "state_variable",  "rate_variable",   "input_variable",      "parameter_variable",
    "tied_variable", "energy_variable", "output_variable", "multiplier_variable", "event_variable"};

std::size_t multipliers_of(const Program& p) {
    return p.nodes_of(Group::multiplier).size();
}

std::vector<std::string> rows_of(const std::vector<UnitVariable>& variables) {
    std::vector<std::string> rows;
    for (const UnitVariable& v : variables)
        rows.push_back(fmt::format("{}, {}", kind_names[static_cast<int>(v.kind)], v.place));
    return rows;
}

std::vector<std::string> quoted_names(const std::vector<UnitVariable>& variables) {
    std::vector<std::string> result;
    for (const UnitVariable& v : variables) result.push_back("\"" + v.name + "\"");
    return result;
}

std::vector<std::string> actions_of(const UnitModel& model) {
    std::vector<std::string> rows;
    int kicks = 0;
    for (const Mechanism::EventAction& action : model.mechanism.event_actions) {
        const bool sets = !action.set.empty() || !action.rates.empty();
        const auto is = [k = rows.size()](const std::vector<bool>& list) {
            return k < list.size() && list[k] ? 1 : 0;
        };
        rows.push_back(fmt::format("{}, {}, {}, {}, {}, {}, {}", action.direction, action.stop ? 1 : 0,
                                   action.impulse.empty() ? -1 : kicks++, sets ? 1 : 0, action.count.value_or(0),
                                   is(model.of_modes), is(model.of_forces)));
    }
    return rows;
}

/// The event and the component of the state of each value that events set.
std::vector<std::string> setters_of(const UnitModel& model) {
    std::vector<std::string> rows;
    for (const auto& [event, place] : model.setters) rows.push_back(fmt::format("{}, {}", event, place));
    return rows;
}

void add_actions(kainjow::mustache::data& file, const UnitModel& model) {
    file.set("actions", list_of(actions_of(model)));
    file.set("states", std::to_string(model.mechanism.states.size()));
    file.set("sets", std::to_string(model.setters.size()));
    file.set("has_sets", !model.setters.empty());
    file.set("setters", list_of(setters_of(model)));
    file.set("has_jumps", model.has_jumps());
    file.set("has_forces",
             std::find(model.of_forces.begin(), model.of_forces.end(), true) != model.of_forces.end());
}

/// The bodies in the order of inertias_at: of how many numbers, which of them are moments that must be possible,
/// and their names.
void add_bodies(kainjow::mustache::data& file, const UnitModel& model) {
    std::vector<std::string> rows;
    for (const MassElement& element : model.mechanism.masses) {
        const bool is_planar = element.origin.kind == Origin::Kind::body &&
                               model.scene.bodies[static_cast<std::size_t>(element.origin.index)].inertia &&
                               model.scene.bodies[static_cast<std::size_t>(element.origin.index)].inertia->planar;
        rows.push_back(fmt::format("{}, {}, \"{}\"", element.rotation ? 10 : 1,
                                   !has_own_moments(model.scene, element) ? "no_moments"
                                   : is_planar                            ? "one_moment"
                                                                          : "moments",
                                   label(element.origin)));
    }
    file.set("has_inertias", model.inertia_function.rows > 0);
    file.set("inertias", std::to_string(model.inertia_function.rows));
    file.set("bodies", std::to_string(rows.size()));
    file.set("body_rows", list_of(rows));
}

/// The watched function of each clock, and in which way its argument tells a zero.
std::vector<std::string> clocks_of(const UnitModel& model) {
    constexpr const char* kinds[] = {"at_zero", "at_sine", "at_cosine", "at_turn"};
    std::vector<std::string> rows;
    for (const TimedZero& clock : model.clocks)
        rows.push_back(fmt::format("{}, {}", clock.watched, kinds[static_cast<int>(clock.kind)]));
    return rows;
}

/// The positions of the outputs that show the inputs and their derivatives.
std::string shown_inputs(const UnitModel& model) {
    std::string result;
    for (const FreeInput& input : model.inputs)
        for (const std::string& name : input.shown) {
            int position = 0;
            for (const Root& root : model.program.roots) {
                if (root.group != Group::output) continue;
                if (root.name == name) break;
                ++position;
            }
            result += fmt::format("{}, ", position);
        }
    return result;
}

/// The sudden times of inputs, and the values of parameters for which they were found. Where others are set, and
/// after the duration of the scene, steps are as short everywhere as the shortest there, but for a bound of their
/// number.
void add_quick_times(kainjow::mustache::data& file, const UnitModel& model) {
    constexpr double most_steps = 1e5;
    const std::vector<InputTimeScale>& quick = model.quick_times;
    file.set("has_quick", !quick.empty());
    if (quick.empty()) return;
    file.set("quick_times", std::to_string(quick.size()));
    file.set("quick", fmt::format("{}", fmt::join(quick_rows(quick), ",\n")));
    double least = HUGE_VAL;
    for (const InputTimeScale& q : quick) least = std::min(least, q.step);
    file.set("quick_least", shortest(std::max(least, model.duration / most_steps)));
    file.set("quick_end", shortest(model.start.t + model.duration));
    std::vector<std::string> follow;
    for (std::size_t k = 0; k < std::min(model.times_follow.size(), model.own_parameters()); ++k)
        if (model.times_follow[k])
            follow.push_back(fmt::format("{{{}, {}}}, ", k, shortest(model.start.parameters[k])));
    file.set("quick_follow_count", std::to_string(follow.size()));
    file.set("quick_follow", fmt::format("{}", fmt::join(follow, "")));
}

void add_start(kainjow::mustache::data& file, const UnitModel& model) {
    std::string initial;
    for (const auto* part : {&model.start.q, &model.start.qdot})
        for (const double x : *part) initial += shortest(x) + ", ";
    file.set("initial", initial);
    std::string given, guesses;
    for (std::size_t i = 0; i < model.given.size(); ++i) {
        given += shortest(model.given[i]) + ", ";
        guesses += model.is_guess[i] ? "1, " : "0, ";
    }
    file.set("given", given);
    file.set("guesses", guesses);
    std::string holonomic;
    for (const Mechanism::Constraint& c : model.mechanism.constraints) holonomic += c.position ? "1, " : "0, ";
    file.set("holonomic", holonomic);
}

}  // namespace

SourceFile unit_source(const UnitModel& model, const std::vector<UnitVariable>& variables, const UnitHead& head) {
    const Program& p = model.program;
    const Vocabulary words(p);
    const std::string scene = ascii_identifier(p.name);
    const std::size_t signs = static_cast<std::size_t>(model.signs), parameters = p.parameters.size();
    kainjow::mustache::data file;
    const auto number = [&file](const char* name, std::size_t value) { file.set(name, std::to_string(value)); };
    file.set("scene", scene);
    file.set("version", ALEMBERT_VERSION);
    file.set("token", head.token);
    file.set("command", comment_text(head.command));
    number("n", words.q().size());
    number("s", words.u().size());
    number("p", parameters);
    number("inputs", model.inputs.size());
    number("first_input", model.own_parameters());
    number("signs", signs);
    number("first_sign", parameters - signs);
    number("events", model.mechanism.events.size());
    number("kicks", p.nodes_of(Group::event_impulse).size() / std::max<std::size_t>(1, words.q().size()));
    number("constraints", p.nodes_of(Group::velocity).size());
    file.set("all_constraints", all_constraints(p));
    number("outputs", p.nodes_of(Group::output).size() + p.nodes_of(Group::speed).size());
    number("multipliers", multipliers_of(p));
    number("variables", variables.size());
    file.set("table", list_of(rows_of(variables)));
    file.set("names", list_of(quoted_names(variables)));
    add_actions(file, model);
    add_bodies(file, model);
    number("clocks", model.clocks.size());
    file.set("has_clocks", !model.clocks.empty());
    file.set("clock_rows", list_of(clocks_of(model)));
    file.set("shown_inputs", shown_inputs(model));
    add_quick_times(file, model);
    add_start(file, model);
    file.set("own_speeds", !p.speeds.empty());
    file.set("start", shortest(model.start.t));
    file.set("tolerance", shortest(model.tolerance));
    file.set("finite", argument::finite);
    file.set("positive", argument::positive);
    file.set("nonnegative", argument::nonnegative);
    file.set("rounded_moment", shortest(rounded_moment));
    const auto has = [&file](const char* name, const FunctionTask& task) {
        file.set(std::string("has_") + name, !task.results.empty());
    };
    has("energy", energy(p)), has("outputs_at", outputs_at(p)), has("events_at", events_at(p));
    has("multipliers_at", multipliers_at(p)), has("constraints_at", constraints_at(p));
    has("project", project(p)), has("impulses_at", impulses_at(p));
    const auto contacts = static_cast<std::size_t>(model.contacts);
    number("contacts", contacts);
    number("first_contact_force", parameters - signs - contacts);
    file.set("has_contacts", contacts > 0);
    file.set("moves_states", contacts > 0 || !project(p).results.empty());
    file.set("watches_energy", !model.moves_contacts && !energy(p).results.empty());
    const std::size_t kicks = model.has_jumps() ? 1 : 0;
    file.set("projection", projection_text(p, CodeLanguage::c,
                                           {.watches_energy = !model.moves_contacts,
                                            .contacts = contacts,
                                            .responses = std::max(contacts, kicks)}));
    const auto rendered = [&file](std::string_view shape) {
        return kainjow::mustache::mustache{std::string(shape)}.render(file);
    };
    file.set("contacts_of_unit", rendered(template_fmu_contacts));
    file.set("instants_of_unit", rendered(template_fmu_instants));
    return {scene + "_fmu.c", rendered(template_fmu_model) + rendered(template_fmu_events) +
                                  rendered(template_fmu_steps) +
                                  rendered(head.version == 2 ? template_fmi2 : template_fmi3)};
}

}  // namespace alembert
