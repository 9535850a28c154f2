// Equations of motion of 'sphere_on_sphere': routh, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[6]        x [m], y [m], psi [rad], then their rates
//   rate[6]         d state / dt
//   par[16]         m = 0.3 [kg], R = 1 [m], r = 0.2 [m], g = 9.81 [m/s^2],
//                   then 12 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[9], M row by row; forcing[3], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   constraints_at  position[2], velocity[2]; rows[6], A row by row
//   multipliers_at  lambda[2]
//   project         out[6], position[2], pivots[2]
//   cost            46 operations a right-hand side: 12 additions, 32 multiplications, 2 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "sphere_on_sphere.cpp"
//
//   int main() {
//       const double state[6] = {0.72, 0.96, 0, 0, 0, 0};
//       double par[16], rate[6];
//       for (int k = 0; k < 4; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m = par[0], &R = par[1], &r = par[2], &g = par[3];

    // Constants
    const Real z0 = m * r * r;
    const Real M22 = Real(0.4) * z0;
    const Real k0 = m * g;
    const Real z1 = R + r;
    const Real k1 = z1 * z1;
    const Real k2 = Real(1) / z1;
    const Real k3 = Real(1) / m;
    const Real k4 = Real(2) * k3;
    const Real z2 = r / z0;
    const Real k5 = Real(2.5) * r * z2;
    const Real k6 = k3 * k0;
    const Real k7 = Real(2.5) * z2;
    const Real k8 = Real(5) * z2;
    const Real k9 = Real(0.2) * z0;
    const Real k10 = Real(0.5) * m;

    // Result
    par[4] = M22;
    par[5] = k0;
    par[6] = k1;
    par[7] = k2;
    par[8] = k3;
    par[9] = k4;
    par[10] = k5;
    par[11] = k6;
    par[12] = k7;
    par[13] = k8;
    par[14] = k9;
    par[15] = k10;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &x = state[0], &y = state[1], &x_dot = state[3], &y_dot = state[4], &psi_dot = state[5];
    const Real &k0 = par[5], &k2 = par[7], &k3 = par[8], &k4 = par[9], &k5 = par[10], &k6 = par[11];
    const Real &k7 = par[12];

    // Mass matrix M(q), lower triangle
    // M00 = m, M10 = 0, M11 = m, M20 = 0, M21 = 0

    // Forcing f
    // f0 = 0, f1 = -k0, f2 = 0

    // Constraints A q'' = gamma
    const Real A1_0 = k2 * y;

    // Solve M q'' = f + A^T lambda, A q'' = gamma
    const Real z0 = k2 * x;
    const Real z1 = k4 * x;
    const Real z2 = k4 * y;
    const Real z3 = k0 * z2 - Real(2) * (x_dot * x_dot + y_dot * y_dot);
    const Real z4 = k3 * z0;
    const Real z5 = k0 * z4;
    const Real z6 = k3 * A1_0;
    const Real z7 = x * z6 - y * z4;
    const Real z8 = Real(1) / (z6 * A1_0 + (k5 + z4 * z0));
    const Real z9 = z7 * z8;
    const Real z10 = Real(2) * (x * z1 + y * z2) - Real(4) * z7 * z9;
    const Real z11 = (z3 + Real(2) * z5 * z9) / z10;
    const Real z12 = z5 * z8 + Real(2) * z9 * z11;
    const Real x_ddot = z1 * z11 - z6 * z12;
    const Real y_ddot = z2 * z11 - k6 + z4 * z12;
    const Real psi_ddot = k7 * z12;

    // Result
    rate[0] = x_dot;
    rate[1] = y_dot;
    rate[2] = psi_dot;
    rate[3] = x_ddot;
    rate[4] = y_ddot;
    rate[5] = psi_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real*, const Real* par, Real* mass, Real* forcing) {
    const Real &m = par[0], &M22 = par[4], &k0 = par[5];

    // Result
    mass[0] = m;
    mass[1] = mass[3] = Real(0);
    mass[4] = m;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = M22;
    forcing[0] = Real(0);
    forcing[1] = -k0;
    forcing[2] = Real(0);
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &y = state[1], &x_dot = state[3], &y_dot = state[4], &psi_dot = state[5];
    const Real &k0 = par[5], &k9 = par[14], &k10 = par[15];

    // Energy
    const Real T = k9 * psi_dot * psi_dot + k10 * (x_dot * x_dot + y_dot * y_dot);
    const Real V = k0 * y;
    const Real E = V + T;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = Real(0);
    jacobi[0] = E;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real* par, Real* position, Real* velocity, Real* rows) {
    const Real &x = state[0], &y = state[1], &x_dot = state[3], &y_dot = state[4], &psi_dot = state[5];
    const Real &r = par[2], &k1 = par[6], &k2 = par[7];

    // Constraints
    const Real z0 = k2 * y;
    const Real z1 = k2 * x;

    // Result
    position[0] = x * x - k1 + y * y;
    position[1] = Real(0);
    velocity[0] = Real(2) * (x * x_dot + y * y_dot);
    velocity[1] = x_dot * z0 - y_dot * z1 - r * psi_dot;
    rows[0] = Real(2) * x;
    rows[1] = Real(2) * y;
    rows[2] = Real(0);
    rows[3] = z0;
    rows[4] = -z1;
    rows[5] = -r;
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real* state, const Real* par, Real* lambda) {
    const Real &x = state[0], &y = state[1], &x_dot = state[3], &y_dot = state[4];
    const Real &k0 = par[5], &k2 = par[7], &k3 = par[8], &k4 = par[9], &k5 = par[10];

    // Multipliers
    const Real z0 = k2 * y;
    const Real z1 = k2 * x;
    const Real z2 = k4 * y;
    const Real z3 = k0 * z2 - Real(2) * (x_dot * x_dot + y_dot * y_dot);
    const Real z4 = k3 * z1;
    const Real z5 = k0 * z4;
    const Real z6 = k3 * z0;
    const Real z7 = x * z6 - y * z4;
    const Real z8 = Real(1) / (z6 * z0 + (k5 + z4 * z1));
    const Real z9 = z7 * z8;
    const Real z10 = x * k4 * x + y * z2;
    const Real z11 = Real(1) / (Real(2) * z10 - Real(4) * z7 * z9);
    const Real lambda_contact = (z3 + Real(2) * z5 * z9) * z11;
    const Real F = -z5 * z8 - Real(2) * z9 * lambda_contact;

    // Result
    lambda[0] = lambda_contact;
    lambda[1] = F;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &x = state[0], &y = state[1], &psi = state[2], &x_dot = state[3], &y_dot = state[4];
    const Real &psi_dot = state[5];
    const Real &r = par[2], &k1 = par[6], &k2 = par[7], &k3 = par[8], &k4 = par[9], &k5 = par[10], &k7 = par[12];
    const Real &k8 = par[13];

    // Projection
    const Real z0 = k1 - x * x - y * y;
    const Real z1 = k2 * y;
    const Real z2 = k2 * x;
    const Real z3 = k4 * x;
    const Real z4 = k4 * y;
    const Real z5 = k3 * z2;
    const Real z6 = k3 * z1;
    const Real z7 = x * z6 - y * z5;
    const Real z8 = z6 * z1 + (k5 + z5 * z2);
    const Real z9 = Real(1) / z8;
    const Real z10 = z7 * z9;
    const Real z11 = Real(2) * (x * z3 + y * z4) - Real(4) * z7 * z10;
    const Real z12 = Real(1) / z11;
    const Real z13 = z12 * z0;
    const Real z14 = z10 * z13;
    const Real z15 = x + (z3 * z13 - Real(2) * z6 * z14);
    const Real z16 = y + (z4 * z13 + Real(2) * z5 * z14);
    const Real z17 = y_dot * k2 * z15;
    const Real z18 = z17 - x_dot * k2 * z16 + r * psi_dot;
    const Real z19 = (x_dot * z15 + y_dot * z16) + z10 * z18;
    const Real z20 = z12 * z19;
    const Real z21 = z9 * z18 + Real(4) * z10 * z20;

    // Result
    out[0] = z15;
    out[1] = z16;
    out[2] = psi + k8 * z14;
    out[3] = x_dot - (Real(2) * z3 * z20 - z6 * z21);
    out[4] = y_dot - (Real(2) * z4 * z20 + z5 * z21);
    out[5] = psi_dot - k7 * z21;
    position[0] = -z0;
    position[1] = Real(0);
    pivots[0] = z11;
    pivots[1] = z8;
}

/// gamma of A q'' = gamma.
template <typename Real>
void gamma_at(const Real&, const Real* state, const Real*, Real* out) {
    const Real &x_dot = state[3], &y_dot = state[4];

    // Constraints
    const Real gamma0 = -Real(2) * (x_dot * x_dot + y_dot * y_dot);

    // Result
    out[0] = gamma0;
    out[1] = Real(0);
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

constexpr const char* coordinate_names[] = { "x", "y", "psi", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "R", "r", "g", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.3, 1, 0.2, 9.81, 0};

constexpr alembert_solver_table table{
    4, 3, 3, 4, 12, 0, 0, 2, "sphere_on_sphere", "routh, textbook form",
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

