// Equations of motion of 'belt_drive': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        theta1 [rad], theta2 [rad], then their rates
//   rate[4]         d state / dt
//   par[13]         J1 = 0.2 [kg*m^2], J2 = 0.5 [kg*m^2], r1 = 0.1 [m], r2 = 0.25 [m], k = 2000 [N/m],
//                   M = 1.5 [N m], then 7 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   cost            9 operations a right-hand side: 3 additions, 6 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "belt_drive.cpp"
//
//   int main() {
//       const double state[4] = {0.05, 0, 0, 0};
//       double par[13], rate[4];
//       for (int k = 0; k < 6; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &J1 = par[0], &J2 = par[1], &r1 = par[2], &r2 = par[3], &k = par[4];

    // Constants
    const Real k0 = Real(2) * r1 * r1 * k;
    const Real k1 = Real(2) * r1 * r2 * k;
    const Real z0 = r2 * k;
    const Real k2 = Real(2) * z0;
    const Real k3 = Real(1) / J1;
    const Real k4 = Real(2) * z0 / J2;
    const Real k5 = Real(0.5) * J1;
    const Real k6 = Real(0.5) * J2;

    // Result
    par[6] = k0;
    par[7] = k1;
    par[8] = k2;
    par[9] = k3;
    par[10] = k4;
    par[11] = k5;
    par[12] = k6;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &theta1 = state[0], &theta2 = state[1], &theta1_dot = state[2], &theta2_dot = state[3];
    const Real &r1 = par[2], &r2 = par[3], &M = par[5], &k0 = par[6], &k1 = par[7], &k3 = par[9], &k4 = par[10];

    // Mass matrix M(q), lower triangle
    // M00 = J1, M10 = 0, M11 = J2

    // Forcing f
    const Real f0 = M - k0 * theta1 + k1 * theta2;

    // Solve M q'' = f with M = L D L^T
    const Real theta1_ddot = k3 * f0;
    const Real theta2_ddot = k4 * (r1 * theta1 - r2 * theta2);

    // Result
    rate[0] = theta1_dot;
    rate[1] = theta2_dot;
    rate[2] = theta1_ddot;
    rate[3] = theta2_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &theta1 = state[0], &theta2 = state[1];
    const Real &J1 = par[0], &J2 = par[1], &r1 = par[2], &r2 = par[3], &M = par[5], &k0 = par[6], &k1 = par[7];
    const Real &k2 = par[8];

    // Forcing f
    const Real f0 = M - k0 * theta1 + k1 * theta2;
    const Real f1 = k2 * (r1 * theta1 - r2 * theta2);

    // Result
    mass[0] = J1;
    mass[1] = mass[2] = Real(0);
    mass[3] = J2;
    forcing[0] = f0;
    forcing[1] = f1;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &theta1 = state[0], &theta2 = state[1], &theta1_dot = state[2], &theta2_dot = state[3];
    const Real &r1 = par[2], &r2 = par[3], &k = par[4], &M = par[5], &k5 = par[11], &k6 = par[12];

    // Energy
    const Real z0 = r1 * theta1 - r2 * theta2;
    const Real T = k5 * theta1_dot * theta1_dot + k6 * theta2_dot * theta2_dot;
    const Real V = k * z0 * z0;
    const Real E = T + V;
    const Real P = M * theta1_dot;

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

constexpr const char* coordinate_names[] = { "theta1", "theta2", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "J1", "J2", "r1", "r2", "k", "M", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.2, 0.5, 0.1, 0.25, 2000, 1.5, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 6, 7, 0, 0, 0, "belt_drive", "lagrange, textbook form",
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

