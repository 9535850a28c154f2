// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/written/equation_number.hpp"

#include <algorithm>

namespace alembert {

namespace {

using Kind = WrittenToken::Kind;
using Tokens = std::vector<WrittenToken>;

bool is_roman(const std::string& letters) {
    static constexpr const char* numbers[] = {"i",   "ii",   "iii", "iv", "v",  "vi",
                                              "vii", "viii", "ix",  "x",  "xi", "xii"};
    return std::any_of(std::begin(numbers), std::end(numbers), [&](const char* one) { return letters == one; });
}

/// a to d of (5a): other letters are factors.
bool counts_parts(const std::string& letters) {
    return letters.empty() || (letters.size() == 1 && letters[0] >= 'a' && letters[0] <= 'd');
}

/// Whether what stands between the brackets counts equations. A single letter may be a factor, m (a).
bool counts(const Tokens& tokens, std::size_t begin, std::size_t end, bool is_apart) {
    std::string digits, letters;
    std::size_t stars = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const WrittenToken& token = tokens[i];
        if (i > begin && !token.tight) return false;  // (2 r)
        if (token.kind == Kind::number && letters.empty())
            digits += token.text;
        else if (token.kind == Kind::letter && token.letter.index.empty() && token.dots == 0)
            letters += token.letter.base;
        else if (token.kind == Kind::times)
            ++stars;
        else if (token.kind != Kind::primes && token.kind != Kind::period)
            return false;
    }
    if (stars > 0) return digits.empty() && letters.empty() && stars <= 3;
    if (!digits.empty())
        return digits.size() <= 5 && digits[0] >= '1' && digits[0] <= '9' && counts_parts(letters);
    return (is_roman(letters) && letters.size() > 1) || (is_apart && letters.size() == 1);
}

bool ends_operand(const WrittenToken& token) {
    switch (token.kind) {
        case Kind::number:
        case Kind::letter:
        case Kind::close:
        case Kind::end_group:
        case Kind::end_environment:
        case Kind::no_close:
        case Kind::bar:
        case Kind::primes:
        case Kind::dots:
            return true;
        default:
            return false;
    }
}

}  // namespace

bool is_long_dash(const WrittenToken& token) {
    return token.kind == Kind::stray && token.text == "—";
}

std::size_t before_equation_number(const Tokens& tokens, std::size_t begin, std::size_t end) {
    if (end < begin + 5 || tokens[end - 1].kind != Kind::close) return end;
    std::size_t open = end - 1;
    while (open > begin && tokens[open].kind != Kind::open) --open;
    if (open == begin) return end;
    std::size_t last = open;  // of the formula
    while (last > begin && (is_long_dash(tokens[last - 1]) || tokens[last - 1].kind == Kind::space)) --last;
    const bool is_apart = last < open;
    if ((tokens[open].tight && !is_apart) || last < begin + 2 || !ends_operand(tokens[last - 1]) ||
        !counts(tokens, open + 1, end - 1, is_apart))
        return end;
    std::size_t side = last;
    while (side > begin && tokens[side - 1].kind != Kind::relation) --side;
    if (side == begin) return end;  // no relation
    const bool is_zero = side + 1 == last && tokens[side].text == "0";
    const bool has_letter = std::any_of(tokens.begin() + static_cast<std::ptrdiff_t>(side),
                                        tokens.begin() + static_cast<std::ptrdiff_t>(last),
                                        [](const WrittenToken& token) { return token.kind == Kind::letter; });
    return is_zero || has_letter || is_apart ? last : end;
}

}  // namespace alembert
