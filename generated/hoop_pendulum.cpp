// Equations of motion of 'hoop_pendulum': routh, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
//   state  x [m], psi [rad], theta [rad], then their rates
//   par    M [kg], m [kg], R [m], l [m], g [m/s^2]
//   cost   23 operations a right-hand side: 5 additions, 14 multiplications, 2 divisions, 2 functions
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma. This file includes nothing and allocates nothing.

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
    const Real &M = par[0], &m = par[1], &R = par[2], &l = par[3], &g = par[4];

    // Constants
    const Real M00 = M + m;
    const Real M11 = M * R * R;
    const Real k0 = m * l;
    const Real M22 = m * l * l;
    const Real k1 = m * l * g;
    const Real k2 = Real(1) / M22;
    const Real k3 = R / M11;
    const Real k4 = R * k3;
    const Real k5 = Real(0.5) * M00;
    const Real k6 = Real(0.5) * M11;
    const Real k7 = Real(0.5) * M22;
    const Real k8 = R * g * M00;

    // Result
    par[5] = M00;
    par[6] = M11;
    par[7] = k0;
    par[8] = M22;
    par[9] = k1;
    par[10] = k2;
    par[11] = k3;
    par[12] = k4;
    par[13] = k5;
    par[14] = k6;
    par[15] = k7;
    par[16] = k8;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate) {
    const Real &theta = state[2], &x_dot = state[3], &psi_dot = state[4], &theta_dot = state[5];
    const Real &R = par[2], &M00 = par[5], &M11 = par[6], &k0 = par[7], &M22 = par[8], &k1 = par[9];
    const Real &k2 = par[10], &k3 = par[11], &k4 = par[12];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);

    // Mass matrix M(q), lower triangle
    const Real M20 = k0 * cos_theta;

    // Forcing f
    const Real f0 = k0 * theta_dot * theta_dot * sin_theta;
    const Real z0 = k1 * sin_theta;
    const Real f2 = -z0;

    // Solve M q'' = f + A^T lambda, A q'' = gamma
    const Real z1 = k2 * M20;
    const Real z2 = Real(1) / (M00 - M20 * z1);
    const Real z3 = z2 * (f0 + z0 * z1);
    const Real z4 = z3 / (k4 + z2);
    const Real x_ddot = z3 - z2 * z4;
    const Real psi_ddot = k3 * z4;
    const Real theta_ddot = -x_ddot * z1 - k2 * z0;

    // Result
    rate[0] = x_dot;
    rate[1] = psi_dot;
    rate[2] = theta_dot;
    rate[3] = x_ddot;
    rate[4] = psi_ddot;
    rate[5] = theta_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, Real* mass, Real* forcing) {
    const Real &theta = state[2], &theta_dot = state[5];
    const Real &M00 = par[5], &M11 = par[6], &k0 = par[7], &M22 = par[8], &k1 = par[9];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);

    // Mass matrix M(q), lower triangle
    const Real M20 = k0 * cos_theta;

    // Forcing f
    const Real f0 = k0 * theta_dot * theta_dot * sin_theta;
    const Real f2 = -k1 * sin_theta;

    // Result
    mass[0] = M00;
    mass[1] = mass[3] = Real(0);
    mass[4] = M11;
    mass[2] = mass[6] = M20;
    mass[5] = mass[7] = Real(0);
    mass[8] = M22;
    forcing[0] = f0;
    forcing[1] = Real(0);
    forcing[2] = f2;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, Real* energy, Real* jacobi) {
    const Real &theta = state[2], &x_dot = state[3], &psi_dot = state[4], &theta_dot = state[5];
    const Real &k0 = par[7], &k1 = par[9], &k5 = par[13], &k6 = par[14], &k7 = par[15], &k8 = par[16];

    // Trigonometry
    const Real cos_theta = cos(theta);

    // Energy
    const Real z0 = k0 * x_dot * theta_dot * cos_theta;
    const Real T = k5 * x_dot * x_dot + k6 * psi_dot * psi_dot + k7 * theta_dot * theta_dot + z0;
    const Real V = k8 - k1 * cos_theta;
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
void outputs_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {
    const Real &theta = state[2], &x_dot = state[3], &theta_dot = state[5];
    const Real &M00 = par[5], &k0 = par[7];

    // Trigonometry
    const Real cos_theta = cos(theta);

    // Outputs
    const Real momentum = M00 * x_dot + k0 * theta_dot * cos_theta;

    // Result
    out[0] = momentum;
}

/// The scene's event functions.
template <typename Real>
void events_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {


}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* position, [[maybe_unused]] Real* velocity, [[maybe_unused]] Real* rows) {
    const Real &x_dot = state[3], &psi_dot = state[4];
    const Real &R = par[2];

    // Result
    position[0] = Real(0);
    velocity[0] = x_dot - R * psi_dot;
    rows[0] = Real(1);
    rows[1] = -R;
    rows[2] = Real(0);
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* lambda) {
    const Real &theta = state[2], &theta_dot = state[5];
    const Real &M00 = par[5], &k0 = par[7], &k1 = par[9], &k2 = par[10], &k4 = par[12];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);

    // Multipliers
    const Real z0 = k0 * cos_theta;
    const Real z1 = k2 * z0;
    const Real z2 = Real(1) / (M00 - z0 * z1);
    const Real z3 = k0 * theta_dot * theta_dot * sin_theta + k1 * sin_theta * z1;
    const Real F = -z2 * z3 / (k4 + z2);

    // Result
    lambda[0] = F;
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

constexpr const char* coordinate_names[] = { "x", "psi", "theta", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "M", "m", "R", "l", "g", nullptr};
constexpr const char* output_names[] = { "momentum", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 2, 1, 0.5, 0.4, 9.81, 0};

constexpr alembert_solver_table table{
    3, 3, 3, 5, 12, 1, 0, 1, "hoop_pendulum", "routh, textbook form",
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
