// Equations of motion of 'cartesian_pendulum': routh, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        x [m], y [m], then their rates
//   rate[4]         d state / dt
//   par[9]          m = 2 [kg], l = 1 [m], g = 9.81 [m/s^2],
//                   then 6 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   outputs_at      out[1]: tension
//   constraints_at  position[1], velocity[1]; rows[2], A row by row
//   multipliers_at  lambda[1]
//   project         out[4], position[1], pivots[1]
//   cost            18 operations a right-hand side: 4 additions, 13 multiplications, 1 division, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "cartesian_pendulum.cpp"
//
//   int main() {
//       const double state[4] = {1, 0, 0, 0};
//       double par[9], rate[4];
//       for (int k = 0; k < 3; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m = par[0], &l = par[1], &g = par[2];

    // Constants
    const Real k0 = m * g;
    const Real k1 = l * l;
    const Real z0 = Real(1) / m;
    const Real k2 = Real(2) * z0;
    const Real k3 = z0 * k0;
    const Real k4 = Real(0.5) * m;
    const Real k5 = Real(0.5) * l;

    // Result
    par[3] = k0;
    par[4] = k1;
    par[5] = k2;
    par[6] = k3;
    par[7] = k4;
    par[8] = k5;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &k0 = par[3], &k2 = par[5], &k3 = par[6];

    // Mass matrix M(q), lower triangle
    // M00 = m, M10 = 0, M11 = m

    // Forcing f
    // f0 = 0, f1 = -k0

    // Solve M q'' = f + A^T lambda, A q'' = gamma
    const Real z0 = k2 * x;
    const Real z1 = k2 * y;
    const Real z2 = k0 * z1 - Real(2) * (x_dot * x_dot + y_dot * y_dot);
    const Real z3 = z2 / (x * z0 + y * z1);
    const Real x_ddot = Real(0.5) * z0 * z3;
    const Real y_ddot = Real(0.5) * z1 * z3 - k3;

    // Result
    rate[0] = x_dot;
    rate[1] = y_dot;
    rate[2] = x_ddot;
    rate[3] = y_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real*, const Real* par, Real* mass, Real* forcing) {
    const Real &m = par[0], &k0 = par[3];

    // Result
    mass[0] = m;
    mass[1] = mass[2] = Real(0);
    mass[3] = m;
    forcing[0] = Real(0);
    forcing[1] = -k0;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &k0 = par[3], &k4 = par[7];

    // Energy
    const Real T = k4 * (x_dot * x_dot + y_dot * y_dot);
    const Real V = k0 * y;
    const Real E = V + T;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = Real(0);
    jacobi[0] = E;
}

/// The scene's outputs.
template <typename Real>
void outputs_at(const Real&, const Real* state, const Real*, const Real* par, Real* out) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &k0 = par[3], &k2 = par[5], &k5 = par[8];

    // Outputs
    const Real z0 = k2 * y;
    const Real z1 = Real(1) / (x * k2 * x + y * z0);
    const Real z2 = (k0 * z0 - Real(2) * (x_dot * x_dot + y_dot * y_dot)) * z1;
    const Real tension = -Real(2) * k5 * z2;

    // Result
    out[0] = tension;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real* par, Real* position, Real* velocity, Real* rows) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &k1 = par[4];

    // Result
    position[0] = x * x - k1 + y * y;
    velocity[0] = Real(2) * (x * x_dot + y * y_dot);
    rows[0] = Real(2) * x;
    rows[1] = Real(2) * y;
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real* state, const Real* par, Real* lambda) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &k0 = par[3], &k2 = par[5];

    // Multipliers
    const Real z0 = k2 * y;
    const Real z1 = Real(1) / (x * k2 * x + y * z0);
    const Real z2 = (k0 * z0 - Real(2) * (x_dot * x_dot + y_dot * y_dot)) * z1;
    const Real lambda_rod = Real(0.5) * z2;

    // Result
    lambda[0] = lambda_rod;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &k1 = par[4], &k2 = par[5];

    // Projection
    const Real z0 = k1 - x * x - y * y;
    const Real z1 = k2 * x;
    const Real z2 = k2 * y;
    const Real z3 = x * z1 + y * z2;
    const Real z4 = Real(1) / z3;
    const Real z5 = z4 * z0;
    const Real z6 = x + Real(0.5) * z1 * z5;
    const Real z7 = y + Real(0.5) * z2 * z5;
    const Real z8 = z4 * (y_dot * z7 + x_dot * z6);

    // Result
    out[0] = z6;
    out[1] = z7;
    out[2] = x_dot - z1 * z8;
    out[3] = y_dot - z2 * z8;
    position[0] = -z0;
    pivots[0] = Real(2) * z3;
}

/// gamma of A q'' = gamma.
template <typename Real>
void gamma_at(const Real&, const Real* state, const Real*, Real* out) {
    const Real &x_dot = state[2], &y_dot = state[3];

    // Constraints
    const Real gamma0 = -Real(2) * (x_dot * x_dot + y_dot * y_dot);

    // Result
    out[0] = gamma0;
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
constexpr const char* parameter_names[] = { "m", "l", "g", nullptr};
constexpr const char* output_names[] = { "tension", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 2, 1, 9.81, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 3, 6, 1, 0, 1, "cartesian_pendulum", "routh, textbook form",
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
    [](double t, const double* state, const double* par, double* position, double* velocity, double* rows) {
        constraints_at(t, state, par, position, velocity, rows);
    },
    [](double t, const double* state, const double* par, double* lambda) { multipliers_at(t, state, par, lambda); },
};

}  // namespace

extern "C" __attribute__((visibility("default"))) const void* alembert_solver() { return &table; }

namespace {

struct alembert_projection_table {
    int abi;
    void (*project)(double t, const double* state, const double* par, double* moved, double* position,
                    double* pivots);
    void (*gamma_at)(double t, const double* state, const double* par, double* gamma);
};

constexpr alembert_projection_table projection{
    4,
    [](double t, const double* state, const double* par, double* moved, double* position, double* pivots) {
        project(t, state, par, moved, position, pivots);
    },
    [](double t, const double* state, const double* par, double* gamma) { gamma_at(t, state, par, gamma); },
};

}  // namespace

extern "C" __attribute__((visibility("default"))) const void* alembert_projection() { return &projection; }

