// Equations of motion of 'magnetic_field': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[6]        x [m], y [m], z [m], then their rates
//   rate[6]         d state / dt
//   par[9]          m = 1 [kg], q = 1 [C], B = 2 [T], E = 0.6 [V/m],
//                   then 5 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[9], M row by row; forcing[3], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   outputs_at      out[1]: speed
//   cost            4 operations a right-hand side: 1 addition, 3 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "magnetic_field.cpp"
//
//   int main() {
//       const double state[6] = {0.3, -0.2, 0, 0, 0.8, 0.1};
//       double par[9], rate[6];
//       for (int k = 0; k < 4; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

inline double sqrt(double x) { return __builtin_sqrt(x); }

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m = par[0], &q = par[1], &B = par[2], &E = par[3];

    // Constants
    const Real k0 = q * E;
    const Real k1 = q * B;
    const Real k2 = Real(1) / m;
    const Real k3 = k2 * k1;
    const Real k4 = Real(0.5) * m;

    // Result
    par[4] = k0;
    par[5] = k1;
    par[6] = k2;
    par[7] = k3;
    par[8] = k4;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &x_dot = state[3], &y_dot = state[4], &z_dot = state[5];
    const Real &k0 = par[4], &k1 = par[5], &k2 = par[6], &k3 = par[7];

    // Mass matrix M(q), lower triangle
    // M00 = m, M10 = 0, M11 = m, M20 = 0, M21 = 0, M22 = m

    // Forcing f
    // f2 = 0
    const Real f0 = k0 + k1 * y_dot;

    // Solve M q'' = f with M = L D L^T
    const Real x_ddot = k2 * f0;
    const Real y_ddot = -k3 * x_dot;

    // Result
    rate[0] = x_dot;
    rate[1] = y_dot;
    rate[2] = z_dot;
    rate[3] = x_ddot;
    rate[4] = y_ddot;
    rate[5] = Real(0);
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &x_dot = state[3], &y_dot = state[4];
    const Real &m = par[0], &k0 = par[4], &k1 = par[5];

    // Forcing f
    const Real f0 = k0 + k1 * y_dot;
    const Real f1 = -k1 * x_dot;

    // Result
    mass[0] = m;
    mass[1] = mass[3] = Real(0);
    mass[4] = m;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = m;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = Real(0);
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &x = state[0], &x_dot = state[3], &y_dot = state[4], &z_dot = state[5];
    const Real &k0 = par[4], &k4 = par[8];

    // Energy
    const Real T = k4 * (x_dot * x_dot + y_dot * y_dot + z_dot * z_dot);
    const Real z0 = k0 * x;
    const Real V = -z0;
    const Real E_ = T - z0;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E_;
    energy[3] = Real(0);
    jacobi[0] = E_;
}

/// The scene's outputs.
template <typename Real>
void outputs_at(const Real&, const Real* state, const Real*, const Real*, Real* out) {
    const Real &x_dot = state[3], &y_dot = state[4], &z_dot = state[5];

    // Outputs
    const Real speed = sqrt(x_dot * x_dot + y_dot * y_dot + z_dot * z_dot);

    // Result
    out[0] = speed;
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

constexpr const char* coordinate_names[] = { "x", "y", "z", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "q", "B", "E", nullptr};
constexpr const char* output_names[] = { "speed", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 1, 2, 0.6, 0};

constexpr alembert_solver_table table{
    4, 3, 3, 4, 5, 1, 0, 0, "magnetic_field", "lagrange, textbook form",
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

