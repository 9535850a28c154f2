// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The signs of Chinese keyboards and of word processors in a TOML file, as the signs of TOML.
///
///     with_plain_signs("m ＝ 1，5 # （）")       // "m = 1,5 # （）"
///     with_plain_signs("name = “M1”")           // "name = \"M1\""
///
/// Strings and comments keep what is in them; each character becomes one, so that lines and columns stay.

#include <string>
#include <string_view>

namespace alembert {

std::string with_plain_signs(std::string_view text);

/// Whether this is a typographic quote: “ ” „ « » 「 」 and the like.
bool is_typographic_quote(char32_t c);

}  // namespace alembert
