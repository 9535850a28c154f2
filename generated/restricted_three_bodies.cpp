// Equations of motion of 'restricted_three_bodies': lagrange, intermediate symbols.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        x, y, then their rates
//   rate[4]         d state / dt
//   par[2]          mu = 0.0121505, then 1 number that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   cost            28 operations a right-hand side: 12 additions, 12 multiplications, 2 divisions, 2 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "restricted_three_bodies.cpp"
//
//   int main() {
//       const double state[4] = {0.5, 0.85, 0, 0};
//       double par[2], rate[4];
//       for (int k = 0; k < 1; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

inline double sqrt(double x) { return __builtin_sqrt(x); }

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &mu = par[0];

    // Constants
    const Real k0 = mu - Real(1);

    // Result
    par[1] = k0;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &mu = par[0], &k0 = par[1];

    // Mass matrix M(q), lower triangle
    // M00 = 1, M10 = 0, M11 = 1

    // Forcing f
    // f0 = x_ddot, f1 = y_ddot
    const Real z0 = mu + x;
    const Real z1 = y * y;
    const Real z2 = z1 + z0 * z0;
    const Real z3 = Real(1) / z2;
    const Real z4 = z3 * k0 * z3 * sqrt(z2);
    const Real z5 = k0 + x;
    const Real z6 = z1 + z5 * z5;
    const Real z7 = Real(1) / z6;
    const Real z8 = z7 * mu * z7 * sqrt(z6);
    const Real z9 = (x + y_dot) + z0 * z4 - z5 * z8;
    const Real z10 = x_dot - ((y - x_dot) + y * (z4 - z8));

    // Solve M q'' = f with M = L D L^T
    const Real x_ddot = y_dot + z9;
    const Real y_ddot = -z10;

    // Result
    rate[0] = x_dot;
    rate[1] = y_dot;
    rate[2] = x_ddot;
    rate[3] = y_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &mu = par[0], &k0 = par[1];

    // Forcing f
    const Real z0 = mu + x;
    const Real z1 = y * y;
    const Real z2 = z1 + z0 * z0;
    const Real z3 = Real(1) / z2;
    const Real z4 = z3 * k0 * z3 * sqrt(z2);
    const Real z5 = k0 + x;
    const Real z6 = z1 + z5 * z5;
    const Real z7 = Real(1) / z6;
    const Real z8 = z7 * mu * z7 * sqrt(z6);
    const Real z9 = (x + y_dot) + z0 * z4 - z5 * z8;
    const Real f0 = y_dot + z9;
    const Real z10 = x_dot - ((y - x_dot) + y * (z4 - z8));
    const Real f1 = -z10;

    // Result
    mass[0] = Real(1);
    mass[1] = mass[2] = Real(0);
    mass[3] = Real(1);
    forcing[0] = f0;
    forcing[1] = f1;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &mu = par[0], &k0 = par[1];

    // Energy
    const Real z0 = mu + x;
    const Real z1 = y * y;
    const Real z2 = k0 + x;
    const Real z3 = x + y_dot;
    const Real z4 = y - x_dot;
    const Real T = Real(0.5) * (x_dot * x_dot + y_dot * y_dot);
    const Real z5 = mu / sqrt(z1 + z2 * z2);
    const Real z6 = k0 / sqrt(z1 + z0 * z0);
    const Real V = -Real(0.5) * x * x - Real(0.5) * z1 - z5 + z6;
    const Real z7 = Real(0.5) * z3 * z3 + Real(0.5) * z4 * z4 + z5 - z6;
    const Real E = (y_dot * z3 - x_dot * z4) - z7;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = Real(0);
    jacobi[0] = E;
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

constexpr const char* coordinate_names[] = { "x", "y", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "mu", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.0121505, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 1, 1, 0, 0, 0, "restricted_three_bodies", "lagrange, intermediate symbols",
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

