// SPDX-License-Identifier: MIT
// Equations of motion of 'moving_support': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//   alembert emit moving_support.toml -o .
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[2]        phi [rad], then their rates
//   rate[2]         d state / dt
//   par[15]         m = 1 [kg], l = 0.7 [m], a = 0.15 [m], gamma = 5 [rad/s], g = 9.81 [m/s^2],
//                   then 10 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[1], M row by row; forcing[1], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   outputs_at      out[1]: reach
//   cost            14 operations a right-hand side: 2 additions, 8 multiplications, 0 divisions, 4 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "moving_support.cpp"
//
//   int main() {
//       const double state[2] = {0.4, 0};
//       double par[15], rate[2];
//       for (int k = 0; k < 5; ++k) par[k] = moving_support::parameter_values[k];
//       moving_support::prepare(par);
//       moving_support::rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // some are for other types of numbers
#pragma GCC diagnostic ignored "-Wpsabi"            // all functions with vectors are inline
namespace moving_support::code_769d90ac {
namespace {  // seen in this file alone

inline double sqrt(double x) { return __builtin_sqrt(x); }
inline float sqrt(float x) { return __builtin_sqrtf(x); }
inline long double sqrt(long double x) { return __builtin_sqrtl(x); }

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
    const Real &m = par[0], &l = par[1], &a = par[2], &gamma = par[3], &g = par[4];

    // Constants
    const Real M00 = m * l * l;
    const Real k0 = m * l;
    const Real k1 = a * k0;
    const Real k2 = gamma * gamma;
    const Real k3 = m * l * g;
    const Real k4 = Real(1) / M00;
    const Real k5 = a * gamma;
    const Real k6 = Real(0.5) * M00;
    const Real k7 = Real(0.5) * m;
    const Real k8 = m * g;

    // Result
    par[5] = M00;
    par[6] = k0;
    par[7] = k1;
    par[8] = k2;
    par[9] = k3;
    par[10] = k4;
    par[11] = k5;
    par[12] = k6;
    par[13] = k7;
    par[14] = k8;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real& t, const Real* state, const Real* par, Real* rate) {
    const Real &phi = state[0], &phi_dot = state[1];
    const Real &gamma = par[3], &k1 = par[7], &k2 = par[8], &k3 = par[9], &k4 = par[10];

    // Trigonometry
    const Real phi0 = gamma * t;
    const auto trig0 = sincos(phi0, phi);
    const Real sin_phi0 = trig0.sine[0], cos_phi0 = trig0.cosine[0], sin_phi = trig0.sine[1],
        cos_phi = trig0.cosine[1];

    // Forcing f
    const Real z0 = (k3 - k1 * k2 * sin_phi0) * sin_phi;
    const Real f0 = k1 * k2 * cos_phi0 * cos_phi - z0;

    // Solve M q'' = f with M = L D L^T
    const Real phi_ddot = k4 * f0;

    // Result
    rate[0] = phi_dot;
    rate[1] = phi_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real& t, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &phi = state[0];
    const Real &gamma = par[3], &M00 = par[5], &k1 = par[7], &k2 = par[8], &k3 = par[9];

    // Trigonometry
    const Real phi0 = gamma * t;
    const auto trig0 = sincos(phi0, phi);
    const Real sin_phi0 = trig0.sine[0], cos_phi0 = trig0.cosine[0], sin_phi = trig0.sine[1],
        cos_phi = trig0.cosine[1];

    // Forcing f
    const Real z0 = (k3 - k1 * k2 * sin_phi0) * sin_phi;
    const Real f0 = k1 * k2 * cos_phi0 * cos_phi - z0;

    // Result
    mass[0] = M00;
    forcing[0] = f0;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real& t, const Real* state, const Real* rate, const Real* par, Real* energy, Real* jacobi) {
    const Real &phi = state[0], &phi_dot = state[1];
    const Real &phi_ddot = rate[1];
    const Real &m = par[0], &a = par[2], &gamma = par[3], &k0 = par[6], &k3 = par[9], &k5 = par[11];
    const Real &k6 = par[12], &k7 = par[13], &k8 = par[14];

    // Trigonometry
    const Real phi0 = gamma * t;
    const auto trig0 = sincos(phi0, phi);
    const Real sin_phi0 = trig0.sine[0], cos_phi0 = trig0.cosine[0], sin_phi = trig0.sine[1],
        cos_phi = trig0.cosine[1];

    // Energy
    const Real z0 = k5 * sin_phi0;
    const Real z1 = k5 * cos_phi0;
    const Real z2 = z0 * cos_phi - z1 * sin_phi;
    const Real z3 = phi_dot * phi_dot;
    const Real z4 = k6 * z3;
    const Real z5 = k7 * z0 * z0 + k7 * z1 * z1;
    const Real z6 = k0 * phi_dot * z2 - (z4 + z5);
    const Real T = -z6;
    const Real z7 = k3 * cos_phi - k8 * a * sin_phi0;
    const Real V = -z7;
    const Real E = -z7 - z6;
    const Real z8 = z1 * k5 * gamma * sin_phi0;
    const Real z9 = m * (z8 - z0 * k5 * gamma * cos_phi0);
    const Real z10 = (z1 * cos_phi + z0 * sin_phi) * z3;
    const Real z11 = k8 * z1 - k0 * (phi_ddot * z2 - z10);
    const Real P = z11 - z9;
    const Real h = z4 - z7 - z5;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = P;
    jacobi[0] = h;
}

/// The scene's outputs.
template <typename Real>
void outputs_at(const Real& t, const Real* state, const Real*, const Real* par, Real* out) {
    const Real &phi = state[0];
    const Real &l = par[1], &a = par[2], &gamma = par[3];

    // Trigonometry
    const Real phi0 = gamma * t;
    const auto trig0 = sincos(phi0, phi);
    const Real sin_phi0 = trig0.sine[0], cos_phi0 = trig0.cosine[0], sin_phi = trig0.sine[1],
        cos_phi = trig0.cosine[1];

    // Outputs
    const Real z0 = l * cos_phi - a * sin_phi0;
    const Real z1 = l * sin_phi + a * cos_phi0;
    const Real reach = sqrt(z0 * z0 + z1 * z1);

    // Result
    out[0] = reach;
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

constexpr const char* coordinate_names[] = { "phi", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "l", "a", "gamma", "g", nullptr};
constexpr const char* output_names[] = { "reach", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 0.7, 0.15, 5, 9.81, 0};

constexpr alembert_solver_table table{
    4, 1, 1, 5, 10, 1, 0, 0, "moving_support", "lagrange, textbook form",
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
    [](double, const double*, const double*, double*, double*, double*) {},
    [](double, const double*, const double*, double*) {},
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
    &table, nullptr, nullptr, nullptr, nullptr, 0,
};

}  // namespace
}  // namespace moving_support::code_769d90ac
#pragma GCC diagnostic pop

namespace moving_support {
using code_769d90ac::parameter_values;
using code_769d90ac::coordinate_names;
using code_769d90ac::speed_names;
using code_769d90ac::parameter_names;
using code_769d90ac::output_names;
using code_769d90ac::event_names;
using code_769d90ac::table;
using code_769d90ac::prepare;
using code_769d90ac::rhs;
using code_769d90ac::mass_forcing;
using code_769d90ac::energy;
using code_769d90ac::outputs_at;
}  // namespace moving_support

using namespace moving_support;

#ifndef ALEMBERT_moving_support_769d90ac  // once in a unit, however many namespaces include this file
#define ALEMBERT_moving_support_769d90ac
// What moving_support.hpp declares: under names that begin with that of the scene and end with a fingerprint of this file and its
// header, so that many systems can be in one program, and no header is linked with another file than its own.
extern "C" __attribute__((weak, visibility("default"))) void moving_support_prepare_769d90ac(double* par) {
    moving_support::code_769d90ac::table.prepare(par);
}
extern "C" __attribute__((weak, visibility("default"))) void moving_support_rhs_769d90ac(double t, const double* state, const double* par, double* rate) {
    moving_support::code_769d90ac::table.rhs(t, state, par, rate);
}
extern "C" __attribute__((weak, visibility("default"))) void moving_support_mass_forcing_769d90ac(double t, const double* state, const double* par, double* mass, double* forcing) {
    moving_support::code_769d90ac::table.mass_forcing(t, state, par, mass, forcing);
}
extern "C" __attribute__((weak, visibility("default"))) void moving_support_energy_769d90ac(double t, const double* state, const double* rate, const double* par, double* energy, double* jacobi) {
    moving_support::code_769d90ac::table.energy(t, state, rate, par, energy, jacobi);
}
extern "C" __attribute__((weak, visibility("default"))) void moving_support_outputs_at_769d90ac(double t, const double* state, const double* rate, const double* par, double* out) {
    moving_support::code_769d90ac::table.outputs_at(t, state, rate, par, out);
}
extern "C" __attribute__((weak, visibility("default"))) const void* moving_support_tables_769d90ac() {
    return &moving_support::code_769d90ac::all;
}
#endif

#ifndef ALEMBERT_NO_MODULE  // What is looked for in a module that is loaded while a program runs; once in a unit.
#define ALEMBERT_NO_MODULE
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_solver() { return moving_support::code_769d90ac::all.solver; }
#endif
