// SPDX-License-Identifier: MIT
#include "alembert/native/simd_math.hpp"

#include <cmath>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "alembert/native/registers.hpp"

// Sines and cosines of four angles at once, as in templates/sines.cpp.mustache, which says more:
//
//   x = k π/2 + r, |r| ≤ π/4, with π/2 in three parts of 53 bits (Cody & Waite 1980, ch. 8);
//   sin r = r − r³ P(r²), cos r = 1 − r²/2 + r⁴ Q(r²), minimax polynomials; k mod 4 says which goes where.

namespace alembert {

#if defined(__x86_64__)
namespace {

ALEMBERT_WIDE inline __m256d all(double x) {
    return _mm256_set1_pd(x);
}

/// a + b z
ALEMBERT_WIDE inline __m256d line(double a, double b, __m256d z) {
    return _mm256_fmadd_pd(all(b), z, all(a));
}

/// c₀ + c₁ z + … + c₅ z⁵
ALEMBERT_WIDE inline __m256d polynomial(const double (&c)[6], __m256d z, __m256d zz) {
    return _mm256_fmadd_pd(zz, _mm256_fmadd_pd(zz, line(c[4], c[5], z), line(c[2], c[3], z)), line(c[0], c[1], z));
}

/// The sign that the second bit of a number of quarter turns gives.
ALEMBERT_WIDE inline __m256d sign_of(__m256i quarters) {
    return _mm256_and_pd(_mm256_castsi256_pd(_mm256_slli_epi64(quarters, 62)), all(-0.0));
}

ALEMBERT_WIDE inline bool are_near(__m256d x) {
    return _mm256_movemask_pd(_mm256_cmp_pd(_mm256_andnot_pd(all(-0.0), x), all(farthest_for_code), _CMP_LE_OQ)) ==
           15;
}

/// A number that is loaded by itself: a wide load of numbers that were just written one by one would wait for
/// them.
inline double alone(double x) {
    __asm__("" : "+x"(x));
    return x;
}

[[gnu::noinline, gnu::cold]] void sines_far(const double* angles, double* sines, double* cosines) {
    for (int i = 0; i < 4; ++i)
        if (!(std::abs(angles[i]) <= farthest_for_code))
            sines[i] = std::sin(angles[i]), cosines[i] = std::cos(angles[i]);
}

}  // namespace

ALEMBERT_WIDE void sines_for_code(double* values, int count) {
    for (int k = 0; k < count; k += 4) {
        double *const angles = values + k, *const sines = angles + count, *const cosines = sines + count;
        const __m256d x = _mm256_set_pd(alone(angles[3]), alone(angles[2]), alone(angles[1]), alone(angles[0]));
        // Adding this number rounds to a whole number, in the last bits.
        const __m256d shift = all(rounding_shift), shifted = _mm256_fmadd_pd(x, all(quarters_per_radian), shift);
        const __m256d turns = _mm256_sub_pd(shifted, shift);
        __m256d r = _mm256_fnmadd_pd(turns, all(quarter_turn[0]), x);
        r = _mm256_fnmadd_pd(turns, all(quarter_turn[1]), r);
        r = _mm256_fnmadd_pd(turns, all(quarter_turn[2]), r);
        const __m256d z = _mm256_mul_pd(r, r), zz = _mm256_mul_pd(z, z);
        const __m256d P = polynomial(sine_coefficients, z, zz);
        const __m256d Q = polynomial(cosine_coefficients, z, zz);
        const __m256d s = _mm256_mul_pd(r, _mm256_fnmadd_pd(z, P, all(1)));
        const __m256d c = _mm256_fmadd_pd(zz, Q, line(1, -0.5, z));
        // The lowest bit of the number of quarter turns says whether sine and cosine change places.
        const __m256i quarters = _mm256_castpd_si256(shifted),
                      next = _mm256_add_epi64(quarters, _mm256_set1_epi64x(1));
        const __m256d odd = _mm256_castsi256_pd(_mm256_slli_epi64(quarters, 63));
        _mm256_storeu_pd(sines, _mm256_xor_pd(_mm256_blendv_pd(s, c, odd), sign_of(quarters)));
        _mm256_storeu_pd(cosines, _mm256_xor_pd(_mm256_blendv_pd(c, s, odd), sign_of(next)));
        if (!are_near(x)) sines_far(angles, sines, cosines);
    }
}

namespace {

ALEMBERT_WIDEST inline __m512d eight(double x) {
    return _mm512_set1_pd(x);
}

ALEMBERT_WIDEST inline __m512d line(double a, double b, __m512d z) {
    return _mm512_fmadd_pd(eight(b), z, eight(a));
}

ALEMBERT_WIDEST inline __m512d polynomial(const double (&c)[6], __m512d z, __m512d zz) {
    return _mm512_fmadd_pd(zz, _mm512_fmadd_pd(zz, line(c[4], c[5], z), line(c[2], c[3], z)), line(c[0], c[1], z));
}

ALEMBERT_WIDEST inline __m512d sign_of(__m512i quarters) {
    return _mm512_and_pd(_mm512_castsi512_pd(_mm512_slli_epi64(quarters, 62)), eight(-0.0));
}

}  // namespace

ALEMBERT_WIDEST void sines_of_packs_for_code(double* values, int count) {
    for (int k = 0; k < count; k += 8) {
        double *const angles = values + k, *const sines = angles + count, *const cosines = sines + count;
        const __m512d x = _mm512_load_pd(angles);
        const __m512d shift = eight(rounding_shift),
                      shifted = _mm512_fmadd_pd(x, eight(quarters_per_radian), shift);
        const __m512d turns = _mm512_sub_pd(shifted, shift);
        __m512d r = _mm512_fnmadd_pd(turns, eight(quarter_turn[0]), x);
        r = _mm512_fnmadd_pd(turns, eight(quarter_turn[1]), r);
        r = _mm512_fnmadd_pd(turns, eight(quarter_turn[2]), r);
        const __m512d z = _mm512_mul_pd(r, r), zz = _mm512_mul_pd(z, z);
        const __m512d P = polynomial(sine_coefficients, z, zz);
        const __m512d Q = polynomial(cosine_coefficients, z, zz);
        const __m512d s = _mm512_mul_pd(r, _mm512_fnmadd_pd(z, P, eight(1)));
        const __m512d c = _mm512_fmadd_pd(zz, Q, line(1, -0.5, z));
        const __m512i quarters = _mm512_castpd_si512(shifted),
                      next = _mm512_add_epi64(quarters, _mm512_set1_epi64(1));
        const __mmask8 odd = _mm512_test_epi64_mask(quarters, _mm512_set1_epi64(1));
        _mm512_store_pd(sines, _mm512_xor_pd(_mm512_mask_blend_pd(odd, s, c), sign_of(quarters)));
        _mm512_store_pd(cosines, _mm512_xor_pd(_mm512_mask_blend_pd(odd, c, s), sign_of(next)));
        const __mmask8 near = _mm512_cmp_pd_mask(_mm512_abs_pd(x), eight(farthest_for_code), _CMP_LE_OQ);
        if (near != 0xff)
            for (int half = 0; half < 8; half += 4) sines_far(angles + half, sines + half, cosines + half);
    }
}
#else
void sines_of_packs_for_code(double* values, int count) {
    sines_for_code(values, count);
}

void sines_for_code(double* values, int count) {
    for (int k = 0; k < count; ++k) {
        values[count + k] = std::sin(values[k]);
        values[2 * count + k] = std::cos(values[k]);
    }
}
#endif

void each_for_code(double (*f)(double), double* values) {
    for (int i = 0; i < 8; ++i) values[i] = f(values[i]);
}

void each_pair_for_code(double (*f)(double, double), double* values) {
    for (int i = 0; i < 8; ++i) values[i] = f(values[i], values[i + 8]);
}

void each_of_four_for_code(double (*f)(double), double* values) {
    for (int i = 0; i < 4; ++i) values[i] = f(values[i]);
}

void each_pair_of_four_for_code(double (*f)(double, double), double* values) {
    for (int i = 0; i < 4; ++i) values[i] = f(values[i], values[i + 4]);
}

void each_triple_for_code(double (*f)(double, double, double), double* values) {
    for (int i = 0; i < 8; ++i) values[i] = f(values[i], values[i + 8], values[i + 16]);
}

void each_triple_of_four_for_code(double (*f)(double, double, double), double* values) {
    for (int i = 0; i < 4; ++i) values[i] = f(values[i], values[i + 4], values[i + 8]);
}

double sign_for_code(double x) {
    return std::isnan(x) ? x : static_cast<double>(x > 0) - static_cast<double>(x < 0);
}

double lesser_for_code(double x, double y) {
    return y < x || std::isnan(y) ? y : x;
}

double greater_for_code(double x, double y) {
    return x < y || std::isnan(y) ? y : x;
}

}  // namespace alembert
