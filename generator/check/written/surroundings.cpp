// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/surroundings.hpp"

#include <algorithm>
#include <set>

namespace alembert {

std::string words_behind(const Written& written, const WrittenStatement& statement) {
    constexpr std::size_t most = 80;
    std::size_t begin = statement.offset + statement.length;
    if (begin >= written.text.size()) return {};
    std::string rest = written.text.substr(begin, most);
    const std::size_t opened = rest.find_first_not_of("$ \n)\\");
    if (opened == std::string::npos) return {};
    rest.erase(0, opened);
    std::size_t end = rest.find_first_of("$.\n\\;");
    for (const char* const stop : {"。", "；"}) end = std::min(end, rest.find(stop));
    return rest.substr(0, end);
}

bool is_conditioned_behind(const Written& written, const WrittenStatement& statement) {
    const std::size_t end = statement.offset + statement.length;
    const std::size_t open =
        written.text.find('$', std::min(written.text.find_first_not_of("$ ", end), written.text.size()));
    if (open == std::string::npos || open > end + 24) return false;
    const std::size_t close = written.text.find('$', open + 1);
    if (close == std::string::npos || close > open + 80) return false;
    std::string words = written.text.substr(end, open - end);
    std::erase_if(words, [](char c) { return c == '$' || c == ' ' || c == ',' || c == '\n'; });
    static const std::set<std::string> conditions{"at",  "when", "if", "for", "bei", "falls", "wenn",
                                                  "für", "在",   "当", "en",  "si",  "pour"};
    return conditions.contains(words) && written.text.substr(open, close - open).find('=') != std::string::npos;
}

bool is_limit(const Written& written, const WrittenStatement& statement) {
    constexpr std::size_t most = 60;
    const std::size_t from = statement.offset > most ? statement.offset - most : 0;
    std::string before = written.text.substr(from, statement.offset - from);
    for (const char* const stop : {". ", ".\n", "。", "\n\n"})
        if (const std::size_t end = before.rfind(stop); end != std::string::npos) before.erase(0, end + 1);
    static constexpr const char* limits[] = {"\\infty", "∞", "\\to 0", "\\to0", "→ 0", "→0", "\\rightarrow 0"};
    return std::any_of(std::begin(limits), std::end(limits),
                       [&](const char* limit) { return before.find(limit) != std::string::npos; });
}

}  // namespace alembert
