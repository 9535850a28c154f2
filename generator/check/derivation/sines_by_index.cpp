// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/sines_by_index.hpp"

#include <algorithm>

#include "check/derivation/parts.hpp"
#include "scene/concluded_dimensions.hpp"

namespace alembert {

namespace {

/// The coordinates that are lengths, as far as it is known.
std::set<std::string> lengths(const Scene& scene) {
    std::set<std::string> result;
    for (const ConcludedDimension& one : concluded_dimensions(scene))
        if (one.dimension && !one.dimension->empty()) result.insert(one.name);
    return result;
}

std::string digits_of(const Letter& letter) {
    std::string digits = letter.index;
    std::erase_if(digits, [](char c) { return c == ',' || c == ' '; });
    return digits;
}

}  // namespace

std::vector<std::pair<Letter, std::string>> sines_by_index(const Written& written, const Letters& letters,
                                                           const Scene& scene) {
    std::set<Letter> stated;
    std::map<Letter, int> all;
    for (const WrittenStatement& statement : written.statements)
        for (const MathPtr& side : statement.sides) {
            collect_letters(*side, all);
            if (side->kind == Math::Kind::letter && statement.sides.size() > 1) stated.insert(side->letter);
        }
    std::vector<std::pair<Letter, std::string>> result;
    std::optional<std::set<std::string>> no_angles;
    bool has_sine = false, has_cosine = false;
    for (const auto& item : all) {
        const Letter& letter = item.first;
        const bool is_sine = letter.base == "s" || letter.base == "S",
                   is_cosine = letter.base == "c" || letter.base == "C";
        const std::string digits = digits_of(letter);
        if ((!is_sine && !is_cosine) || !is_count(digits) || !letter.accent.empty() || !letter.raised.empty() ||
            letters.name_of(letter))
            continue;
        if (!no_angles) no_angles = lengths(scene);
        const bool is_difference = letters.reads_sines_of_differences() && digits.size() == 2;
        std::string angle;
        for (const char digit : digits) {
            const std::string coordinate = letters.coordinate_of(std::string(1, digit));
            if (coordinate.empty() || !coordinate.ends_with(digit) || no_angles->contains(coordinate)) return {};
            angle += (angle.empty() ? "" : is_difference ? "-" : "+") + coordinate;
        }
        (is_sine ? has_sine : has_cosine) = true;
        if (!stated.contains(letter)) result.emplace_back(letter, (is_sine ? "sin(" : "cos(") + angle + ")");
    }
    return has_sine && has_cosine ? result : std::vector<std::pair<Letter, std::string>>{};
}

}  // namespace alembert
