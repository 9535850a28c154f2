// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Mathematics as its author wrote it, in MathML Core: what stands in a derivation, not yet read as names of a
/// scene.
///
///     written_mathml(*statement.sides[0], {.offset = line.term_offset, .length = line.term_length})
///
/// Gives the elements inside <math>, without it.

#include <string>

#include "check/written/math.hpp"

namespace alembert {

/// The part of the document that is shown as wrong; none if the length is 0.
struct WrongPart {
    std::size_t offset = 0, length = 0;
};

std::string written_mathml(const Math& math, const WrongPart& wrong = {});

/// A formula of LaTeX among words, with its <math>; its text where it cannot be read.
std::string latex_math(const std::string& latex);

}  // namespace alembert
