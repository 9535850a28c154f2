// Equations of motion of 'beam_two_modes': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        q1 [m], q2 [m], then their rates
//   rate[4]         d state / dt
//   par[18]         rho = 2 [kg/m], L = 1.5 [m], EI = 30 [N*m^2], M = 0.5 [kg], P = 1 [N],
//                   then 13 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   cost            14 operations a right-hand side: 6 additions, 8 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "beam_two_modes.cpp"
//
//   int main() {
//       const double state[4] = {0.1, 0, 0, 0};
//       double par[18], rate[4];
//       for (int k = 0; k < 5; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &rho = par[0], &L = par[1], &EI_ = par[2], &M = par[3];

    // Constants
    const Real z0 = rho * L;
    const Real M00 = M + Real(0.2) * z0;
    const Real M10 = M + (Real(1) / Real(6)) * z0;
    const Real M11 = M + (Real(1) / Real(7)) * z0;
    const Real z1 = Real(1) / L;
    const Real z2 = EI_ * z1 * z1 * z1;
    const Real k0 = Real(6) * z2;
    const Real k1 = Real(4) * z2;
    const Real k2 = Real(12) * z2;
    const Real k3 = Real(1) / M11;
    const Real k4 = M10 * k3;
    const Real k5 = Real(1) / (M00 - M10 * k4);
    const Real k6 = (Real(1) / Real(14)) * (Real(7) * M + z0);
    const Real k7 = Real(0.1) * (Real(5) * M + z0);
    const Real k8 = (Real(1) / Real(6)) * (Real(6) * M + z0);
    const Real k9 = Real(2) * z2;

    // Result
    par[5] = M00;
    par[6] = M10;
    par[7] = M11;
    par[8] = k0;
    par[9] = k1;
    par[10] = k2;
    par[11] = k3;
    par[12] = k4;
    par[13] = k5;
    par[14] = k6;
    par[15] = k7;
    par[16] = k8;
    par[17] = k9;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &q1 = state[0], &q2 = state[1], &q1_dot = state[2], &q2_dot = state[3];
    const Real &P = par[4], &k0 = par[8], &k1 = par[9], &k2 = par[10], &k3 = par[11], &k4 = par[12];
    const Real &k5 = par[13];

    // Forcing f
    const Real f0 = P - k0 * q2 - k1 * q1;
    const Real f1 = P - k0 * q1 - k2 * q2;

    // Solve M q'' = f with M = L D L^T
    const Real z0 = k5 * (k4 * f1 - f0);
    const Real q1_ddot = -z0;
    const Real q2_ddot = k3 * f1 + k4 * z0;

    // Result
    rate[0] = q1_dot;
    rate[1] = q2_dot;
    rate[2] = q1_ddot;
    rate[3] = q2_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &q1 = state[0], &q2 = state[1];
    const Real &P = par[4], &M00 = par[5], &M10 = par[6], &M11 = par[7], &k0 = par[8], &k1 = par[9];
    const Real &k2 = par[10];

    // Forcing f
    const Real f0 = P - k0 * q2 - k1 * q1;
    const Real f1 = P - k0 * q1 - k2 * q2;

    // Result
    mass[0] = M00;
    mass[1] = mass[2] = M10;
    mass[3] = M11;
    forcing[0] = f0;
    forcing[1] = f1;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &q1 = state[0], &q2 = state[1], &q1_dot = state[2], &q2_dot = state[3];
    const Real &P = par[4], &k0 = par[8], &k6 = par[14], &k7 = par[15], &k8 = par[16], &k9 = par[17];

    // Energy
    const Real T = k6 * q2_dot * q2_dot + k7 * q1_dot * q1_dot + k8 * q1_dot * q2_dot;
    const Real V = k9 * q1 * q1 + k0 * q2 * q2 + k0 * q1 * q2;
    const Real E = T + V;
    const Real P_ = P * (q1_dot + q2_dot);

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = P_;
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

constexpr const char* coordinate_names[] = { "q1", "q2", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "rho", "L", "EI", "M", "P", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 2, 1.5, 30, 0.5, 1, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 5, 13, 0, 0, 0, "beam_two_modes", "lagrange, textbook form",
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

