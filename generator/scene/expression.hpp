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

#include "alembert/base/error.hpp"

namespace alembert {

class KnownNames;

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
    std::string unit = {};  ///< of a quantity such as `200 mm`: a product of the number and of the unit in the SI
};

/// An expression as text, its place in the file, and its tree. `tree` is null only if the key was missing in the
/// scene.
struct Expression {
    std::string text;
    std::vector<Place> places;  ///< place in the file of each byte of `text`, and one past the end
    TreePtr tree;
    explicit operator bool() const { return tree != nullptr; }
    Place place(int offset = 0) const {
        return places.empty() ? Place{} : places[std::min<std::size_t>(offset, places.size() - 1)];
    }
};

/// Parses one expression. Mistakes are appended to `diagnostics`, and the result's tree is then null. `places` is
/// as in Expression and may be empty. The limits are 64 KiB, 200 levels of nesting, and whole exponents up to 64.
/// Right after a number, units of the scene's own come first, then its names, then most units.
Expression parse_expression(std::string text, std::vector<Place> places, std::vector<Diagnostic>& diagnostics,
                            const KnownNames* names = nullptr);

/// The value of the digits of a number, which are within the range of double precision, or near 0.
double value_of_digits(const std::string& digits);

/// An equation `lhs = rhs` (exactly one `=`).
struct Equality {
    Expression lhs, rhs;
};

/// An inequality `greater > less`, or `less < greater`.
struct Inequality {
    Expression greater, less;
    bool begins_with_less = false;  ///< whether it was typed as `less < greater`
};

Inequality parse_inequality(const std::string& text, const std::vector<Place>& places,
                            std::vector<Diagnostic>& diagnostics, const KnownNames* names = nullptr);

/// The text `lhs = rhs` without superfluous blanks, and that of an inequality as it was typed.
std::string text_of(const Equality& equation);
std::string text_of(const Inequality& inequality);

/// With `rates_before`, `x'(-)`, the rate before an impact, is allowed: it becomes a call named `(-)` whose
/// argument is the name x with one prime.
Equality parse_equality(const std::string& text, const std::vector<Place>& places,
                        std::vector<Diagnostic>& diagnostics, bool rates_before = false,
                        const KnownNames* names = nullptr);

/// The names of the scalar functions of one argument, of those of two arguments, and of the vector functions, for
/// reserved names and for hints.
const std::vector<std::string>& function_names();

}  // namespace alembert
