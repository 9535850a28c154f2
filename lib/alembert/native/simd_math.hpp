// SPDX-License-Identifier: MIT
#pragma once

/// Functions that machine code in memory calls (executable.hpp), with the meaning that they have in emitted files.
///
///     double values[12] = {0.5, 1.0, 1.5, 1.5};   // four angles, then room for their sines and cosines
///     sines_for_code(values, 4);
///     values[4];                                  // sin 0.5
///     values[8];                                  // cos 0.5

namespace alembert {

/// sin r = r − r³ P(r²), cos r = 1 − r²/2 + r⁴ Q(r²) for |r| ≤ π/4: P and Q from the lowest power (minimax; the
/// template templates/sines.cpp.mustache has the same). π/2 in three parts of 53 bits, 2/π, and a number whose
/// addition rounds to a whole number in the last bits.
inline constexpr double sine_coefficients[6]{0.1666666666666663,     -0.008333333333322118,
                                             0.00019841269829589533, -2.7557313621383334e-06,
                                             2.505074776244275e-08,  -1.5896230131492603e-10};
inline constexpr double cosine_coefficients[6]{0.041666666666666595,   -0.0013888888888873056,
                                               2.4801587288851683e-05, -2.755731417929107e-07,
                                               2.0875700841213046e-09, -1.13585364822807e-11};
inline constexpr double quarter_turn[3]{0x1.921fb54442d18p0, 0x1.1a62633145c06p-54, 0x1.c1cd129024e09p-107};
inline constexpr double quarters_per_radian = 0x1.45f306dc9c883p-1, rounding_shift = 0x1.8p52;

/// The largest angle whose sine and cosine are computed by polynomials.
inline constexpr double farthest_for_code = 1e8;

/// The sines and cosines of `count` angles, each within 2 ulp up to 1e8 and libm's beyond. `count` is a multiple
/// of four; the sines stand after the angles, and the cosines after the sines. Only for processors with AVX2 and
/// FMA.
void sines_for_code(double* values, int count);

/// The same where `count` is a multiple of eight and the array begins at a multiple of 64 bytes. Only for
/// processors with AVX-512.
void sines_of_packs_for_code(double* values, int count);

/// values[i] = f(values[i]), and values[i] = f(values[i], values[i + 8]), for i = 0 … 7; of four likewise.
void each_for_code(double (*f)(double), double* values);
void each_pair_for_code(double (*f)(double, double), double* values);
void each_of_four_for_code(double (*f)(double), double* values);
void each_pair_of_four_for_code(double (*f)(double, double), double* values);
void each_triple_for_code(double (*f)(double, double, double), double* values);
void each_triple_of_four_for_code(double (*f)(double, double, double), double* values);

double sign_for_code(double x);
double lesser_for_code(double x, double y);   ///< NaN if one of the two is
double greater_for_code(double x, double y);  ///< likewise

}  // namespace alembert
