// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// All roots of a polynomial with discs that contain them, and on which side of the imaginary axis they lie.
///
///     roots_of({1, 0, 1})                  // ±i, on the axis: proved, as the polynomial is even
///     roots_of({1, 0, 2, 0, 1})            // ±i, each twice
///
/// Rational coefficients: equal roots are found by square-free factors (Yun), those that lie symmetrically to the
/// origin by the common factor of p(s) and p(−s). This factor is even, and a real negative u = s² is a pair on the
/// axis. So what lies on the axis is known, and everything else is found by its distance from it. Other
/// coefficients: `even` says that odd powers vanish by the structure of the system.
///
/// Discs: for any z₁ … z_n the union of |z − z_i| ≤ n |p(z_i)| / (|a₀| Π_{j≠i} |z_i − z_j|) holds all roots, and k
/// discs that touch each other and no other hold k (Smith, J. ACM 17 (1970) 661). The z_i are found by Aberth's
/// iteration in 34 digits.

#include <complex>
#include <vector>

#include "stability/matrix.hpp"

namespace alembert {

struct RootOf {
    enum class Side { left, axis, right, unclear };
    std::complex<double> value;
    double radius = 0;     ///< of the disc
    int multiplicity = 1;  ///< such a root counts once in the list for each time
    Side side = Side::unclear;
};

/// By real part, then imaginary part. The first coefficient is not zero.
std::vector<RootOf> roots_of(CertainVector coefficients, bool even = false);

/// Greatest common divisor, monic; coefficients rational, highest power first.
std::vector<Rational> common_divisor(std::vector<Rational> a, std::vector<Rational> b);

}  // namespace alembert
