// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// GiNaC's `factor` where it ends soon; the expression itself elsewhere.
///
///     factored(2*x*y + 2*x)        // 2*x*(y + 1)
///
/// Square-free factorization and multivariate Hensel lifting have no useful bound of their own: time grows with
/// terms, variables and degrees together. The bound here is on these, so that the answer is the same on every
/// computer.

#include <ginac/ginac.h>

namespace alembert {

/// A product of factors, or `e` where it is no polynomial in its symbols with rational coefficients, or a large
/// one.
GiNaC::ex factored(const GiNaC::ex& e);

}  // namespace alembert
