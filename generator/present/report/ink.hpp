// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Marks around words that a terminal shows in colour. Views take an Ink and insert its marks; the default Ink has
/// no marks, so that text for files and pipes is plain.
///
///     as_text(checked, {});                // "proved     theta'' + …"
///     as_text(checked, terminal_ink());    // the verdict between marks, which streams.hpp turns into colours
///
/// A mark is a byte that no UTF-8 text has, and a letter.

#include <string>

namespace alembert {

struct Ink {
    std::string good = {}, bad = {}, unsure = {}, strong = {}, end = {};
};

inline constexpr char ink_mark = '\xFF';

/// An Ink with all marks.
inline Ink marking_ink() {
    const auto mark = [](char letter) { return std::string{ink_mark, letter}; };
    return {.good = mark('g'), .bad = mark('b'), .unsure = mark('u'), .strong = mark('s'), .end = mark('e')};
}

}  // namespace alembert
