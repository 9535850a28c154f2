// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Trees of claims that are changed in one place, and their text: what is left as it was looks as its author wrote
/// it.
///
///     const TreePtr turned = with_part(lhs.tree, term, negated(term), lhs.text);
///     text_of(turned, lhs.text)           // "m*x'' - k*x"
///
/// Nodes that are made here have no place in the text (offset −1). A sum made here has blanks around its signs if
/// it is `loose`, which its `text` says.

#include <string>
#include <utility>

#include "scene/expression.hpp"

namespace alembert {

TreePtr made(Tree::Kind kind, std::vector<TreePtr> args, std::string text = {}, int primes = 0);
TreePtr number_tree(long value);
TreePtr name_tree(const std::string& name, int primes = 0);

/// The same tree without its place in a text.
TreePtr detached(const TreePtr& tree);

/// The product of factors; the factor itself if there is one.
TreePtr product_of(std::vector<TreePtr> factors);
/// The factors with a sign before the first.
std::vector<TreePtr> negated_first(std::vector<TreePtr> factors);

/// An expression without a text, for those who read trees. The tree must outlive it.
Expression expression_of(const Tree& tree);

/// The term without its sign, and whether it had one. A sign before a product belongs to its first factor.
std::pair<TreePtr, bool> without_sign(const TreePtr& tree);

/// With the opposite sign, as short as possible: x for −x, (b − a)·c for (a − b)·c.
TreePtr negated(const TreePtr& tree);

/// The sum with one more term. `tree` may be any tree: it is then the first term.
TreePtr plus(const TreePtr& tree, const TreePtr& term, bool loose);

/// The same tree with another part in place of `part`. `source`: the text of `root`.
TreePtr with_part(const TreePtr& root, const Tree* part, const TreePtr& by, const std::string& source);
/// The sum without one of its terms; 0 if it is the only one.
TreePtr without_term(const TreePtr& root, const Tree* term, const std::string& source);

std::string text_of(const Tree& tree, const std::string& source);
/// As if all of it had been made here: the same for trees that are the same.
std::string plain_text_of(const Tree& tree);

/// Whether a sum has blanks around its signs.
bool is_loose(const Tree& sum, const std::string& source);

/// Whether two trees are the same apart from their places.
bool same(const Tree& a, const Tree& b);

}  // namespace alembert
