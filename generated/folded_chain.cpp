// Equations of motion of 'folded_chain': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[2]        x [m], then their rates
//   rate[2]         d state / dt
//   par[8]          rho = 0.5 [kg/m], b = 2 [m], g = 9.81 [m/s^2],
//                   then 5 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[1], M row by row; forcing[1], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   cost            8 operations a right-hand side: 2 additions, 5 multiplications, 1 division, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "folded_chain.cpp"
//
//   int main() {
//       const double state[2] = {0, 0};
//       double par[8], rate[2];
//       for (int k = 0; k < 3; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &rho = par[0], &b = par[1], &g = par[2];

    // Constants
    const Real k0 = Real(0.5) * rho;
    const Real k1 = Real(0.25) * rho;
    const Real z0 = rho * g;
    const Real k2 = Real(0.5) * z0;
    const Real k3 = Real(0.5) * rho * b * b * g;
    const Real k4 = Real(0.25) * z0;

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
    const Real &x = state[0], &x_dot = state[1];
    const Real &b = par[1], &k0 = par[3], &k1 = par[4], &k2 = par[5];

    // Shared terms
    const Real z0 = b - x;

    // Mass matrix M(q), lower triangle
    const Real M00 = k0 * z0;

    // Forcing f
    const Real f0 = k1 * x_dot * x_dot + k2 * z0;

    // Solve M q'' = f with M = L D L^T
    const Real x_ddot = f0 / M00;

    // Result
    rate[0] = x_dot;
    rate[1] = x_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &x = state[0], &x_dot = state[1];
    const Real &b = par[1], &k0 = par[3], &k1 = par[4], &k2 = par[5];

    // Mass matrix M(q), lower triangle
    const Real z0 = b - x;
    const Real M00 = k0 * z0;

    // Forcing f
    const Real f0 = k1 * x_dot * x_dot + k2 * z0;

    // Result
    mass[0] = M00;
    forcing[0] = f0;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &x = state[0], &x_dot = state[1];
    const Real &b = par[1], &k1 = par[4], &k3 = par[6], &k4 = par[7];

    // Energy
    const Real z0 = b - x;
    const Real T = k1 * x_dot * x_dot * z0;
    const Real z1 = k3 - k4 * z0 * z0;
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

constexpr const char* coordinate_names[] = { "x", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "rho", "b", "g", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.5, 2, 9.81, 0};

constexpr alembert_solver_table table{
    4, 1, 1, 3, 5, 0, 0, 0, "folded_chain", "lagrange, textbook form",
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

