// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A formula in MathML Core (https://www.w3.org/TR/mathml-core/), as one <math display="block"> element.
///
/// Dots for time derivatives, Greek letters, indices as <msub>; inputs are functions of time: F(t).

#include <string>

#include "algebra/notation/phrase.hpp"

namespace alembert {

std::string mathml(const Phrase& phrase);
/// lhs = rhs
std::string mathml(const Phrase& lhs, const Phrase& rhs);

/// A row in brackets, which grow with what is tall; around what is flat, a font's brackets that can grow stand too
/// far off.
std::string in_brackets(const std::string& content, const std::string& open = "(", const std::string& close = ")");

}  // namespace alembert
