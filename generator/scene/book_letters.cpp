// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/book_letters.hpp"

#include <algorithm>
#include <array>

namespace alembert {

namespace {

constexpr std::array plain_letters{"T", "V", "L", "E", "H", "deltaW"};

bool is_declared(const std::string& name, const NameSpaces& names) {
    return NameSpaces::find(names.values, name) != nullptr;
}

bool is_coordinate(const std::string& name, const NameSpaces& names) {
    const Declared* const declared = NameSpaces::find(names.values, name);
    return declared != nullptr && declared->kind == Declared::Kind::coordinate;
}

}  // namespace

std::string after_prefix(const std::string& name, const std::string& prefix) {
    return name.starts_with(prefix) ? name.substr(prefix.size()) : std::string();
}

bool is_book_letter(const std::string& name, const NameSpaces& names) {
    if (is_declared(name, names)) return false;
    if (std::find(plain_letters.begin(), plain_letters.end(), name) != plain_letters.end()) return true;
    return is_coordinate(after_prefix(name, "Q_"), names) || is_coordinate(after_prefix(name, "delta_"), names);
}

bool is_book_call(const Tree& call, const NameSpaces& names) {
    if (call.kind != Tree::Kind::call || is_declared(call.text, names)) return false;
    return call.text == "T" || call.text == "V" || call.text == book_inertia ||
           is_coordinate(after_prefix(call.text, "Q_"), names);
}

std::vector<std::string> reaction_letters(const Scene& scene, const NameSpaces& names) {
    std::vector<std::string> result;
    const auto add = [&](const std::string& name) {
        if (!is_declared(name, names)) result.push_back(name);
    };
    for (const RollingRule& rolling : scene.rolling) add("N_" + rolling.name.text);
    for (const Joint& joint : scene.joints)
        for (const char* letter : {"F_x_", "F_y_", "F_z_", "M_x_", "M_y_", "M_z_"}) add(letter + joint.name.text);
    return result;
}

std::vector<std::string> book_letters(const Scene& scene, const NameSpaces& names) {
    std::vector<std::string> result = reaction_letters(scene, names);
    const auto add = [&](const std::string& name) {
        if (!is_declared(name, names)) result.push_back(name);
    };
    for (const char* letter : plain_letters) add(letter);
    for (const auto& [name, declared] : names.values)
        if (declared.kind == Declared::Kind::coordinate)
            for (const char* prefix : {"p_", "Q_", "delta_"}) add(prefix + name);
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace alembert
