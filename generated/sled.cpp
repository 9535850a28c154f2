// SPDX-License-Identifier: MIT
// Equations of motion of 'sled': routh, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//   alembert emit sled.toml -o .
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[6]        xC [m], yC [m], phi [rad], then their rates
//   rate[6]         d state / dt
//   par[5]          m = 4 [kg], J = 0.8 [kg*m^2],
//                   then 3 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[9], M row by row; forcing[3], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   outputs_at      out[1]: v
//   constraints_at  position[1], velocity[1]; rows[3], A row by row
//   rows of A       blade
//   multipliers_at  lambda[1]: lambda1
//   project         out[6], position[1], pivots[1]
//   cost            12 operations a right-hand side: 2 additions, 8 multiplications, 1 division, 1 function
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "sled.cpp"
//
//   int main() {
//       const double state[6] = {0, 0, 0, 1.2, 0, 0.3};
//       double par[5], rate[6];
//       for (int k = 0; k < 2; ++k) par[k] = sled::parameter_values[k];
//       sled::prepare(par);
//       sled::rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // some are for other types of numbers
#pragma GCC diagnostic ignored "-Wpsabi"            // all functions with vectors are inline
namespace sled::code_a531dba3 {
namespace {  // seen in this file alone

inline double tan(double x) { return __builtin_tan(x); }
inline float tan(float x) { return __builtin_tanf(x); }
inline long double tan(long double x) { return __builtin_tanl(x); }

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
    const Real &m = par[0], &J = par[1];

    // Constants
    const Real k0 = Real(1) / m;
    const Real k1 = Real(0.5) * m;
    const Real k2 = Real(0.5) * J;

    // Result
    par[2] = k0;
    par[3] = k1;
    par[4] = k2;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &phi = state[2], &xC_dot = state[3], &yC_dot = state[4], &phi_dot = state[5];
    const Real &k0 = par[2];

    // Mass matrix M(q), lower triangle
    // M00 = m, M10 = 0, M11 = m, M20 = 0, M21 = 0, M22 = J

    // Forcing f
    // f0 = 0, f1 = 0, f2 = 0

    // Constraints A q'' = gamma
    const Real A0_0 = tan(phi);

    // Solve M q'' = f + A^T lambda, A q'' = gamma
    const Real z0 = xC_dot * phi_dot * (A0_0 * A0_0 + Real(1));
    const Real z1 = k0 * A0_0;
    const Real z2 = z0 / (k0 + z1 * A0_0);
    const Real xC_ddot = -z1 * z2;
    const Real yC_ddot = k0 * z2;

    // Result
    rate[0] = xC_dot;
    rate[1] = yC_dot;
    rate[2] = phi_dot;
    rate[3] = xC_ddot;
    rate[4] = yC_ddot;
    rate[5] = Real(0);
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real*, const Real* par, Real* mass, Real* forcing) {
    const Real &m = par[0], &J = par[1];

    // Result
    mass[0] = m;
    mass[1] = mass[3] = Real(0);
    mass[4] = m;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = J;
    forcing[0] = Real(0);
    forcing[1] = Real(0);
    forcing[2] = Real(0);
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &xC_dot = state[3], &yC_dot = state[4], &phi_dot = state[5];
    const Real &k1 = par[3], &k2 = par[4];

    // Energy
    const Real T = k1 * (xC_dot * xC_dot + yC_dot * yC_dot) + k2 * phi_dot * phi_dot;

    // Result
    energy[0] = T;
    energy[1] = Real(0);
    energy[2] = T;
    energy[3] = Real(0);
    jacobi[0] = T;
}

/// The scene's outputs.
template <typename Real>
void outputs_at(const Real&, const Real* state, const Real*, const Real*, Real* out) {
    const Real &phi = state[2], &xC_dot = state[3], &yC_dot = state[4];

    // Trigonometry
    const auto [sin_phi, cos_phi] = sincos(phi);

    // Outputs
    const Real v = xC_dot * cos_phi + yC_dot * sin_phi;

    // Result
    out[0] = v;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real*, Real* position, Real* velocity, Real* rows) {
    const Real &phi = state[2], &xC_dot = state[3], &yC_dot = state[4];

    // Constraints
    const Real z0 = tan(phi);

    // Result
    position[0] = Real(0);
    velocity[0] = xC_dot * z0 - yC_dot;
    rows[0] = z0;
    rows[1] = Real(-1);
    rows[2] = Real(0);
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real* state, const Real* par, Real* lambda) {
    const Real &phi = state[2], &xC_dot = state[3], &phi_dot = state[5];
    const Real &k0 = par[2];

    // Multipliers
    const Real z0 = tan(phi);
    const Real z1 = Real(1) / (k0 + k0 * z0 * z0);
    const Real lambda1 = -z1 * xC_dot * phi_dot * (z0 * z0 + Real(1));

    // Result
    lambda[0] = lambda1;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &xC = state[0], &yC = state[1], &phi = state[2], &xC_dot = state[3], &yC_dot = state[4];
    const Real &phi_dot = state[5];
    const Real &k0 = par[2];

    // Projection
    const Real z0 = tan(phi);
    const Real z1 = k0 * z0;
    const Real z2 = k0 + z1 * z0;
    const Real z3 = (yC_dot - xC_dot * z0) / z2;

    // Result
    out[0] = xC;
    out[1] = yC;
    out[2] = phi;
    out[3] = xC_dot + z1 * z3;
    out[4] = yC_dot - k0 * z3;
    out[5] = phi_dot;
    position[0] = Real(0);
    pivots[0] = z2;
}

/// gamma of A q'' = gamma.
template <typename Real>
void gamma_at(const Real&, const Real* state, const Real*, Real* out) {
    const Real &phi = state[2], &xC_dot = state[3], &phi_dot = state[5];

    // Constraints
    const Real z0 = tan(phi);
    const Real gamma0 = -xC_dot * phi_dot * (z0 * z0 + Real(1));

    // Result
    out[0] = gamma0;
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

constexpr const char* coordinate_names[] = { "xC", "yC", "phi", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "J", nullptr};
constexpr const char* output_names[] = { "v", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 4, 0.8, 0};

constexpr alembert_solver_table table{
    4, 3, 3, 2, 3, 1, 0, 1, "sled", "routh, textbook form",
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
    &table, nullptr, &projection, nullptr, nullptr, 1,
};

}  // namespace
}  // namespace sled::code_a531dba3
#pragma GCC diagnostic pop

namespace sled {
using code_a531dba3::parameter_values;
using code_a531dba3::coordinate_names;
using code_a531dba3::speed_names;
using code_a531dba3::parameter_names;
using code_a531dba3::output_names;
using code_a531dba3::event_names;
using code_a531dba3::table;
using code_a531dba3::prepare;
using code_a531dba3::rhs;
using code_a531dba3::mass_forcing;
using code_a531dba3::energy;
using code_a531dba3::outputs_at;
using code_a531dba3::constraints_at;
using code_a531dba3::multipliers_at;
using code_a531dba3::project;
using code_a531dba3::gamma_at;
}  // namespace sled

using namespace sled;

#ifndef ALEMBERT_sled_a531dba3  // once in a unit, however many namespaces include this file
#define ALEMBERT_sled_a531dba3
// What sled.hpp declares: under names that begin with that of the scene and end with a fingerprint of this file and its
// header, so that many systems can be in one program, and no header is linked with another file than its own.
extern "C" __attribute__((weak, visibility("default"))) void sled_prepare_a531dba3(double* par) {
    sled::code_a531dba3::table.prepare(par);
}
extern "C" __attribute__((weak, visibility("default"))) void sled_rhs_a531dba3(double t, const double* state, const double* par, double* rate) {
    sled::code_a531dba3::table.rhs(t, state, par, rate);
}
extern "C" __attribute__((weak, visibility("default"))) void sled_mass_forcing_a531dba3(double t, const double* state, const double* par, double* mass, double* forcing) {
    sled::code_a531dba3::table.mass_forcing(t, state, par, mass, forcing);
}
extern "C" __attribute__((weak, visibility("default"))) void sled_energy_a531dba3(double t, const double* state, const double* rate, const double* par, double* energy, double* jacobi) {
    sled::code_a531dba3::table.energy(t, state, rate, par, energy, jacobi);
}
extern "C" __attribute__((weak, visibility("default"))) void sled_outputs_at_a531dba3(double t, const double* state, const double* rate, const double* par, double* out) {
    sled::code_a531dba3::table.outputs_at(t, state, rate, par, out);
}
extern "C" __attribute__((weak, visibility("default"))) void sled_constraints_at_a531dba3(double t, const double* state, const double* par, double* position, double* velocity, double* rows) {
    sled::code_a531dba3::table.constraints_at(t, state, par, position, velocity, rows);
}
extern "C" __attribute__((weak, visibility("default"))) void sled_multipliers_at_a531dba3(double t, const double* state, const double* par, double* lambda) {
    sled::code_a531dba3::table.multipliers_at(t, state, par, lambda);
}
extern "C" __attribute__((weak, visibility("default"))) void sled_project_a531dba3(double t, const double* state, const double* par, double* out, double* position, double* pivots) {
    sled::code_a531dba3::projection.project(t, state, par, out, position, pivots);
}
extern "C" __attribute__((weak, visibility("default"))) void sled_gamma_at_a531dba3(double t, const double* state, const double* par, double* out) {
    sled::code_a531dba3::projection.gamma_at(t, state, par, out);
}
extern "C" __attribute__((weak, visibility("default"))) const void* sled_tables_a531dba3() {
    return &sled::code_a531dba3::all;
}
#endif

#ifndef ALEMBERT_NO_MODULE  // What is looked for in a module that is loaded while a program runs; once in a unit.
#define ALEMBERT_NO_MODULE
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_solver() { return sled::code_a531dba3::all.solver; }
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_projection() { return sled::code_a531dba3::all.projection; }
#endif
