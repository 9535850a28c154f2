// Equations of motion of 'triatomic_molecule': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[6]        x1 [m], x2 [m], x3 [m], then their rates
//   rate[6]         d state / dt
//   par[10]         m = 1 [kg], M = 1.4 [kg], k = 10 [N/m], b = 1 [m],
//                   then 6 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[9], M row by row; forcing[3], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   cost            11 operations a right-hand side: 6 additions, 5 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "triatomic_molecule.cpp"
//
//   int main() {
//       const double state[6] = {-0.1, 1, 2, 0, 0, 0};
//       double par[10], rate[6];
//       for (int k = 0; k < 4; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m = par[0], &M = par[1], &k = par[2];

    // Constants
    const Real k0 = Real(2) * k;
    const Real k1 = k / m;
    const Real k2 = Real(1) / M;
    const Real k3 = Real(0.5) * m;
    const Real k4 = Real(0.5) * M;
    const Real k5 = Real(0.5) * k;

    // Result
    par[4] = k0;
    par[5] = k1;
    par[6] = k2;
    par[7] = k3;
    par[8] = k4;
    par[9] = k5;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &x1 = state[0], &x2 = state[1], &x3 = state[2], &x1_dot = state[3], &x2_dot = state[4];
    const Real &x3_dot = state[5];
    const Real &k = par[2], &b = par[3], &k0 = par[4], &k1 = par[5], &k2 = par[6];

    // Mass matrix M(q), lower triangle
    // M00 = m, M10 = 0, M11 = M, M20 = 0, M21 = 0, M22 = m

    // Forcing f
    const Real f1 = k * (x1 + x3) - k0 * x2;

    // Solve M q'' = f with M = L D L^T
    const Real x1_ddot = -k1 * (b + x1 - x2);
    const Real x2_ddot = k2 * f1;
    const Real x3_ddot = k1 * (b + x2 - x3);

    // Result
    rate[0] = x1_dot;
    rate[1] = x2_dot;
    rate[2] = x3_dot;
    rate[3] = x1_ddot;
    rate[4] = x2_ddot;
    rate[5] = x3_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &x1 = state[0], &x2 = state[1], &x3 = state[2];
    const Real &m = par[0], &M = par[1], &k = par[2], &b = par[3], &k0 = par[4];

    // Forcing f
    const Real f0 = -k * (b + x1 - x2);
    const Real f1 = k * (x1 + x3) - k0 * x2;
    const Real f2 = k * (b + x2 - x3);

    // Result
    mass[0] = m;
    mass[1] = mass[3] = Real(0);
    mass[4] = M;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = m;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = f2;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &x1 = state[0], &x2 = state[1], &x3 = state[2], &x1_dot = state[3], &x2_dot = state[4];
    const Real &x3_dot = state[5];
    const Real &b = par[3], &k3 = par[7], &k4 = par[8], &k5 = par[9];

    // Energy
    const Real z0 = b + x1 - x2;
    const Real z1 = b + x2 - x3;
    const Real T = k3 * (x1_dot * x1_dot + x3_dot * x3_dot) + k4 * x2_dot * x2_dot;
    const Real V = k5 * (z1 * z1 + z0 * z0);
    const Real E = T + V;

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

constexpr const char* coordinate_names[] = { "x1", "x2", "x3", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "M", "k", "b", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 1.4, 10, 1, 0};

constexpr alembert_solver_table table{
    4, 3, 3, 4, 6, 0, 0, 0, "triatomic_molecule", "lagrange, textbook form",
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

