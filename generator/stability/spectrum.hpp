// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// All roots of a polynomial, with discs that contain them and the side of the imaginary axis on which they lie.
///
///     roots_of({1, 0, 1})                  // ±i, on the axis: proved, as the polynomial is even
///     roots_of({1, 0, 2, 0, 1})            // ±i, each twice
///
/// If the coefficients are rational, equal roots are found by square-free factors (Yun), and roots that are
/// symmetric about the origin by the common factor of p(s) and p(−s). This factor is even, and a real negative u =
/// s² is a pair on the axis. So the roots on the axis are known exactly, and the sides of all others follow from
/// their distance from it. For other coefficients, `even` says that odd powers vanish by the structure of the
/// system.
///
/// For any z₁ … z_n the union of the discs |z − z_i| ≤ n |p(z_i)| / (|a₀| Π_{j≠i} |z_i − z_j|) contains all roots,
/// and k discs that touch each other and no other contain k roots (Smith, J. ACM 17 (1970) 661). The z_i are found
/// by Aberth's iteration in 34 digits.

#include <complex>
#include <vector>

#include "stability/interval/matrix.hpp"

namespace alembert {

struct RootOf {
    enum class Side { left, axis, right, unclear };
    std::complex<double> value;
    double radius = 0;     ///< of the disc
    int multiplicity = 1;  ///< a multiple root is in the list as many times
    Side side = Side::unclear;
};

/// The order of roots in lists: by real part, then imaginary part. A real part of roundings alone decides nothing.
bool precedes(const RootOf& a, const RootOf& b);

/// The roots in this order. The first coefficient must not be zero.
std::vector<RootOf> roots_of(RealBallVector coefficients, bool even = false);

}  // namespace alembert
