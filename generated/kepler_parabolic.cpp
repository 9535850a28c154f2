// Equations of motion of 'kepler_parabolic': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        xi, eta, then their rates
//   rate[4]         d state / dt
//   par[6]          m = 1 [kg], k = 1 [N m^2],
//                   then 4 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   cost            24 operations a right-hand side: 6 additions, 16 multiplications, 2 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "kepler_parabolic.cpp"
//
//   int main() {
//       const double state[4] = {1.2, 0.2, 0, 0.4};
//       double par[6], rate[4];
//       for (int k = 0; k < 2; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m = par[0], &k = par[1];

    // Constants
    const Real k0 = Real(2) * m;
    const Real k1 = Real(4) * k;
    const Real k2 = Real(0.5) * m;
    const Real k3 = Real(2) * k;

    // Result
    par[2] = k0;
    par[3] = k1;
    par[4] = k2;
    par[5] = k3;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &xi = state[0], &eta = state[1], &xi_dot = state[2], &eta_dot = state[3];
    const Real &m = par[0], &k0 = par[2], &k1 = par[3];

    // Shared terms
    const Real z0 = xi * xi + eta * eta;

    // Mass matrix M(q), lower triangle
    // M10 = 0, M11 = M00
    const Real M00 = m * z0;

    // Forcing f
    const Real z1 = eta_dot * k0 * xi_dot;
    const Real z2 = m * (xi_dot * xi_dot - eta_dot * eta_dot);
    const Real z3 = Real(1) / z0;
    const Real z4 = k1 * z3 * z3;
    const Real f0 = -eta * z1 - xi * (z2 + z4);
    const Real f1 = eta * (z2 - z4) - xi * z1;

    // Solve M q'' = f with M = L D L^T
    const Real z5 = Real(1) / M00;
    const Real xi_ddot = z5 * f0;
    const Real eta_ddot = z5 * f1;

    // Result
    rate[0] = xi_dot;
    rate[1] = eta_dot;
    rate[2] = xi_ddot;
    rate[3] = eta_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &xi = state[0], &eta = state[1], &xi_dot = state[2], &eta_dot = state[3];
    const Real &m = par[0], &k0 = par[2], &k1 = par[3];

    // Mass matrix M(q), lower triangle
    const Real z0 = xi * xi + eta * eta;
    const Real M00 = m * z0;

    // Forcing f
    const Real z1 = eta_dot * k0 * xi_dot;
    const Real z2 = m * (xi_dot * xi_dot - eta_dot * eta_dot);
    const Real z3 = Real(1) / z0;
    const Real z4 = k1 * z3 * z3;
    const Real f0 = -eta * z1 - xi * (z2 + z4);
    const Real f1 = eta * (z2 - z4) - xi * z1;

    // Result
    mass[0] = M00;
    mass[1] = mass[2] = Real(0);
    mass[3] = M00;
    forcing[0] = f0;
    forcing[1] = f1;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &xi = state[0], &eta = state[1], &xi_dot = state[2], &eta_dot = state[3];
    const Real &k2 = par[4], &k3 = par[5];

    // Energy
    const Real z0 = xi * xi + eta * eta;
    const Real T = k2 * z0 * (xi_dot * xi_dot + eta_dot * eta_dot);
    const Real z1 = k3 / z0;
    const Real V = -z1;
    const Real E = T - z1;

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

constexpr const char* coordinate_names[] = { "xi", "eta", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "k", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 1, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 2, 4, 0, 0, 0, "kepler_parabolic", "lagrange, textbook form",
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

