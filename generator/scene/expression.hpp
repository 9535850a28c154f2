// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The expression language of a scene as a plain tree: no symbols, no arithmetic, numbers as typed.
///
///     const Expression e = parse_expression("m*(x' + 1/2)^2", place);
///
/// The tree knows nothing of scalars and vectors: `pos(P,Q)` is a call with two names.

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "alembert/error.hpp"

namespace alembert {

struct Tree;
using TreePtr = std::shared_ptr<const Tree>;

/// One node. `offset` and `length` are bytes into the expression's text (for messages).
struct Tree {
    enum class Kind {
        number,      ///< text: the literal as typed (`2`, `.5`, `2e3`): an exact rational
        name,        ///< text, primes: x, x', x''
        call,        ///< text: the function's name; args
        sum,         ///< args, at least two; a difference has `negate` nodes in it
        product,     ///< args, at least two; a quotient has `reciprocal` nodes in it
        negate,      ///< one arg
        reciprocal,  ///< one arg
        power,       ///< base, exponent
        derivative,  ///< (…)' : one arg, primes
    };
    Kind kind;
    std::string text;
    int primes = 0;
    std::vector<TreePtr> args{};
    int offset = 0;
    int length = 0;
};

/// An expression as written, where it was written, and what it says. `tree` is null only where the key was
/// missing in the scene.
struct Expression {
    std::string text;
    std::vector<Place> places;  ///< place in the file of each byte of `text`, and one past the end
    TreePtr tree;
    explicit operator bool() const { return tree != nullptr; }
    Place place(int offset = 0) const {
        return places.empty() ? Place{} : places[std::min<std::size_t>(offset, places.size() - 1)];
    }
};

/// Parses one expression. Mistakes are appended to `diagnostics` (then the result's tree is null).
/// `places` as in Expression; may be empty. Limits: 64 KiB, 200 levels of nesting, whole exponents up to 64.
Expression parse_expression(std::string text, std::vector<Place> places, std::vector<Diagnostic>& diagnostics);

/// An equation `lhs = rhs` (exactly one `=`).
struct Equality {
    Expression lhs, rhs;
};

/// `lhs = rhs` without needless blanks.
std::string text_of(const Equality& equation);

/// With `rates_before`, `x'(-)` (the rate before an impact) is read: a call named `(-)` of the name x with one
/// prime.
Equality parse_equality(const std::string& text, const std::vector<Place>& places,
                        std::vector<Diagnostic>& diagnostics, bool rates_before = false);

/// The scalar functions of one argument, of two, and the vector functions; for reserved names and for hints.
const std::vector<std::string>& function_names();

}  // namespace alembert
