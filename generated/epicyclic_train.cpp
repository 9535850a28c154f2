// Equations of motion of 'epicyclic_train': routh, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[6]        sun [rad], phi [rad], psi [rad], then their rates
//   rate[6]         d state / dt
//   par[26]         a = 0.2 [m], b = 0.1 [m], m = 0.5 [kg], Is = 0.02 [kg*m^2], Ip = 0.003 [kg*m^2],
//                   Ic = 0.05 [kg*m^2], M = 1.2 [N m], N1 = 3 [N m],
//                   then 18 numbers that prepare computes from them; call it after each change
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
//   #include "epicyclic_train.cpp"
//
//   int main() {
//       const double state[6] = {0, 0.3, 0, 0, 0, 0};
//       double par[26], rate[6];
//       for (int k = 0; k < 8; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &a = par[0], &b = par[1], &m = par[2], &Is = par[3], &Ip = par[4], &Ic = par[5], &M = par[6];
    const Real &N1 = par[7];

    // Constants
    const Real z0 = a * b * m;
    const Real M11 = Ic + a * a * m + Real(2) * z0 + b * b * m;
    const Real k0 = a + b;
    const Real z1 = Real(1) / Is;
    const Real k1 = a * z1;
    const Real z2 = Real(1) / M11;
    const Real k2 = k0 * z2;
    const Real z3 = N1 * k2;
    const Real z4 = M * k1 + z3;
    const Real k3 = b / Ip;
    const Real z5 = b * k3;
    const Real z6 = k0 * k2;
    const Real k4 = (a * k1 + z5) + z6;
    const Real k5 = Real(1) / k4;
    const Real z7 = z6 - z5;
    const Real k6 = z7 * k5;
    const Real k7 = (z6 + z5) - z7 * k6;
    const Real k8 = Real(1) / k7;
    const Real k9 = (z3 - z4 * k6) * k8;
    const Real k10 = z4 * k5 - k6 * k9;
    const Real k11 = k1 * k10 - M * z1;
    const Real k12 = N1 * z2 - k2 * k9 - k2 * k10;
    const Real k13 = k9 * k3 - k10 * k3;
    const Real k14 = Real(0.5) * (Ic + m * k0 * k0);
    const Real k15 = Real(0.5) * Is;
    const Real k16 = Real(0.5) * Ip;

    // Result
    par[8] = M11;
    par[9] = k0;
    par[10] = k1;
    par[11] = k2;
    par[12] = k3;
    par[13] = k4;
    par[14] = k5;
    par[15] = k6;
    par[16] = k7;
    par[17] = k8;
    par[18] = k9;
    par[19] = k10;
    par[20] = k11;
    par[21] = k12;
    par[22] = k13;
    par[23] = k14;
    par[24] = k15;
    par[25] = k16;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &sun_dot = state[3], &phi_dot = state[4], &psi_dot = state[5];
    const Real &b = par[1], &k0 = par[9], &k11 = par[20], &k12 = par[21], &k13 = par[22];

    // Mass matrix M(q), lower triangle
    // M00 = Is, M10 = 0, M20 = 0, M21 = 0, M22 = Ip

    // Forcing f
    // f0 = M, f1 = -N1, f2 = 0

    // Result
    rate[0] = sun_dot;
    rate[1] = phi_dot;
    rate[2] = psi_dot;
    rate[3] = -k11;
    rate[4] = -k12;
    rate[5] = k13;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real*, const Real* par, Real* mass, Real* forcing) {
    const Real &Is = par[3], &Ip = par[4], &M = par[6], &N1 = par[7], &M11 = par[8];

    // Result
    mass[0] = Is;
    mass[1] = mass[3] = Real(0);
    mass[4] = M11;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = Ip;
    forcing[0] = M;
    forcing[1] = -N1;
    forcing[2] = Real(0);
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &sun_dot = state[3], &phi_dot = state[4], &psi_dot = state[5];
    const Real &M = par[6], &N1 = par[7], &k14 = par[23], &k15 = par[24], &k16 = par[25];

    // Energy
    const Real T = k14 * phi_dot * phi_dot + k15 * sun_dot * sun_dot + k16 * psi_dot * psi_dot;
    const Real P = M * sun_dot - N1 * phi_dot;

    // Result
    energy[0] = T;
    energy[1] = Real(0);
    energy[2] = T;
    energy[3] = P;
    jacobi[0] = T;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real* par, Real* position, Real* velocity, Real* rows) {
    const Real &sun_dot = state[3], &phi_dot = state[4], &psi_dot = state[5];
    const Real &a = par[0], &b = par[1], &k0 = par[9];

    // Constraints
    const Real z0 = k0 * phi_dot;
    const Real z1 = b * psi_dot;

    // Result
    position[0] = Real(0);
    position[1] = Real(0);
    velocity[0] = z0 + z1;
    velocity[1] = z0 - a * sun_dot - z1;
    rows[0] = Real(0);
    rows[1] = k0;
    rows[2] = b;
    rows[3] = -a;
    rows[4] = k0;
    rows[5] = -b;
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real*, const Real* par, Real* lambda) {
    const Real &k9 = par[18], &k10 = par[19];

    // Result
    lambda[0] = k9;
    lambda[1] = k10;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &sun_ = state[0], &phi = state[1], &psi = state[2], &sun_dot = state[3], &phi_dot = state[4];
    const Real &psi_dot = state[5];
    const Real &a = par[0], &b = par[1], &k0 = par[9], &k1 = par[10], &k2 = par[11], &k3 = par[12], &k4 = par[13];
    const Real &k5 = par[14], &k6 = par[15], &k7 = par[16], &k8 = par[17];

    // Projection
    const Real z0 = k0 * phi_dot;
    const Real z1 = b * psi_dot;
    const Real z2 = a * sun_dot - z0 + z1;
    const Real z3 = k8 * ((z0 + z1) + k6 * z2);
    const Real z4 = k5 * z2 + k6 * z3;

    // Result
    out[0] = sun_;
    out[1] = phi;
    out[2] = psi;
    out[3] = sun_dot - k1 * z4;
    out[4] = phi_dot - (k2 * z3 - k2 * z4);
    out[5] = psi_dot - (k3 * z3 + k3 * z4);
    position[0] = Real(0);
    position[1] = Real(0);
    pivots[0] = k7;
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

constexpr const char* coordinate_names[] = { "sun", "phi", "psi", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "a", "b", "m", "Is", "Ip", "Ic", "M", "N1", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.2, 0.1, 0.5, 0.02, 0.003, 0.05, 1.2, 3, 0};

constexpr alembert_solver_table table{
    4, 3, 3, 8, 18, 0, 0, 2, "epicyclic_train", "routh, textbook form",
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

