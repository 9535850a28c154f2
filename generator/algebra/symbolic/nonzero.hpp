// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A quick test at one state, which recognizes most expressions that are not identically zero.
///
///     if (shows_nonzero(e, z)) …        // then no normal form is needed to refuse e = 0
///
/// Symbols get fixed numbers of order one, and each operation carries along how far rounding may have moved its
/// value (a running error bound of first order: Higham, Accuracy and Stability of Numerical Algorithms (2002),
/// §3.3). The result is true only if the value is 10⁵ times that bound; false means nothing. Only polynomials,
/// powers, sines and cosines are evaluated; anything else gives false.

#include "algebra/symbolic/intermediates.hpp"

namespace alembert {

bool shows_nonzero(const GiNaC::ex& e, const Intermediates& z);

}  // namespace alembert
