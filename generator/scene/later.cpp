// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/later.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "scene/text.hpp"

namespace alembert {
namespace {

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
    return true;
}

}  // namespace alembert
