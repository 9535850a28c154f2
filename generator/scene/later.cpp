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
}

bool is_list(std::string_view name) {
    return name != "polynomial";
}

}  // namespace

std::vector<std::string> later_sections() {
    return {"polynomial"};
}

bool refuse_later(const Reading& reading, const Entry& entry) {
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
    }
    return true;
}

}  // namespace alembert
