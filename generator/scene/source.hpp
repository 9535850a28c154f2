// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The text of a scene file and where its characters are.

#include <string>
#include <string_view>
#include <vector>

#include "alembert/error.hpp"

namespace alembert {

/// Lines and columns (in characters, from 1) to bytes and back. The text must be UTF-8 and outlive this.
class SourceText {
public:
    explicit SourceText(std::string_view text);

    std::string_view text() const { return text_; }
    std::size_t offset(Place place) const;  ///< places beyond the text give its end
    Place place(std::size_t offset) const;

private:
    std::string_view text_;
    std::vector<std::size_t> characters_;  // byte of each character, and one past the end
    std::vector<std::size_t> lines_;       // index of the first character of each line
};

/// A string of a TOML file as its reader sees it, with the place of each byte (and one past the end).
struct Literal {
    std::string text;
    std::vector<Place> places;
};

/// The string (basic, literal, of one line or many) that begins with a quote at `begin`.
Literal read_string(const SourceText& source, std::size_t begin);

/// What no TOML file may have: bytes that are not UTF-8, control characters, stray carriage returns; and what no
/// scene may have: more than 1 MiB. Only the first of each kind is told.
std::vector<Diagnostic> check_bytes(std::string_view text);

}  // namespace alembert
