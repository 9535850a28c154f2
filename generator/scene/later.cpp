// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/later.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "scene/text.hpp"

namespace alembert {
namespace {

void allow(const Table& table, const std::string& name) {
    if (name == "polynomial") table.allow({"coefficients"});
    if (name == "joint")
        table.allow({"name", "type", "parent", "child", "parent_point", "child_point", "parent_rotate",
                     "child_rotate", "axis", "pitch", "coordinates", "angles", "motion"});
}

void add_names(const Table& table, const std::string& section, std::vector<std::string>& names) {
    if (section != "joint") return;
    if (const Entry* const own = table.find("name"); own && own->node->is_string())
        names.push_back(own->node->as_string()->get());
    if (const Entry* const child = table.find("child"); child && child->node->is_string())
        names.push_back(child->node->as_string()->get());
    if (const Entry* const own = table.find("coordinates"); own && own->node->is_table())
        for (const auto& [key, node] : *own->node->as_table()) names.emplace_back(key.str());
}

bool is_list(std::string_view name) {
    return name != "polynomial";
}

}  // namespace

std::vector<std::string> later_sections() {
    return {"joint", "polynomial"};
}

bool refuse_later(const Reading& reading, const Entry& entry, std::vector<std::string>& names) {
    const std::vector<std::string> sections = later_sections();
    if (std::find(sections.begin(), sections.end(), entry.key) == sections.end()) return false;
    const std::string title = is_list(entry.key) ? "[[" + entry.key + "]]" : "[" + entry.key + "]";
    const Place place = std::min(place_of(*entry.node), entry.place);
    reading.complain(place, title + " is not supported yet");
    std::vector<const toml::table*> tables;
    if (const toml::table* const table = entry.node->as_table()) tables.push_back(table);
    if (const toml::array* const list = entry.node->as_array())
        for (const toml::node& node : *list)
            if (const toml::table* const table = node.as_table()) tables.push_back(table);
    for (const toml::table* const node : tables) {
        const Table table(reading, *node, title, place_of(*node));
        allow(table, entry.key);
        add_names(table, entry.key, names);
    }
    return true;
}

}  // namespace alembert
