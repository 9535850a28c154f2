// Equations of motion of 'turntable_particle': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        x [m], y [m], then their rates
//   rate[4]         d state / dt
//   par[9]          m = 0.4 [kg], k = 5 [N/m], w = 1.5 [rad/s], e = 0.3 [rad/s^2],
//                   then 5 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   cost            18 operations a right-hand side: 6 additions, 12 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "turntable_particle.cpp"
//
//   int main() {
//       const double state[4] = {0.2, -0.1, 0.1, 0.3};
//       double par[9], rate[4];
//       for (int k = 0; k < 4; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m = par[0], &k = par[1], &e = par[3];

    // Constants
    const Real k0 = m * e;
    const Real k1 = Real(2) * m;
    const Real k2 = Real(1) / m;
    const Real k3 = Real(0.5) * m;
    const Real k4 = Real(0.5) * k;

    // Result
    par[4] = k0;
    par[5] = k1;
    par[6] = k2;
    par[7] = k3;
    par[8] = k4;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real& t, const Real* state, const Real* par, Real* rate) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &m = par[0], &k = par[1], &w = par[2], &e = par[3], &k0 = par[4], &k1 = par[5], &k2 = par[6];

    // Mass matrix M(q), lower triangle
    // M00 = m, M10 = 0, M11 = m

    // Forcing f
    const Real z0 = w + e * t;
    const Real z1 = k1 * z0;
    const Real z2 = k - m * z0 * z0;
    const Real f0 = (k0 * y + y_dot * z1) - x * z2;
    const Real f1 = -(k0 * x + x_dot * z1) - y * z2;

    // Solve M q'' = f with M = L D L^T
    const Real x_ddot = k2 * f0;
    const Real y_ddot = k2 * f1;

    // Result
    rate[0] = x_dot;
    rate[1] = y_dot;
    rate[2] = x_ddot;
    rate[3] = y_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real& t, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &m = par[0], &k = par[1], &w = par[2], &e = par[3], &k0 = par[4], &k1 = par[5];

    // Forcing f
    const Real z0 = w + e * t;
    const Real z1 = k1 * z0;
    const Real z2 = k - m * z0 * z0;
    const Real f0 = (k0 * y + y_dot * z1) - x * z2;
    const Real z3 = (k0 * x + x_dot * z1) + y * z2;
    const Real f1 = -z3;

    // Result
    mass[0] = m;
    mass[1] = mass[2] = Real(0);
    mass[3] = m;
    forcing[0] = f0;
    forcing[1] = f1;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real& t, const Real* state, const Real* rate, const Real* par, Real* energy, Real* jacobi) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &x_ddot = rate[2], &y_ddot = rate[3];
    const Real &m = par[0], &w = par[2], &e = par[3], &k0 = par[4], &k1 = par[5], &k3 = par[7], &k4 = par[8];

    // Energy
    const Real z0 = w + e * t;
    const Real z1 = k3 * (x_dot * x_dot + y_dot * y_dot);
    const Real z2 = x * x + y * y;
    const Real z3 = k3 * z0 * z0 * z2;
    const Real z4 = m * z0 * (x * y_dot - y * x_dot);
    const Real T = z1 + z3 + z4;
    const Real V = k4 * z2;
    const Real E = T + V;
    const Real z5 = m * (x * y_ddot - y * x_ddot);
    const Real z6 = k1 * z0 * (x * x_dot + y * y_dot);
    const Real P = (z5 + (k0 * z2 + z6)) * z0;
    const Real h = z1 - z3 + V;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = P;
    jacobi[0] = h;
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
constexpr const char* parameter_names[] = { "m", "k", "w", "e", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.4, 5, 1.5, 0.3, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 4, 5, 0, 0, 0, "turntable_particle", "lagrange, textbook form",
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

