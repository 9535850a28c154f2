// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/general_law.hpp"

#include <algorithm>
#include <array>

#include "check/derivation/claim_text.hpp"

namespace alembert {

namespace {

bool has_sum_sign(const Math& math) {
    return (math.kind == Math::Kind::call && math.text == "sum") ||
           std::any_of(math.args.begin(), math.args.end(), [](const MathPtr& arg) { return has_sum_sign(*arg); });
}

/// q_i, Q_r: an index that counts coordinates.
bool counts(const std::string& index) {
    static constexpr std::array<const char*, 7> counters{"i", "j", "k", "r", "s", "q", "alpha"};
    return std::find(counters.begin(), counters.end(), index) != counters.end();
}

bool is_general(const Letter& letter, int dots, const Letters& letters, bool displayed) {
    if (letters.is_authors(letter)) return false;
    if (const auto name = letters.name_of(letter))  // a charge q has no rate
        return !displayed && letter.base == "q" && dots > 0 && letters.is_of_scene(*name) && !letters.moves(*name);
    const bool is_inertia_force = letter.base == "F" && letter.raised == "*";
    if (!displayed && letter.index.empty() && (letter.base == "Q" || is_inertia_force)) return true;
    if (!displayed && letter.base == "A" && letter.raised == "T") return true;
    if (!displayed && letter.base == "u" && letter.index.empty()) return true;
    if (letter.index.empty()) return letter.base == "q";
    const bool general = letter.base == "q" || letter.base == "Q" || letter.base == "p";
    return general && counts(letter.index) && letters.coordinate_of(letter.index).empty();
}

}  // namespace

bool states_general_law(const Math& side, const Letters& letters, bool displayed) {
    if (!displayed && has_sum_sign(side)) return true;
    std::map<Letter, int> all;
    collect_letters(side, all);
    const bool is_of_scene = std::any_of(all.begin(), all.end(), [&](const auto& item) {
        return letters.moves(letters.name_of(item.first).value_or(""));
    });
    if (is_of_scene && !all.contains(Letter{.base = "Q"})) all.erase(Letter{.base = "q"});  // a charge beside r, θ
    return std::any_of(all.begin(), all.end(),
                       [&](const auto& item) { return is_general(item.first, item.second, letters, displayed); });
}

}  // namespace alembert
