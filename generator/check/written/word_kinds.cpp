// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/word_kinds.hpp"

#include <algorithm>

#include "base/language/greek.hpp"
#include "check/written/commands.hpp"
#include "check/written/sentences.hpp"

namespace alembert {

bool is_word_for_constant(std::string_view word) {
    static constexpr std::string_view names[] = {
        "const",     "const.",    "constant", "konst",     "konst.", "konstante", "konstant", "constante",
        "cte",       "cst",       "常数",     "常量",      "恒量",   "常值",      "cste",     "cst.",
        "cte.",      "costante",  "cost.",    "konstanta", "stała",  "stały",     "stałe",    "постоянная",
        "постоянно", "постоянна", "конст",    "一定",      "定数"};
    return std::find(std::begin(names), std::end(names), in_lower_case(word)) != std::end(names);
}

bool is_word_for_letter(std::string_view word) {
    if (word.empty() || word.size() > 40) return false;
    if (is_word_for_constant(word)) return true;
    static constexpr std::string_view no_names[] = {
        "and",      "or",        "where",     "with",   "for",    "if",      "when",      "so",    "thus",
        "hence",    "therefore", "otherwise", "then",   "since",  "because", "at",        "as",    "in",
        "on",       "is",        "are",       "gives",  "yields", "implies", "similarly", "also",  "while",
        "but",      "by",        "from",      "let",    "using",  "we",      "that",      "which", "und",
        "oder",     "mit",       "also",      "wo",     "wenn",   "falls",   "bei",       "somit", "daher",
        "folglich", "gilt",      "avec",      "donc",   "pour",   "donde",   "cuando",    "luego", "entonces",
        "dove",     "quindi",    "dunque",    "quando", "allora", "onde",    "portanto",  "oraz",  "gdzie",
        "gdy",      "dla",       "zatem",     "czyli",  "och",    "eller"};
    if (std::find(std::begin(no_names), std::end(no_names), in_lower_case(word)) != std::end(no_names))
        return false;
    return std::all_of(word.begin(), word.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '.' || c == '-';
    });
}

bool is_prose(std::string_view word) {
    static constexpr std::string_view short_words[] = {
        "a",     "an",   "the",  "is",    "are",  "be",   "of",    "to",    "in",   "on",    "at",    "by",
        "for",   "from", "with", "and",   "or",   "so",   "we",    "it",    "as",   "if",    "let",   "get",
        "has",   "have", "this", "that",  "then", "thus", "hence", "where", "when", "which", "gives", "yields",
        "its",   "our",  "here", "us",    "now",  "was",  "were",  "can",   "will", "both",  "also",  "since",
        "put",   "say",  "ok",   "OK",    "try",  "you",  "may",   "one",   "all",  "any",   "how",   "who",
        "let's", "yes",  "und",  "oder",  "mit",  "aus",  "der",   "die",   "das",  "ist",   "wir",   "et",
        "ou",    "est",  "les",  "des",   "une",  "con",  "por",   "que",   "los",  "las",   "del",   "not",
        "no",    "but",  "use",  "using", "set",  "find", "take",  "per",   "via",  "into",  "I",     "ein",
        "von",   "zur",  "zum",  "bei",   "auf",  "wie",  "nur",   "sur",   "qui",  "pas",   "una",   "che",
        "nel",   "gli",  "uma",  "dla",   "gdy",  "nie",  "jak",   "och",   "med",  "dvs",   "vid",   "ger",
        "som",   "att",  "til"};
    if (std::find(std::begin(short_words), std::end(short_words), word) != std::end(short_words)) return true;
    const std::string lower = in_lower_case(word);
    if (std::find(std::begin(short_words), std::end(short_words), lower) != std::end(short_words) &&
        lower != "i" && lower != "a")
        return true;
    if (word.size() < 4) return false;
    if (!std::all_of(lower.begin(), lower.end(), [](char c) { return c >= 'a' && c <= 'z'; })) return false;
    return greek_named(word) == nullptr && function_named(word).empty() && !lower.ends_with("dot") &&
           command_named(word) == nullptr;
}

}  // namespace alembert
