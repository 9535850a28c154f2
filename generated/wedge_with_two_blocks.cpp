// Equations of motion of 'wedge_with_two_blocks': lagrange, intermediate symbols.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        X [m], s [m], then their rates
//   rate[4]         d state / dt
//   par[17]         M = 4 [kg], m1 = 1 [kg], m2 = 2 [kg], alpha = 0.5 [rad], beta = 0.9 [rad], d = 1 [m],
//                   g = 9.81 [m/s^2], then 10 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   cost            0 operations a right-hand side: 0 additions, 0 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "wedge_with_two_blocks.cpp"
//
//   int main() {
//       const double state[4] = {0, 0, 0, 0};
//       double par[17], rate[4];
//       for (int k = 0; k < 7; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

// Sines and cosines in pairs, of one angle or of several at once; at the end of this file.
template <typename Real> struct pair;
template <typename Real, unsigned count> struct sines;
template <typename Real> pair<Real> sincos(const Real& x);
template <typename Real, typename... Angle> sines<Real, 1 + sizeof...(Angle)> sincos(const Real& first, const Angle&... x);
inline pair<double> sincos(double x);
inline double sin(double x), cos(double x);

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &M = par[0], &m1 = par[1], &m2 = par[2], &alpha = par[3], &beta = par[4], &g = par[6];

    // Trigonometry
    const auto trig0 = sincos(alpha, beta);
    const Real sin_alpha = trig0.sine[0], cos_alpha = trig0.cosine[0], sin_beta = trig0.sine[1],
        cos_beta = trig0.cosine[1];

    // Constants
    const Real M00 = M + m1 + m2;
    const Real z0 = m1 * cos_alpha;
    const Real z1 = m2 * cos_beta;
    const Real M10 = z0 + z1;
    const Real z2 = m1 * sin_alpha * sin_alpha;
    const Real z3 = m2 * sin_beta * sin_beta;
    const Real M11 = z2 + z0 * cos_alpha + z1 * cos_beta + z3;
    const Real k2 = m1 * g;
    const Real k3 = m2 * g;
    const Real k4 = k2 * sin_alpha - k3 * sin_beta;
    const Real z4 = Real(1) / M11;
    const Real z5 = M10 * z4;
    const Real k5 = k4 * z5 / (M00 - M10 * z5);
    const Real k6 = k5 * z5 + k4 * z4;

    // Result
    par[7] = M00;
    par[8] = M10;
    par[9] = sin_alpha;
    par[10] = sin_beta;
    par[11] = M11;
    par[12] = k2;
    par[13] = k3;
    par[14] = k4;
    par[15] = k5;
    par[16] = k6;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &X_dot = state[2], &s_dot = state[3];
    const Real &k5 = par[15], &k6 = par[16];

    // Forcing f
    // f0 = 0, f1 = -k4

    // Result
    rate[0] = X_dot;
    rate[1] = s_dot;
    rate[2] = k5;
    rate[3] = -k6;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real*, const Real* par, Real* mass, Real* forcing) {
    const Real &M00 = par[7], &M10 = par[8], &M11 = par[11], &k4 = par[14];

    // Result
    mass[0] = M00;
    mass[1] = mass[2] = M10;
    mass[3] = M11;
    forcing[0] = Real(0);
    forcing[1] = -k4;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &s = state[1], &X_dot = state[2], &s_dot = state[3];
    const Real &d = par[5], &M00 = par[7], &M10 = par[8], &k0 = par[9], &k1 = par[10], &M11 = par[11];
    const Real &k2 = par[12], &k3 = par[13];

    // Energy
    const Real T = M10 * X_dot * s_dot + Real(0.5) * M00 * X_dot * X_dot + Real(0.5) * M11 * s_dot * s_dot;
    const Real z0 = k2 * k0 * (d - s);
    const Real z1 = k3 * k1 * s + z0;
    const Real V = -z1;
    const Real E = T - z1;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = Real(0);
    jacobi[0] = E;
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

#if defined(__FAST_MATH__) || defined(ALEMBERT_REASSOCIATES)
constexpr bool is_reducible = false;  // the reduction does not survive sums in another order
#else
constexpr bool is_reducible = true;
#endif
constexpr double farthest = 1e8;
[[gnu::always_inline]] inline bool is_near(double x) { return is_reducible && __builtin_fabs(x) <= farthest; }
/// Are all angles near whose squares make this sum? (If not, some may be.)
[[gnu::always_inline]] inline bool is_near_all(double squares) { return is_reducible && squares <= farthest * farthest; }
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
template <typename Real> constexpr bool fuses = requires(const Real& x) { fused(x, 1.0, x); };

template <typename Bits, typename Real>
[[gnu::always_inline]] inline void sines_near(const Real& x, Real& sine, Real& cosine) {
    constexpr double shift = 0x1.8p52;  // adding it rounds to a whole number, in the last bits
    const Real shifted = x * 0x1.45f306dc9c883p-1 + shift, turns = shifted - shift;
    const Bits k = __builtin_bit_cast(Bits, shifted);
    Real hi, lo;
    if constexpr (fuses<Real>) {
        hi = fused(turns, -0x1.1a62633145c06p-54, fused(turns, -0x1.921fb54442d18p0, x));
        hi = fused(turns, -0x1.c1cd129024e09p-107, hi);
    } else {
        hi = ((x - turns * 0x1.921fb54p0) - turns * 0x1.10b46p-30) - turns * 0x1.1a62630p-54;
        lo = turns * 0x1.8a2e03707344ap-81;
    }
    const Real z = hi * hi, zz = z * z;
    const Real P = (0.1666666666666663 - 0.008333333333322118 * z) +
                   zz * ((0.00019841269829589533 - 2.7557313621383334e-06 * z) + zz * (2.505074776244275e-08 - 1.5896230131492603e-10 * z));
    const Real Q = (0.041666666666666595 - 0.0013888888888873056 * z) +
                   zz * ((2.4801587288851683e-05 - 2.755731417929107e-07 * z) + zz * (2.0875700841213046e-09 - 1.13585364822807e-11 * z));
    Real s;
    if constexpr (fuses<Real>)
        s = hi * (1 - z * P);
    else
        s = hi - (hi * z * P + lo);
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

// What the runtime loads (alembert/native/abi.hpp).

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

constexpr const char* coordinate_names[] = { "X", "s", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "M", "m1", "m2", "alpha", "beta", "d", "g", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 4, 1, 2, 0.5, 0.9, 1, 9.81, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 7, 10, 0, 0, 0, "wedge_with_two_blocks", "lagrange, intermediate symbols",
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
    [](double, const double*, const double*, double*, double*, double*) {},
    [](double, const double*, const double*, double*) {},
};

}  // namespace

extern "C" __attribute__((visibility("default"))) const void* alembert_solver() { return &table; }

