// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/sentences.hpp"

#include <algorithm>

namespace alembert {

std::string in_lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c | 0x20);
    return lower;
}

bool has_phrase(const std::string& text, std::string_view phrases) {
    const auto is_letter_at = [&](std::size_t k) { return k < text.size() && text[k] >= 'a' && text[k] <= 'z'; };
    while (!phrases.empty()) {
        const std::size_t end = std::min(phrases.find('|'), phrases.size());
        std::string_view phrase = phrases.substr(0, end);
        phrases.remove_prefix(std::min(end + 1, phrases.size()));
        const bool may_go_on = phrase.ends_with('*');
        if (may_go_on) phrase.remove_suffix(1);
        for (std::size_t at = text.find(phrase); at != std::string::npos; at = text.find(phrase, at + 1))
            if ((at == 0 || !is_letter_at(at - 1)) && (may_go_on || !is_letter_at(at + phrase.size())))
                return true;
    }
    return false;
}

std::size_t end_of_first_sentence(std::string_view words, std::size_t begin) {
    for (std::size_t at = begin; at < words.size(); ++at) {
        const std::string_view rest = words.substr(at), before = words.substr(0, at + 1);
        const bool is_stop = rest.front() == '.' && (rest.size() == 1 || rest[1] == ' ' || rest[1] == '*') &&
                             !before.ends_with("i.e.") && !before.ends_with("d.h.") && !before.ends_with("z.b.") &&
                             !before.ends_with("z.B.");
        if (is_stop || rest.starts_with("; ")) return at + 1;
        for (const std::string_view wide : {"。", "；"})
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
        if (next == words.size() && !last.ends_with('.') && !last.ends_with("。") && !last.ends_with("；")) break;
        if (next == words.size() && (last.ends_with("i.e.") || last.ends_with("d.h."))) break;
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
        const bool is_chinese = static_cast<unsigned char>(word.front()) >= 0x80;
        return begin == 0 || is_chinese || sentence[begin - 1] == ' ' || sentence[begin - 1] == '(';
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
    constexpr std::size_t longest = 16;
    return words.size() < longest && !ends_sentence(words);
}

bool begins_sentence(std::string_view words) {
    return !words.empty() && words.front() >= 'A' && words.front() <= 'Z';
}

}  // namespace alembert
