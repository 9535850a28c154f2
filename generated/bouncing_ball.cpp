// SPDX-License-Identifier: MIT
// Equations of motion of 'bouncing_ball': lagrange, intermediate symbols.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//   alembert emit bouncing_ball.toml -o .
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   left out        the contact floor; between them this is the motion
//   t               the time [s]
//   state[2]        y [m], then their rates
//   rate[2]         d state / dt
//   par[6]          m = 0.5 [kg], g = 9.81 [m/s^2], h = 1 [m], e = 0.7,
//                   then 2 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[1], M row by row; forcing[1], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   outputs_at      out[1]: reaction
//   cost            0 operations a right-hand side: 0 additions, 0 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "bouncing_ball.cpp"
//
//   int main() {
//       const double state[2] = {1, 0};
//       double par[6], rate[2];
//       for (int k = 0; k < 4; ++k) par[k] = bouncing_ball::parameter_values[k];
//       bouncing_ball::prepare(par);
//       bouncing_ball::rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // some are for other types of numbers
#pragma GCC diagnostic ignored "-Wpsabi"            // all functions with vectors are inline
namespace bouncing_ball::code_61771972 {
namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m = par[0], &g = par[1];

    // Constants
    const Real k0 = m * g;
    const Real k1 = k0 / m;

    // Result
    par[4] = k0;
    par[5] = k1;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &y_dot = state[1];
    const Real &k1 = par[5];

    // Mass matrix M(q), lower triangle
    // M00 = m

    // Forcing f
    // f0 = -k0

    // Result
    rate[0] = y_dot;
    rate[1] = -k1;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real*, const Real* par, Real* mass, Real* forcing) {
    const Real &m = par[0], &k0 = par[4];

    // Result
    mass[0] = m;
    forcing[0] = -k0;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &y = state[0], &y_dot = state[1];
    const Real &m = par[0], &k0 = par[4];

    // Energy
    const Real z0 = m * y_dot * y_dot;
    const Real T = Real(0.5) * z0;
    const Real V = k0 * y;
    const Real E = V + Real(0.5) * z0;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = Real(0);
    jacobi[0] = E;
}

/// The scene's outputs.
template <typename Real>
void outputs_at(const Real&, const Real*, const Real*, const Real*, Real* out) {

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

constexpr const char* coordinate_names[] = { "y", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "g", "h", "e", nullptr};
constexpr const char* output_names[] = { "reaction", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.5, 9.81, 1, 0.7, 0};

constexpr alembert_solver_table table{
    4, 1, 1, 4, 2, 1, 0, 0, "bouncing_ball", "lagrange, intermediate symbols",
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
}  // namespace bouncing_ball::code_61771972
#pragma GCC diagnostic pop

namespace bouncing_ball {
using code_61771972::parameter_values;
using code_61771972::coordinate_names;
using code_61771972::speed_names;
using code_61771972::parameter_names;
using code_61771972::output_names;
using code_61771972::event_names;
using code_61771972::table;
using code_61771972::prepare;
using code_61771972::rhs;
using code_61771972::mass_forcing;
using code_61771972::energy;
using code_61771972::outputs_at;
}  // namespace bouncing_ball

using namespace bouncing_ball;

#ifndef ALEMBERT_bouncing_ball_61771972  // once in a unit, however many namespaces include this file
#define ALEMBERT_bouncing_ball_61771972
// What bouncing_ball.hpp declares: under names that begin with that of the scene and end with a fingerprint of this file and its
// header, so that many systems can be in one program, and no header is linked with another file than its own.
extern "C" __attribute__((weak, visibility("default"))) void bouncing_ball_prepare_61771972(double* par) {
    bouncing_ball::code_61771972::table.prepare(par);
}
extern "C" __attribute__((weak, visibility("default"))) void bouncing_ball_rhs_61771972(double t, const double* state, const double* par, double* rate) {
    bouncing_ball::code_61771972::table.rhs(t, state, par, rate);
}
extern "C" __attribute__((weak, visibility("default"))) void bouncing_ball_mass_forcing_61771972(double t, const double* state, const double* par, double* mass, double* forcing) {
    bouncing_ball::code_61771972::table.mass_forcing(t, state, par, mass, forcing);
}
extern "C" __attribute__((weak, visibility("default"))) void bouncing_ball_energy_61771972(double t, const double* state, const double* rate, const double* par, double* energy, double* jacobi) {
    bouncing_ball::code_61771972::table.energy(t, state, rate, par, energy, jacobi);
}
extern "C" __attribute__((weak, visibility("default"))) void bouncing_ball_outputs_at_61771972(double t, const double* state, const double* rate, const double* par, double* out) {
    bouncing_ball::code_61771972::table.outputs_at(t, state, rate, par, out);
}
extern "C" __attribute__((weak, visibility("default"))) const void* bouncing_ball_tables_61771972() {
    return &bouncing_ball::code_61771972::all;
}
#endif

#ifndef ALEMBERT_NO_MODULE  // What is looked for in a module that is loaded while a program runs; once in a unit.
#define ALEMBERT_NO_MODULE
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_solver() { return bouncing_ball::code_61771972::all.solver; }
#endif
