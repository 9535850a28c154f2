// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes terms that are divided by functions of the state as a textbook prints them, for equations in momenta.
///
///     p_psi/C − (p_phi − p_psi·cos θ)·cos θ/(A·sin²θ)       and not four quotients over A·sin²θ
///
/// Terms of the same degree in the momenta that are divided by functions of the state get a common denominator, in
/// lowest terms and factored, where that is shorter.

#include "algebra/notation/readable.hpp"

namespace alembert {

/// Terms with rates come first, then terms with momenta, then the others.
Phrase in_fractions(const Fourier& f, const Symbols& symbols);

/// lhs = rhs, which is not multiplied by the denominators of its terms in momenta unless that makes it much
/// shorter: m·r″ − p²/(m·r³) = 0, not m²·r″ − p²/r³ = 0.
ReadableEquation equation_in_fractions(const Fourier& lhs, const Fourier& rhs, const Symbols& symbols);

}  // namespace alembert
