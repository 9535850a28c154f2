// Equations of motion of 'free_body': kane, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
//   state  psi [rad], theta [rad], phi [rad], then w1, w2, w3
//   par    m [kg], I1 [kg*m^2], I2 [kg*m^2], I3 [kg*m^2]
//   cost   24 operations a right-hand side: 3 additions, 16 multiplications, 1 divisions, 4 functions
//
// M(q) u' = f(q, u, t), q' = h(q, u, t). This file includes nothing and allocates nothing.

namespace {

inline double sin(double x) { return __builtin_sin(x); }
inline double cos(double x) { return __builtin_cos(x); }
inline double tan(double x) { return __builtin_tan(x); }
inline double asin(double x) { return __builtin_asin(x); }
inline double acos(double x) { return __builtin_acos(x); }
inline double atan(double x) { return __builtin_atan(x); }
inline double sinh(double x) { return __builtin_sinh(x); }
inline double cosh(double x) { return __builtin_cosh(x); }
inline double tanh(double x) { return __builtin_tanh(x); }
inline double exp(double x) { return __builtin_exp(x); }
inline double log(double x) { return __builtin_log(x); }
inline double sqrt(double x) { return __builtin_sqrt(x); }
inline double abs(double x) { return __builtin_fabs(x); }
inline double pow(double x, double y) { return __builtin_pow(x, y); }
inline double atan2(double y, double x) { return __builtin_atan2(y, x); }
template <typename Real> Real sign(const Real& x) { return Real(x > Real(0)) - Real(x < Real(0)); }
template <typename Real> Real min(const Real& x, const Real& y) { return y < x ? y : x; }
template <typename Real> Real max(const Real& x, const Real& y) { return x < y ? y : x; }

template <typename Real> struct pair { Real s, c; };
template <typename Real> pair<Real> sincos(const Real& x) { return {sin(x), cos(x)}; }

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &I1 = par[1], &I2 = par[2], &I3 = par[3];

    // Constants
    const Real k0 = I2 - I3;
    const Real k1 = I1 - I3;
    const Real k2 = I1 - I2;
    const Real k3 = Real(1) / I1;
    const Real k4 = Real(1) / I2;
    const Real k5 = Real(1) / I3;
    const Real k6 = Real(0.5) * I3;

    // Result
    par[4] = k0;
    par[5] = k1;
    par[6] = k2;
    par[7] = k3;
    par[8] = k4;
    par[9] = k5;
    par[10] = k6;
}

/// rate = (q', u') at t and state = (q, u).
template <typename Real>
void rhs([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate) {
    const Real &theta = state[1], &phi = state[2], &w1 = state[3], &w2 = state[4], &w3 = state[5];
    const Real &I1 = par[1], &I2 = par[2], &I3 = par[3], &k0 = par[4], &k1 = par[5], &k2 = par[6], &k3 = par[7];
    const Real &k4 = par[8], &k5 = par[9];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);
    const auto [sin_phi, cos_phi] = sincos(phi);

    // Kinematics q' = h(q, u, t)
    const Real z0 = Real(1) / sin_theta;
    const Real z1 = w1 * sin_phi + w2 * cos_phi;
    const Real psi_dot = z0 * z1;
    const Real theta_dot = w1 * cos_phi - w2 * sin_phi;
    const Real phi_dot = w3 - z0 * cos_theta * z1;

    // Forcing f
    const Real f0 = k0 * w2 * w3;
    const Real z2 = k1 * w1 * w3;
    const Real f1 = -z2;
    const Real f2 = k2 * w1 * w2;

    // Solve M u' = f with M = L D L^T
    const Real w1_dot = k3 * f0;
    const Real w2_dot = -k4 * z2;
    const Real w3_dot = k5 * f2;

    // Result
    rate[0] = psi_dot;
    rate[1] = theta_dot;
    rate[2] = phi_dot;
    rate[3] = w1_dot;
    rate[4] = w2_dot;
    rate[5] = w3_dot;
}

/// M (s by s, row-major) and f of M u' = f.
template <typename Real>
void mass_forcing([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, Real* mass, Real* forcing) {
    const Real &w1 = state[3], &w2 = state[4], &w3 = state[5];
    const Real &I1 = par[1], &I2 = par[2], &I3 = par[3], &k0 = par[4], &k1 = par[5], &k2 = par[6];

    // Forcing f
    const Real f0 = k0 * w2 * w3;
    const Real f1 = -k1 * w1 * w3;
    const Real f2 = k2 * w1 * w2;

    // Result
    mass[0] = I1;
    mass[1] = mass[3] = Real(0);
    mass[4] = I2;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = I3;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = f2;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, Real* energy, Real* jacobi) {
    const Real &theta = state[1], &phi = state[2], &w1 = state[3], &w2 = state[4], &w3 = state[5];
    const Real &I1 = par[1], &I2 = par[2], &I3 = par[3], &k2 = par[6], &k6 = par[10];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);
    const auto [sin_phi, cos_phi] = sincos(phi);

    // Energy
    const Real z0 = Real(1) / sin_theta;
    const Real z1 = w1 * sin_phi + w2 * cos_phi;
    const Real z2 = z0 * z1;
    const Real z3 = w1 * cos_phi - w2 * sin_phi;
    const Real z4 = w3 - z0 * cos_theta * z1;
    const Real z5 = (I1 * cos_phi * cos_phi + I2 * sin_phi * sin_phi) * z3 * z3;
    const Real z6 = k2 * sin_theta * sin_phi * cos_phi * z3;
    const Real z7 = (I1 * sin_phi * sin_phi + I2 * cos_phi * cos_phi) * sin_theta * sin_theta;
    const Real z8 = (z7 + I3 * cos_theta * cos_theta) * z2;
    const Real z9 = (z6 + Real(0.5) * z8 + I3 * cos_theta * z4) * z2;
    const Real T = (Real(0.5) * z5 + k6 * z4 * z4) + z9;

    // Result
    energy[0] = T;
    energy[1] = Real(0);
    energy[2] = T;
    energy[3] = Real(0);
    jacobi[0] = T;
}

/// The scene's outputs.
template <typename Real>
void outputs_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {
    const Real &w1 = state[3], &w2 = state[4], &w3 = state[5];

    // Result
    out[0] = w1;
    out[1] = w2;
    out[2] = w3;
}

/// The scene's event functions.
template <typename Real>
void events_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {


}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* position, [[maybe_unused]] Real* velocity, [[maybe_unused]] Real* rows) {


}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* lambda) {


}

// What the runtime loads (alembert/abi.hpp).

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

constexpr const char* coordinate_names[] = { "psi", "theta", "phi", nullptr};
constexpr const char* speed_names[] = { "w1", "w2", "w3", nullptr};
constexpr const char* parameter_names[] = { "m", "I1", "I2", "I3", nullptr};
constexpr const char* output_names[] = { "w1", "w2", "w3", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 1, 2, 2.5, 0};

constexpr alembert_solver_table table{
    3, 3, 3, 4, 7, 3, 0, 0, "free_body", "kane, textbook form",
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
    [](double t, const double* state, const double* rate, const double* par, double* out) {
        events_at(t, state, rate, par, out);
    },
    [](double t, const double* state, const double* par, double* position, double* velocity, double* rows) {
        constraints_at(t, state, par, position, velocity, rows);
    },
    [](double t, const double* state, const double* par, double* lambda) { multipliers_at(t, state, par, lambda); },
};

}  // namespace

extern "C" __attribute__((visibility("default"))) const void* alembert_solver() { return &table; }
