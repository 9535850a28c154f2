// Equations of motion of 'shortened_pendulum': routh, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        x [m], y [m], then their rates
//   rate[4]         d state / dt
//   par[9]          m = 1 [kg], l0 = 1.5 [m], v = 0.2 [m/s], g = 9.81 [m/s^2],
//                   then 5 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   constraints_at  position[1], velocity[1]; rows[2], A row by row
//   multipliers_at  lambda[1]
//   project         out[4], position[1], pivots[1]
//   cost            19 operations a right-hand side: 5 additions, 13 multiplications, 1 division, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "shortened_pendulum.cpp"
//
//   int main() {
//       const double state[4] = {0.8999999999999999, -1.2000000000000002, -0.12, 0.16};
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
    const Real &m = par[0], &v = par[2], &g = par[3];

    // Constants
    const Real k0 = m * g;
    const Real k1 = Real(2) * v * v;
    const Real z0 = Real(1) / m;
    const Real k2 = Real(2) * z0;
    const Real k3 = z0 * k0;
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
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &k0 = par[4], &k1 = par[5], &k2 = par[6], &k3 = par[7];

    // Mass matrix M(q), lower triangle
    // M00 = m, M10 = 0, M11 = m

    // Forcing f
    // f0 = 0, f1 = -k0

    // Constraints A q'' = gamma
    const Real gamma0 = k1 - Real(2) * (x_dot * x_dot + y_dot * y_dot);

    // Solve M q'' = f + A^T lambda, A q'' = gamma
    const Real z0 = k2 * x;
    const Real z1 = k2 * y;
    const Real z2 = Real(1) / (x * z0 + y * z1);
    const Real z3 = z2 * (k0 * z1 + gamma0);
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
    const Real &m = par[0], &k0 = par[4];

    // Result
    mass[0] = m;
    mass[1] = mass[2] = Real(0);
    mass[3] = m;
    forcing[0] = Real(0);
    forcing[1] = -k0;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real& t, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &l0 = par[1], &v = par[2], &k0 = par[4], &k1 = par[5], &k2 = par[6], &k4 = par[8];

    // Energy
    const Real z0 = x_dot * x_dot + y_dot * y_dot;
    const Real z1 = k2 * y;
    const Real z2 = Real(1) / (x * k2 * x + y * z1);
    const Real z3 = z2 * (k0 * z1 + (k1 - Real(2) * z0));
    const Real T = k4 * z0;
    const Real V = k0 * y;
    const Real E = V + T;
    const Real P = -z3 * v * (l0 - v * t);

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = P;
    jacobi[0] = E;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real& t, const Real* state, const Real* par, Real* position, Real* velocity, Real* rows) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &l0 = par[1], &v = par[2];

    // Constraints
    const Real z0 = l0 - v * t;

    // Result
    position[0] = x * x - z0 * z0 + y * y;
    velocity[0] = Real(2) * (v * z0 + x * x_dot + y * y_dot);
    rows[0] = Real(2) * x;
    rows[1] = Real(2) * y;
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real* state, const Real* par, Real* lambda) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &k0 = par[4], &k1 = par[5], &k2 = par[6];

    // Multipliers
    const Real z0 = k2 * y;
    const Real z1 = Real(1) / (x * k2 * x + y * z0);
    const Real z2 = k0 * z0 + (k1 - Real(2) * (x_dot * x_dot + y_dot * y_dot));
    const Real lambda_string = Real(0.5) * z1 * z2;

    // Result
    lambda[0] = lambda_string;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real& t, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &x = state[0], &y = state[1], &x_dot = state[2], &y_dot = state[3];
    const Real &l0 = par[1], &v = par[2], &k2 = par[6];

    // Projection
    const Real z0 = l0 - v * t;
    const Real z1 = z0 * z0 - x * x - y * y;
    const Real z2 = k2 * x;
    const Real z3 = k2 * y;
    const Real z4 = x * z2 + y * z3;
    const Real z5 = Real(1) / z4;
    const Real z6 = z5 * z1;
    const Real z7 = x + Real(0.5) * z2 * z6;
    const Real z8 = y + Real(0.5) * z3 * z6;
    const Real z9 = x_dot * z7 + y_dot * z8 + v * z0;
    const Real z10 = z5 * z9;

    // Result
    out[0] = z7;
    out[1] = z8;
    out[2] = x_dot - z2 * z10;
    out[3] = y_dot - z3 * z10;
    position[0] = -z1;
    pivots[0] = Real(2) * z4;
}

/// gamma of A q'' = gamma.
template <typename Real>
void gamma_at(const Real&, const Real* state, const Real* par, Real* out) {
    const Real &x_dot = state[2], &y_dot = state[3];
    const Real &k1 = par[5];

    // Constraints
    const Real gamma0 = k1 - Real(2) * (x_dot * x_dot + y_dot * y_dot);

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
constexpr const char* parameter_names[] = { "m", "l0", "v", "g", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 1.5, 0.2, 9.81, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 4, 5, 0, 0, 1, "shortened_pendulum", "routh, textbook form",
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

