// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/surroundings.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include "check/written/words.hpp"

namespace alembert {

std::string words_behind(const Written& written, const WrittenStatement& statement) {
    constexpr std::size_t most = 80;
    std::size_t begin = statement.offset + statement.length;
    if (begin >= written.text.size()) return {};
    std::string rest = written.text.substr(begin, most);
    const std::size_t opened = rest.find_first_not_of("$ \n)\\");
    const std::size_t blank_line = rest.find("\n\n");
    if (opened == std::string::npos || blank_line < opened) return {};
    rest.erase(0, opened);
    std::size_t end = rest.find_first_of("$.\n\\;");
    for (const char* const stop : {"。", "；"}) end = std::min(end, rest.find(stop));
    return rest.substr(0, end);
}

bool is_conditioned_behind(const Written& written, const WrittenStatement& statement) {
    const std::size_t end = statement.offset + statement.length;
    std::string_view after = std::string_view(written.text).substr(std::min(end, written.text.size()));
    after.remove_prefix(std::min(after.find_first_not_of("$ )\\"), after.size()));
    for (const std::string_view condition : {"の場合", "のとき", "ならば", "时，", "时,"})
        if (after.starts_with(condition)) return true;
    const std::size_t open =
        written.text.find('$', std::min(written.text.find_first_not_of("$ ", end), written.text.size()));
    if (open == std::string::npos || open > end + 24) return false;
    const std::size_t close = written.text.find('$', open + 1);
    if (close == std::string::npos || close > open + 80) return false;
    std::string words = written.text.substr(end, open - end);
    std::erase_if(words, [](char c) { return c == '$' || c == ' ' || c == ',' || c == '\n'; });
    static const std::set<std::string> conditions{"at",   "when", "if",   "for", "bei", "falls", "wenn",
                                                  "für",  "在",   "当",   "en",  "si",  "pour",  "при",
                                                  "если", "per",  "para", "dla", "gdy", "för",   "om"};
    return conditions.contains(words) && written.text.substr(open, close - open).find('=') != std::string::npos;
}

std::string in_whole_brackets(const std::string& text, std::size_t begin, std::size_t end) {
    end = std::min(end, text.size());
    begin = std::min(begin, end);
    constexpr std::string_view opening = "([{", closing = ")]}";
    std::string open;  // those that are not closed
    std::string lost;  // those that close none
    for (std::size_t k = begin; k < end; ++k) {
        if (k > 0 && text[k - 1] == '\\' && (text[k] == '[' || text[k] == ']' || text[k] == '(' || text[k] == ')'))
            continue;  // \[ begins a formula
        if (opening.find(text[k]) != std::string_view::npos) open += text[k];
        const std::size_t kind = closing.find(text[k]);
        if (kind == std::string_view::npos) continue;
        if (!open.empty() && open.back() == opening[kind])
            open.pop_back();
        else
            lost += opening[kind];
    }
    static constexpr std::string_view before[] = {"\\right", "\\bigr", "\\Bigr", "\\big", "\\Big", " "};
    while (!open.empty() && end < text.size()) {
        std::size_t at = end;
        for (const std::string_view word : before)
            if (std::string_view(text).substr(at).starts_with(word)) at += word.size();
        if (at >= text.size() || text[at] != closing[opening.find(open.back())]) break;
        end = at + 1;
        open.pop_back();
    }
    static constexpr std::string_view behind[] = {"\\left", "\\bigl", "\\Bigl", "\\big", "\\Big"};
    for (std::size_t k = 0; k < lost.size() && begin > 0; ++k) {
        std::size_t at = begin;
        while (at > 0 && text[at - 1] == ' ') --at;
        if (at == 0 || text[at - 1] != lost[k]) break;
        begin = at - 1;
        for (const std::string_view word : behind)
            if (std::string_view(text).substr(0, begin).ends_with(word)) begin -= word.size();
    }
    return text.substr(begin, end - begin);
}

bool is_limit(const Written& written, const WrittenStatement& statement, std::size_t most) {
    const std::size_t from = statement.offset > most ? statement.offset - most : 0;
    std::string before = written.text.substr(from, statement.offset - from);
    before.resize(before.find_last_not_of(" \t\r\n$[\\") + 1);  // what opens a display
    for (const char* const stop : {". ", ".\n", "。", "\n\n"})
        if (const std::size_t end = before.rfind(stop); end != std::string::npos) before.erase(0, end + 1);
    if (denies_limit(before)) return false;
    static constexpr const char* limits[] = {
        "\\gg",  "\\ll", "≫",           "≪",    ">>",  "<<",   "\\infty", "∞",  "\\to 0",        "\\to0",
        "-> oo", "->oo", "-> infinity", "-> 0", "->0", "→ oo", "→ 0",     "→0", "\\rightarrow 0"};
    return std::any_of(std::begin(limits), std::end(limits),
                       [&](const char* limit) { return before.find(limit) != std::string::npos; });
}

}  // namespace alembert
