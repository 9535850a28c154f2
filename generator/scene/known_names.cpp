// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/known_names.hpp"

#include <utility>
#include <vector>

#include "base/language/greek.hpp"
#include "scene/book_letters.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/text.hpp"
#include "scene/typed.hpp"

namespace alembert {

namespace {

bool is_latin(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// The word with its Greek letters spelled out: "theta_1" for "θ_1". A letter after a Latin one stays, so that
/// "bη" is not "beta".
std::string spelled_out(std::string_view word) {
    std::string result;
    for (std::size_t i = 0; i < word.size();) {
        const std::size_t begin = i;
        decode(word, i);
        const std::string_view letter = word.substr(begin, i - begin);
        const GreekLetter* const greek = letter.size() > 1 ? greek_of(letter) : nullptr;
        const bool is_apart = begin == 0 || !is_latin(word[begin - 1]);
        result +=
            greek != nullptr && is_apart ? greek->name.substr(greek->name.starts_with("var") ? 3 : 0) : letter;
    }
    return result;
}

/// Letters with dots that are one character.
constexpr std::pair<std::string_view, std::string_view> dotted[] = {
    {"ẋ", "x'"}, {"ẍ", "x''"}, {"ẏ", "y'"}, {"ÿ", "y''"}, {"ż", "z'"},
    {"ṙ", "r'"}, {"ṡ", "s'"},  {"ṗ", "p'"}, {"ḣ", "h'"},  {"Ẋ", "X'"}};

constexpr std::pair<std::string_view, std::string_view> rate_suffixes[] = {
    {"_ddot", "''"}, {"ddot", "''"}, {"dotdot", "''"}, {"_dot", "'"}, {"dot", "'"}, {"Dot", "'"}};

}  // namespace

KnownNames::KnownNames(const Scene& scene) : units_(scene.units) {
    using Kind = Declared::Kind;
    std::vector<Diagnostic> none;
    const NameSpaces names = declare(scene, none);
    for (const NameSpaces::Space* const space : {&names.values, &names.frames, &names.points})
        for (const auto& [name, declared] : *space)
            add(name, declared.kind == Kind::coordinate || declared.kind == Kind::speed ||
                          declared.kind == Kind::state || declared.kind == Kind::input ||
                          declared.kind == Kind::definition);
    for (const Output& output : scene.outputs) add(output.name.text);
    for (const std::string& letter : book_letters(scene, names))
        if (letter.find('_') != std::string::npos) add(letter, true);  // Q_θ; T alone may be a unit
}

void KnownNames::add(const std::string& given, bool moves) {
    const std::string name = plain_name(given);
    const auto [known, is_new] = names_.emplace(name, moves);
    known->second = known->second || moves;
    if (!is_new) return;
    const auto [spelling, is_first] = by_spelling_.emplace(spelled_out(name), name);
    if (!is_first) spelling->second.clear();
}

bool KnownNames::moves(const std::string& name) const {
    const auto known = names_.find(name);
    return known != names_.end() && known->second;
}

std::string KnownNames::meant(const std::string& word) const {
    if (has(word)) return word;
    const auto known = by_spelling_.find(spelled_out(word));
    return known == by_spelling_.end() ? std::string() : known->second;
}

std::string KnownNames::spelled(const std::string& word) const {
    const std::string name = meant(word);
    return name.empty() ? word : name;
}

std::string KnownNames::rate_meant(const std::string& word) const {
    for (const auto& [letter, rate] : dotted)
        if (word == letter && moves(std::string(rate.substr(0, 1)))) return std::string(rate);
    for (const auto& [suffix, primes] : rate_suffixes) {
        if (!word.ends_with(suffix) || word.size() == suffix.size()) continue;
        const std::string name = meant(word.substr(0, word.size() - suffix.size()));
        if (moves(name)) return name + std::string(primes);
    }
    return {};
}

}  // namespace alembert
