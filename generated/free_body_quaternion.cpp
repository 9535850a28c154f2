// SPDX-License-Identifier: MIT
// Equations of motion of 'free_body_quaternion': kane, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//   alembert emit free_body_quaternion.toml -o .
//
// M(q) u' = f(q, u, t), q' = h(q, u, t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[7]        e0, e1, e2, e3, then w1 [rad/s], w2 [rad/s], w3 [rad/s]
//   rate[7]         d state / dt
//   par[12]         A = 1 [kg m^2], B = 2 [kg m^2], C = 3 [kg m^2],
//                   then 9 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[9], M row by row; forcing[3], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   outputs_at      out[6]: Hx, Hy, Hz, w1, w2, w3
//   constraints_at  position[1], velocity[1]; rows[7], A row by row
//   rows of A       F
//   multipliers_at  lambda[1]: lambda_F
//   project         out[7], position[1], pivots[1]
//   cost            30 operations a right-hand side: 8 additions, 22 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "free_body_quaternion.cpp"
//
//   int main() {
//       const double state[7] = {1, 0, 0, 0, 0.01, 1, 0};
//       double par[12], rate[7];
//       for (int k = 0; k < 3; ++k) par[k] = free_body_quaternion::parameter_values[k];
//       free_body_quaternion::prepare(par);
//       free_body_quaternion::rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // some are for other types of numbers
#pragma GCC diagnostic ignored "-Wpsabi"            // all functions with vectors are inline
namespace free_body_quaternion::code_e8835615 {
namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &A = par[0], &B = par[1], &C = par[2];

    // Constants
    const Real k0 = B - C;
    const Real k1 = A - C;
    const Real k2 = A - B;
    const Real k3 = k0 / A;
    const Real k4 = k1 / B;
    const Real k5 = k2 / C;
    const Real k6 = Real(0.5) * A;
    const Real k7 = Real(0.5) * C;
    const Real k8 = Real(0.5) * B;

    // Result
    par[3] = k0;
    par[4] = k1;
    par[5] = k2;
    par[6] = k3;
    par[7] = k4;
    par[8] = k5;
    par[9] = k6;
    par[10] = k7;
    par[11] = k8;
}

/// rate = (q', u') at t and state = (q, u).
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];
    const Real &k3 = par[6], &k4 = par[7], &k5 = par[8];

    // Kinematics q' = h(q, u, t)
    const Real e0_dot = -Real(0.5) * (e1 * w1 + e2 * w2 + e3 * w3);
    const Real e1_dot = Real(0.5) * (e0 * w1 + e2 * w3 - e3 * w2);
    const Real e2_dot = Real(0.5) * (e0 * w2 - e1 * w3 + e3 * w1);
    const Real e3_dot = Real(0.5) * (e0 * w3 + e1 * w2 - e2 * w1);

    // Mass matrix M(q), lower triangle
    // M00 = A, M10 = 0, M11 = B, M20 = 0, M21 = 0, M22 = C

    // Solve M u' = f with M = L D L^T
    const Real w1_dot = k3 * w2 * w3;
    const Real w2_dot = -k4 * w1 * w3;
    const Real w3_dot = k5 * w1 * w2;

    // Result
    rate[0] = e0_dot;
    rate[1] = e1_dot;
    rate[2] = e2_dot;
    rate[3] = e3_dot;
    rate[4] = w1_dot;
    rate[5] = w2_dot;
    rate[6] = w3_dot;
}

/// M (s by s, row-major) and f of M u' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &w1 = state[4], &w2 = state[5], &w3 = state[6];
    const Real &A = par[0], &B = par[1], &C = par[2], &k0 = par[3], &k1 = par[4], &k2 = par[5];

    // Forcing f
    const Real f0 = k0 * w2 * w3;
    const Real f1 = -k1 * w1 * w3;
    const Real f2 = k2 * w1 * w2;

    // Result
    mass[0] = A;
    mass[1] = mass[3] = Real(0);
    mass[4] = B;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = C;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = f2;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &w1 = state[4], &w2 = state[5], &w3 = state[6];
    const Real &A = par[0], &B = par[1], &C = par[2];

    // Energy
    const Real T = Real(0.5) * (A * w1 * w1 + B * w2 * w2 + C * w3 * w3);

    // Result
    energy[0] = T;
    energy[1] = Real(0);
    energy[2] = T;
    energy[3] = Real(0);
    jacobi[0] = T;
}

/// The scene's outputs.
template <typename Real>
void outputs_at(const Real&, const Real* state, const Real*, const Real* par, Real* out) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];
    const Real &A = par[0], &B = par[1], &C = par[2], &k6 = par[9], &k7 = par[10], &k8 = par[11];

    // Outputs
    const Real z0 = e0 * e0;
    const Real z1 = e1 * e1;
    const Real z2 = z0 + z1;
    const Real z3 = e2 * e2;
    const Real z4 = e3 * e3;
    const Real z5 = z3 + z4;
    const Real z6 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z7 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z8 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z9 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z10 = Real(1) / (z2 + z5);
    const Real z11 = e0 * z9;
    const Real z12 = z11 + e3 * z6 - e2 * z7 + e1 * z8;
    const Real z13 = z10 * z12;
    const Real z14 = e2 * z9;
    const Real z15 = z14 - e1 * z6 + e0 * z7 + e3 * z8;
    const Real z16 = z10 * z15;
    const Real z17 = e3 * z9;
    const Real z18 = z17 - e0 * z6 - e1 * z7 - e2 * z8;
    const Real z19 = z10 * z18;
    const Real z20 = k6 * z13 * (z2 - z5) * z10;
    const Real z21 = B * z19;
    const Real z22 = e0 * e3;
    const Real z23 = e1 * e2;
    const Real z24 = z20 + z21 * (z22 - z23) * z10;
    const Real z25 = C * z16;
    const Real z26 = e0 * e2;
    const Real z27 = e1 * e3;
    const Real Hx = Real(2) * (z24 + z25 * (z26 + z27) * z10);
    const Real z28 = A * z13;
    const Real z29 = z0 - z1;
    const Real z30 = z3 - z4;
    const Real z31 = k8 * z19 * (z29 + z30) * z10;
    const Real z32 = z28 * (z22 + z23) * z10 - z31;
    const Real z33 = e0 * e1;
    const Real z34 = e2 * e3;
    const Real Hy = Real(2) * (z32 - z25 * (z33 - z34) * z10);
    const Real z35 = z28 * (z26 - z27) * z10;
    const Real z36 = z35 + z21 * (z33 + z34) * z10;
    const Real z37 = z36 - k7 * z16 * (z29 - z30) * z10;
    const Real Hz = -Real(2) * z37;

    // Result
    out[0] = Hx;
    out[1] = Hy;
    out[2] = Hz;
    out[3] = w1;
    out[4] = w2;
    out[5] = w3;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real*, Real* position, Real* velocity, Real* rows) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];

    // Constraints
    const Real z0 = (e0 * e0 + e1 * e1) + (e2 * e2 + e3 * e3);
    const Real z1 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z2 = e2 * z1;
    const Real z3 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z4 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z5 = e0 * w1 + e2 * w3 - e3 * w2;

    // Result
    position[0] = z0 - Real(1);
    velocity[0] = z2 + e3 * z3 - e0 * z4 + e1 * z5;
    rows[0] = Real(2) * e0;
    rows[1] = Real(2) * e1;
    rows[2] = Real(2) * e2;
    rows[3] = Real(2) * e3;
    rows[4] = Real(0);
    rows[5] = Real(0);
    rows[6] = Real(0);
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real* state, const Real* par, Real* lambda) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];
    const Real &A = par[0], &B = par[1], &C = par[2], &k3 = par[6], &k4 = par[7], &k5 = par[8], &k6 = par[9];
    const Real &k7 = par[10], &k8 = par[11];

    // Multipliers
    const Real z0 = (e0 * e0 + e1 * e1) + (e2 * e2 + e3 * e3);
    const Real z1 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z2 = e2 * z1;
    const Real z3 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z4 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z5 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z6 = z2 + e3 * z3 - e0 * z4 + e1 * z5;
    const Real z7 = k3 * w2 * w3;
    const Real z8 = k4 * w1 * w3;
    const Real z9 = k5 * w1 * w2;
    const Real z10 = Real(1) / z0;
    const Real z11 = (w2 * z3 - w3 * z1) + w1 * z4;
    const Real z12 = Real(0.5) * e3 * z8 + Real(0.5) * e2 * z9 + Real(0.5) * e0 * z7 - Real(0.25) * z11;
    const Real z13 = e2 * z10;
    const Real z14 = A * z13;
    const Real z15 = e0 * z10;
    const Real z16 = e1 * z10;
    const Real z17 = B * z16;
    const Real z18 = e3 * z10;
    const Real z19 = C * z15;
    const Real z20 = z14 * z15 + z17 * z18 - z19 * z13;
    const Real z21 = z12 * z20;
    const Real z22 = (w2 * z5 - w1 * z1) - w3 * z4;
    const Real z23 = Real(0.5) * e2 * z7 + Real(0.5) * e1 * z8 - Real(0.5) * e0 * z9 - Real(0.25) * z22;
    const Real z24 = z14 * z13 + z17 * z16 + z19 * z15;
    const Real z25 = z23 * z24;
    const Real z26 = w1 * z5 + (w3 * z3 + w2 * z1);
    const Real z27 = Real(0.5) * e2 * z8 - Real(0.5) * e3 * z9 - Real(0.5) * e1 * z7 - Real(0.25) * z26;
    const Real z28 = z14 * z16 - z17 * z13 - z19 * z18;
    const Real z29 = (w3 * z5 - w1 * z3) + w2 * z4;
    const Real z30 = Real(0.5) * e1 * z9 + Real(0.5) * e0 * z8 - Real(0.5) * e3 * z7 + Real(0.25) * z29;
    const Real z31 = z14 * z18 - z17 * z15 + z19 * z16;
    const Real z32 = e0 * z5;
    const Real z33 = z32 + e3 * z1 - e2 * z3 + e1 * z4;
    const Real z34 = z10 * z33;
    const Real z35 = k6 * z34;
    const Real z36 = e2 * z5;
    const Real z37 = z36 - e1 * z1 + e0 * z3 + e3 * z4;
    const Real z38 = z10 * z37;
    const Real z39 = k7 * z38;
    const Real z40 = z35 * z38 - z39 * z34;
    const Real z41 = e3 * z5;
    const Real z42 = z41 - e0 * z1 - e1 * z3 - e2 * z4;
    const Real z43 = z10 * z10 * z6;
    const Real z44 = z40 + k8 * z42 * z43;
    const Real z45 = z10 * z42;
    const Real z46 = k8 * z45;
    const Real z47 = z35 * z45 - z46 * z34;
    const Real z48 = z47 - k7 * z37 * z43;
    const Real z49 = z46 * z38 - z39 * z45;
    const Real z50 = k6 * z33 * z43 - z49;
    const Real z51 = z44 * z16 + z48 * z15 + z50 * z13;
    const Real z52 = z21 + z25 - z27 * z28 - z30 * z31 - z51;
    const Real z53 = e3 * z52;
    const Real z54 = A * z18;
    const Real z55 = B * z15;
    const Real z56 = C * z16;
    const Real z57 = z54 * z16 + z55 * z13 - z56 * z18;
    const Real z58 = z27 * z57;
    const Real z59 = z23 * z31;
    const Real z60 = z54 * z18 + z55 * z15 + z56 * z16;
    const Real z61 = z54 * z15 - z55 * z18 - z56 * z13;
    const Real z62 = z50 * z18 - z44 * z15 + z48 * z16;
    const Real z63 = z58 - z59 + z30 * z60 - z12 * z61 + z62;
    const Real z64 = z23 * z20;
    const Real z65 = z30 * z61;
    const Real z66 = A * z15;
    const Real z67 = B * z18;
    const Real z68 = C * z13;
    const Real z69 = z66 * z16 - z67 * z13 + z68 * z18;
    const Real z70 = z66 * z15 + z67 * z18 + z68 * z13;
    const Real z71 = z44 * z18 + z50 * z15 - z48 * z13;
    const Real z72 = z64 - z65 - z27 * z69 + z12 * z70 - z71;
    const Real z73 = z12 * z69;
    const Real z74 = A * z16 * z16;
    const Real z75 = B * z13 * z13;
    const Real z76 = z27 * (z74 + z75 + C * z18 * z18);
    const Real z77 = z44 * z13 + z48 * z18 - z50 * z16;
    const Real z78 = z73 - z76 - z30 * z57 + z23 * z28 + z77;
    const Real z79 = z53 + e2 * z63 - e1 * z72 + e0 * z78;
    const Real lambda_F = -Real(2) * z79 * z10;

    // Result
    lambda[0] = lambda_F;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real*, Real* out, Real* position, Real* pivots) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];

    // Projection
    const Real z0 = (e0 * e0 + e1 * e1) + (e2 * e2 + e3 * e3);
    const Real z1 = z0 - Real(1);
    const Real z2 = z1 / z0;

    // Result
    out[0] = e0 - Real(0.5) * e0 * z2;
    out[1] = e1 - Real(0.5) * e1 * z2;
    out[2] = e2 - Real(0.5) * e2 * z2;
    out[3] = e3 - Real(0.5) * e3 * z2;
    out[4] = w1;
    out[5] = w2;
    out[6] = w3;
    position[0] = z1;
    pivots[0] = Real(4) * z0;
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

constexpr const char* coordinate_names[] = { "e0", "e1", "e2", "e3", nullptr};
constexpr const char* speed_names[] = { "w1", "w2", "w3", nullptr};
constexpr const char* parameter_names[] = { "A", "B", "C", nullptr};
constexpr const char* output_names[] = { "Hx", "Hy", "Hz", "w1", "w2", "w3", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 2, 3, 0};

constexpr alembert_solver_table table{
    4, 4, 3, 3, 9, 6, 0, 1, "free_body_quaternion", "kane, textbook form",
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
    nullptr,
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
}  // namespace free_body_quaternion::code_e8835615
#pragma GCC diagnostic pop

namespace free_body_quaternion {
using code_e8835615::parameter_values;
using code_e8835615::coordinate_names;
using code_e8835615::speed_names;
using code_e8835615::parameter_names;
using code_e8835615::output_names;
using code_e8835615::event_names;
using code_e8835615::table;
using code_e8835615::prepare;
using code_e8835615::rhs;
using code_e8835615::mass_forcing;
using code_e8835615::energy;
using code_e8835615::outputs_at;
using code_e8835615::constraints_at;
using code_e8835615::multipliers_at;
using code_e8835615::project;
}  // namespace free_body_quaternion

using namespace free_body_quaternion;

#ifndef ALEMBERT_free_body_quaternion_e8835615  // once in a unit, however many namespaces include this file
#define ALEMBERT_free_body_quaternion_e8835615
// What free_body_quaternion.hpp declares: under names that begin with that of the scene and end with a fingerprint of this file and its
// header, so that many systems can be in one program, and no header is linked with another file than its own.
extern "C" __attribute__((weak, visibility("default"))) void free_body_quaternion_prepare_e8835615(double* par) {
    free_body_quaternion::code_e8835615::table.prepare(par);
}
extern "C" __attribute__((weak, visibility("default"))) void free_body_quaternion_rhs_e8835615(double t, const double* state, const double* par, double* rate) {
    free_body_quaternion::code_e8835615::table.rhs(t, state, par, rate);
}
extern "C" __attribute__((weak, visibility("default"))) void free_body_quaternion_mass_forcing_e8835615(double t, const double* state, const double* par, double* mass, double* forcing) {
    free_body_quaternion::code_e8835615::table.mass_forcing(t, state, par, mass, forcing);
}
extern "C" __attribute__((weak, visibility("default"))) void free_body_quaternion_energy_e8835615(double t, const double* state, const double* rate, const double* par, double* energy, double* jacobi) {
    free_body_quaternion::code_e8835615::table.energy(t, state, rate, par, energy, jacobi);
}
extern "C" __attribute__((weak, visibility("default"))) void free_body_quaternion_outputs_at_e8835615(double t, const double* state, const double* rate, const double* par, double* out) {
    free_body_quaternion::code_e8835615::table.outputs_at(t, state, rate, par, out);
}
extern "C" __attribute__((weak, visibility("default"))) void free_body_quaternion_constraints_at_e8835615(double t, const double* state, const double* par, double* position, double* velocity, double* rows) {
    free_body_quaternion::code_e8835615::table.constraints_at(t, state, par, position, velocity, rows);
}
extern "C" __attribute__((weak, visibility("default"))) void free_body_quaternion_multipliers_at_e8835615(double t, const double* state, const double* par, double* lambda) {
    free_body_quaternion::code_e8835615::table.multipliers_at(t, state, par, lambda);
}
extern "C" __attribute__((weak, visibility("default"))) void free_body_quaternion_project_e8835615(double t, const double* state, const double* par, double* out, double* position, double* pivots) {
    free_body_quaternion::code_e8835615::projection.project(t, state, par, out, position, pivots);
}
extern "C" __attribute__((weak, visibility("default"))) const void* free_body_quaternion_tables_e8835615() {
    return &free_body_quaternion::code_e8835615::all;
}
#endif

#ifndef ALEMBERT_NO_MODULE  // What is looked for in a module that is loaded while a program runs; once in a unit.
#define ALEMBERT_NO_MODULE
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_solver() { return free_body_quaternion::code_e8835615::all.solver; }
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_projection() { return free_body_quaternion::code_e8835615::all.projection; }
#endif
