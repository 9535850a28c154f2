// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Applies GiNaC's `factor` if it is sure to end soon; otherwise gives the expression itself.
///
///     factored(2*x*y + 2*x)        // 2*x*(y + 1)
///
/// Square-free factorization and multivariate Hensel lifting have no useful bound of their own: time grows with
/// terms, variables and degrees together. The bound here is on these numbers, so that the answer is the same on
/// every computer.

#include <ginac/ginac.h>

namespace alembert {

/// A product of factors, or `e` itself if it is no polynomial in its symbols with rational coefficients or is too
/// large.
GiNaC::ex factored(const GiNaC::ex& e);

}  // namespace alembert
