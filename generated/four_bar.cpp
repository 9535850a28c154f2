// SPDX-License-Identifier: MIT
// Equations of motion of 'four_bar': routh, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//   alembert emit four_bar.toml -o .
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[6]        alpha [rad], beta [rad], gamma [rad], then their rates
//   rate[6]         d state / dt
//   par[16]         a = 1 [m], b = 4 [m], c = 3.5 [m], d = 3 [m], m1 = 1 [kg], m2 = 2 [kg], m3 = 1.5 [kg],
//                   then 9 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[9], M row by row; forcing[3], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   constraints_at  position[2], velocity[2]; rows[6], A row by row
//   rows of A       x, y
//   multipliers_at  lambda[2]: lambda_x, lambda_y
//   project         out[6], position[2], pivots[2]
//   cost            97 operations a right-hand side: 28 additions, 58 multiplications, 3 divisions, 8 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "four_bar.cpp"
//
//   int main() {
//       const double state[6] = {0.5, 0.839510959448, 1.41332050088, 2, -0.729076763624, -0.350567744451};
//       double par[16], rate[6];
//       for (int k = 0; k < 7; ++k) par[k] = four_bar::parameter_values[k];
//       four_bar::prepare(par);
//       four_bar::rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // some are for other types of numbers
#pragma GCC diagnostic ignored "-Wpsabi"            // all functions with vectors are inline
namespace four_bar::code_c46f44f9 {
namespace {  // seen in this file alone

// Sines and cosines in pairs, of one angle or of several at once; at the end of this file.
template <typename Real> struct pair;
template <typename Real, unsigned count> struct sines;
template <typename Real> pair<Real> sincos(const Real& x);
template <typename Real, typename... Angle> sines<Real, 1 + sizeof...(Angle)> sincos(const Real& first, const Angle&... x);
inline pair<double> sincos(double x);
inline double sin(double x), cos(double x);
inline float sin(float x), cos(float x);
inline long double sin(long double x), cos(long double x);

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &a = par[0], &b = par[1], &c = par[2], &m1 = par[4], &m2 = par[5], &m3 = par[6];

    // Constants
    const Real z0 = a * a * (m1 + Real(3) * m2);
    const Real M00 = (Real(1) / Real(3)) * z0;
    const Real k0 = Real(0.5) * a * b * m2;
    const Real z1 = b * b * m2;
    const Real M11 = (Real(1) / Real(3)) * z1;
    const Real z2 = c * c * m3;
    const Real M22 = (Real(1) / Real(3)) * z2;
    const Real k1 = Real(3) * Real(1) / z1;
    const Real k2 = Real(3) * Real(1) / z2;
    const Real k3 = (Real(1) / Real(6)) * z0;
    const Real k4 = (Real(1) / Real(6)) * z1;
    const Real k5 = (Real(1) / Real(6)) * z2;

    // Result
    par[7] = M00;
    par[8] = k0;
    par[9] = M11;
    par[10] = M22;
    par[11] = k1;
    par[12] = k2;
    par[13] = k3;
    par[14] = k4;
    par[15] = k5;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &alpha = state[0], &beta = state[1], &gamma = state[2], &alpha_dot = state[3];
    const Real &beta_dot = state[4], &gamma_dot = state[5];
    const Real &a = par[0], &b = par[1], &c = par[2], &M00 = par[7], &k0 = par[8], &k1 = par[11], &k2 = par[12];

    // Trigonometry
    const Real phi0 = alpha - beta;
    const auto trig0 = sincos(phi0, alpha, beta, gamma);
    const Real sin_phi0 = trig0.sine[0], cos_phi0 = trig0.cosine[0], sin_alpha = trig0.sine[1],
        cos_alpha = trig0.cosine[1], sin_beta = trig0.sine[2], cos_beta = trig0.cosine[2], sin_gamma = trig0.sine[3],
        cos_gamma = trig0.cosine[3];

    // Shared terms
    const Real z0 = beta_dot * beta_dot;
    const Real z1 = alpha_dot * alpha_dot;

    // Mass matrix M(q), lower triangle
    // M20 = 0, M21 = 0
    const Real M10 = k0 * cos_phi0;

    // Forcing f
    // f2 = 0
    const Real z2 = k0 * sin_phi0;
    const Real f0 = -z2 * z0;
    const Real f1 = z2 * z1;

    // Constraints A q'' = gamma
    const Real z3 = a * sin_alpha;
    const Real z4 = b * sin_beta;
    const Real A0_2 = c * sin_gamma;
    const Real A1_0 = a * cos_alpha;
    const Real A1_1 = b * cos_beta;
    const Real z5 = c * cos_gamma;
    const Real z6 = gamma_dot * gamma_dot;
    const Real gamma0 = A1_0 * z1 + A1_1 * z0 - z5 * z6;
    const Real gamma1 = z3 * z1 + z4 * z0 - A0_2 * z6;

    // Solve M q'' = f + A^T lambda, A q'' = gamma
    const Real z7 = k1 * M10;
    const Real z8 = Real(1) / (M00 - M10 * z7);
    const Real z9 = f1 * z7 - f0;
    const Real z10 = k1 * z4;
    const Real z11 = z3 - M10 * z10;
    const Real z12 = z11 * z8;
    const Real z13 = k2 * A0_2;
    const Real z14 = z11 * z12 + (z4 * z10 + A0_2 * z13);
    const Real z15 = k1 * A1_1;
    const Real z16 = A1_0 - M10 * z15;
    const Real z17 = z16 * z8;
    const Real z18 = k2 * z5;
    const Real z19 = z11 * z17 + (z4 * z15 + A0_2 * z18);
    const Real z20 = z16 * z17 + (A1_1 * z15 + z5 * z18);
    const Real z21 = Real(1) / z20;
    const Real z22 = z19 * z21;
    const Real z23 = Real(1) / (z14 - z19 * z22);
    const Real z24 = (gamma0 + f1 * z10) - z9 * z12;
    const Real z25 = (gamma1 - f1 * z15) + z9 * z17;
    const Real z26 = z23 * (z24 + z25 * z22);
    const Real z27 = z21 * z25 + z22 * z26;
    const Real z28 = z8 * z9 + z12 * z26 - z17 * z27;
    const Real alpha_ddot = -z28;
    const Real z29 = k1 * f1;
    const Real beta_ddot = z29 - z26 * z10 + z27 * z15 + z7 * z28;
    const Real gamma_ddot = z26 * z13 - z27 * z18;

    // Result
    rate[0] = alpha_dot;
    rate[1] = beta_dot;
    rate[2] = gamma_dot;
    rate[3] = alpha_ddot;
    rate[4] = beta_ddot;
    rate[5] = gamma_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &alpha = state[0], &beta = state[1], &alpha_dot = state[3], &beta_dot = state[4];
    const Real &M00 = par[7], &k0 = par[8], &M11 = par[9], &M22 = par[10];

    // Trigonometry
    const Real phi0 = alpha - beta;
    const auto [sin_phi0, cos_phi0] = sincos(phi0);

    // Mass matrix M(q), lower triangle
    const Real M10 = k0 * cos_phi0;

    // Forcing f
    const Real z0 = k0 * sin_phi0;
    const Real f0 = -z0 * beta_dot * beta_dot;
    const Real f1 = z0 * alpha_dot * alpha_dot;

    // Result
    mass[0] = M00;
    mass[1] = mass[3] = M10;
    mass[4] = M11;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = M22;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = Real(0);
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &alpha = state[0], &beta = state[1], &alpha_dot = state[3], &beta_dot = state[4];
    const Real &gamma_dot = state[5];
    const Real &k0 = par[8], &k3 = par[13], &k4 = par[14], &k5 = par[15];

    // Trigonometry
    const Real phi0 = alpha - beta;
    const Real cos_phi0 = cos(phi0);

    // Energy
    const Real z0 = k3 * alpha_dot * alpha_dot;
    const Real z1 = alpha_dot * beta_dot * k0 * cos_phi0;
    const Real T = z0 + z1 + k4 * beta_dot * beta_dot + k5 * gamma_dot * gamma_dot;

    // Result
    energy[0] = T;
    energy[1] = Real(0);
    energy[2] = T;
    energy[3] = Real(0);
    jacobi[0] = T;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real* par, Real* position, Real* velocity, Real* rows) {
    const Real &alpha = state[0], &beta = state[1], &gamma = state[2], &alpha_dot = state[3];
    const Real &beta_dot = state[4], &gamma_dot = state[5];
    const Real &a = par[0], &b = par[1], &c = par[2], &d = par[3];

    // Trigonometry
    const auto trig0 = sincos(alpha, beta, gamma);
    const Real sin_alpha = trig0.sine[0], cos_alpha = trig0.cosine[0], sin_beta = trig0.sine[1],
        cos_beta = trig0.cosine[1], sin_gamma = trig0.sine[2], cos_gamma = trig0.cosine[2];

    // Constraints
    const Real z0 = a * sin_alpha;
    const Real z1 = b * sin_beta;
    const Real z2 = c * sin_gamma;
    const Real z3 = a * cos_alpha;
    const Real z4 = b * cos_beta;
    const Real z5 = c * cos_gamma;

    // Result
    position[0] = (z3 + z4) - (d + z5);
    position[1] = (z0 + z1) - z2;
    velocity[0] = gamma_dot * z2 - alpha_dot * z0 - beta_dot * z1;
    velocity[1] = alpha_dot * z3 + beta_dot * z4 - gamma_dot * z5;
    rows[0] = -z0;
    rows[1] = -z1;
    rows[2] = z2;
    rows[3] = z3;
    rows[4] = z4;
    rows[5] = -z5;
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real* state, const Real* par, Real* lambda) {
    const Real &alpha = state[0], &beta = state[1], &gamma = state[2], &alpha_dot = state[3];
    const Real &beta_dot = state[4], &gamma_dot = state[5];
    const Real &a = par[0], &b = par[1], &c = par[2], &M00 = par[7], &k0 = par[8], &k1 = par[11], &k2 = par[12];

    // Trigonometry
    const Real phi0 = alpha - beta;
    const auto trig0 = sincos(phi0, alpha, beta, gamma);
    const Real sin_phi0 = trig0.sine[0], cos_phi0 = trig0.cosine[0], sin_alpha = trig0.sine[1],
        cos_alpha = trig0.cosine[1], sin_beta = trig0.sine[2], cos_beta = trig0.cosine[2], sin_gamma = trig0.sine[3],
        cos_gamma = trig0.cosine[3];

    // Multipliers
    const Real z0 = k0 * cos_phi0;
    const Real z1 = k0 * sin_phi0;
    const Real z2 = beta_dot * beta_dot;
    const Real z3 = alpha_dot * alpha_dot;
    const Real z4 = z1 * z3;
    const Real z5 = a * sin_alpha;
    const Real z6 = b * sin_beta;
    const Real z7 = c * sin_gamma;
    const Real z8 = a * cos_alpha;
    const Real z9 = b * cos_beta;
    const Real z10 = c * cos_gamma;
    const Real z11 = gamma_dot * gamma_dot;
    const Real z12 = z8 * z3 + z9 * z2 - z10 * z11;
    const Real z13 = z5 * z3 + z6 * z2 - z7 * z11;
    const Real z14 = k1 * z0;
    const Real z15 = Real(1) / (M00 - z0 * z14);
    const Real z16 = z1 * z2 + z4 * z14;
    const Real z17 = k1 * z6;
    const Real z18 = z5 - z0 * z17;
    const Real z19 = z18 * z15;
    const Real z20 = z6 * z17 + z7 * k2 * z7;
    const Real z21 = k1 * z9;
    const Real z22 = z8 - z0 * z21;
    const Real z23 = z22 * z15;
    const Real z24 = k2 * z10;
    const Real z25 = z18 * z23 + (z6 * z21 + z7 * z24);
    const Real z26 = z22 * z23 + (z9 * z21 + z10 * z24);
    const Real z27 = Real(1) / z26;
    const Real z28 = z25 * z27;
    const Real z29 = Real(1) / ((z18 * z19 + z20) - z25 * z28);
    const Real z30 = (z12 + z4 * z17) - z16 * z19;
    const Real z31 = (z13 - z4 * z21) + z16 * z23;
    const Real lambda_x = z29 * (z30 + z31 * z28);
    const Real lambda_y = z27 * z31 + z28 * lambda_x;

    // Result
    lambda[0] = lambda_x;
    lambda[1] = lambda_y;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &alpha = state[0], &beta = state[1], &gamma = state[2], &alpha_dot = state[3];
    const Real &beta_dot = state[4], &gamma_dot = state[5];
    const Real &a = par[0], &b = par[1], &c = par[2], &d = par[3], &M00 = par[7], &k0 = par[8], &k1 = par[11];
    const Real &k2 = par[12];

    // Trigonometry
    const Real phi0 = alpha - beta;
    const auto trig0 = sincos(phi0, alpha, beta, gamma);
    const Real cos_phi0 = trig0.cosine[0], sin_alpha = trig0.sine[1], cos_alpha = trig0.cosine[1],
        sin_beta = trig0.sine[2], cos_beta = trig0.cosine[2], sin_gamma = trig0.sine[3], cos_gamma = trig0.cosine[3];
    const Real z0 = k0 * cos_phi0;
    const Real z1 = a * sin_alpha;
    const Real z2 = b * sin_beta;
    const Real z3 = c * sin_gamma;
    const Real z4 = a * cos_alpha;
    const Real z5 = b * cos_beta;
    const Real z6 = c * cos_gamma;
    const Real z7 = (z4 + z5) - (d + z6);
    const Real z8 = (z1 + z2) - z3;
    const Real z9 = k1 * z0;
    const Real z10 = Real(1) / (M00 - z0 * z9);
    const Real z11 = k1 * z2;
    const Real z12 = z1 - z0 * z11;
    const Real z13 = z12 * z10;
    const Real z14 = k2 * z3;
    const Real z15 = z12 * z13 + (z2 * z11 + z3 * z14);
    const Real z16 = k1 * z5;
    const Real z17 = z4 - z0 * z16;
    const Real z18 = z17 * z10;
    const Real z19 = k2 * z6;
    const Real z20 = z12 * z18 + (z2 * z16 + z3 * z19);
    const Real z21 = z17 * z18 + (z5 * z16 + z6 * z19);
    const Real z22 = Real(1) / z21;
    const Real z23 = z20 * z22;
    const Real z24 = z15 - z20 * z23;
    const Real z25 = Real(1) / z24;
    const Real z26 = (z7 + z8 * z23) * z25;
    const Real z27 = z8 * z22 + z23 * z26;
    const Real z28 = z13 * z26 - z18 * z27;
    const Real phi1 = alpha + z28;
    const Real z29 = z26 * z11 - z27 * z16 - z9 * z28;
    const Real phi2 = beta + z29;
    const Real phi3 = gamma - (z26 * z14 - z27 * z19);
    const auto trig1 = sincos(phi3, phi1, phi2);
    const Real sin_phi3 = trig1.sine[0], cos_phi3 = trig1.cosine[0], sin_phi1 = trig1.sine[1],
        cos_phi1 = trig1.cosine[1], sin_phi2 = trig1.sine[2], cos_phi2 = trig1.cosine[2];

    // Projection
    const Real z30 = gamma_dot * c * sin_phi3;
    const Real z31 = alpha_dot * a * sin_phi1;
    const Real z32 = z30 - z31 - beta_dot * b * sin_phi2;
    const Real z33 = gamma_dot * c * cos_phi3;
    const Real z34 = alpha_dot * a * cos_phi1;
    const Real z35 = z33 - z34 - beta_dot * b * cos_phi2;
    const Real z36 = z25 * (z32 - z23 * z35);
    const Real z37 = z22 * z35 - z23 * z36;
    const Real z38 = z13 * z36 + z18 * z37;
    const Real z39 = z36 * z11 + z37 * z16 - z9 * z38;

    // Result
    out[0] = phi1;
    out[1] = phi2;
    out[2] = phi3;
    out[3] = alpha_dot + z38;
    out[4] = beta_dot + z39;
    out[5] = gamma_dot - (z36 * z14 + z37 * z19);
    position[0] = z7;
    position[1] = z8;
    pivots[0] = z24;
    pivots[1] = z21;
}

/// gamma of A q'' = gamma.
template <typename Real>
void gamma_at(const Real&, const Real* state, const Real* par, Real* out) {
    const Real &alpha = state[0], &beta = state[1], &gamma = state[2], &alpha_dot = state[3];
    const Real &beta_dot = state[4], &gamma_dot = state[5];
    const Real &a = par[0], &b = par[1], &c = par[2];

    // Trigonometry
    const auto trig0 = sincos(alpha, beta, gamma);
    const Real sin_alpha = trig0.sine[0], cos_alpha = trig0.cosine[0], sin_beta = trig0.sine[1],
        cos_beta = trig0.cosine[1], sin_gamma = trig0.sine[2], cos_gamma = trig0.cosine[2];

    // Constraints
    const Real z0 = beta_dot * beta_dot;
    const Real z1 = alpha_dot * alpha_dot;
    const Real z2 = a * cos_alpha * z1;
    const Real z3 = b * cos_beta * z0;
    const Real z4 = gamma_dot * gamma_dot;
    const Real gamma0 = z2 + z3 - c * cos_gamma * z4;
    const Real z5 = a * sin_alpha * z1;
    const Real z6 = b * sin_beta * z0;
    const Real gamma1 = z5 + z6 - c * sin_gamma * z4;

    // Result
    out[0] = gamma0;
    out[1] = gamma1;
}

// Sines and cosines of several angles at once, each within 2 ulp; lanes of a vector are angles.
//
//   x = k pi/2 + r, |r| <= pi/4: pi/2 in three parts of 53 bits where multiplication and addition fuse, so that x - k pi/2 is exact
//   up to the roundings of the last two steps, of which the last counts only where r is tiny; else in four, the first three of
//   27 bits, so that their products with k are exact and so is all of r but one rounding of hi and the last part, lo (Cody & Waite
//   1980, ch. 8);
//   sin r = r - r^3 P(r^2), cos r = 1 - r^2/2 + r^4 Q(r^2), minimax polynomials; k mod 4 says which goes where.
//
// Angles beyond 1e8, infinities and NaN go to libm.

using real2 = double __attribute__((vector_size(16)));
using real4 = double __attribute__((vector_size(32)));
using real8 = double __attribute__((vector_size(64)));
using bits2 = long long __attribute__((vector_size(16)));
using bits4 = long long __attribute__((vector_size(32)));
using bits8 = long long __attribute__((vector_size(64)));

template <typename Real> struct pair { Real s, c; };
template <typename Real, unsigned count> struct sines { Real sine[count], cosine[count]; };

/// Stands where a sum has to be made as it is written, also for a compiler that may make it in another order.
#if defined(__FAST_MATH__) || defined(ALEMBERT_REASSOCIATES)
template <typename Real> [[gnu::always_inline]] inline Real&& as_written(Real&& x) {
#if defined(__AVX512F__)
    constexpr unsigned widest = 64;
#elif defined(__AVX__)
    constexpr unsigned widest = 32;
#else
    constexpr unsigned widest = 16;
#endif
    if constexpr (sizeof x > widest)
        __asm__("" : "+m"(x));
    else
#if defined(__x86_64__)
        __asm__("" : "+v"(x));
#elif defined(__aarch64__)
        __asm__("" : "+w"(x));
#else
        __asm__("" : "+m"(x));
#endif
    return static_cast<Real&&>(x);
}
#else
template <typename Real> [[gnu::always_inline]] inline const Real& as_written(const Real& x) { return x; }
#endif
constexpr double farthest = 1e8;
[[gnu::always_inline]] inline bool is_near(double x) { return __builtin_fabs(x) <= farthest; }
/// Are all angles near whose squares make this sum? (If not, some may be.)
[[gnu::always_inline]] inline bool is_near_all(double squares) { return squares <= farthest * farthest; }
[[gnu::always_inline]] inline double sum_of(const real2& x) { return x[0] + x[1]; }
[[gnu::always_inline]] inline double sum_of(const real4& x) { return sum_of(__builtin_shufflevector(x, x, 0, 1) + __builtin_shufflevector(x, x, 2, 3)); }
[[gnu::always_inline]] inline double sum_of(const real8& x) { return sum_of(__builtin_shufflevector(x, x, 0, 1, 2, 3) + __builtin_shufflevector(x, x, 4, 5, 6, 7)); }

/// a b + c with one rounding, where the processor has that.
#if defined(__FMA__)
[[gnu::always_inline]] inline double fused(double a, double b, double c) { return __builtin_fma(a, b, c); }
[[gnu::always_inline]] inline real2 fused(const real2& a, double b, const real2& c) { return __builtin_ia32_vfmaddpd(a, real2{b, b}, c); }
[[gnu::always_inline]] inline real4 fused(const real4& a, double b, const real4& c) { return __builtin_ia32_vfmaddpd256(a, real4{b, b, b, b}, c); }
#if defined(__AVX512F__)
[[gnu::always_inline]] inline real8 fused(const real8& a, double b, const real8& c) {
    return __builtin_ia32_vfmaddpd512_mask(a, real8{b, b, b, b, b, b, b, b}, c, static_cast<unsigned char>(-1), 4);
}
#endif
#endif
#if !defined(__FMA__)
template <typename Real> constexpr bool fuses = false;
#elif defined(__AVX512F__)
template <typename Real> constexpr bool fuses = __is_same(Real, double) || __is_same(Real, real2) || __is_same(Real, real4) || __is_same(Real, real8);
#else
template <typename Real> constexpr bool fuses = __is_same(Real, double) || __is_same(Real, real2) || __is_same(Real, real4);
#endif

template <typename Bits, typename Real>
[[gnu::always_inline]] inline void sines_near(const Real& x, Real& sine, Real& cosine) {
    constexpr double shift = 0x1.8p52;  // adding it rounds to a whole number, in the last bits
    const Real shifted = as_written(x * 0x1.45f306dc9c883p-1 + shift), turns = as_written(shifted - shift);
    const Bits k = __builtin_bit_cast(Bits, shifted);
    Real hi, lo;
    if constexpr (fuses<Real>) {
        hi = fused(turns, -0x1.1a62633145c06p-54, as_written(fused(turns, -0x1.921fb54442d18p0, x)));
        hi = fused(turns, -0x1.c1cd129024e09p-107, as_written(hi));
    } else {
        hi = as_written(as_written(x - turns * 0x1.921fb54p0) - turns * 0x1.10b46p-30) - turns * 0x1.1a62630p-54;
        lo = turns * 0x1.8a2e03707344ap-81;
    }
    const Real z = hi * hi, zz = z * z;
    const Real P = (0.1666666666666663 - 0.008333333333322118 * z) +
                   zz * ((0.00019841269829589533 - 2.7557313621383334e-06 * z) + zz * (2.505074776244275e-08 - 1.5896230131492603e-10 * z));
    const Real Q = (0.041666666666666595 - 0.0013888888888873056 * z) +
                   zz * ((2.4801587288851683e-05 - 2.755731417929107e-07 * z) + zz * (2.0875700841213046e-09 - 1.13585364822807e-11 * z));
    Real s;
    if constexpr (fuses<Real>)
        s = hi * as_written(1 - z * P);
    else
        s = hi - as_written(hi * z * P + lo);
    const Real c = (1 - 0.5 * z) + zz * Q;
    constexpr Bits top = Bits{} + (-0x7fffffffffffffff - 1);
    const Bits s_sign = (k << 62) & top, odd = k & 1;
    if constexpr (sizeof(Real) == 64) {  // a subtraction under a mask is one instruction there
        sine = __builtin_bit_cast(Real, __builtin_bit_cast(Bits, odd != 0 ? c : s) ^ s_sign);
        cosine = __builtin_bit_cast(Real, __builtin_bit_cast(Bits, odd != 0 ? Real{} - s : c) ^ s_sign);
    } else if constexpr (sizeof(Real) > sizeof(double)) {
        const Bits c_sign = ((k + 1) << 62) & top;
        sine = __builtin_bit_cast(Real, __builtin_bit_cast(Bits, odd != 0 ? c : s) ^ s_sign);
        cosine = __builtin_bit_cast(Real, __builtin_bit_cast(Bits, odd != 0 ? s : c) ^ c_sign);
    } else {
        const Bits c_sign = ((k + 1) << 62) & top;
        const Bits s_bits = __builtin_bit_cast(Bits, s), c_bits = __builtin_bit_cast(Bits, c), differ = (s_bits ^ c_bits) & -odd;
        sine = __builtin_bit_cast(Real, s_bits ^ differ ^ s_sign);
        cosine = __builtin_bit_cast(Real, c_bits ^ differ ^ c_sign);
    }
}

[[gnu::noinline, gnu::cold]] inline void sines_far(double x, double& sine, double& cosine) {
    sine = __builtin_sin(x);
    cosine = __builtin_cos(x);
}

[[gnu::always_inline]] inline pair<double> sincos(double x) {
    pair<double> result;
    if (__builtin_expect(is_near(x), 1))
        sines_near<long long>(x, result.s, result.c);
    else
        sines_far(x, result.s, result.c);
    return result;
}

template <typename Wide, typename Bits, typename... Angle>
[[gnu::always_inline]] inline sines<double, sizeof...(Angle)> sincos_in(Angle... x) {
    sines<double, sizeof...(Angle)> result;
    Wide s, c;
#if defined(__x86_64__)
    // One load for each: a wide load of a state that was just written number by number would wait for the stores.
    const auto alone = [](double& value) { __asm__("" : "+x"(value)); };
    (alone(x), ...);
#endif
    const Wide angles{x...};
    sines_near<Bits>(angles, s, c);
    for (unsigned i = 0; i < sizeof...(Angle); ++i) result.sine[i] = s[i], result.cosine[i] = c[i];
    if (__builtin_expect(is_near_all(sum_of(angles * angles)), 1)) return result;
    int i = 0;
    ((is_near(x) ? void() : sines_far(x, result.sine[i], result.cosine[i]), ++i), ...);
    return result;
}

inline double sin(double x) { return sincos(x).s; }
inline double cos(double x) { return sincos(x).c; }
inline float sin(float x) { return __builtin_sinf(x); }
inline float cos(float x) { return __builtin_cosf(x); }
inline long double sin(long double x) { return __builtin_sinl(x); }
inline long double cos(long double x) { return __builtin_cosl(x); }
template <typename Real> pair<Real> sincos(const Real& x) { return {sin(x), cos(x)}; }

/// Five to eight in two vectors of four at most: with AVX-512, a wide one among scalar code takes one of the two units from all of it.
template <typename... Angle>
[[gnu::always_inline]] inline sines<double, 4 + sizeof...(Angle)> sincos_in_two(double a, double b, double c, double d, Angle... x) {
    constexpr unsigned more = sizeof...(Angle);
    sines<double, 4 + more> result;
    const sines<double, 4> first = sincos_in<real4, bits4>(a, b, c, d);
    for (unsigned i = 0; i < 4; ++i) result.sine[i] = first.sine[i], result.cosine[i] = first.cosine[i];
    const auto add = [&](const sines<double, more>& rest) {
        for (unsigned i = 0; i < more; ++i) result.sine[4 + i] = rest.sine[i], result.cosine[4 + i] = rest.cosine[i];
    };
    if constexpr (more > 2)
        add(sincos_in<real4, bits4>(x...));
    else
        add(sincos_in<real2, bits2>(x...));
    return result;
}

/// Of two to eight angles.
template <typename Real, typename... Angle>
[[gnu::always_inline]] inline sines<Real, 1 + sizeof...(Angle)> sincos(const Real& first, const Angle&... x) {
    constexpr unsigned count = 1 + sizeof...(Angle);
    if constexpr (!__is_same(Real, double))
        return { {sin(first), sin(x)...}, {cos(first), cos(x)...} };
    else if constexpr (count == 2)
        return sincos_in<real2, bits2>(first, x...);
    else if constexpr (count <= 4)
        return sincos_in<real4, bits4>(first, x...);
    else
        return sincos_in_two(first, x...);
}

// The tables of alembert/native/abi.hpp.

struct alembert_solver_table {
    int abi;
    int coordinates;
    int speeds;
    int parameters;
    int constants;
    int outputs;
    int events;
    int constraints;
    const char* scene;
    const char* formulation;
    const char* const* coordinate_names;
    const char* const* speed_names;
    const char* const* parameter_names;
    const char* const* output_names;
    const char* const* event_names;
    const double* parameter_values;
    void (*prepare)(double* par);
    void (*rhs)(double t, const double* state, const double* par, double* rate);
    void (*mass_forcing)(double t, const double* state, const double* par, double* mass, double* forcing);
    void (*energy)(double t, const double* state, const double* rate, const double* par, double* energy,
                   double* jacobi);
    void (*outputs_at)(double t, const double* state, const double* rate, const double* par, double* out);
    void (*events_at)(double t, const double* state, const double* rate, const double* par, double* out);
    void (*constraints_at)(double t, const double* state, const double* par, double* position, double* velocity,
                           double* rows);
    void (*multipliers_at)(double t, const double* state, const double* par, double* lambda);
};

constexpr const char* coordinate_names[] = { "alpha", "beta", "gamma", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "a", "b", "c", "d", "m1", "m2", "m3", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 4, 3.5, 3, 1, 2, 1.5, 0};

constexpr alembert_solver_table table{
    4, 3, 3, 7, 9, 0, 0, 2, "four_bar", "routh, textbook form",
    coordinate_names, speed_names, parameter_names, output_names, event_names, parameter_values,
    [](double* par) { prepare(par); },
    [](double t, const double* state, const double* par, double* rate) { rhs(t, state, par, rate); },
    [](double t, const double* state, const double* par, double* mass, double* forcing) {
        mass_forcing(t, state, par, mass, forcing);
    },
    [](double t, const double* state, const double* rate, const double* par, double* e, double* jacobi) {
        energy(t, state, rate, par, e, jacobi);
    },
    [](double, const double*, const double*, const double*, double*) {},
    [](double, const double*, const double*, const double*, double*) {},
    [](double t, const double* state, const double* par, double* position, double* velocity, double* rows) {
        constraints_at(t, state, par, position, velocity, rows);
    },
    [](double t, const double* state, const double* par, double* lambda) { multipliers_at(t, state, par, lambda); },
};

struct alembert_projection_table {
    int abi;
    void (*project)(double t, const double* state, const double* par, double* moved, double* position,
                    double* pivots);
    void (*gamma_at)(double t, const double* state, const double* par, double* gamma);
};

constexpr alembert_projection_table projection{
    4,
    [](double t, const double* state, const double* par, double* moved, double* position, double* pivots) {
        project(t, state, par, moved, position, pivots);
    },
    [](double t, const double* state, const double* par, double* gamma) { gamma_at(t, state, par, gamma); },
};

struct alembert_tables {
    const void* solver;
    const void* derivatives;
    const void* projection;
    const void* pack;
    const void* functions;
    int independent_constraints;
};

constexpr alembert_tables all{
    &table, nullptr, &projection, nullptr, nullptr, 2,
};

}  // namespace
}  // namespace four_bar::code_c46f44f9
#pragma GCC diagnostic pop

namespace four_bar {
using code_c46f44f9::parameter_values;
using code_c46f44f9::coordinate_names;
using code_c46f44f9::speed_names;
using code_c46f44f9::parameter_names;
using code_c46f44f9::output_names;
using code_c46f44f9::event_names;
using code_c46f44f9::table;
using code_c46f44f9::prepare;
using code_c46f44f9::rhs;
using code_c46f44f9::mass_forcing;
using code_c46f44f9::energy;
using code_c46f44f9::constraints_at;
using code_c46f44f9::multipliers_at;
using code_c46f44f9::project;
using code_c46f44f9::gamma_at;
}  // namespace four_bar

using namespace four_bar;

#ifndef ALEMBERT_four_bar_c46f44f9  // once in a unit, however many namespaces include this file
#define ALEMBERT_four_bar_c46f44f9
// What four_bar.hpp declares: under names that begin with that of the scene and end with a fingerprint of this file and its
// header, so that many systems can be in one program, and no header is linked with another file than its own.
extern "C" __attribute__((weak, visibility("default"))) void four_bar_prepare_c46f44f9(double* par) {
    four_bar::code_c46f44f9::table.prepare(par);
}
extern "C" __attribute__((weak, visibility("default"))) void four_bar_rhs_c46f44f9(double t, const double* state, const double* par, double* rate) {
    four_bar::code_c46f44f9::table.rhs(t, state, par, rate);
}
extern "C" __attribute__((weak, visibility("default"))) void four_bar_mass_forcing_c46f44f9(double t, const double* state, const double* par, double* mass, double* forcing) {
    four_bar::code_c46f44f9::table.mass_forcing(t, state, par, mass, forcing);
}
extern "C" __attribute__((weak, visibility("default"))) void four_bar_energy_c46f44f9(double t, const double* state, const double* rate, const double* par, double* energy, double* jacobi) {
    four_bar::code_c46f44f9::table.energy(t, state, rate, par, energy, jacobi);
}
extern "C" __attribute__((weak, visibility("default"))) void four_bar_constraints_at_c46f44f9(double t, const double* state, const double* par, double* position, double* velocity, double* rows) {
    four_bar::code_c46f44f9::table.constraints_at(t, state, par, position, velocity, rows);
}
extern "C" __attribute__((weak, visibility("default"))) void four_bar_multipliers_at_c46f44f9(double t, const double* state, const double* par, double* lambda) {
    four_bar::code_c46f44f9::table.multipliers_at(t, state, par, lambda);
}
extern "C" __attribute__((weak, visibility("default"))) void four_bar_project_c46f44f9(double t, const double* state, const double* par, double* out, double* position, double* pivots) {
    four_bar::code_c46f44f9::projection.project(t, state, par, out, position, pivots);
}
extern "C" __attribute__((weak, visibility("default"))) void four_bar_gamma_at_c46f44f9(double t, const double* state, const double* par, double* out) {
    four_bar::code_c46f44f9::projection.gamma_at(t, state, par, out);
}
extern "C" __attribute__((weak, visibility("default"))) const void* four_bar_tables_c46f44f9() {
    return &four_bar::code_c46f44f9::all;
}
#endif

#ifndef ALEMBERT_NO_MODULE  // What is looked for in a module that is loaded while a program runs; once in a unit.
#define ALEMBERT_NO_MODULE
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_solver() { return four_bar::code_c46f44f9::all.solver; }
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_projection() { return four_bar::code_c46f44f9::all.projection; }
#endif
