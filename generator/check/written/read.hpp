// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Reads a hand derivation: LaTeX, Markdown with LaTeX, or plain text.
///
///     const Written written = read_derivation(text, "homework.tex");
///     written.statements[0].sides.size();        // 3 for T = a = b
///
/// Words between formulas are kept as the words before the next statement. What is no mathematics that can be read
/// becomes a statement with a reason in place of sides, so that nothing is passed over in silence. Nothing is
/// executed and no other file is read: \input, \def, \newcommand and the like are refused at their place (a
/// \newcommand without arguments or with plain ones may be taken in, within the limits).
///
/// Limits: 1 MiB of text, 100,000 tokens, 100 levels of nesting, 10,000 statements.

#include <string>
#include <vector>

#include "check/written/math.hpp"

namespace alembert {

/// What stands between two sides.
enum class Relation {
    equal,          ///< =
    approximately,  ///< \approx, ≈, \simeq, \sim, \doteq: to first order
    identical,      ///< \equiv, :=, \triangleq: a definition, or an identity
    proportional,   ///< \propto and inequalities: not a claim that can be judged
};

/// One chain a = b = c. Rows of `align` that begin with `&=` go on with the chain of the row above.
struct WrittenStatement {
    std::vector<MathPtr> sides;  ///< empty if it was not understood; one side alone is an expression, no claim
    std::vector<Relation> relations;    ///< one fewer than sides
    std::vector<MathPtr> conditions{};  ///< of `cases` and "if": not judged; told
    std::string reason{};               ///< why it was not understood: what was found, what was expected
    std::size_t offset = 0;             ///< of the statement in the document, or of what was not understood
    std::size_t length = 0;
    std::string words{};       ///< what stands before it in words since the last statement, blanks collapsed
    bool in_words = false;     ///< whether its first side stands in words: "the kinetic energy is"
    bool displayed = false;    ///< in a display or a line of its own, not among words
    bool first_order = false;  ///< the words before it, in its paragraph, speak of small angles or of linearizing
    bool is_copy = false;      ///< the formula before it, with another number for an index that runs
    bool consequence = false;  ///< \implies, \Rightarrow, "therefore", "hence", "so" stand before it
};

/// A document and its statements in the order of reading.
struct Written {
    std::string file;  ///< the name as given, for messages
    std::string text;
    std::vector<WrittenStatement> statements;
    std::vector<std::size_t> lines{};       ///< where each line begins
    std::vector<std::size_t> characters{};  ///< how many characters stand before each 1024th byte
    int line(std::size_t offset) const;     ///< from 1
    int column(std::size_t offset) const;   ///< from 1, in characters
};

/// Whether `check` should read this as a derivation rather than as a file of claims: by the ending .tex or .md, by
/// mathematics of LaTeX in it ($…$, \[, \(, \begin{align}, \frac), or, in a .txt, by sentences, labels or signs
/// that a file of claims does not have.
bool is_derivation(const std::string& text, const std::string& file);

/// Throws SceneError for text that is no UTF-8, that exceeds the limits, or that holds no mathematics at all.
Written read_derivation(std::string text, std::string file);

/// A tree as LaTeX, normalized: for messages, and for tests that read it again.
std::string latex(const Math& math);

}  // namespace alembert
