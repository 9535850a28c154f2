// SPDX-License-Identifier: GPL-2.0-or-later
// What a word of plain text says of its letter: index and dots.

#include <string>
#include <string_view>
#include <utility>

#include "base/language/greek.hpp"
#include "check/written/tokens.hpp"

namespace alembert {

namespace {

/// Takes "_ddot", "dot" … off the end of a word, if a letter stays.
int take_dots(std::string& word) {
    for (const auto& [suffix, dots] : {std::pair{"_dddot", 3}, {"_ddot", 2}, {"_dot", 1}, {"_dd", 2}, {"_d", 1}}) {
        const std::string_view text = suffix;
        if (text == "_d" || text == "_dd" || !word.ends_with(text) || word.size() == text.size()) continue;
        word.resize(word.size() - text.size());
        return dots;
    }
    for (const auto& [suffix, dots] : {std::pair{"dddot", 3}, {"ddot", 2}, {"dot", 1}}) {
        const std::string_view text = suffix;
        if (!word.ends_with(text)) continue;
        const std::string rest = word.substr(0, word.size() - text.size());
        std::string base = rest.substr(0, rest.find('_'));
        while (base.size() > 1 && base.back() >= '0' && base.back() <= '9') base.pop_back();
        if (base.size() != 1 && greek_named(base) == nullptr) return 0;
        word = rest;
        return dots;
    }
    return 0;
}

}  // namespace

std::pair<Letter, int> letter_of_word(std::string word) {
    Letter letter;
    int dots = take_dots(word);
    std::string index;
    if (const std::size_t line = word.find('_'); line != std::string::npos && line > 0) {
        index = word.substr(line + 1);
        word.resize(line);
        if (dots == 0) dots = take_dots(word);
        for (const auto& [prefix, order] : {std::pair{"dot_", 1}, {"ddot_", 2}, {"dddot_", 3}})  // theta_dot_1
            if (dots == 0 && index.starts_with(prefix)) {
                dots = order;
                index = index.substr(std::string_view(prefix).size());
                break;
            }
    }
    std::size_t end = word.size();
    while (end > 1 && word[end - 1] >= '0' && word[end - 1] <= '9') --end;
    if (word.find_first_of("0123456789") == end && end < word.size()) {
        index = word.substr(end) + (index.empty() ? "" : "," + index);
        word.resize(end);
        if (dots == 0) dots = take_dots(word);
    }
    if (word == "lamda" || word == "lambd") word = "lambda";
    letter.base = std::move(word);
    letter.index = std::move(index);
    return {letter, dots};
}

}  // namespace alembert
