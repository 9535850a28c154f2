// Equations of motion of 'double_pendulum_joints': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
//   state  q1 [rad], q2 [rad], then their rates
//   par    m1 [kg], m2 [kg], l1 [m], l2 [m], g [m/s^2]
//   cost   32 operations a right-hand side: 10 additions, 17 multiplications, 1 divisions, 4 functions
//
// M(q) q'' = f(q, q', t). This file includes nothing and allocates nothing.

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
    const Real &m1 = par[0], &m2 = par[1], &l1 = par[2], &l2 = par[3], &g = par[4];

    // Constants
    const Real k0 = m1 * l1 * l1;
    const Real M11 = m2 * l2 * l2;
    const Real k1 = k0 + m2 * l1 * l1 + M11;
    const Real k2 = m2 * l1 * l2;
    const Real k3 = Real(2) * k2;
    const Real k4 = l1 * g * (m1 + m2);
    const Real k5 = m2 * l2 * g;
    const Real k6 = Real(1) / M11;
    const Real k7 = l1 * l1 + l2 * l2;
    const Real k8 = Real(2) * l1 * l2;
    const Real k9 = Real(0.5) * M11;
    const Real k10 = m2 * l2;

    // Result
    par[5] = k0;
    par[6] = M11;
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
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate) {
    const Real &q1 = state[0], &q2 = state[1], &q1_dot = state[2], &q2_dot = state[3];
    const Real &M11 = par[6], &k1 = par[7], &k2 = par[8], &k3 = par[9], &k4 = par[10], &k5 = par[11];
    const Real &k6 = par[12];

    // Trigonometry
    const auto [sin_q2, cos_q2] = sincos(q2);
    const Real sin_q1 = sin(q1);
    const Real phi0 = q1 + q2;
    const Real sin_phi0 = sin(phi0);

    // Mass matrix M(q), lower triangle
    const Real M00 = k1 + k3 * cos_q2;
    const Real M10 = M11 + k2 * cos_q2;

    // Forcing f
    const Real z0 = k5 * sin_phi0;
    const Real z1 = q2_dot * (k2 * q2_dot + k3 * q1_dot) * sin_q2;
    const Real z2 = (k4 * sin_q1 + z0) - z1;
    const Real f0 = -z2;
    const Real z3 = k2 * q1_dot * q1_dot * sin_q2 + z0;
    const Real f1 = -z3;

    // Solve M q'' = f with M = L D L^T
    const Real z4 = k6 * M10;
    const Real z5 = Real(1) / (M00 - M10 * z4);
    const Real z6 = z5 * (z2 - z4 * z3);
    const Real q1_ddot = -z6;
    const Real q2_ddot = z6 * z4 - k6 * z3;

    // Result
    rate[0] = q1_dot;
    rate[1] = q2_dot;
    rate[2] = q1_ddot;
    rate[3] = q2_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, Real* mass, Real* forcing) {
    const Real &q1 = state[0], &q2 = state[1], &q1_dot = state[2], &q2_dot = state[3];
    const Real &M11 = par[6], &k1 = par[7], &k2 = par[8], &k3 = par[9], &k4 = par[10], &k5 = par[11];

    // Trigonometry
    const auto [sin_q2, cos_q2] = sincos(q2);
    const Real sin_q1 = sin(q1);
    const Real phi0 = q1 + q2;
    const Real sin_phi0 = sin(phi0);

    // Mass matrix M(q), lower triangle
    const Real M00 = k1 + k3 * cos_q2;
    const Real M10 = M11 + k2 * cos_q2;

    // Forcing f
    const Real z0 = k5 * sin_phi0;
    const Real z1 = q2_dot * (k2 * q2_dot + k3 * q1_dot) * sin_q2;
    const Real f0 = z1 - (k4 * sin_q1 + z0);
    const Real f1 = -k2 * q1_dot * q1_dot * sin_q2 - z0;

    // Result
    mass[0] = M00;
    mass[1] = mass[2] = M10;
    mass[3] = M11;
    forcing[0] = f0;
    forcing[1] = f1;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, Real* energy, Real* jacobi) {
    const Real &q1 = state[0], &q2 = state[1], &q1_dot = state[2], &q2_dot = state[3];
    const Real &m2 = par[1], &l1 = par[2], &l2 = par[3], &k0 = par[5], &k4 = par[10], &k5 = par[11];
    const Real &k7 = par[13], &k8 = par[14], &k9 = par[15], &k10 = par[16];

    // Trigonometry
    const Real cos_q2 = cos(q2);
    const Real phi0 = q1 + q2;
    const Real cos_q1 = cos(q1);
    const Real cos_phi0 = cos(phi0);

    // Energy
    const Real z0 = q1_dot * q1_dot * (k0 + m2 * (k7 + k8 * cos_q2));
    const Real z1 = k10 * q1_dot * (l2 + l1 * cos_q2);
    const Real T = Real(0.5) * z0 + q2_dot * (k9 * q2_dot + z1);
    const Real z2 = k4 * cos_q1 + k5 * cos_phi0;
    const Real V = -z2;
    const Real E = T - z2;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = Real(0);
    jacobi[0] = E;
}

/// The scene's outputs.
template <typename Real>
void outputs_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {


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

constexpr const char* coordinate_names[] = { "q1", "q2", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m1", "m2", "l1", "l2", "g", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 1, 1, 0.8, 9.81, 0};

constexpr alembert_solver_table table{
    3, 2, 2, 5, 12, 0, 0, 0, "double_pendulum_joints", "lagrange, textbook form",
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
