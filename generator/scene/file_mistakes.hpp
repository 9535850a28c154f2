// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Mistakes in a file of those who know other files: YAML, Python, C, LaTeX; and brackets and signs that are
/// missing. Each is told where it stands, with what TOML writes there.
///
///     m: 1                      the sign = stands between a key and its value; write m = 1
///     position = ["x", 0        this array is not closed; a ] is missing
///     // the mass               a comment begins with #

#include <optional>
#include <string>
#include <string_view>

#include "scene/layout.hpp"
#include "scene/source.hpp"

namespace alembert {

/// `message` is that of toml++ at `offset`, where it stopped.
std::optional<Diagnostic> familiar_mistake(const std::string& message, const Layout& layout,
                                           const SourceText& source, std::size_t offset);

/// `[[particle]`, `[particle]]`: brackets that do not fit.
std::optional<Diagnostic> mistake_in_header(const SourceText& source, std::size_t offset);

/// Whether the line has a quote of a word processor.
bool has_typographic_quote(const SourceText& source, std::size_t offset);

/// Only digits, signs, points and exponents, with a digit among them.
bool is_number_like(std::string_view text);

/// "the decimal sign is a point; write 0.5" for "0,5"; empty if this is no number with a comma in it.
std::string advice_on_comma(std::string_view text);

}  // namespace alembert
