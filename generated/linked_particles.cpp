// SPDX-License-Identifier: MIT
// Equations of motion of 'linked_particles': recursive, composite bodies.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//   alembert emit linked_particles.toml -o .
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[8]        x1 [m], y1 [m], x2 [m], y2 [m], then their rates
//   rate[8]         d state / dt
//   par[15]         m1 = 1 [kg], m2 = 1.5 [kg], l = 1 [m], beta = 0.2 [rad], g = 9.81 [m/s^2],
//                   then 10 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[16], M row by row; forcing[4], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   outputs_at      out[2]: tension, turn
//   constraints_at  position[2], velocity[2]; rows[8], A row by row
//   rows of A       rod, blade
//   multipliers_at  lambda[2]: lambda1, lambda2
//   project         out[8], position[2], pivots[2]
//   cost            73 operations a right-hand side: 30 additions, 41 multiplications, 2 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "linked_particles.cpp"
//
//   int main() {
//       const double state[8] = {0, 0, 0.6, 0.8, 0.7, 0.1, -0.1, 0.7};
//       double par[15], rate[8];
//       for (int k = 0; k < 5; ++k) par[k] = linked_particles::parameter_values[k];
//       linked_particles::prepare(par);
//       linked_particles::rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // some are for other types of numbers
#pragma GCC diagnostic ignored "-Wpsabi"            // all functions with vectors are inline
namespace linked_particles::code_336b0152 {
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
    const Real &m1 = par[0], &m2 = par[1], &l = par[2], &beta = par[3], &g = par[4];

    // Trigonometry
    const Real sin_beta = sin(beta);

    // Constants
    const Real z0 = g * sin_beta;
    const Real k0 = m1 * z0;
    const Real k1 = m2 * z0;
    const Real k2 = l * l;
    const Real k3 = Real(1) / m1;
    const Real k4 = Real(2) * k3;
    const Real k5 = Real(1) / m2;
    const Real k6 = Real(2) * k5;
    const Real k7 = k3 * k0;
    const Real k8 = k5 * k1;
    const Real z1 = Real(1) / l;
    const Real k9 = z1 * z1;

    // Result
    par[5] = k0;
    par[6] = k1;
    par[7] = k2;
    par[8] = k3;
    par[9] = k4;
    par[10] = k5;
    par[11] = k6;
    par[12] = k7;
    par[13] = k8;
    par[14] = k9;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &x1 = state[0], &y1 = state[1], &x2 = state[2], &y2 = state[3], &x1_dot = state[4];
    const Real &y1_dot = state[5], &x2_dot = state[6], &y2_dot = state[7];
    const Real &k0 = par[5], &k1 = par[6], &k3 = par[8], &k4 = par[9], &k5 = par[10], &k6 = par[11];
    const Real &k7 = par[12], &k8 = par[13];

    // Mass matrix M(q), lower triangle
    // M00 = m1, M10 = 0, M11 = m1, M20 = 0, M21 = 0, M22 = m2, M30 = 0, M31 = 0, M32 = 0, M33 = m2

    // Forcing f
    // f0 = 0, f1 = -k0, f2 = 0, f3 = -k1

    // Constraints A q'' = gamma
    const Real A1_1 = x1 - x2;

    // Solve M q'' = f + A^T lambda, A q'' = gamma
    const Real z0 = y1 - y2;
    const Real z1 = x1_dot - x2_dot;
    const Real z2 = y1_dot - y2_dot;
    const Real z3 = z1 * z1 + z2 * z2;
    const Real z4 = z1 * (y1_dot + y2_dot) - (x1_dot + x2_dot) * z2;
    const Real z5 = k4 * A1_1;
    const Real z6 = k4 * z0;
    const Real z7 = k6 * z0;
    const Real z8 = k6 * A1_1;
    const Real z9 = z0 * (z6 + z7) + A1_1 * (z5 + z8);
    const Real z10 = k3 * A1_1;
    const Real z11 = k5 * A1_1;
    const Real z12 = k3 * z0;
    const Real z13 = k5 * z0;
    const Real z14 = z0 * (z10 - z11) - A1_1 * (z12 - z13);
    const Real z15 = z0 * (z12 + z13) + A1_1 * (z10 + z11);
    const Real z16 = Real(1) / z15;
    const Real z17 = z14 * z16;
    const Real z18 = k0 * z10 - z4 + k1 * z11;
    const Real z19 = k0 * z6 - k1 * z7 - Real(2) * z3 - Real(2) * z18 * z17;
    const Real z20 = z19 / (Real(2) * z9 - Real(4) * z14 * z17);
    const Real z21 = z18 * z16 - Real(2) * z17 * z20;
    const Real x1_ddot = z5 * z20 - z12 * z21;
    const Real y1_ddot = z6 * z20 - k7 + z10 * z21;
    const Real x2_ddot = -z8 * z20 - z13 * z21;
    const Real y2_ddot = -k8 - z7 * z20 + z11 * z21;

    // Result
    rate[0] = x1_dot;
    rate[1] = y1_dot;
    rate[2] = x2_dot;
    rate[3] = y2_dot;
    rate[4] = x1_ddot;
    rate[5] = y1_ddot;
    rate[6] = x2_ddot;
    rate[7] = y2_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real*, const Real* par, Real* mass, Real* forcing) {
    const Real &m1 = par[0], &m2 = par[1], &k0 = par[5], &k1 = par[6];

    // Result
    mass[0] = m1;
    mass[1] = mass[4] = Real(0);
    mass[5] = m1;
    mass[2] = mass[8] = Real(0);
    mass[6] = mass[9] = Real(0);
    mass[10] = m2;
    mass[3] = mass[12] = Real(0);
    mass[7] = mass[13] = Real(0);
    mass[11] = mass[14] = Real(0);
    mass[15] = m2;
    forcing[0] = Real(0);
    forcing[1] = -k0;
    forcing[2] = Real(0);
    forcing[3] = -k1;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &y1 = state[1], &y2 = state[3], &x1_dot = state[4], &y1_dot = state[5], &x2_dot = state[6];
    const Real &y2_dot = state[7];
    const Real &m1 = par[0], &m2 = par[1], &k0 = par[5], &k1 = par[6];

    // Energy
    const Real z0 = m1 * (x1_dot * x1_dot + y1_dot * y1_dot);
    const Real z1 = z0 + m2 * (x2_dot * x2_dot + y2_dot * y2_dot);
    const Real T = Real(0.5) * z1;
    const Real V = k0 * y1 + k1 * y2;
    const Real E = V + Real(0.5) * z1;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = Real(0);
    jacobi[0] = E;
}

/// The scene's outputs.
template <typename Real>
void outputs_at(const Real&, const Real* state, const Real*, const Real* par, Real* out) {
    const Real &x1 = state[0], &y1 = state[1], &x2 = state[2], &y2 = state[3], &x1_dot = state[4];
    const Real &y1_dot = state[5], &x2_dot = state[6], &y2_dot = state[7];
    const Real &l = par[2], &k0 = par[5], &k1 = par[6], &k3 = par[8], &k4 = par[9], &k5 = par[10], &k6 = par[11];
    const Real &k9 = par[14];

    // Outputs
    const Real z0 = x1 - x2;
    const Real z1 = y1 - y2;
    const Real z2 = x1_dot - x2_dot;
    const Real z3 = y1_dot - y2_dot;
    const Real z4 = z2 * z2 + z3 * z3;
    const Real z5 = z2 * (y1_dot + y2_dot) - (x1_dot + x2_dot) * z3;
    const Real z6 = k4 * z1;
    const Real z7 = k6 * z1;
    const Real z8 = z0 * (k4 * z0 + k6 * z0);
    const Real z9 = k3 * z0;
    const Real z10 = k5 * z0;
    const Real z11 = k3 * z1;
    const Real z12 = k5 * z1;
    const Real z13 = z1 * (z9 - z10) - z0 * (z11 - z12);
    const Real z14 = z1 * (z11 + z12) + z0 * (z9 + z10);
    const Real z15 = z13 / z14;
    const Real z16 = Real(2) * (z1 * (z6 + z7) + z8) - Real(4) * z13 * z15;
    const Real z17 = (k0 * z9 - z5 + k1 * z10) * z15;
    const Real z18 = k0 * z6 - k1 * z7 - Real(2) * z4 - Real(2) * z17;
    const Real tension = -Real(2) * l * z18 / z16;
    const Real turn = k9 * (z0 * z3 - z1 * z2);

    // Result
    out[0] = tension;
    out[1] = turn;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real* par, Real* position, Real* velocity, Real* rows) {
    const Real &x1 = state[0], &y1 = state[1], &x2 = state[2], &y2 = state[3], &x1_dot = state[4];
    const Real &y1_dot = state[5], &x2_dot = state[6], &y2_dot = state[7];
    const Real &k2 = par[7];

    // Constraints
    const Real z0 = x1 - x2;
    const Real z1 = y1 - y2;
    const Real z2 = z0 * (x1_dot - x2_dot) + z1 * (y1_dot - y2_dot);

    // Result
    position[0] = z0 * z0 - k2 + z1 * z1;
    position[1] = Real(0);
    velocity[0] = Real(2) * z2;
    velocity[1] = z0 * (y1_dot + y2_dot) - z1 * (x1_dot + x2_dot);
    rows[0] = Real(2) * z0;
    rows[1] = Real(2) * z1;
    rows[2] = -Real(2) * z0;
    rows[3] = -Real(2) * z1;
    rows[4] = -z1;
    rows[5] = z0;
    rows[6] = -z1;
    rows[7] = z0;
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real* state, const Real* par, Real* lambda) {
    const Real &x1 = state[0], &y1 = state[1], &x2 = state[2], &y2 = state[3], &x1_dot = state[4];
    const Real &y1_dot = state[5], &x2_dot = state[6], &y2_dot = state[7];
    const Real &k0 = par[5], &k1 = par[6], &k3 = par[8], &k4 = par[9], &k5 = par[10], &k6 = par[11];

    // Multipliers
    const Real z0 = x1 - x2;
    const Real z1 = y1 - y2;
    const Real z2 = x1_dot - x2_dot;
    const Real z3 = y1_dot - y2_dot;
    const Real z4 = z2 * z2 + z3 * z3;
    const Real z5 = z2 * (y1_dot + y2_dot) - (x1_dot + x2_dot) * z3;
    const Real z6 = k4 * z1;
    const Real z7 = k6 * z1;
    const Real z8 = z0 * (k4 * z0 + k6 * z0);
    const Real z9 = k3 * z0;
    const Real z10 = k5 * z0;
    const Real z11 = k3 * z1;
    const Real z12 = k5 * z1;
    const Real z13 = z1 * (z9 - z10) - z0 * (z11 - z12);
    const Real z14 = z1 * (z11 + z12) + z0 * (z9 + z10);
    const Real z15 = Real(1) / z14;
    const Real z16 = z13 * z15;
    const Real z17 = Real(2) * (z1 * (z6 + z7) + z8) - Real(4) * z13 * z16;
    const Real z18 = k0 * z9 - z5 + k1 * z10;
    const Real z19 = k0 * z6 - k1 * z7 - Real(2) * z4 - Real(2) * z18 * z16;
    const Real lambda1 = z19 / z17;
    const Real lambda2 = z18 * z15 - Real(2) * z16 * lambda1;

    // Result
    lambda[0] = lambda1;
    lambda[1] = lambda2;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &x1 = state[0], &y1 = state[1], &x2 = state[2], &y2 = state[3], &x1_dot = state[4];
    const Real &y1_dot = state[5], &x2_dot = state[6], &y2_dot = state[7];
    const Real &k2 = par[7], &k3 = par[8], &k4 = par[9], &k5 = par[10], &k6 = par[11];

    // Projection
    const Real z0 = x1 - x2;
    const Real z1 = y1 - y2;
    const Real z2 = k2 - z0 * z0 - z1 * z1;
    const Real z3 = k4 * z0;
    const Real z4 = k4 * z1;
    const Real z5 = k6 * z1;
    const Real z6 = k6 * z0;
    const Real z7 = z1 * (z4 + z5) + z0 * (z3 + z6);
    const Real z8 = k3 * z0;
    const Real z9 = k5 * z0;
    const Real z10 = k3 * z1;
    const Real z11 = k5 * z1;
    const Real z12 = z1 * (z8 - z9) - z0 * (z10 - z11);
    const Real z13 = z1 * (z10 + z11) + z0 * (z8 + z9);
    const Real z14 = Real(1) / z13;
    const Real z15 = z12 * z14;
    const Real z16 = Real(2) * z7 - Real(4) * z12 * z15;
    const Real z17 = Real(1) / z16;
    const Real z18 = z2 * z17;
    const Real z19 = z15 * z18;
    const Real z20 = x1 + z3 * z18 + Real(2) * z10 * z19;
    const Real z21 = y1 + z4 * z18 - Real(2) * z8 * z19;
    const Real z22 = x2 - z6 * z18 + Real(2) * z11 * z19;
    const Real z23 = y2 - z5 * z18 - Real(2) * z9 * z19;
    const Real z24 = z22 - z20;
    const Real z25 = z23 - z21;
    const Real z26 = (x1_dot + x2_dot) * z25 - (y1_dot + y2_dot) * z24;
    const Real z27 = (y1_dot - y2_dot) * z25 + z15 * z26;
    const Real z28 = z17 * (z27 + (x1_dot - x2_dot) * z24);
    const Real z29 = z14 * z26 + Real(4) * z15 * z28;

    // Result
    out[0] = z20;
    out[1] = z21;
    out[2] = z22;
    out[3] = z23;
    out[4] = x1_dot + Real(2) * z3 * z28 + z10 * z29;
    out[5] = y1_dot + Real(2) * z4 * z28 - z8 * z29;
    out[6] = x2_dot - Real(2) * z6 * z28 + z11 * z29;
    out[7] = y2_dot - Real(2) * z5 * z28 - z9 * z29;
    position[0] = -z2;
    position[1] = Real(0);
    pivots[0] = z16;
    pivots[1] = z13;
}

/// gamma of A q'' = gamma.
template <typename Real>
void gamma_at(const Real&, const Real* state, const Real*, Real* out) {
    const Real &x1_dot = state[4], &y1_dot = state[5], &x2_dot = state[6], &y2_dot = state[7];

    // Constraints
    const Real z0 = x1_dot - x2_dot;
    const Real z1 = y1_dot - y2_dot;
    const Real gamma0 = -Real(2) * (z0 * z0 + z1 * z1);
    const Real z2 = z0 * (y1_dot + y2_dot) - (x1_dot + x2_dot) * z1;
    const Real gamma1 = -z2;

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

constexpr const char* coordinate_names[] = { "x1", "y1", "x2", "y2", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m1", "m2", "l", "beta", "g", nullptr};
constexpr const char* output_names[] = { "tension", "turn", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 1.5, 1, 0.2, 9.81, 0};

constexpr alembert_solver_table table{
    4, 4, 4, 5, 10, 2, 0, 2, "linked_particles", "recursive, composite bodies",
    coordinate_names, speed_names, parameter_names, output_names, event_names, parameter_values,
    [](double* par) { prepare(par); },
    [](double t, const double* state, const double* par, double* rate) { rhs(t, state, par, rate); },
    [](double t, const double* state, const double* par, double* mass, double* forcing) {
        mass_forcing(t, state, par, mass, forcing);
    },
    [](double t, const double* state, const double* rate, const double* par, double* e, double* jacobi) {
        energy(t, state, rate, par, e, jacobi);
    },
    [](double t, const double* state, const double* rate, const double* par, double* out) {
        outputs_at(t, state, rate, par, out);
    },
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
}  // namespace linked_particles::code_336b0152
#pragma GCC diagnostic pop

namespace linked_particles {
using code_336b0152::parameter_values;
using code_336b0152::coordinate_names;
using code_336b0152::speed_names;
using code_336b0152::parameter_names;
using code_336b0152::output_names;
using code_336b0152::event_names;
using code_336b0152::table;
using code_336b0152::prepare;
using code_336b0152::rhs;
using code_336b0152::mass_forcing;
using code_336b0152::energy;
using code_336b0152::outputs_at;
using code_336b0152::constraints_at;
using code_336b0152::multipliers_at;
using code_336b0152::project;
using code_336b0152::gamma_at;
}  // namespace linked_particles

using namespace linked_particles;

#ifndef ALEMBERT_linked_particles_336b0152  // once in a unit, however many namespaces include this file
#define ALEMBERT_linked_particles_336b0152
// What linked_particles.hpp declares: under names that begin with that of the scene and end with a fingerprint of this file and its
// header, so that many systems can be in one program, and no header is linked with another file than its own.
extern "C" __attribute__((weak, visibility("default"))) void linked_particles_prepare_336b0152(double* par) {
    linked_particles::code_336b0152::table.prepare(par);
}
extern "C" __attribute__((weak, visibility("default"))) void linked_particles_rhs_336b0152(double t, const double* state, const double* par, double* rate) {
    linked_particles::code_336b0152::table.rhs(t, state, par, rate);
}
extern "C" __attribute__((weak, visibility("default"))) void linked_particles_mass_forcing_336b0152(double t, const double* state, const double* par, double* mass, double* forcing) {
    linked_particles::code_336b0152::table.mass_forcing(t, state, par, mass, forcing);
}
extern "C" __attribute__((weak, visibility("default"))) void linked_particles_energy_336b0152(double t, const double* state, const double* rate, const double* par, double* energy, double* jacobi) {
    linked_particles::code_336b0152::table.energy(t, state, rate, par, energy, jacobi);
}
extern "C" __attribute__((weak, visibility("default"))) void linked_particles_outputs_at_336b0152(double t, const double* state, const double* rate, const double* par, double* out) {
    linked_particles::code_336b0152::table.outputs_at(t, state, rate, par, out);
}
extern "C" __attribute__((weak, visibility("default"))) void linked_particles_constraints_at_336b0152(double t, const double* state, const double* par, double* position, double* velocity, double* rows) {
    linked_particles::code_336b0152::table.constraints_at(t, state, par, position, velocity, rows);
}
extern "C" __attribute__((weak, visibility("default"))) void linked_particles_multipliers_at_336b0152(double t, const double* state, const double* par, double* lambda) {
    linked_particles::code_336b0152::table.multipliers_at(t, state, par, lambda);
}
extern "C" __attribute__((weak, visibility("default"))) void linked_particles_project_336b0152(double t, const double* state, const double* par, double* out, double* position, double* pivots) {
    linked_particles::code_336b0152::projection.project(t, state, par, out, position, pivots);
}
extern "C" __attribute__((weak, visibility("default"))) void linked_particles_gamma_at_336b0152(double t, const double* state, const double* par, double* out) {
    linked_particles::code_336b0152::projection.gamma_at(t, state, par, out);
}
extern "C" __attribute__((weak, visibility("default"))) const void* linked_particles_tables_336b0152() {
    return &linked_particles::code_336b0152::all;
}
#endif

#ifndef ALEMBERT_NO_MODULE  // What is looked for in a module that is loaded while a program runs; once in a unit.
#define ALEMBERT_NO_MODULE
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_solver() { return linked_particles::code_336b0152::all.solver; }
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_projection() { return linked_particles::code_336b0152::all.projection; }
#endif
