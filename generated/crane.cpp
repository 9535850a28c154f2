// Equations of motion of 'crane': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
//   state  x [m], l [m], theta [rad], then their rates
//   par    M [kg], m [kg], g [m/s^2], F0 [N], S0 [N], w [rad/s]
//   cost   47 operations a right-hand side: 12 additions, 29 multiplications, 2 divisions, 4 functions
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
    const Real &M = par[0], &m = par[1], &g = par[2];

    // Constants
    const Real M00 = M + m;
    const Real k0 = Real(2) * m;
    const Real k1 = m * g;
    const Real k2 = Real(1) / m;
    const Real k3 = Real(0.5) * M00;
    const Real k4 = Real(0.5) * m;

    // Result
    par[6] = M00;
    par[7] = k0;
    par[8] = k1;
    par[9] = k2;
    par[10] = k3;
    par[11] = k4;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate) {
    const Real &l = state[1], &theta = state[2], &x_dot = state[3], &l_dot = state[4], &theta_dot = state[5];
    const Real &m = par[1], &F0 = par[3], &S0 = par[4], &w = par[5], &M00 = par[6], &k0 = par[7], &k1 = par[8];
    const Real &k2 = par[9];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);
    const Real phi0 = w * t;
    const auto [sin_phi0, cos_phi0] = sincos(phi0);

    // Shared terms
    const Real z0 = m * l;

    // Mass matrix M(q), lower triangle
    const Real M10 = m * sin_theta;
    const Real M20 = z0 * cos_theta;
    const Real M22 = l * z0;

    // Forcing f
    const Real z1 = k0 * l_dot;
    const Real z2 = theta_dot * (z1 * cos_theta - theta_dot * z0 * sin_theta);
    const Real z3 = z2 - F0 * sin_phi0;
    const Real f0 = -z3;
    const Real z4 = k1 + S0 * cos_phi0;
    const Real f1 = k1 * cos_theta + z0 * theta_dot * theta_dot - z4;
    const Real z5 = l * (k1 * sin_theta + theta_dot * z1);
    const Real f2 = -z5;

    // Solve M q'' = f with M = L D L^T
    const Real z6 = Real(1) / M22;
    const Real z7 = M20 * z6;
    const Real z8 = k2 * M10;
    const Real z9 = Real(1) / ((M00 - M20 * z7) - M10 * z8);
    const Real z10 = z9 * (z8 * f1 + (z3 - z7 * z5));
    const Real x_ddot = -z10;
    const Real l_ddot = z10 * z8 + k2 * f1;
    const Real theta_ddot = z10 * z7 - z6 * z5;

    // Result
    rate[0] = x_dot;
    rate[1] = l_dot;
    rate[2] = theta_dot;
    rate[3] = x_ddot;
    rate[4] = l_ddot;
    rate[5] = theta_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, Real* mass, Real* forcing) {
    const Real &l = state[1], &theta = state[2], &l_dot = state[4], &theta_dot = state[5];
    const Real &m = par[1], &F0 = par[3], &S0 = par[4], &w = par[5], &M00 = par[6], &k0 = par[7], &k1 = par[8];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);
    const Real phi0 = w * t;
    const auto [sin_phi0, cos_phi0] = sincos(phi0);

    // Mass matrix M(q), lower triangle
    const Real M10 = m * sin_theta;
    const Real z0 = m * l;
    const Real M20 = z0 * cos_theta;
    const Real M22 = l * z0;

    // Forcing f
    const Real z1 = k0 * l_dot;
    const Real z2 = theta_dot * (z1 * cos_theta - theta_dot * z0 * sin_theta);
    const Real f0 = F0 * sin_phi0 - z2;
    const Real z3 = k1 + S0 * cos_phi0;
    const Real f1 = k1 * cos_theta + z0 * theta_dot * theta_dot - z3;
    const Real f2 = -l * (k1 * sin_theta + theta_dot * z1);

    // Result
    mass[0] = M00;
    mass[1] = mass[3] = M10;
    mass[4] = m;
    mass[2] = mass[6] = M20;
    mass[5] = mass[7] = Real(0);
    mass[8] = M22;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = f2;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, Real* energy, Real* jacobi) {
    const Real &l = state[1], &theta = state[2], &x_dot = state[3], &l_dot = state[4], &theta_dot = state[5];
    const Real &m = par[1], &F0 = par[3], &S0 = par[4], &w = par[5], &k1 = par[8], &k3 = par[10], &k4 = par[11];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);
    const Real phi0 = w * t;
    const auto [sin_phi0, cos_phi0] = sincos(phi0);

    // Energy
    const Real z0 = l * cos_theta;
    const Real z1 = m * (theta_dot * z0 + l_dot * sin_theta);
    const Real z2 = k4 * (l * l * theta_dot * theta_dot + l_dot * l_dot);
    const Real T = x_dot * (k3 * x_dot + z1) + z2;
    const Real z3 = k1 * z0;
    const Real V = -z3;
    const Real E = T - z3;
    const Real z4 = l_dot * (k1 + S0 * cos_phi0);
    const Real P = x_dot * F0 * sin_phi0 - z4;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = P;
    jacobi[0] = E;
}

/// The scene's outputs.
template <typename Real>
void outputs_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {
    const Real &x = state[0], &l = state[1], &theta = state[2];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);

    // Outputs
    const Real load_x = x + l * sin_theta;
    const Real load_y = -l * cos_theta;

    // Result
    out[0] = load_x;
    out[1] = load_y;
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

constexpr const char* coordinate_names[] = { "x", "l", "theta", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "M", "m", "g", "F0", "S0", "w", nullptr};
constexpr const char* output_names[] = { "load_x", "load_y", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 50, 20, 9.81, 30, 4, 1.5, 0};

constexpr alembert_solver_table table{
    3, 3, 3, 6, 6, 2, 0, 0, "crane", "lagrange, textbook form",
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
