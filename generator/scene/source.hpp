// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The text of a scene file and the places of its characters.

#include <string>
#include <string_view>
#include <vector>

#include "alembert/base/error.hpp"

namespace alembert {

/// Converts lines and columns (in characters, from 1) to bytes and back. The text must be UTF-8 and outlive this
/// object.
class SourceText {
public:
    explicit SourceText(std::string_view text);

    std::string_view text() const { return text_; }
    std::size_t offset(Place place) const;  ///< a place beyond the text gives its end
    Place place(std::size_t offset) const;

private:
    std::string_view text_;
    std::vector<std::size_t> characters_;  // byte of each character, and one past the end
    std::vector<std::size_t> lines_;       // index of the first character of each line
};

/// The value of a string in a TOML file, with the place of each byte (and one past the end).
struct Literal {
    std::string text;
    std::vector<Place> places;
};

/// The string (basic, literal, of one line or many) that begins with a quote at `begin`.
Literal read_string(const SourceText& source, std::size_t begin);

/// Finds bytes that no TOML file may have (invalid UTF-8, control characters, stray carriage returns), and scenes
/// of more than 1 MiB. Only the first mistake of each kind is reported.
std::vector<Diagnostic> check_bytes(std::string_view text);

}  // namespace alembert
