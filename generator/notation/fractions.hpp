// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What is divided by functions of the state, as a textbook prints it: equations in momenta.
///
///     p_psi/C − (p_phi − p_psi·cos θ)·cos θ/(A·sin²θ)       and not four quotients over A·sin²θ
///
/// Terms of one degree in the momenta that are divided by functions of the state stand over one denominator, in
/// lowest terms and in factors, where that is shorter.

#include "notation/readable.hpp"

namespace alembert {

/// Terms with rates, then with momenta, then the others.
Phrase in_fractions(const Fourier& f, const Symbols& symbols);

/// lhs = rhs, not multiplied by what its terms in momenta are divided by, unless it is much shorter then:
/// m·r″ − p²/(m·r³) = 0, not m²·r″ − p²/r³ = 0.
ReadableEquation equation_in_fractions(const Fourier& lhs, const Fourier& rhs, const Symbols& symbols);

}  // namespace alembert
