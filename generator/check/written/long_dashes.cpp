// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/long_dashes.hpp"

#include <algorithm>
#include <string>

#include "check/written/commands.hpp"
#include "check/written/equation_number.hpp"

namespace alembert {

bool LongDashes::is_minus(std::size_t i) const {
    if (!is_dash(i) || i == 0 || i + 1 >= tokens_.size() || is_dash(i + 1) || is_dash(i - 1)) return false;
    if (before_equation_number(tokens_, 0, tokens_.size()) == i) return false;
    if (is_any_of(i - 1, {Kind::relation, Kind::open})) return is_term_from(i + 1);
    if (depth_before(i) > 0) return true;
    const bool has_before = count_relations(0, i) > 0, has_behind = count_relations(i, tokens_.size()) > 0;
    if (has_before == has_behind) return false;
    // "(2) — x = …": a label has one token, or stands in brackets of its own.
    if (has_behind) return i > 3 && is_term_from(i + 1);
    const bool is_whole = source_(i - 1) == "0" && is_any_of(i - 2, {Kind::relation});
    return !is_whole && is_term_from(i + 1) && tokens_.size() - i > 2;
}

bool LongDashes::is_dash(std::size_t i) const {
    return is_long_dash(tokens_[i]);
}
bool LongDashes::is_any_of(std::size_t i, std::initializer_list<Kind> kinds) const {
    return std::find(kinds.begin(), kinds.end(), tokens_[i].kind) != kinds.end();
}

int LongDashes::depth_before(std::size_t i) const {
    int depth = 0;
    for (std::size_t k = 0; k < i; ++k)
        depth += is_any_of(k, {Kind::open}) ? 1 : is_any_of(k, {Kind::close}) ? -1 : 0;
    return depth;
}

std::ptrdiff_t LongDashes::count_relations(std::size_t from, std::size_t to) const {
    return std::count_if(tokens_.begin() + static_cast<std::ptrdiff_t>(from),
                         tokens_.begin() + static_cast<std::ptrdiff_t>(to),
                         [](const WrittenToken& token) { return token.kind == Kind::relation; });
}

/// Whether no word stands from there to the end of the line: a word has letters of the alphabet alone.
bool LongDashes::is_term_from(std::size_t from) const {
    for (std::size_t k = from; k < tokens_.size(); ++k) {
        if (tokens_[k].kind != Kind::letter) continue;
        const std::string_view word = source_(k);
        const bool is_word = word.size() > 1 && std::all_of(word.begin(), word.end(), [](char c) {
                                 return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
                             });
        if (is_word && command_named(std::string(word)) == nullptr) return false;
    }
    return true;
}

}  // namespace alembert
