// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/scene_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/functions.hpp"
#include "scene/text.hpp"

namespace alembert {

std::string scene_number(double value) {
    return value == 0 ? "0" : fmt::format("{}", value);
}

std::string scene_vector(const Real3& v) {
    return fmt::format("[{}, {}, {}]", scene_number(v[0]), scene_number(v[1]), scene_number(v[2]));
}

std::string scene_text(const std::string& text) {
    std::string result = "\"";
    for (std::size_t i = 0; i < text.size();) {
        const char32_t c = decode(text, i);
        if (c == U'"' || c == U'\\') result += '\\';
        result += c == invalid_character || is_disturbing(c) ? "?" : encode(c);
    }
    return result + "\"";
}

std::string scene_angle(double value) {
    const std::optional<int> k = twelfths_of_pi(value);
    if (!k) return scene_number(value);
    const int by = std::gcd(*k, 12), over = 12 / by, times = *k / by;
    return fmt::format("\"{}pi{}\"",
                       times == 1    ? ""
                       : times == -1 ? "-"
                                     : fmt::format("{}*", times),
                       over == 1 ? "" : fmt::format("/{}", over));
}

std::string scene_axis(const Real3& a) {
    for (int k = 0; k < 3; ++k)
        if (a[k] > 0 && a[(k + 1) % 3] == 0 && a[(k + 2) % 3] == 0) return fmt::format("\"{}\"", "xyz"[k]);
    return scene_vector(a);
}

std::string scene_list(const std::vector<std::string>& list) {
    return fmt::format("[{}]", fmt::join(list, ", "));
}

std::string scene_key(const std::string& name) {
    return std::all_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; })
               ? name
               : "\"" + name + "\"";
}

void add_term(std::string& sum, double factor, const std::string& what) {
    if (factor == 0) return;
    const double size = std::abs(factor);
    const std::string term = what.empty() ? scene_number(size)
                             : size == 1  ? what
                                          : fmt::format("{}*{}", scene_number(size), what);
    sum += sum.empty() ? (factor < 0 ? "-" : "") : factor < 0 ? " - " : " + ";
    sum += term;
}

const char* joint_word(Robot::Type type) {
    switch (type) {
        case Robot::Type::fixed:
            return "fixed";
        case Robot::Type::revolute:
        case Robot::Type::continuous:
            return "revolute";
        case Robot::Type::prismatic:
            return "prismatic";
        case Robot::Type::planar:
            return "planar";
        case Robot::Type::floating:
            return "free";
        case Robot::Type::spherical:
            return "spherical";
        case Robot::Type::universal:
            return "universal";
        case Robot::Type::screw:
            return "screw";
        case Robot::Type::cylindrical:
            return "cylindrical";
    }
    return "";
}

std::string SceneNames::given(const std::string& wanted) {
    std::string name;
    for (std::size_t i = 0; i < wanted.size();) {
        const char32_t c = decode(wanted, i);
        const bool fits = c != invalid_character && (is_letter(c) || (is_digit(c) && !name.empty()));
        if (!fits && name.empty() && is_digit(c)) name = "_";
        name += fits || is_digit(c) ? encode(c) : "_";
    }
    if (name.empty()) name = "unnamed";
    while (!taken_.insert(name).second || is_reserved_function(name)) name += "_";
    return name;
}

}  // namespace alembert
