// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/unit_pounds.hpp"

#include <algorithm>
#include <cmath>

namespace alembert {

namespace {

bool is_same(const UnitMeaning& a, const char* symbol) {
    const UnitMeaning b = unit_word(symbol).meaning.value();
    return a.exponents == b.exponents && std::abs(a.factor / b.factor - 1) < 1e-12;
}

/// lbm is a mass whatever stands beside it.
bool is_pound(const WrittenWord& one) {
    const bool is_named_a_mass = one.word.ends_with('m') || one.word.ends_with('M');
    return !is_named_a_mass && (is_same(one.meaning, "lb") || is_same(one.meaning, "oz"));
}

bool is_foot(const WrittenWord& one) {
    return is_same(one.meaning, "ft") || is_same(one.meaning, "in");
}

double exponent_of(const std::vector<WrittenWord>& words, const char* base) {
    double result = 0;
    for (const WrittenWord& one : words)
        if (const auto found = one.meaning.exponents.find(base); found != one.meaning.exponents.end())
            result += found->second * one.power;
    return result;
}

bool has(const std::vector<WrittenWord>& words, const char* symbol) {
    return std::any_of(words.begin(), words.end(),
                       [&](const WrittenWord& one) { return is_same(one.meaning, symbol); });
}

/// Whether a mass times these powers of metres and seconds is a quantity that is seldom one of a mass: a
/// stiffness, a pressure, a torque, or what has time in its numerator.
bool is_like_force(double metres, double seconds) {
    return seconds > 0 || (seconds == 0 && (metres == 1 || metres == -1 || metres == -2));
}

/// In units of the SI that engineers also use for forces only some are: kg/m is a mass per length.
bool is_doubtful(const WrittenWord& mass, const std::vector<WrittenWord>& words, double metres, double seconds) {
    if (is_pound(mass)) return is_like_force(metres, seconds);
    const bool has_cm = has(words, "cm"), has_mm = has(words, "mm");
    if (is_same(mass.meaning, "kg")) return (has_cm || has_mm) && is_like_force(metres, seconds);
    return is_same(mass.meaning, "g") && has_cm && (seconds > 0 || (seconds == 0 && metres == 1));
}

}  // namespace

std::set<std::size_t> pounds_of_force(const std::vector<WrittenWord>& words) {
    std::set<std::size_t> forces;
    if (exponent_of(words, "s") <= -2) return forces;
    const WrittenWord* before = nullptr;
    for (const WrittenWord& one : words) {
        if (before != nullptr && before->power == 1 && one.power == 1) {
            if (is_pound(*before) && is_foot(one)) forces.insert(before->begin);
            if (is_foot(*before) && is_pound(one)) forces.insert(one.begin);
        }
        before = &one;
    }
    return forces;
}

const WrittenWord* doubtful_mass(const std::vector<WrittenWord>& words, const std::set<std::size_t>& forces) {
    const WrittenWord* mass = nullptr;
    for (const WrittenWord& one : words) {
        if (!one.meaning.exponents.contains("kg")) continue;
        if (mass != nullptr || forces.contains(one.begin) || std::abs(one.power) != 1) return nullptr;
        mass = &one;
    }
    const auto is_mechanical = [](const WrittenWord& one) {
        return std::all_of(one.meaning.exponents.begin(), one.meaning.exponents.end(), [](const auto& entry) {
            return std::set<std::string>{"kg", "m", "s", "rad"}.contains(entry.first);
        });
    };
    if (mass == nullptr || !std::all_of(words.begin(), words.end(), is_mechanical)) return nullptr;
    const double metres = mass->power * exponent_of(words, "m"), seconds = mass->power * exponent_of(words, "s");
    return is_doubtful(*mass, words, metres, seconds) ? mass : nullptr;
}

std::string force_of_mass(const UnitMeaning& mass) {
    return is_same(mass, "lb") ? "lbf" : is_same(mass, "oz") ? "ozf" : is_same(mass, "g") ? "gf" : "kgf";
}

}  // namespace alembert
