// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Splits a scene's names into the letter and the index that are set in print.
///
///     theta1 → θ, 1      m_cart → m, cart      x → x      lambda_rod → λ, rod      speed2 → speed, 2
///
/// Names are UTF-8; Latin spellings of Greek letters become Greek.

#include <string>

namespace alembert {

struct Lettering {
    std::string stem, index;  ///< UTF-8; index may be empty
};
Lettering lettering(const std::string& name);

/// A stem or index for LaTeX's math mode: `\theta`, `x`, `\mathrm{cart}`, `12`. Compiles with pdflatex whatever
/// the name.
std::string latex_letters(const std::string& letters);

/// True if the stem is set upright because it has several letters.
bool is_word(const std::string& letters);

/// The text with & < > " escaped.
std::string xml_escaped(const std::string& text);

}  // namespace alembert
