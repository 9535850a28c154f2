// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The Greek alphabet by its letters, by their Latin spellings, and in LaTeX.
///
///     greek_named("theta")->letter      // "θ"
///     greek_of("θ")->latex              // "\\theta"

#include <string_view>

namespace alembert {

struct GreekLetter {
    std::string_view name, letter, latex;
};

/// Null if this is not the Latin spelling of a Greek letter.
const GreekLetter* greek_named(std::string_view name);

/// Null if this is no Greek letter. A variant (ϕ, ϵ, the sign µ) has the name of the letter that is found by it.
const GreekLetter* greek_of(std::string_view letter);

}  // namespace alembert
