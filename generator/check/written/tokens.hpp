// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The tokens of a formula. LaTeX, Unicode mathematics and plain text become one stream: θ̈₁² and
/// \ddot{\theta}_{1}^{2} have the same tokens. A character of Unicode and a macro of the document are replaced by
/// the LaTeX that they stand for; what comes of them keeps the place where they were written.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "check/written/math.hpp"

namespace alembert {

struct WrittenToken {
    enum class Kind {
        number,
        letter,    ///< with what its own word says: theta1_dot
        function,  ///< sin
        command,   ///< what the parser knows by its name: frac, dot, sum
        open,      ///< ( [ \{ \langle; text: the bracket
        close,
        begin_group,  ///< {
        end_group,
        begin_environment,  ///< matrix, array, cases; text: its name
        end_environment,
        no_open,   ///< \left.
        no_close,  ///< \right.
        bar,       ///< | and ‖, which open or close
        plus,
        minus,
        times,  ///< text: "", "cdot" or "times"
        divide,
        power,
        index,
        primes,
        partial,   ///< ∂
        relation,  ///< text: = ~ : or <, by what it says
        arrow,     ///< \implies and other signs between statements
        comma,
        semicolon,
        period,
        dots,  ///< …
        ampersand,
        row,      ///< \\ and line ends of plain text
        space,    ///< \quad
        text,     ///< \text{…}; letter.base: "unit" if upright
        refused,  ///< text: what a message says about it
        stray,    ///< what has no meaning in a formula
        end,
    };
    Kind kind = Kind::end;
    std::string text{};
    Letter letter{};
    int dots = 0;
    std::size_t offset = 0;
    std::size_t length = 0;
    bool tight = false;    ///< nothing stands between it and the token before
    bool upright = false;  ///< \mathrm
};

/// A macro of the document that is taken in: \newcommand{\pd}[2]{\frac{\partial #1}{\partial #2}}
struct WrittenMacro {
    int arguments = 0;
    std::string body;
};

/// A limit that the document exceeds, thrown inside this room.
struct BeyondLimit {
    std::size_t offset;
    std::string message;
};

/// What is shared by all formulas of one document.
struct TokenContext {
    std::map<std::string, WrittenMacro, std::less<>> macros;
    std::size_t tokens = 0;         ///< so far
    std::size_t expanded = 0;       ///< bytes that macros became
    bool has_virtual_work = false;  ///< whether plain text has delta_y for δy
};

inline constexpr std::size_t most_written_tokens = 100000;
inline constexpr int most_written_nesting = 100;

/// Plain text has words, and line ends that count; LaTeX has single letters.
enum class WrittenNotation { latex, plain };

/// The tokens of a piece of a document that begins at `offset` in it. Throws BeyondLimit.
std::vector<WrittenToken> tokens_of(std::string_view text, std::size_t offset, WrittenNotation notation,
                                    TokenContext& context);

/// The letter and the dots of a word of plain text: "theta1_dot" is θ₁ with one dot.
std::pair<Letter, int> letter_of_word(std::string word);

}  // namespace alembert
