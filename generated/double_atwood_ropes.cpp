// Equations of motion of 'double_atwood_ropes': routh, intermediate symbols.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[8]        y1 [m], z [m], y2 [m], y3 [m], then their rates
//   rate[8]         d state / dt
//   par[27]         m1 = 2 [kg], m2 = 1.1 [kg], m3 = 0.9 [kg], mp = 0.3 [kg], L1 = 10 [m], L2 = 8 [m],
//                   g = 9.81 [m/s^2], then 20 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[16], M row by row; forcing[4], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   outputs_at      out[2]: upper_tension, lower_tension
//   constraints_at  position[2], velocity[2]; rows[8], A row by row
//   multipliers_at  lambda[2]
//   project         out[8], position[2], pivots[2]
//   cost            0 operations a right-hand side: 0 additions, 0 multiplications, 0 divisions, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "double_atwood_ropes.cpp"
//
//   int main() {
//       const double state[8] = {5, 5, 8, 10, 0, 0, 0, 0};
//       double par[27], rate[8];
//       for (int k = 0; k < 7; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m1 = par[0], &m2 = par[1], &m3 = par[2], &mp = par[3], &g = par[6];

    // Constants
    const Real f0 = m1 * g;
    const Real f1 = mp * g;
    const Real f2 = m2 * g;
    const Real f3 = m3 * g;
    const Real k0 = Real(1) / m1;
    const Real z0 = k0 * f0;
    const Real k1 = Real(1) / mp;
    const Real k2 = Real(1) / m2;
    const Real k3 = Real(1) / m3;
    const Real k4 = (k2 + k3) + Real(4) * k1;
    const Real k5 = Real(1) / k4;
    const Real z1 = k5 * k1;
    const Real k6 = (k0 + k1) - Real(4) * z1 * k1;
    const Real k7 = Real(1) / k6;
    const Real z2 = k1 * f1;
    const Real z3 = k2 * f2;
    const Real z4 = k3 * f3;
    const Real z5 = (z3 + z4) - Real(2) * z2;
    const Real k8 = k7 * ((z0 + z2) + Real(2) * z1 * z5);
    const Real k9 = z0 - k0 * k8;
    const Real k10 = k5 * z5 + Real(2) * k8 * z1;
    const Real k11 = k8 * k1 - Real(2) * k10 * k1 - z2;
    const Real k12 = k10 * k2 - z3;
    const Real k13 = k10 * k3 - z4;
    const Real k14 = Real(2) * z1;
    const Real k15 = Real(2) * k1;

    // Result
    par[7] = f0;
    par[8] = f1;
    par[9] = f2;
    par[10] = f3;
    par[11] = k0;
    par[12] = k1;
    par[13] = k2;
    par[14] = k3;
    par[15] = k4;
    par[16] = k5;
    par[17] = k6;
    par[18] = k7;
    par[19] = k8;
    par[20] = k9;
    par[21] = k10;
    par[22] = k11;
    par[23] = k12;
    par[24] = k13;
    par[25] = k14;
    par[26] = k15;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &y1_dot = state[4], &z_dot = state[5], &y2_dot = state[6], &y3_dot = state[7];
    const Real &k9 = par[20], &k11 = par[22], &k12 = par[23], &k13 = par[24];

    // Mass matrix M(q), lower triangle
    // M00 = m1, M10 = 0, M11 = mp, M20 = 0, M21 = 0, M22 = m2, M30 = 0, M31 = 0, M32 = 0, M33 = m3

    // Result
    rate[0] = y1_dot;
    rate[1] = z_dot;
    rate[2] = y2_dot;
    rate[3] = y3_dot;
    rate[4] = k9;
    rate[5] = -k11;
    rate[6] = -k12;
    rate[7] = -k13;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real*, const Real* par, Real* mass, Real* forcing) {
    const Real &m1 = par[0], &m2 = par[1], &m3 = par[2], &mp = par[3], &f0 = par[7], &f1 = par[8], &f2 = par[9];
    const Real &f3 = par[10];

    // Result
    mass[0] = m1;
    mass[1] = mass[4] = Real(0);
    mass[5] = mp;
    mass[2] = mass[8] = Real(0);
    mass[6] = mass[9] = Real(0);
    mass[10] = m2;
    mass[3] = mass[12] = Real(0);
    mass[7] = mass[13] = Real(0);
    mass[11] = mass[14] = Real(0);
    mass[15] = m3;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = f2;
    forcing[3] = f3;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &y1 = state[0], &z = state[1], &y2 = state[2], &y3 = state[3], &y1_dot = state[4];
    const Real &z_dot = state[5], &y2_dot = state[6], &y3_dot = state[7];
    const Real &m1 = par[0], &m2 = par[1], &m3 = par[2], &mp = par[3], &f0 = par[7], &f1 = par[8], &f2 = par[9];
    const Real &f3 = par[10];

    // Energy
    const Real z0 = m1 * y1_dot * y1_dot;
    const Real z1 = z0 + m2 * y2_dot * y2_dot + m3 * y3_dot * y3_dot + mp * z_dot * z_dot;
    const Real T = Real(0.5) * z1;
    const Real z2 = f0 * y1;
    const Real z3 = z2 + f2 * y2 + f3 * y3 + f1 * z;
    const Real V = -z3;
    const Real E = Real(0.5) * z1 - z3;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = Real(0);
    jacobi[0] = E;
}

/// The scene's outputs.
template <typename Real>
void outputs_at(const Real&, const Real*, const Real*, const Real* par, Real* out) {
    const Real &k8 = par[19], &k10 = par[21];

    // Result
    out[0] = k8;
    out[1] = k10;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real* par, Real* position, Real* velocity, Real* rows) {
    const Real &y1 = state[0], &z = state[1], &y2 = state[2], &y3 = state[3], &y1_dot = state[4];
    const Real &z_dot = state[5], &y2_dot = state[6], &y3_dot = state[7];
    const Real &L1 = par[4], &L2 = par[5];

    // Result
    position[0] = y1 - L1 + z;
    position[1] = y2 - L2 - Real(2) * z + y3;
    velocity[0] = y1_dot + z_dot;
    velocity[1] = y2_dot - Real(2) * z_dot + y3_dot;
    rows[0] = Real(1);
    rows[1] = Real(1);
    rows[2] = Real(0);
    rows[3] = Real(0);
    rows[4] = Real(0);
    rows[5] = Real(-2);
    rows[6] = Real(1);
    rows[7] = Real(1);
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real*, const Real* par, Real* lambda) {
    const Real &k8 = par[19], &k10 = par[21];

    // Result
    lambda[0] = -k8;
    lambda[1] = -k10;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &y1 = state[0], &z = state[1], &y2 = state[2], &y3 = state[3], &y1_dot = state[4];
    const Real &z_dot = state[5], &y2_dot = state[6], &y3_dot = state[7];
    const Real &L1 = par[4], &L2 = par[5], &k0 = par[11], &k1 = par[12], &k2 = par[13], &k3 = par[14];
    const Real &k4 = par[15], &k5 = par[16], &k6 = par[17], &k7 = par[18], &k14 = par[25], &k15 = par[26];

    // Projection
    const Real z0 = L1 - y1 - z;
    const Real z1 = L2 + Real(2) * z - y2 - y3;
    const Real z2 = Real(2) * z_dot - y2_dot - y3_dot;
    const Real z3 = k7 * (z0 + k14 * z1);
    const Real z4 = k5 * z1 + k14 * z3;
    const Real z5 = k7 * (k14 * z2 - (y1_dot + z_dot));
    const Real z6 = k5 * z2 + k14 * z5;

    // Result
    out[0] = y1 + k0 * z3;
    out[1] = z + (k1 * z3 - k15 * z4);
    out[2] = y2 + k2 * z4;
    out[3] = y3 + k3 * z4;
    out[4] = y1_dot + k0 * z5;
    out[5] = z_dot + (k1 * z5 - k15 * z6);
    out[6] = y2_dot + k2 * z6;
    out[7] = y3_dot + k3 * z6;
    position[0] = -z0;
    position[1] = -z1;
    pivots[0] = k6;
    pivots[1] = k4;
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

constexpr const char* coordinate_names[] = { "y1", "z", "y2", "y3", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m1", "m2", "m3", "mp", "L1", "L2", "g", nullptr};
constexpr const char* output_names[] = { "upper_tension", "lower_tension", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 2, 1.1, 0.9, 0.3, 10, 8, 9.81, 0};

constexpr alembert_solver_table table{
    4, 4, 4, 7, 20, 2, 0, 2, "double_atwood_ropes", "routh, intermediate symbols",
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

