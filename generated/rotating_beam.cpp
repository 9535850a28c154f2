// Equations of motion of 'rotating_beam': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        phi [rad], q [m], then their rates
//   rate[4]         d state / dt
//   par[12]         J = 0.5 [kg*m^2], rho = 1 [kg/m], L = 2 [m], EI = 20 [N*m^2], M = 0.8 [N m],
//                   then 7 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   cost            14 operations a right-hand side: 3 additions, 10 multiplications, 1 division, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "rotating_beam.cpp"
//
//   int main() {
//       const double state[4] = {0, 0.1, 6, 0};
//       double par[12], rate[4];
//       for (int k = 0; k < 5; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &J = par[0], &rho = par[1], &L = par[2], &EI_ = par[3];

    // Constants
    const Real k0 = J + (Real(1) / Real(3)) * rho * L * L * L;
    const Real z0 = rho * L;
    const Real k1 = (Real(4) / Real(15)) * z0;
    const Real M11 = Real(0.2) * z0;
    const Real k2 = (Real(8) / Real(15)) * z0;
    const Real z1 = Real(1) / L;
    const Real z2 = EI_ * z1 * z1 * z1;
    const Real k3 = Real(4) * z2;
    const Real k4 = Real(5) * Real(1) / z0;
    const Real k5 = Real(2) * z2;

    // Result
    par[5] = k0;
    par[6] = k1;
    par[7] = M11;
    par[8] = k2;
    par[9] = k3;
    par[10] = k4;
    par[11] = k5;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &q = state[1], &phi_dot = state[2], &q_dot = state[3];
    const Real &M = par[4], &k0 = par[5], &k1 = par[6], &k2 = par[8], &k3 = par[9], &k4 = par[10];

    // Mass matrix M(q), lower triangle
    // M10 = 0
    const Real M00 = k0 - k1 * q * q;

    // Forcing f
    const Real f0 = M + k2 * q * phi_dot * q_dot;
    const Real f1 = -q * (k3 + k1 * phi_dot * phi_dot);

    // Solve M q'' = f with M = L D L^T
    const Real phi_ddot = f0 / M00;
    const Real q_ddot = k4 * f1;

    // Result
    rate[0] = phi_dot;
    rate[1] = q_dot;
    rate[2] = phi_ddot;
    rate[3] = q_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &q = state[1], &phi_dot = state[2], &q_dot = state[3];
    const Real &M = par[4], &k0 = par[5], &k1 = par[6], &M11 = par[7], &k2 = par[8], &k3 = par[9];

    // Mass matrix M(q), lower triangle
    const Real M00 = k0 - k1 * q * q;

    // Forcing f
    const Real f0 = M + k2 * q * phi_dot * q_dot;
    const Real f1 = -q * (k3 + k1 * phi_dot * phi_dot);

    // Result
    mass[0] = M00;
    mass[1] = mass[2] = Real(0);
    mass[3] = M11;
    forcing[0] = f0;
    forcing[1] = f1;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &q = state[1], &phi_dot = state[2], &q_dot = state[3];
    const Real &M = par[4], &k0 = par[5], &k1 = par[6], &M11 = par[7], &k5 = par[11];

    // Energy
    const Real z0 = phi_dot * phi_dot * (k0 - k1 * q * q) + M11 * q_dot * q_dot;
    const Real T = Real(0.5) * z0;
    const Real V = k5 * q * q;
    const Real E = Real(0.5) * z0 + V;
    const Real P = M * phi_dot;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = P;
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

constexpr const char* coordinate_names[] = { "phi", "q", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "J", "rho", "L", "EI", "M", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.5, 1, 2, 20, 0.8, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 5, 7, 0, 0, 0, "rotating_beam", "lagrange, textbook form",
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

