// SPDX-License-Identifier: MIT
#pragma once

/// Functions that machine code in memory calls (executable.hpp), with the meaning that they have in emitted files.
///
///     double values[12] = {0.5, 1.0, 1.5, 1.5};   // four angles, then room for their sines and cosines
///     sines_for_code(values, 4);
///     values[4];                                  // sin 0.5
///     values[8];                                  // cos 0.5

namespace alembert {

/// The largest angle whose sine and cosine are computed by polynomials.
inline constexpr double farthest_for_code = 1e8;

/// The sines and cosines of `count` angles, each within 2 ulp up to 1e8 and libm's beyond. `count` is a multiple
/// of four; the sines stand after the angles, and the cosines after the sines. Only for processors with AVX2 and
/// FMA.
void sines_for_code(double* values, int count);

/// The same where `count` is a multiple of eight and the array begins at a multiple of 64 bytes. Only for
/// processors with AVX-512.
void sines_of_packs_for_code(double* values, int count);

/// values[i] = f(values[i]), and values[i] = f(values[i], values[i + 8]), for i = 0 … 7.
void each_for_code(double (*f)(double), double* values);
void each_pair_for_code(double (*f)(double, double), double* values);

double sign_for_code(double x);
double lesser_for_code(double x, double y);   ///< NaN if one of the two is
double greater_for_code(double x, double y);  ///< likewise

}  // namespace alembert
