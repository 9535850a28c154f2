// SPDX-License-Identifier: MIT
// Equations of motion of 'planetary_gear': routh, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//   alembert emit planetary_gear.toml -o .
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        phi [rad], psi [rad], then their rates
//   rate[4]         d state / dt
//   par[17]         m1 = 2 [kg], m2 = 1.5 [kg], R = 0.4 [m], r = 0.15 [m], M = 3 [N m],
//                   then 12 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   constraints_at  position[1], velocity[1]; rows[2], A row by row
//   rows of A       mesh_y
//   multipliers_at  lambda[1]: lambda_mesh_y
//   project         out[4], position[1], pivots[1]
//   cost            0 operations a right-hand side: 0 additions, 0 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "planetary_gear.cpp"
//
//   int main() {
//       const double state[4] = {0, 0, 0, 0};
//       double par[17], rate[4];
//       for (int k = 0; k < 5; ++k) par[k] = planetary_gear::parameter_values[k];
//       planetary_gear::prepare(par);
//       planetary_gear::rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // some are for other types of numbers
#pragma GCC diagnostic ignored "-Wpsabi"            // all functions with vectors are inline
namespace planetary_gear::code_08fa7725 {
namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m1 = par[0], &m2 = par[1], &R = par[2], &r = par[3], &M = par[4];

    // Constants
    const Real k0 = R + r;
    const Real z0 = (m1 + Real(3) * m2) * k0 * k0;
    const Real M00 = (Real(1) / Real(3)) * z0;
    const Real z1 = m2 * r * r;
    const Real M11 = Real(0.5) * z1;
    const Real z2 = Real(1) / z0;
    const Real z3 = z2 * k0;
    const Real z4 = r / z1;
    const Real k1 = Real(3) * z3 * k0 + Real(2) * r * z4;
    const Real k2 = Real(1) / k1;
    const Real z5 = M * z3 * k2;
    const Real k3 = Real(3) * M * z2 - Real(9) * z3 * z5;
    const Real k4 = Real(6) * z5 * z4;
    const Real k5 = Real(3) * z3;
    const Real k6 = Real(2) * z4;
    const Real k7 = -Real(3) * z5;
    const Real k8 = (Real(1) / Real(6)) * z0;
    const Real k9 = Real(0.25) * z1;

    // Result
    par[5] = k0;
    par[6] = M00;
    par[7] = M11;
    par[8] = k1;
    par[9] = k2;
    par[10] = k3;
    par[11] = k4;
    par[12] = k5;
    par[13] = k6;
    par[14] = k7;
    par[15] = k8;
    par[16] = k9;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &phi_dot = state[2], &psi_dot = state[3];
    const Real &k0 = par[5], &k3 = par[10], &k4 = par[11];

    // Mass matrix M(q), lower triangle
    // M10 = 0

    // Forcing f
    // f0 = M, f1 = 0

    // Result
    rate[0] = phi_dot;
    rate[1] = psi_dot;
    rate[2] = k3;
    rate[3] = k4;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real*, const Real* par, Real* mass, Real* forcing) {
    const Real &M = par[4], &M00 = par[6], &M11 = par[7];

    // Result
    mass[0] = M00;
    mass[1] = mass[2] = Real(0);
    mass[3] = M11;
    forcing[0] = M;
    forcing[1] = Real(0);
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &phi_dot = state[2], &psi_dot = state[3];
    const Real &M = par[4], &k8 = par[15], &k9 = par[16];

    // Energy
    const Real T = k8 * phi_dot * phi_dot + k9 * psi_dot * psi_dot;
    const Real P = M * phi_dot;

    // Result
    energy[0] = T;
    energy[1] = Real(0);
    energy[2] = T;
    energy[3] = P;
    jacobi[0] = T;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real* par, Real* position, Real* velocity, Real* rows) {
    const Real &phi_dot = state[2], &psi_dot = state[3];
    const Real &r = par[3], &k0 = par[5];

    // Result
    position[0] = Real(0);
    velocity[0] = k0 * phi_dot - r * psi_dot;
    rows[0] = k0;
    rows[1] = -r;
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real*, const Real* par, Real* lambda) {
    const Real &k7 = par[14];

    // Result
    lambda[0] = k7;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &phi = state[0], &psi = state[1], &phi_dot = state[2], &psi_dot = state[3];
    const Real &r = par[3], &k0 = par[5], &k1 = par[8], &k2 = par[9], &k5 = par[12], &k6 = par[13];

    // Projection
    const Real z0 = k2 * (k0 * phi_dot - r * psi_dot);

    // Result
    out[0] = phi;
    out[1] = psi;
    out[2] = phi_dot - k5 * z0;
    out[3] = psi_dot + k6 * z0;
    position[0] = Real(0);
    pivots[0] = k1;
}

/// gamma of A q'' = gamma.
template <typename Real>
void gamma_at(const Real&, const Real*, const Real*, Real* out) {

    // Result
    out[0] = Real(0);
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

constexpr const char* coordinate_names[] = { "phi", "psi", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m1", "m2", "R", "r", "M", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 2, 1.5, 0.4, 0.15, 3, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 5, 12, 0, 0, 1, "planetary_gear", "routh, textbook form",
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
    &table, nullptr, &projection, nullptr, nullptr, 1,
};

}  // namespace
}  // namespace planetary_gear::code_08fa7725
#pragma GCC diagnostic pop

namespace planetary_gear {
using code_08fa7725::parameter_values;
using code_08fa7725::coordinate_names;
using code_08fa7725::speed_names;
using code_08fa7725::parameter_names;
using code_08fa7725::output_names;
using code_08fa7725::event_names;
using code_08fa7725::table;
using code_08fa7725::prepare;
using code_08fa7725::rhs;
using code_08fa7725::mass_forcing;
using code_08fa7725::energy;
using code_08fa7725::constraints_at;
using code_08fa7725::multipliers_at;
using code_08fa7725::project;
using code_08fa7725::gamma_at;
}  // namespace planetary_gear

using namespace planetary_gear;

#ifndef ALEMBERT_planetary_gear_08fa7725  // once in a unit, however many namespaces include this file
#define ALEMBERT_planetary_gear_08fa7725
// What planetary_gear.hpp declares: under names that begin with that of the scene and end with a fingerprint of this file and its
// header, so that many systems can be in one program, and no header is linked with another file than its own.
extern "C" __attribute__((weak, visibility("default"))) void planetary_gear_prepare_08fa7725(double* par) {
    planetary_gear::code_08fa7725::table.prepare(par);
}
extern "C" __attribute__((weak, visibility("default"))) void planetary_gear_rhs_08fa7725(double t, const double* state, const double* par, double* rate) {
    planetary_gear::code_08fa7725::table.rhs(t, state, par, rate);
}
extern "C" __attribute__((weak, visibility("default"))) void planetary_gear_mass_forcing_08fa7725(double t, const double* state, const double* par, double* mass, double* forcing) {
    planetary_gear::code_08fa7725::table.mass_forcing(t, state, par, mass, forcing);
}
extern "C" __attribute__((weak, visibility("default"))) void planetary_gear_energy_08fa7725(double t, const double* state, const double* rate, const double* par, double* energy, double* jacobi) {
    planetary_gear::code_08fa7725::table.energy(t, state, rate, par, energy, jacobi);
}
extern "C" __attribute__((weak, visibility("default"))) void planetary_gear_constraints_at_08fa7725(double t, const double* state, const double* par, double* position, double* velocity, double* rows) {
    planetary_gear::code_08fa7725::table.constraints_at(t, state, par, position, velocity, rows);
}
extern "C" __attribute__((weak, visibility("default"))) void planetary_gear_multipliers_at_08fa7725(double t, const double* state, const double* par, double* lambda) {
    planetary_gear::code_08fa7725::table.multipliers_at(t, state, par, lambda);
}
extern "C" __attribute__((weak, visibility("default"))) void planetary_gear_project_08fa7725(double t, const double* state, const double* par, double* out, double* position, double* pivots) {
    planetary_gear::code_08fa7725::projection.project(t, state, par, out, position, pivots);
}
extern "C" __attribute__((weak, visibility("default"))) void planetary_gear_gamma_at_08fa7725(double t, const double* state, const double* par, double* out) {
    planetary_gear::code_08fa7725::projection.gamma_at(t, state, par, out);
}
extern "C" __attribute__((weak, visibility("default"))) const void* planetary_gear_tables_08fa7725() {
    return &planetary_gear::code_08fa7725::all;
}
#endif

#ifndef ALEMBERT_NO_MODULE  // What is looked for in a module that is loaded while a program runs; once in a unit.
#define ALEMBERT_NO_MODULE
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_solver() { return planetary_gear::code_08fa7725::all.solver; }
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_projection() { return planetary_gear::code_08fa7725::all.projection; }
#endif
