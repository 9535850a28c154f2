// Equations of motion of 'double_atwood': lagrange, intermediate symbols.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        x [m], y [m], then their rates
//   rate[4]         d state / dt
//   par[14]         m1 = 2 [kg], m2 = 1.1 [kg], m3 = 0.9 [kg], g = 9.81 [m/s^2],
//                   then 10 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   cost            0 operations a right-hand side: 0 additions, 0 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "double_atwood.cpp"
//
//   int main() {
//       const double state[4] = {0, 0, 0, 0};
//       double par[14], rate[4];
//       for (int k = 0; k < 4; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m1 = par[0], &m2 = par[1], &m3 = par[2], &g = par[3];

    // Constants
    const Real M00 = m1 + m2 + m3;
    const Real k0 = m2 - m3;
    const Real M11 = m2 + m3;
    const Real k1 = m1 * g;
    const Real k2 = m2 * g;
    const Real k3 = m3 * g;
    const Real f0 = k1 - k2 - k3;
    const Real f1 = k2 - k3;
    const Real z0 = Real(1) / M11;
    const Real z1 = k0 * z0;
    const Real z2 = Real(1) / (M00 - k0 * z1);
    const Real k4 = z2 * (f0 + f1 * z1);
    const Real k5 = k4 * z1 + z0 * f1;

    // Result
    par[4] = M00;
    par[5] = k0;
    par[6] = M11;
    par[7] = k1;
    par[8] = k2;
    par[9] = k3;
    par[10] = f0;
    par[11] = f1;
    par[12] = k4;
    par[13] = k5;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &x_dot = state[2], &y_dot = state[3];
    const Real &k4 = par[12], &k5 = par[13];

    // Mass matrix M(q), lower triangle
    // M10 = -k0

    // Result
    rate[0] = x_dot;
    rate[1] = y_dot;
    rate[2] = k4;
    rate[3] = k5;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real*, const Real* par, Real* mass, Real* forcing) {
    const Real &M00 = par[4], &k0 = par[5], &M11 = par[6], &f0 = par[10], &f1 = par[11];

    // Result
    mass[0] = M00;
    mass[1] = mass[2] = -k0;
    mass[3] = M11;
    forcing[0] = f0;
    forcing[1] = f1;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &M00 = par[4], &k0 = par[5], &M11 = par[6], &k1 = par[7], &k2 = par[8], &k3 = par[9];

    // Energy
    const Real T = Real(0.5) * M00 * x_dot * x_dot - k0 * x_dot * y_dot + Real(0.5) * M11 * y_dot * y_dot;
    const Real z0 = k2 * (x - y);
    const Real z1 = k1 * x - z0 - k3 * (x + y);
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

constexpr const char* coordinate_names[] = { "x", "y", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m1", "m2", "m3", "g", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 2, 1.1, 0.9, 9.81, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 4, 10, 0, 0, 0, "double_atwood", "lagrange, intermediate symbols",
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

