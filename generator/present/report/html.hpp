// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Escapes the text of a scene for a page, so that nothing in it becomes markup or script.
///
///     put(page, "<h1>{}</h1>", html(scene.title));
///     put(page, "<script type=\"application/json\">{}</script>", script_json(data));

#include <string>
#include <vector>

#include "algebra/notation/phrase.hpp"
#include "present/report/json.hpp"

namespace alembert {

/// & < > " ' escaped; for text and for values of attributes in quotes.
std::string html(const std::string& text);

/// JSON in ASCII only, without < > and &, so that it cannot end the script element around it.
std::string script_json(const Json& json);

/// A formula in a line of text.
std::string inline_math(const Phrase& phrase);

/// A name or a short expression with Greek letters and indices.
std::string html_letters(const std::string& expression);

/// Rows of MathML and the signs between them, "<mo>=</mo>" and the like, as a block that may be broken before
/// these and before the plus and minus signs of their outermost sums.
std::string breakable(const std::vector<std::string>& rows);

/// left = right as a block that may be broken before the plus and minus signs of its outermost sums.
std::string equation(const std::string& left_mathml, const std::string& right_mathml);

}  // namespace alembert
