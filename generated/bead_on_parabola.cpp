// Equations of motion of 'bead_on_parabola': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[2]        r [m], then their rates
//   rate[2]         d state / dt
//   par[12]         m = 0.1 [kg], c = 1.5 [1/m], omega = 4 [rad/s], g = 9.81 [m/s^2],
//                   then 8 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[1], M row by row; forcing[1], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   cost            9 operations a right-hand side: 2 additions, 6 multiplications, 1 division, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "bead_on_parabola.cpp"
//
//   int main() {
//       const double state[2] = {0.3, 0};
//       double par[12], rate[2];
//       for (int k = 0; k < 4; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m = par[0], &c = par[1], &omega = par[2], &g = par[3];

    // Constants
    const Real k0 = Real(4) * m * c * c;
    const Real k1 = m * (Real(2) * c * g - omega * omega);
    const Real z0 = m * omega * omega;
    const Real k2 = Real(0.5) * z0;
    const Real k3 = Real(0.5) * m;
    const Real k4 = Real(4) * c * c;
    const Real k5 = m * c * g;
    const Real k6 = Real(2) * z0;
    const Real k7 = Real(0.5) * k1;

    // Result
    par[4] = k0;
    par[5] = k1;
    par[6] = k2;
    par[7] = k3;
    par[8] = k4;
    par[9] = k5;
    par[10] = k6;
    par[11] = k7;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &r = state[0], &r_dot = state[1];
    const Real &m = par[0], &k0 = par[4], &k1 = par[5];

    // Mass matrix M(q), lower triangle
    const Real M00 = m + k0 * r * r;

    // Forcing f
    const Real f0 = -r * (k1 + k0 * r_dot * r_dot);

    // Solve M q'' = f with M = L D L^T
    const Real r_ddot = f0 / M00;

    // Result
    rate[0] = r_dot;
    rate[1] = r_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &r = state[0], &r_dot = state[1];
    const Real &m = par[0], &k0 = par[4], &k1 = par[5];

    // Mass matrix M(q), lower triangle
    const Real M00 = m + k0 * r * r;

    // Forcing f
    const Real f0 = -r * (k1 + k0 * r_dot * r_dot);

    // Result
    mass[0] = M00;
    forcing[0] = f0;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &r = state[0], &r_dot = state[1];
    const Real &k2 = par[6], &k3 = par[7], &k4 = par[8], &k5 = par[9], &k6 = par[10], &k7 = par[11];

    // Energy
    const Real z0 = k3 * r_dot * r_dot * (k4 * r * r + Real(1));
    const Real T = k2 * r * r + z0;
    const Real V = k5 * r * r;
    const Real E = V + T;
    const Real P = k6 * r * r_dot;
    const Real h = z0 + k7 * r * r;

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

constexpr const char* coordinate_names[] = { "r", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "c", "omega", "g", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.1, 1.5, 4, 9.81, 0};

constexpr alembert_solver_table table{
    4, 1, 1, 4, 8, 0, 0, 0, "bead_on_parabola", "lagrange, textbook form",
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

