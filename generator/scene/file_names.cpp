// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/file_names.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/own_units.hpp"
#include "scene/typed.hpp"

namespace alembert {

namespace {

const toml::array* list_of(const toml::table& scene, std::string_view name) {
    return scene[name].as_array();
}

/// The tables of a list, `[[name]]`.
template <typename Use>
void each_of(const toml::table& scene, std::string_view name, const Use& use) {
    if (const toml::array* const list = list_of(scene, name))
        for (const toml::node& node : *list)
            if (const toml::table* const table = node.as_table()) use(*table);
}

void add_keys(const toml::node_view<const toml::node>& node, KnownNames& names, bool moves) {
    if (const toml::table* const table = node.as_table())
        for (const auto& [key, value] : *table) names.add(std::string(key.str()), moves);
}

void add_texts(const toml::node_view<const toml::node>& node, KnownNames& names) {
    if (const toml::array* const list = node.as_array())
        for (const toml::node& one : *list)
            if (const auto* const text = one.as_string()) names.add(text->get());
}

/// The multipliers of a rule, and others that its name gives.
void add_multipliers(const std::string& name, std::string_view kind, KnownNames& names) {
    const std::string stem = "lambda_" + name;
    names.add(stem);
    if (kind == "rolling")
        for (const char* const axis : {"_x", "_y", "_z"}) names.add(stem + axis);
    if (kind == "joint")
        for (int k = 1; k <= 6; ++k) names.add(fmt::format("{}_{}", stem, k));
}

/// What is wrong with them is told where [units] is read.
OwnUnits units_in(const toml::node_view<const toml::node>& node) {
    std::vector<UnitDefinition> definitions;
    if (const toml::table* const table = node.as_table())
        for (const auto& [key, value] : *table) {
            UnitDefinition one{plain_name(std::string(key.str())), value.value_or(std::string())};
            std::vector<Place> none;
            write_plainly(one.value, none);
            definitions.push_back(std::move(one));
        }
    return own_units(definitions, [](std::size_t, std::size_t, const std::string&) {});
}

}  // namespace

KnownNames names_in(const toml::table& scene) {
    KnownNames names;
    names.set_units(units_in(scene["units"]));
    for (const std::string_view table : {"coordinates", "speeds", "states", "inputs", "definitions"})
        add_keys(scene[table], names, true);
    for (const std::string_view table : {"parameters", "functions", "tables", "outputs"})
        add_keys(scene[table], names, false);
    for (const std::string_view list :
         {"frame", "point", "particle", "body", "joint", "constraint", "rolling", "unilateral", "friction"})
        each_of(scene, list, [&](const toml::table& one) {
            const std::string name = one["name"].value_or(std::string());
            if (name.empty()) return;
            names.add(name);
            add_multipliers(name, list, names);
            if (const auto own = one["multiplier"].value<std::string>()) names.add(*own);
        });
    each_of(scene, "joint", [&](const toml::table& joint) {
        for (const std::string_view key : {"coordinates", "motion"}) add_keys(joint[key], names, true);
    });
    each_of(scene, "claim", [&](const toml::table& claim) {
        for (const std::string_view key : {"unknowns", "constants"}) add_texts(claim[key], names);
    });
    return names;
}

}  // namespace alembert
