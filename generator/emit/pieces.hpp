// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Sums as text, from pieces with signs.
///
///     joined({{true, "a"}, {false, "b * c"}})      // "b * c - a"
///     bracketed("a + b")                           // "(a + b)"

#include <algorithm>
#include <string>
#include <vector>

namespace alembert {

struct Piece {
    bool negative;
    std::string text;
};

/// Begins with something that is not subtracted, where there is one; "Real(0)" of no pieces.
inline std::string joined(std::vector<Piece> pieces) {
    if (pieces.empty()) return "Real(0)";
    const auto positive = std::find_if(pieces.begin(), pieces.end(), [](const Piece& x) { return !x.negative; });
    if (positive != pieces.end()) std::rotate(pieces.begin(), positive, positive + 1);
    std::string result = (pieces[0].negative ? "-" : "") + pieces[0].text;
    for (std::size_t k = 1; k < pieces.size(); ++k) result += (pieces[k].negative ? " - " : " + ") + pieces[k].text;
    return result;
}

inline std::string bracketed(const std::string& text) { return text.find(' ') == std::string::npos ? text : "(" + text + ")"; }

}  // namespace alembert
