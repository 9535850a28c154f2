// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the commands of LaTeX and the characters of Unicode mean in a formula.

#include <string_view>

#include "check/written/tokens.hpp"

namespace alembert {

struct WrittenCommand {
    enum class Effect {
        token,       ///< is the token `kind` with `text`
        nothing,     ///< spacing, styles, sizes of brackets
        dropped,     ///< with its arguments, `text` of them ("1")
        words,       ///< \text{…}
        upright,     ///< \mathrm{…}
        delimiter,   ///< \left, \right
        definition,  ///< \newcommand
        refused,     ///< what would execute something or read a file
    };
    std::string_view name;
    Effect effect = Effect::nothing;
    WrittenToken::Kind kind = WrittenToken::Kind::stray;
    std::string_view text = {};
};

/// Null if it is not known. `name` is without backslash.
const WrittenCommand* command_named(std::string_view name);

/// sin for `sin`, `Sin`, and asin for `arcsin` and `ArcSin`; empty if it is no function.
std::string_view function_named(std::string_view name);

/// The LaTeX that a character stands for: \times for ×; empty if it stands for nothing in a formula.
std::string spelled(char32_t c);

/// The raised or lowered digit or letter as a plain one, 0 if it is none: ² gives 2.
char raised_sign(char32_t c);
char lowered_sign(char32_t c);

/// The command that puts a combining mark over a letter: ddot for U+0308; empty if it is none.
std::string_view combining_mark(char32_t c);

}  // namespace alembert
