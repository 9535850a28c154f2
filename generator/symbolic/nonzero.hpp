// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A quick look at one state: most of what is not identically zero shows there.
///
///     if (shows_nonzero(e, z)) …        // then no normal form is needed to refuse e = 0
///
/// Symbols get fixed numbers of order one, and each operation carries along how far rounding may have moved its
/// value (a running error bound of first order: Higham, Accuracy and Stability of Numerical Algorithms (2002),
/// §3.3). True only where the value is 10⁵ times that bound; false says nothing. Polynomials, powers, sines and
/// cosines are looked at; anything else gives false.

#include "symbolic/intermediates.hpp"

namespace alembert {

bool shows_nonzero(const GiNaC::ex& e, const Intermediates& z);

}  // namespace alembert
