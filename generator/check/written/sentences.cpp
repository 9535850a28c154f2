// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/sentences.hpp"

#include <algorithm>
#include <cctype>

namespace alembert {

namespace {

/// Whether a letter of two bytes begins so: é, ł, ж, and no sign of Greek, which stands for a letter of a formula.
bool begins_wide_letter(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte >= 0xC3 && byte <= 0xC5) || (byte >= 0xD0 && byte <= 0xD3);
}

/// É, Ł, Ж in lower case; other characters as they are.
unsigned lower_of(unsigned code) {
    const auto is_in = [code](unsigned first, unsigned last) { return code >= first && code <= last; };
    if (is_in(0xC0, 0xDE) && code != 0xD7) return code + 0x20;
    if (code != 0x130 && (is_in(0x100, 0x137) || is_in(0x14A, 0x177))) return code | 1;
    if ((is_in(0x139, 0x148) || is_in(0x179, 0x17E)) && code % 2 == 1 && code != 0x13F) return code + 1;
    if (is_in(0x410, 0x42F)) return code + 0x20;
    if (is_in(0x400, 0x40F)) return code + 0x50;
    return code;
}

bool has_letter_at(std::string_view text, std::size_t k) {
    return k < text.size() && ((text[k] >= 'a' && text[k] <= 'z') || begins_wide_letter(text[k]));
}

bool has_letter_before(std::string_view text, std::size_t k) {
    return (k > 0 && text[k - 1] >= 'a' && text[k - 1] <= 'z') || (k > 1 && begins_wide_letter(text[k - 2]));
}

/// Whether the stop there is one of "i.e.", "z. B.", "т. е.", and ends no sentence.
bool is_stop_of_abbreviation(std::string_view words, std::size_t at) {
    static constexpr std::string_view all[] = {
        "i.e.",  "d.h.",    "z.b.",   "z.B.",   "d. h.",  "z. b.",    "z. B.",   "bzw.",    "vgl.", "p. ej.",
        "p.ej.", "por ej.", "p. ex.", "p.ex.",  "ad es.", "per es.",  "c.-à-d.", "c. à d.", "np.",  "tzn.",
        "tj.",   "tzw.",    "t.ex.",  "t. ex.", "d.v.s.", "dvs.",     "bl.a.",   "s.k.",    "т.е.", "т. е.",
        "т.к.",  "т. к.",   "т.н.",   "т. н.",  "(см.",   "см. рис.", "рис.",    "напр."};
    return std::any_of(std::begin(all), std::end(all), [&](std::string_view one) {
        for (std::size_t dot = one.find('.'); dot != std::string_view::npos; dot = one.find('.', dot + 1))
            if (at >= dot && words.substr(at - dot).starts_with(one) && !has_letter_before(words, at - dot))
                return true;
        return false;
    });
}

}  // namespace

std::string in_lower_case(std::string_view text) {
    std::string lower(text);
    for (std::size_t k = 0; k < lower.size(); ++k) {
        char& c = lower[k];
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c | 0x20);
        const bool is_whole = k + 1 < lower.size() && (static_cast<unsigned char>(lower[k + 1]) & 0xC0U) == 0x80U;
        if (!begins_wide_letter(c) || !is_whole) continue;
        const unsigned code = lower_of((static_cast<unsigned char>(c) & 0x1FU) << 6 |
                                       (static_cast<unsigned char>(lower[k + 1]) & 0x3FU));
        c = static_cast<char>(0xC0U | code >> 6);
        lower[++k] = static_cast<char>(0x80U | (code & 0x3FU));
    }
    return lower;
}

bool has_phrase(const std::string& text, std::string_view phrases) {
    while (!phrases.empty()) {
        const std::size_t end = std::min(phrases.find('|'), phrases.size());
        std::string_view phrase = phrases.substr(0, end);
        phrases.remove_prefix(std::min(end + 1, phrases.size()));
        const bool may_go_on = phrase.ends_with('*');
        if (may_go_on) phrase.remove_suffix(1);
        for (std::size_t at = text.find(phrase); at != std::string::npos; at = text.find(phrase, at + 1))
            if (!has_letter_before(text, at) && (may_go_on || !has_letter_at(text, at + phrase.size())))
                return true;
    }
    return false;
}

std::size_t end_of_first_sentence(std::string_view words, std::size_t begin) {
    for (std::size_t at = begin; at < words.size(); ++at) {
        const std::string_view rest = words.substr(at);
        const bool is_stop = rest.front() == '.' && (rest.size() == 1 || rest[1] == ' ' || rest[1] == '*') &&
                             !is_stop_of_abbreviation(words, at);
        if (is_stop || rest.starts_with("; ")) return at + 1;
        for (const std::string_view wide : {"。", "；", "．"})
            if (rest.starts_with(wide)) return at + wide.size();
    }
    return words.size();
}

namespace {

/// Where the last sentence that ends in the words does; 0 if none does.
std::size_t end_of_sentences(std::string_view words) {
    std::size_t end = 0;
    while (end < words.size()) {
        const std::size_t next = end_of_first_sentence(words, end);
        const std::string_view last = words.substr(end, next - end);
        if (next == words.size() && !last.ends_with('.') && !last.ends_with("。") && !last.ends_with("；") &&
            !last.ends_with("．"))
            break;
        if (next == words.size() && last.ends_with('.') && is_stop_of_abbreviation(words, next - 1)) break;
        end = next;
    }
    return end;
}

}  // namespace

std::string last_sentence(std::string_view words) {
    return in_lower_case(words.substr(end_of_sentences(words)));
}

std::string trimmed_sentence(std::string_view words) {
    const std::string sentence = last_sentence(words);
    return sentence.substr(0, sentence.find_last_not_of(" ,:(") + 1);
}

bool ends_with_word(std::string_view words, std::initializer_list<std::string_view> list) {
    const std::string sentence = trimmed_sentence(words);
    return std::any_of(list.begin(), list.end(), [&](std::string_view word) {
        if (!sentence.ends_with(word)) return false;
        const std::size_t begin = sentence.size() - word.size();
        const bool is_chinese =
            static_cast<unsigned char>(word.front()) >= 0x80 && !begins_wide_letter(word.front());
        return begin == 0 || is_chinese || sentence[begin - 1] == ' ' || sentence[begin - 1] == '(';
    });
}

bool holds_letters(std::string_view words) {
    return std::any_of(words.begin(), words.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x80 || std::isalpha(byte) != 0;
    });
}

bool ends_sentence(std::string_view words) {
    return end_of_sentences(words) > 0;
}

bool holds_sentence(std::string_view words) {
    const std::size_t first = end_of_first_sentence(words, 0);
    const std::size_t last = end_of_sentences(words);
    const bool is_rest_of_sentence = first < 4;  // the full stop behind the formula
    return last > (is_rest_of_sentence ? first : 0) && last > 3;
}

bool joins_formulas(std::string_view words) {
    constexpr std::ptrdiff_t longest = 16, longest_in_han = 6;
    const auto is_letter = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
    const std::ptrdiff_t letters = std::count_if(words.begin(), words.end(), is_letter);
    const bool is_han =
        std::any_of(words.begin(), words.end(), [](char c) { return static_cast<unsigned char>(c) >= 0xE0; });
    return letters < (is_han ? longest_in_han : longest) && !ends_sentence(words);
}

bool goes_on_with_case(std::string_view words) {
    std::string sentence = last_sentence(words);
    sentence.erase(0, std::min(sentence.find_first_not_of(" $"), sentence.size()));
    static constexpr std::string_view beginnings[] = {"then",  "dann", "alors", "entonces", "allora", "então",
                                                      "wtedy", "då ",  "тогда", "则",       "那么",   "このとき"};
    return std::any_of(std::begin(beginnings), std::end(beginnings),
                       [&](std::string_view beginning) { return sentence.starts_with(beginning); });
}

bool begins_sentence(std::string_view words) {
    if (words.empty()) return false;
    const std::string_view first = words.substr(0, begins_wide_letter(words.front()) ? 2 : 1);
    return in_lower_case(first) != first;
}

}  // namespace alembert
