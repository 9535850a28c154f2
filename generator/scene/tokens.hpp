// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The words of an expression.
///
///     tokenize("2*x''")  gives  number `2`, symbol `*`, name `x`, primes `''`, end

#include <string>
#include <vector>

namespace alembert {

struct Token {
    enum class Kind { number, name, primes, symbol, end };
    Kind kind;
    int offset;  ///< bytes into the text
    int length;
    char symbol = 0;  ///< one of + - * / ^ ( ) , = where it is a symbol
};

/// What is wrong with an expression, and at which byte. Thrown inside this layer only.
struct Mistake {
    int offset;
    std::string message;
};

/// Throws Mistake at the first character that cannot be part of an expression.
std::vector<Token> tokenize(const std::string& text);

}  // namespace alembert
