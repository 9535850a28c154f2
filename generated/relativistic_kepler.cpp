// SPDX-License-Identifier: MIT
// Equations of motion of 'relativistic_kepler': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//   alembert emit relativistic_kepler.toml -o .
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        r [m], phi [rad], then their rates
//   rate[4]         d state / dt
//   par[8]          m = 1 [kg], c = 4 [m/s], alpha = 1 [N m^2],
//                   then 5 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   cost            54 operations a right-hand side: 11 additions, 38 multiplications, 4 divisions, 1 function
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "relativistic_kepler.cpp"
//
//   int main() {
//       const double state[4] = {1, 0, 0, 1.2};
//       double par[8], rate[4];
//       for (int k = 0; k < 3; ++k) par[k] = relativistic_kepler::parameter_values[k];
//       relativistic_kepler::prepare(par);
//       relativistic_kepler::rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // some are for other types of numbers
#pragma GCC diagnostic ignored "-Wpsabi"            // all functions with vectors are inline
namespace relativistic_kepler::code_bd284315 {
namespace {  // seen in this file alone

inline double sqrt(double x) { return __builtin_sqrt(x); }
inline float sqrt(float x) { return __builtin_sqrtf(x); }
inline long double sqrt(long double x) { return __builtin_sqrtl(x); }

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m = par[0], &c = par[1];

    // Constants
    const Real k0 = m * c * c;
    const Real k1 = c * c;
    const Real z0 = Real(1) / c;
    const Real k2 = z0 * z0;
    const Real k3 = Real(2) * k0;
    const Real k4 = Real(0.5) * k0;

    // Result
    par[3] = k0;
    par[4] = k1;
    par[5] = k2;
    par[6] = k3;
    par[7] = k4;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &r = state[0], &r_dot = state[2], &phi_dot = state[3];
    const Real &alpha = par[2], &k0 = par[3], &k1 = par[4], &k2 = par[5], &k3 = par[6];

    // Shared terms
    const Real z0 = r * r;
    const Real z1 = phi_dot * phi_dot;
    const Real z2 = z0 * z1;
    const Real z3 = r_dot * r_dot;
    const Real z4 = z2 + z3;
    const Real z5 = Real(1) / (k1 - z4);
    const Real z6 = sqrt(Real(1) - k2 * z4);
    const Real z7 = z5 * z3;
    const Real z8 = k0 * z5;
    const Real z9 = z8 * z6;

    // Mass matrix M(q), lower triangle
    const Real M00 = k0 * z5 * z6 * (z7 + Real(1));
    const Real M10 = r_dot * phi_dot * z9 * z5 * z0;
    const Real z10 = z5 * z6 * (z5 * z0 * z0 * z1 + z0);
    const Real M11 = k0 * z10;

    // Forcing f
    const Real z11 = r * z9 * (z7 - Real(1)) * z1;
    const Real z12 = Real(1) / r;
    const Real f0 = -z11 - alpha * z12 * z12;
    const Real z13 = r_dot * (k3 + z8 * z2) * z6 * z5;
    const Real f1 = -r * phi_dot * z13;

    // Solve M q'' = f with M = L D L^T
    const Real z14 = Real(1) / M11;
    const Real z15 = M10 * z14;
    const Real z16 = Real(1) / (M00 - M10 * z15);
    const Real z17 = z16 * (f1 * z15 - f0);
    const Real r_ddot = -z17;
    const Real phi_ddot = z14 * f1 + z15 * z17;

    // Result
    rate[0] = r_dot;
    rate[1] = phi_dot;
    rate[2] = r_ddot;
    rate[3] = phi_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &r = state[0], &r_dot = state[2], &phi_dot = state[3];
    const Real &alpha = par[2], &k0 = par[3], &k1 = par[4], &k2 = par[5], &k3 = par[6];

    // Mass matrix M(q), lower triangle
    const Real z0 = r * r;
    const Real z1 = phi_dot * phi_dot;
    const Real z2 = z0 * z1;
    const Real z3 = r_dot * r_dot;
    const Real z4 = z2 + z3;
    const Real z5 = Real(1) / (k1 - z4);
    const Real z6 = sqrt(Real(1) - k2 * z4);
    const Real z7 = z5 * z3;
    const Real M00 = k0 * z5 * z6 * (z7 + Real(1));
    const Real z8 = k0 * z5;
    const Real z9 = z8 * z6;
    const Real M10 = r_dot * phi_dot * z9 * z5 * z0;
    const Real z10 = z5 * z6 * (z5 * z0 * z0 * z1 + z0);
    const Real M11 = k0 * z10;

    // Forcing f
    const Real z11 = r * z9 * (z7 - Real(1)) * z1;
    const Real z12 = Real(1) / r;
    const Real f0 = -z11 - alpha * z12 * z12;
    const Real z13 = r_dot * (k3 + z8 * z2) * z6 * z5;
    const Real f1 = -r * phi_dot * z13;

    // Result
    mass[0] = M00;
    mass[1] = mass[2] = M10;
    mass[3] = M11;
    forcing[0] = f0;
    forcing[1] = f1;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &r = state[0], &r_dot = state[2], &phi_dot = state[3];
    const Real &alpha = par[2], &k0 = par[3], &k1 = par[4], &k2 = par[5], &k4 = par[7];

    // Energy
    const Real z0 = r * r;
    const Real z1 = phi_dot * phi_dot;
    const Real z2 = z0 * z1;
    const Real z3 = r_dot * r_dot;
    const Real z4 = z2 + z3;
    const Real z5 = Real(1) / (k1 - z4);
    const Real z6 = sqrt(Real(1) - k2 * z4);
    const Real z7 = alpha / r;
    const Real z8 = k4 * (z0 * z0 * z1 * z1 + z3 * z3);
    const Real z9 = (k0 * z2 * z3 + z8) * z5;
    const Real T = (k4 * z4 + z9) * z6 * z5;
    const Real V = k0 - z7;
    const Real E = k0 * z6 * (z5 * z4 + Real(1)) - z7;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = Real(0);
    jacobi[0] = E;
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

constexpr const char* coordinate_names[] = { "r", "phi", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "c", "alpha", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 4, 1, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 3, 5, 0, 0, 0, "relativistic_kepler", "lagrange, textbook form",
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
}  // namespace relativistic_kepler::code_bd284315
#pragma GCC diagnostic pop

namespace relativistic_kepler {
using code_bd284315::parameter_values;
using code_bd284315::coordinate_names;
using code_bd284315::speed_names;
using code_bd284315::parameter_names;
using code_bd284315::output_names;
using code_bd284315::event_names;
using code_bd284315::table;
using code_bd284315::prepare;
using code_bd284315::rhs;
using code_bd284315::mass_forcing;
using code_bd284315::energy;
}  // namespace relativistic_kepler

using namespace relativistic_kepler;

#ifndef ALEMBERT_relativistic_kepler_bd284315  // once in a unit, however many namespaces include this file
#define ALEMBERT_relativistic_kepler_bd284315
// What relativistic_kepler.hpp declares: under names that begin with that of the scene and end with a fingerprint of this file and its
// header, so that many systems can be in one program, and no header is linked with another file than its own.
extern "C" __attribute__((weak, visibility("default"))) void relativistic_kepler_prepare_bd284315(double* par) {
    relativistic_kepler::code_bd284315::table.prepare(par);
}
extern "C" __attribute__((weak, visibility("default"))) void relativistic_kepler_rhs_bd284315(double t, const double* state, const double* par, double* rate) {
    relativistic_kepler::code_bd284315::table.rhs(t, state, par, rate);
}
extern "C" __attribute__((weak, visibility("default"))) void relativistic_kepler_mass_forcing_bd284315(double t, const double* state, const double* par, double* mass, double* forcing) {
    relativistic_kepler::code_bd284315::table.mass_forcing(t, state, par, mass, forcing);
}
extern "C" __attribute__((weak, visibility("default"))) void relativistic_kepler_energy_bd284315(double t, const double* state, const double* rate, const double* par, double* energy, double* jacobi) {
    relativistic_kepler::code_bd284315::table.energy(t, state, rate, par, energy, jacobi);
}
extern "C" __attribute__((weak, visibility("default"))) const void* relativistic_kepler_tables_bd284315() {
    return &relativistic_kepler::code_bd284315::all;
}
#endif

#ifndef ALEMBERT_NO_MODULE  // What is looked for in a module that is loaded while a program runs; once in a unit.
#define ALEMBERT_NO_MODULE
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_solver() { return relativistic_kepler::code_bd284315::all.solver; }
#endif
