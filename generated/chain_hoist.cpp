// Equations of motion of 'chain_hoist': routh, intermediate symbols.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[4]        theta [rad], y [m], then their rates
//   rate[4]         d state / dt
//   par[17]         M = 40 [kg], J = 0.05 [kg*m^2], R = 0.15 [m], r = 0.12 [m], P = 45 [N], g = 9.81 [m/s^2],
//                   then 11 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[4], M row by row; forcing[2], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   constraints_at  position[1], velocity[1]; rows[2], A row by row
//   multipliers_at  lambda[1]
//   project         out[4], position[1], pivots[1]
//   cost            0 operations a right-hand side: 0 additions, 0 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "chain_hoist.cpp"
//
//   int main() {
//       const double state[4] = {0, 0, 0, 0};
//       double par[17], rate[4];
//       for (int k = 0; k < 6; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &M = par[0], &J = par[1], &R = par[2], &r = par[3], &P = par[4], &g = par[5];

    // Constants
    const Real f0 = R * P;
    const Real k0 = M * g;
    const Real z0 = R - r;
    const Real k1 = -Real(0.5) * z0;
    const Real k2 = Real(0.5) * z0;
    const Real k3 = Real(1) / M;
    const Real z1 = Real(1) / J;
    const Real z2 = z1 * z0;
    const Real k4 = k3 + Real(0.25) * z2 * z0;
    const Real k5 = Real(1) / k4;
    const Real z3 = k3 * k0;
    const Real k6 = k5 * (z3 + Real(0.5) * z2 * f0);
    const Real k7 = Real(0.5) * k6 * z2 - z1 * f0;
    const Real k8 = z3 - k3 * k6;
    const Real k9 = Real(0.5) * z2;

    // Result
    par[6] = f0;
    par[7] = k0;
    par[8] = k1;
    par[9] = k2;
    par[10] = k3;
    par[11] = k4;
    par[12] = k5;
    par[13] = k6;
    par[14] = k7;
    par[15] = k8;
    par[16] = k9;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &theta_dot = state[2], &y_dot = state[3];
    const Real &k7 = par[14], &k8 = par[15];

    // Mass matrix M(q), lower triangle
    // M00 = J, M10 = 0, M11 = M

    // Forcing f
    // f1 = -k0

    // Result
    rate[0] = theta_dot;
    rate[1] = y_dot;
    rate[2] = -k7;
    rate[3] = -k8;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real*, const Real* par, Real* mass, Real* forcing) {
    const Real &M = par[0], &J = par[1], &f0 = par[6], &k0 = par[7];

    // Result
    mass[0] = J;
    mass[1] = mass[2] = Real(0);
    mass[3] = M;
    forcing[0] = f0;
    forcing[1] = -k0;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &y = state[1], &theta_dot = state[2], &y_dot = state[3];
    const Real &M = par[0], &J = par[1], &f0 = par[6], &k0 = par[7];

    // Energy
    const Real z0 = M * y_dot * y_dot + J * theta_dot * theta_dot;
    const Real T = Real(0.5) * z0;
    const Real V = k0 * y;
    const Real E = V + Real(0.5) * z0;
    const Real P_ = f0 * theta_dot;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = P_;
    jacobi[0] = E;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real* par, Real* position, Real* velocity, Real* rows) {
    const Real &theta = state[0], &y = state[1], &theta_dot = state[2], &y_dot = state[3];
    const Real &k1 = par[8], &k2 = par[9];

    // Result
    position[0] = y - k2 * theta;
    velocity[0] = y_dot - k2 * theta_dot;
    rows[0] = k1;
    rows[1] = Real(1);
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real*, const Real* par, Real* lambda) {
    const Real &k6 = par[13];

    // Result
    lambda[0] = k6;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &theta = state[0], &y = state[1], &theta_dot = state[2], &y_dot = state[3];
    const Real &k2 = par[9], &k3 = par[10], &k4 = par[11], &k5 = par[12], &k9 = par[16];

    // Projection
    const Real z0 = y - k2 * theta;
    const Real z1 = k5 * z0;
    const Real z2 = k5 * (y_dot - k2 * theta_dot);

    // Result
    out[0] = theta + k9 * z1;
    out[1] = y - k3 * z1;
    out[2] = theta_dot + k9 * z2;
    out[3] = y_dot - k3 * z2;
    position[0] = z0;
    pivots[0] = k4;
}

/// gamma of A q'' = gamma.
template <typename Real>
void gamma_at(const Real&, const Real*, const Real*, Real* out) {


    // Result
    out[0] = Real(0);
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

constexpr const char* coordinate_names[] = { "theta", "y", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "M", "J", "R", "r", "P", "g", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 40, 0.05, 0.15, 0.12, 45, 9.81, 0};

constexpr alembert_solver_table table{
    4, 2, 2, 6, 11, 0, 0, 1, "chain_hoist", "routh, intermediate symbols",
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

