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

}  // namespace alembert
