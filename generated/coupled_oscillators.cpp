// Equations of motion of 'coupled_oscillators': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        x1 [m], x2 [m], then their rates
//   rate[4]         d state / dt
//   par[18]         m1 = 1 [kg], m2 = 0.5 [kg], k1 = 20 [N/m], k2 = 5 [N/m], k3 = 15 [N/m], c1 = 0.05 [N s/m],
//                   c2 = 0.1 [N s/m], then 11 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   outputs_at      out[1]: loss
//   cost            15 operations a right-hand side: 6 additions, 9 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "coupled_oscillators.cpp"
//
//   int main() {
//       const double state[4] = {0.2, -0.1, 0, 0.5};
//       double par[18], rate[4];
//       for (int k = 0; k < 7; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m1 = par[0], &m2 = par[1], &k1 = par[2], &k2 = par[3], &k3 = par[4], &c1 = par[5], &c2 = par[6];

    // Constants
    const Real k0 = k1 + k2;
    const Real k4 = c1 + c2;
    const Real k5 = k2 + k3;
    const Real k6 = Real(1) / m1;
    const Real k7 = Real(1) / m2;
    const Real k8 = Real(0.5) * m1;
    const Real k9 = Real(0.5) * m2;
    const Real k10 = Real(0.5) * k1;
    const Real k11 = Real(0.5) * k2;
    const Real k12 = Real(0.5) * k3;
    const Real k13 = Real(2) * c2;

    // Result
    par[7] = k0;
    par[8] = k4;
    par[9] = k5;
    par[10] = k6;
    par[11] = k7;
    par[12] = k8;
    par[13] = k9;
    par[14] = k10;
    par[15] = k11;
    par[16] = k12;
    par[17] = k13;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &x1 = state[0], &x2 = state[1], &x1_dot = state[2], &x2_dot = state[3];
    const Real &k2 = par[3], &c2 = par[6], &k0 = par[7], &k4 = par[8], &k5 = par[9], &k6 = par[10], &k7 = par[11];

    // Mass matrix M(q), lower triangle
    // M00 = m1, M10 = 0, M11 = m2

    // Forcing f
    const Real z0 = k0 * x1;
    const Real f0 = k2 * x2 - z0 - k4 * x1_dot + c2 * x2_dot;
    const Real z1 = c2 * (x1_dot - x2_dot);
    const Real f1 = k2 * x1 - k5 * x2 + z1;

    // Solve M q'' = f with M = L D L^T
    const Real x1_ddot = k6 * f0;
    const Real x2_ddot = k7 * f1;

    // Result
    rate[0] = x1_dot;
    rate[1] = x2_dot;
    rate[2] = x1_ddot;
    rate[3] = x2_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &x1 = state[0], &x2 = state[1], &x1_dot = state[2], &x2_dot = state[3];
    const Real &m1 = par[0], &m2 = par[1], &k2 = par[3], &c2 = par[6], &k0 = par[7], &k4 = par[8], &k5 = par[9];

    // Forcing f
    const Real z0 = k0 * x1;
    const Real z1 = z0 - k2 * x2 + k4 * x1_dot - c2 * x2_dot;
    const Real f0 = -z1;
    const Real z2 = c2 * (x1_dot - x2_dot);
    const Real f1 = k2 * x1 - k5 * x2 + z2;

    // Result
    mass[0] = m1;
    mass[1] = mass[2] = Real(0);
    mass[3] = m2;
    forcing[0] = f0;
    forcing[1] = f1;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &x1 = state[0], &x2 = state[1], &x1_dot = state[2], &x2_dot = state[3];
    const Real &c2 = par[6], &k4 = par[8], &k8 = par[12], &k9 = par[13], &k10 = par[14], &k11 = par[15];
    const Real &k12 = par[16], &k13 = par[17];

    // Energy
    const Real T = k8 * x1_dot * x1_dot + k9 * x2_dot * x2_dot;
    const Real z0 = x1 - x2;
    const Real V = k10 * x1 * x1 + k11 * z0 * z0 + k12 * x2 * x2;
    const Real E = T + V;
    const Real z1 = k4 * x1_dot * x1_dot + c2 * x2_dot * x2_dot - k13 * x1_dot * x2_dot;
    const Real P = -z1;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = P;
    jacobi[0] = E;
}

/// The scene's outputs.
template <typename Real>
void outputs_at(const Real&, const Real* state, const Real*, const Real* par, Real* out) {
    const Real &x1_dot = state[2], &x2_dot = state[3];
    const Real &c1 = par[5], &c2 = par[6];

    // Outputs
    const Real z0 = x1_dot - x2_dot;
    const Real loss = c1 * x1_dot * x1_dot + c2 * z0 * z0;

    // Result
    out[0] = loss;
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

constexpr const char* coordinate_names[] = { "x1", "x2", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m1", "m2", "k1", "k2", "k3", "c1", "c2", nullptr};
constexpr const char* output_names[] = { "loss", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 0.5, 20, 5, 15, 0.05, 0.1, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 7, 11, 1, 0, 0, "coupled_oscillators", "lagrange, textbook form",
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

}  // namespace

extern "C" __attribute__((visibility("default"))) const void* alembert_solver() { return &table; }

