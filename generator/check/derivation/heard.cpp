// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/heard.hpp"

#include <algorithm>
#include <cctype>

#include "check/written/sentences.hpp"
#include "check/written/surroundings.hpp"
#include "check/written/words.hpp"

namespace alembert {

void Heard::take_in(const Written& written, const WrittenStatement& statement) {
    const std::string& words = statement.words;
    behind = words_behind(written, statement);
    if (statement.displayed && begins_sentence(behind)) behind.clear();  // "For small r" of the next
    around = words + " " + behind;
    condition_behind = is_conditioned_behind(written, statement);
    if (speaks_of_exact_motion(words)) small = false;
    small = small || statement.first_order || speaks_of_first_order(behind);  // … for small angles
    if (holds_letters(words)) take_in_sentence(words, statement.displayed);
    take_in_conditions(words, is_limit(written, statement, within_sentence));
}

void Heard::take_in_sentence(const std::string& words, bool displayed) {
    std::string lower = words;
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c | 0x20);
    const auto says = [&](std::initializer_list<const char*> list) {
        return std::any_of(list.begin(), list.end(), [&](const char* part) {
            return words.find(part) != std::string::npos || lower.find(part) != std::string::npos;
        });
    };
    no_accelerations = says({"q'' = 0"});
    goes_on = !displayed && joins_formulas(words);  // "sin θ = 0 or cos θ = …"
    frequency = (goes_on && frequency) || speaks_of_frequency(words);
    period = speaks_of_period(words);
    roots = says({"with the roots", "其根"});
    rest = (goes_on && rest) || roots || speaks_of_rest(words);
    if (speaks_of_motion(words)) assumed_rest = impact = false;
    assumed_rest = assumed_rest || mentions_rest(words);
    axes = axes || speaks_of_axes(words);
    turning_axes = turning_axes || speaks_of_turning_axes(words);
    energy_of_accelerations =
        energy_of_accelerations || says({"energy of the accelerations", "Gibbs", "加速度能"});
    abbreviations = says({"intermediate symbols", "abbreviations", "中间符号", "缩写", "简记"});
}

/// "In steady motion", "if the wedge is held": what is said then holds under a condition, until the sentence ends.
void Heard::take_in_conditions(const std::string& words, bool is_limit) {
    if (condition_lines > 0 && !goes_on) --condition_lines;
    if (ends_sentence(words)) condition_lines = 0;
    take_in_steady_motion(words);
    take_in_approximation(words);
    if (is_limit || speaks_of_special_motion(words) || states_condition(words) || is_conditional(words))
        put_under_condition();
    impact = impact || speaks_of_impact(around);
    mentioned_impact = mentioned_impact || mentions_impact(around);
    start_from_rest = start_from_rest || speaks_of_start_from_rest(words);
}

/// "Neglecting the square of Ω" is meant for a few lines.
void Heard::take_in_approximation(const std::string& words) {
    constexpr int most_lines = 5;
    if (neglects_terms(words))
        approximate_lines = most_lines;
    else if (speaks_of_exact_motion(words) || speaks_of_general_case(words))
        approximate_lines = 0;
    else if (approximate_lines > 0)
        --approximate_lines;
}

/// "Steady precession." is meant until the words go on to the motion in general.
void Heard::take_in_steady_motion(const std::string& words) {
    constexpr int most_lines = 8;
    if (mentions_special_motion(words))
        steady_lines = most_lines;
    else if (speaks_of_general_case(words) || speaks_of_motion(words))
        steady_lines = 0;
    else if (steady_lines > 0)
        --steady_lines;
}

}  // namespace alembert
