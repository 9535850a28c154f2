// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The tokens of an expression.
///
///     tokenize("2*x''")  gives  number `2`, symbol `*`, name `x`, primes `''`, end

#include <algorithm>
#include <string>
#include <vector>

namespace alembert {

struct Token {
    enum class Kind { number, name, primes, symbol, end };
    Kind kind;
    int offset;  ///< bytes into the text
    int length;
    char symbol = 0;  ///< one of + - * / ^ ( ) , = if the token is a symbol
};

/// What is wrong with an expression, and at which byte. It is thrown inside this room only.
struct Mistake {
    int offset;
    std::string message;
};

/// Throws Mistake at the first character that cannot be part of an expression.
std::vector<Token> tokenize(const std::string& text);

/// The tokens of one expression and the reader's position among them.
struct Words {
    const std::string& text;
    std::vector<Token> tokens;
    std::size_t at = 0;

    static bool is(const Token& token, char symbol) { return token.symbol == symbol; }
    const Token& now() const { return tokens[at]; }
    const Token& ahead(std::size_t k) const { return tokens[std::min(at + k, tokens.size() - 1)]; }
    const Token& last() const { return tokens[at - 1]; }
    bool at_end() const { return now().kind == Token::Kind::end; }
    bool at_symbol(char symbol) const { return is(now(), symbol); }
    std::string word(const Token& token) const { return text.substr(token.offset, token.length); }
    /// The end, in bytes, of the last token that was read.
    int end() const { return at == 0 ? 0 : last().offset + last().length; }
};

}  // namespace alembert
