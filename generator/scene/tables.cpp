// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "base/language/say.hpp"
#include "scene/own_units.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

/// Reads `name = value` or `name = { value, unit, about }`, the forms of parameters and inputs.
template <typename Item>
Item read_item(const Table& table, const Entry& entry, const std::string& what, std::string_view keys_as) {
    Item item{.name = {entry.key, entry.place}, .value = {}, .unit = {}, .about = {}};
    const toml::table* const inner = entry.node->as_table();
    if (entry.key == "gravity" && entry.node->is_array()) {
        table.reading().complain(entry.place,
                                 say("gravity belongs to the whole scene; write it above the first table"));
        return item;
    }
    if (!inner) {
        item.value = read_expression(table.reading(), *entry.node, what);
        return item;
    }
    const Table keys(table.reading(), *inner, what, entry.place);
    keys.allow(keys_as);
    if (const Entry* const value = keys.find("value"))
        item.value = read_expression(table.reading(), *value->node, what);
    else
        keys.complain("value", say("{} needs '{}'", what, "value"));
    item.unit = keys.unit("unit", item.unit_place);
    item.about = keys.text("about");
    if constexpr (std::is_same_v<Item, Input>)
        if (keys.has("given")) {
            item.from_outside = true;
            if (keys.text("given") != "outside")
                keys.complain("given", say("{} is given \"outside\", by whoever runs the equations, or has an "
                                           "expression in t alone; there is no other way",
                                           what));
        }
    return item;
}

void read_parameters(Table table, Scene& scene) {
    for (const Entry& entry : table.entries())
        scene.parameters.push_back(
            read_item<Parameter>(table, entry, labelled(say("parameter"), entry.key), "parameters.*"));
}

void read_inputs(Table table, Scene& scene) {
    for (const Entry& entry : table.entries())
        scene.inputs.push_back(read_item<Input>(table, entry, labelled(say("input"), entry.key), "inputs.*"));
}

}  // namespace

Coordinate read_coordinate(const Reading& reading, const Entry& entry) {
    const std::string what = labelled(say("coordinate"), entry.key);
    Coordinate coordinate{
        .name = {entry.key, entry.place}, .initial = {}, .rate = zero(entry.place), .unit = {}, .about = {}};
    const toml::table* const inner = entry.node->as_table();
    if (entry.key == "gravity" && entry.node->is_array()) {
        reading.complain(entry.place, say("gravity belongs to the whole scene; write it above the first table"));
        return coordinate;
    }
    if (!inner) {
        coordinate.initial = read_expression(reading, *entry.node, what);
        return coordinate;
    }
    const Table keys(reading, *inner, what, entry.place);
    keys.allow("coordinates.*");
    for (const std::string_view key : {"rate", "rate_guess"})
        if (const Entry* const rate = keys.find(key)) coordinate.rate_given = rate->place;
    const auto start = [&](std::string_view key, std::string_view guess, Expression& value, bool& is_guess) {
        is_guess = keys.has(guess);
        if (is_guess && keys.has(key))
            keys.complain(guess, say("{} has both '{}' and '{}'; give one", what, key, guess));
        value = is_guess || keys.has(key) ? keys.expression(is_guess ? guess : key) : zero(entry.place);
    };
    start("initial", "guess", coordinate.initial, coordinate.initial_is_guess);
    start("rate", "rate_guess", coordinate.rate, coordinate.rate_is_guess);
    coordinate.unit = keys.unit("unit", coordinate.unit_place);
    coordinate.about = keys.text("about");
    return coordinate;
}

namespace {

void read_coordinates(Table table, Scene& scene) {
    for (const Entry& entry : table.entries())
        scene.coordinates.push_back(read_coordinate(table.reading(), entry));
}

void read_speeds(Table table, Scene& scene) {
    for (const Entry& entry : table.entries()) {
        const std::string what = labelled(say("speed"), entry.key);
        Speed speed{.name = {entry.key, entry.place}, .form = {}, .initial = {}, .unit = {}, .about = {}};
        if (const toml::table* const inner = entry.node->as_table()) {
            const Table keys(table.reading(), *inner, what, entry.place);
            keys.allow("speeds.*");
            speed.form = keys.needed_expression("form");
            speed.initial = keys.expression("initial");
            speed.unit = keys.unit("unit", speed.unit_place);
            speed.about = keys.text("about");
        } else {
            speed.form = read_expression(table.reading(), *entry.node, what);
        }
        scene.speeds.push_back(std::move(speed));
    }
}

void read_states(Table table, Scene& scene) {
    for (const Entry& entry : table.entries()) {
        const std::string what = labelled(say("state"), entry.key);
        FirstOrderState state{
            .name = {entry.key, entry.place}, .rate = {}, .initial = zero(entry.place), .unit = {}, .about = {}};
        if (const toml::table* const inner = entry.node->as_table()) {
            const Table keys(table.reading(), *inner, what, entry.place);
            keys.allow("states.*");
            state.rate = keys.expression("rate");
            if (keys.has("initial")) state.initial = keys.expression("initial");
            state.unit = keys.unit("unit", state.unit_place);
            state.about = keys.text("about");
        } else {
            table.reading().complain(
                entry.place,
                say("{} is {}; expected its rate and where it starts: {} = {{ rate = \"…\", initial = 0 }}", what,
                    kind_of(*entry.node), entry.key));
        }
        scene.states.push_back(std::move(state));
    }
}

/// (x)*ex(N) + (y)*ey(N) + (z)*ez(N)
Expression along_N(const Vector& vector, const Reading& reading) {
    if (!vector.component[0] || !vector.component[1] || !vector.component[2]) return {};
    std::string text;
    std::vector<Place> places;
    const auto write = [&](const std::string& words) {
        text += words;
        places.insert(places.end(), words.size(), vector.place);
    };
    for (std::size_t k = 0; k < 3; ++k) {
        const Expression& component = vector.component[k];
        write(k == 0 ? "(" : " + (");
        text += component.text;
        for (std::size_t i = 0; i < component.text.size(); ++i)
            places.push_back(component.place(static_cast<int>(i)));
        write(fmt::format(")*e{}(N)", "xyz"[k]));
    }
    places.push_back(vector.place);
    return parse_expression(std::move(text), std::move(places), reading.diagnostics, &reading.names);
}

void read_definitions(Table table, Scene& scene) {
    for (const Entry& entry : table.entries()) {
        const std::string what = labelled(say("definition"), entry.key);
        const bool has_components = entry.node->is_array();
        scene.definitions.push_back(
            {.name = {entry.key, entry.place},
             .value = has_components ? along_N(read_vector(table.reading(), *entry.node, what), table.reading())
                                     : read_expression(table.reading(), *entry.node, what),
             .has_components = has_components});
    }
}

void read_functions(Table table, Scene& scene) {
    constexpr std::size_t most_arguments = 4;
    for (const Entry& entry : table.entries()) {
        UnspecifiedFunction made{
            {entry.key, entry.place},
            read_names(table.reading(), *entry.node, labelled(say("the arguments of function"), entry.key))};
        if (made.arguments.size() > most_arguments || (made.arguments.empty() && entry.node->is_array()))
            table.reading().complain(entry.place,
                                     say("a function has one to {} arguments, as in V = [\"r\"]; {} has {}",
                                         most_arguments, in_quotes(entry.key), made.arguments.size()));
        scene.functions.push_back(std::move(made));
    }
}

void read_units(Table table, Scene& scene) {
    std::vector<UnitDefinition> definitions;
    std::vector<std::vector<Place>> places;
    for (const Entry& entry : table.entries()) {
        std::optional<Literal> value = table.plain_text(entry.key);
        if (!value) continue;
        definitions.push_back({entry.key, std::move(value->text)});
        places.push_back(std::move(value->places));
    }
    scene.units = own_units(definitions, [&](std::size_t which, std::size_t offset, const std::string& why) {
        table.reading().complain(places[which][std::min(offset, places[which].size() - 1)],
                                 say("the unit {} of [units]: {}", in_quotes(definitions[which].name), why));
    });
}

void read_letters(Table table, Scene& scene) {
    const KnownNames& names = table.reading().names;
    for (const Entry& entry : table.entries()) {
        std::optional<Name> name =
            read_name(table.reading(), *entry.node, labelled(say("the name for the letter"), entry.key));
        if (!name) continue;
        // Rates too: "\\omega" = "phi'". And what derivations call by these letters.
        const std::size_t primes = std::min(name->text.find('\''), name->text.size());
        const std::string stem = names.spelled(name->text.substr(0, primes));
        const bool is_quantity = std::string_view("T V L E H t").find(stem) != std::string_view::npos;
        if (!names.has(stem) && !(is_quantity && stem.size() == 1))
            table.reading().complain(
                name->place, say("the letter {} stands for {}, which the scene does not have; expected one "
                                 "of its names, as in \"\\\\ell\" = \"l\"",
                                 in_quotes(entry.key), in_quotes(name->text)));
        name->text = stem + name->text.substr(primes);
        scene.letters.push_back({{entry.key, entry.place}, *std::move(name)});
    }
}

void read_energy(Table table, Scene& scene) {
    table.allow("energy");
    scene.kinetic = table.expression("kinetic");
    scene.potential = table.expression("potential");
    scene.lagrangian = table.expression("lagrangian");
    if (table.has("lagrangian") && (table.has("kinetic") || table.has("potential")))
        table.complain("lagrangian",
                       say("'lagrangian' stands for the whole energy; leave out 'kinetic' and 'potential'"));
}

void read_dissipation(Table table, Scene& scene) {
    table.allow("dissipation");
    scene.rayleigh = table.needed_expression("rayleigh");
}

}  // namespace

void read_forces(Table table, Scene& scene) {
    for (const Entry& entry : table.entries())
        scene.generalized_forces.push_back(
            {{table.reading().names.spelled(entry.key), entry.place},
             read_expression(table.reading(), *entry.node, labelled(say("the force along"), entry.key))});
}

namespace {

void read_impulses(Table table, Scene& scene) {
    for (const Entry& entry : table.entries())
        scene.generalized_impulses.push_back(
            {{table.reading().names.spelled(entry.key), entry.place},
             read_expression(table.reading(), *entry.node, labelled(say("the impulse along"), entry.key))});
}

void read_outputs(Table table, Scene& scene) {
    for (const Entry& entry : table.entries())
        scene.outputs.push_back(
            {{entry.key, entry.place},
             read_expression(table.reading(), *entry.node, labelled(say("output"), entry.key))});
}

}  // namespace

std::span<const TableReader> symbol_sections() {
    static constexpr TableReader all[] = {
        {"parameters", read_parameters}, {"inputs", read_inputs},       {"coordinates", read_coordinates},
        {"speeds", read_speeds},         {"states", read_states},       {"definitions", read_definitions},
        {"functions", read_functions},   {"tables", read_point_tables}, {"letters", read_letters},
        {"units", read_units},           {"energy", read_energy},       {"dissipation", read_dissipation},
        {"forces", read_forces},         {"impulses", read_impulses},   {"outputs", read_outputs},
    };
    return all;
}

}  // namespace alembert
