// Equations of motion of 'stepped_drum': routh, intermediate symbols.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[6]        theta [rad], y1 [m], y2 [m], then their rates
//   rate[6]         d state / dt
//   par[22]         J = 1.8 [kg*m^2], R = 0.4 [m], r = 0.15 [m], m1 = 12 [kg], m2 = 20 [kg], g = 9.81 [m/s^2],
//                   then 16 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[9], M row by row; forcing[3], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   constraints_at  position[2], velocity[2]; rows[6], A row by row
//   multipliers_at  lambda[2]
//   project         out[6], position[2], pivots[2]
//   cost            0 operations a right-hand side: 0 additions, 0 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "stepped_drum.cpp"
//
//   int main() {
//       const double state[6] = {0, -1, -1.5, 0, 0, 0};
//       double par[22], rate[6];
//       for (int k = 0; k < 6; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &J = par[0], &R = par[1], &r = par[2], &m1 = par[3], &m2 = par[4], &g = par[5];

    // Constants
    const Real k0 = m1 * g;
    const Real k1 = m2 * g;
    const Real z0 = Real(1) / J;
    const Real k2 = R * z0;
    const Real k3 = r * z0;
    const Real z1 = R * k3;
    const Real k4 = Real(1) / m2;
    const Real k5 = r * k3 + k4;
    const Real k6 = Real(1) / k5;
    const Real k7 = z1 * k6;
    const Real z2 = k4 * k1;
    const Real k8 = Real(1) / m1;
    const Real z3 = k8 * k0;
    const Real k9 = (R * k2 + k8) - z1 * k7;
    const Real k10 = Real(1) / k9;
    const Real k11 = (k7 * z2 + z3) * k10;
    const Real k12 = k6 * z2 + k7 * k11;
    const Real k13 = k2 * k11 - k3 * k12;
    const Real k14 = k11 * k8 - z3;
    const Real k15 = k12 * k4 - z2;

    // Result
    par[6] = k0;
    par[7] = k1;
    par[8] = k2;
    par[9] = k3;
    par[10] = k4;
    par[11] = k5;
    par[12] = k6;
    par[13] = k7;
    par[14] = k8;
    par[15] = k9;
    par[16] = k10;
    par[17] = k11;
    par[18] = k12;
    par[19] = k13;
    par[20] = k14;
    par[21] = k15;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &theta_dot = state[3], &y1_dot = state[4], &y2_dot = state[5];
    const Real &R = par[1], &k13 = par[19], &k14 = par[20], &k15 = par[21];

    // Mass matrix M(q), lower triangle
    // M00 = J, M10 = 0, M11 = m1, M20 = 0, M21 = 0, M22 = m2

    // Forcing f
    // f0 = 0, f1 = -k0, f2 = -k1

    // Result
    rate[0] = theta_dot;
    rate[1] = y1_dot;
    rate[2] = y2_dot;
    rate[3] = k13;
    rate[4] = k14;
    rate[5] = k15;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real*, const Real* par, Real* mass, Real* forcing) {
    const Real &J = par[0], &m1 = par[3], &m2 = par[4], &k0 = par[6], &k1 = par[7];

    // Result
    mass[0] = J;
    mass[1] = mass[3] = Real(0);
    mass[4] = m1;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = m2;
    forcing[0] = Real(0);
    forcing[1] = -k0;
    forcing[2] = -k1;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &y1 = state[1], &y2 = state[2], &theta_dot = state[3], &y1_dot = state[4], &y2_dot = state[5];
    const Real &J = par[0], &m1 = par[3], &m2 = par[4], &k0 = par[6], &k1 = par[7];

    // Energy
    const Real z0 = J * theta_dot * theta_dot + m1 * y1_dot * y1_dot + m2 * y2_dot * y2_dot;
    const Real T = Real(0.5) * z0;
    const Real V = k0 * y1 + k1 * y2;
    const Real E = V + Real(0.5) * z0;

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
    const Real &theta = state[0], &y1 = state[1], &y2 = state[2], &theta_dot = state[3], &y1_dot = state[4];
    const Real &y2_dot = state[5];
    const Real &R = par[1], &r = par[2];

    // Result
    position[0] = y1 + (Real(1) + R * theta);
    position[1] = y2 - (r * theta - Real(1.5));
    velocity[0] = y1_dot + R * theta_dot;
    velocity[1] = y2_dot - r * theta_dot;
    rows[0] = R;
    rows[1] = Real(1);
    rows[2] = Real(0);
    rows[3] = -r;
    rows[4] = Real(0);
    rows[5] = Real(1);
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real*, const Real* par, Real* lambda) {
    const Real &k11 = par[17], &k12 = par[18];

    // Result
    lambda[0] = k11;
    lambda[1] = k12;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &theta = state[0], &y1 = state[1], &y2 = state[2], &theta_dot = state[3], &y1_dot = state[4];
    const Real &y2_dot = state[5];
    const Real &R = par[1], &r = par[2], &k2 = par[8], &k3 = par[9], &k4 = par[10], &k5 = par[11], &k6 = par[12];
    const Real &k7 = par[13], &k8 = par[14], &k9 = par[15], &k10 = par[16];

    // Projection
    const Real z0 = y1 + (Real(1) + R * theta);
    const Real z1 = y2 - (r * theta - Real(1.5));
    const Real z2 = y2_dot - r * theta_dot;
    const Real z3 = k10 * (z0 + k7 * z1);
    const Real z4 = k6 * z1 + k7 * z3;
    const Real z5 = k10 * ((y1_dot + R * theta_dot) + k7 * z2);
    const Real z6 = k6 * z2 + k7 * z5;

    // Result
    out[0] = theta - (k2 * z3 - k3 * z4);
    out[1] = y1 - k8 * z3;
    out[2] = y2 - k4 * z4;
    out[3] = theta_dot - (k2 * z5 - k3 * z6);
    out[4] = y1_dot - k8 * z5;
    out[5] = y2_dot - k4 * z6;
    position[0] = z0;
    position[1] = z1;
    pivots[0] = k9;
    pivots[1] = k5;
}

/// gamma of A q'' = gamma.
template <typename Real>
void gamma_at(const Real&, const Real*, const Real*, Real* out) {


    // Result
    out[0] = Real(0);
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

constexpr const char* coordinate_names[] = { "theta", "y1", "y2", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "J", "R", "r", "m1", "m2", "g", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1.8, 0.4, 0.15, 12, 20, 9.81, 0};

constexpr alembert_solver_table table{
    4, 3, 3, 6, 16, 0, 0, 2, "stepped_drum", "routh, intermediate symbols",
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

