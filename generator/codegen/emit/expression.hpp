// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// C++ text of a value, with the precedence that decides about brackets and with its cost.
///
///     CodeExpression("a") * (CodeExpression("b") - CodeExpression("c"))      // "a * (b - c)", 2 operations
///     joined({{true, "a"}, {false, "b"}})                        // "b - a"

#include <algorithm>
#include <string>
#include <vector>

namespace alembert {

struct CodeExpression {
    enum class Kind { atom, product, sum };
    std::string text = {};  ///< empty for a missing factor
    Kind kind = Kind::atom;
    int operations = 0;

    CodeExpression() = default;
    CodeExpression(std::string atom, int cost = 0) : text(std::move(atom)), operations(cost) {}
    CodeExpression(const char* atom) : text(atom) {}
    CodeExpression(std::string made, Kind of, int cost) : text(std::move(made)), kind(of), operations(cost) {}

    bool is_one() const { return text.empty(); }
};

/// The expression as one factor or argument, whatever stands around it.
inline CodeExpression bracketed(const CodeExpression& e) {
    return e.kind == CodeExpression::Kind::atom ? e : CodeExpression("(" + e.text + ")", e.operations);
}

inline CodeExpression operator*(const CodeExpression& a, const CodeExpression& b) {
    if (a.is_one() || b.is_one()) return a.is_one() ? b : a;
    const auto factor = [](const CodeExpression& e) {
        return e.kind == CodeExpression::Kind::sum ? bracketed(e).text : e.text;
    };
    return {factor(a) + " * " + factor(b), CodeExpression::Kind::product, a.operations + b.operations + 1};
}

/// A term of a sum, with its sign.
struct Piece {
    bool negative;
    CodeExpression value;
};

/// The sum in the given order; "Real(0)" if there are no pieces.
inline CodeExpression in_order(const std::vector<Piece>& pieces) {
    if (pieces.empty()) return "Real(0)";
    if (pieces.size() == 1 && !pieces[0].negative) return pieces[0].value;
    const auto text = [](const Piece& piece) {
        return piece.negative && piece.value.kind == CodeExpression::Kind::sum ? bracketed(piece.value).text
                                                                               : piece.value.text;
    };
    CodeExpression sum{(pieces[0].negative ? "-" : "") + text(pieces[0]), CodeExpression::Kind::sum,
                       pieces[0].value.operations};
    for (std::size_t k = 1; k < pieces.size(); ++k) {
        sum.text += (pieces[k].negative ? " - " : " + ") + text(pieces[k]);
        sum.operations += pieces[k].value.operations + 1;
    }
    return sum;
}

/// The sum, beginning with a term that is not subtracted, if there is one.
inline CodeExpression joined(std::vector<Piece> pieces) {
    const auto positive = std::find_if(pieces.begin(), pieces.end(), [](const Piece& x) { return !x.negative; });
    if (positive != pieces.end()) std::rotate(pieces.begin(), positive, positive + 1);
    return in_order(pieces);
}

inline CodeExpression operator+(const CodeExpression& a, const CodeExpression& b) {
    return in_order({{false, a}, {false, b}});
}
inline CodeExpression operator-(const CodeExpression& a, const CodeExpression& b) {
    return in_order({{false, a}, {true, b}});
}

}  // namespace alembert
