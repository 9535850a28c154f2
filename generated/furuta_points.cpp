// Equations of motion of 'furuta_points': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
//   state  phi [rad], theta [rad], then their rates
//   par    M [kg], m [kg], r [m], l [m], g [m/s^2], tau0 [N*m], w [rad/s]
//   cost   30 operations a right-hand side: 7 additions, 19 multiplications, 1 divisions, 3 functions
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
    const Real &M = par[0], &m = par[1], &r = par[2], &l = par[3], &g = par[4];

    // Constants
    const Real k0 = r * r * (M + m);
    const Real M11 = m * l * l;
    const Real k1 = m * r * l;
    const Real k2 = Real(2) * M11;
    const Real k3 = m * l * g;
    const Real k4 = Real(1) / M11;
    const Real k5 = Real(0.5) * M11;

    // Result
    par[7] = k0;
    par[8] = M11;
    par[9] = k1;
    par[10] = k2;
    par[11] = k3;
    par[12] = k4;
    par[13] = k5;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate) {
    const Real &theta = state[1], &phi_dot = state[2], &theta_dot = state[3];
    const Real &tau0 = par[5], &w = par[6], &k0 = par[7], &M11 = par[8], &k1 = par[9], &k2 = par[10];
    const Real &k3 = par[11], &k4 = par[12];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);
    const Real phi0 = w * t;
    const Real cos_phi0 = cos(phi0);

    // Mass matrix M(q), lower triangle
    const Real M00 = k0 + M11 * sin_theta * sin_theta;
    const Real M10 = k1 * cos_theta;

    // Forcing f
    const Real z0 = phi_dot * cos_theta;
    const Real z1 = theta_dot * (k1 * theta_dot - k2 * z0) * sin_theta;
    const Real f0 = z1 + tau0 * cos_phi0;
    const Real z2 = (k3 - M11 * phi_dot * z0) * sin_theta;
    const Real f1 = -z2;

    // Solve M q'' = f with M = L D L^T
    const Real z3 = k4 * M10;
    const Real z4 = Real(1) / (M00 - M10 * z3);
    const Real phi_ddot = z4 * (f0 + z3 * z2);
    const Real theta_ddot = -phi_ddot * z3 - k4 * z2;

    // Result
    rate[0] = phi_dot;
    rate[1] = theta_dot;
    rate[2] = phi_ddot;
    rate[3] = theta_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, Real* mass, Real* forcing) {
    const Real &theta = state[1], &phi_dot = state[2], &theta_dot = state[3];
    const Real &tau0 = par[5], &w = par[6], &k0 = par[7], &M11 = par[8], &k1 = par[9], &k2 = par[10];
    const Real &k3 = par[11];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);
    const Real phi0 = w * t;
    const Real cos_phi0 = cos(phi0);

    // Mass matrix M(q), lower triangle
    const Real M00 = k0 + M11 * sin_theta * sin_theta;
    const Real M10 = k1 * cos_theta;

    // Forcing f
    const Real z0 = phi_dot * cos_theta;
    const Real z1 = theta_dot * (k1 * theta_dot - k2 * z0) * sin_theta;
    const Real f0 = z1 + tau0 * cos_phi0;
    const Real f1 = -(k3 - M11 * phi_dot * z0) * sin_theta;

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
    const Real &theta = state[1], &phi_dot = state[2], &theta_dot = state[3];
    const Real &tau0 = par[5], &w = par[6], &k0 = par[7], &M11 = par[8], &k1 = par[9], &k3 = par[11];
    const Real &k5 = par[13];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);
    const Real phi0 = w * t;
    const Real cos_phi0 = cos(phi0);

    // Energy
    const Real z0 = theta_dot * (k5 * theta_dot + k1 * phi_dot * cos_theta);
    const Real T = Real(0.5) * phi_dot * phi_dot * (k0 + M11 * sin_theta * sin_theta) + z0;
    const Real z1 = k3 * cos_theta;
    const Real V = -z1;
    const Real E = T - z1;
    const Real P = phi_dot * tau0 * cos_phi0;

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
    const Real &phi = state[0], &theta = state[1], &phi_dot = state[2], &theta_dot = state[3];
    const Real &M = par[0], &m = par[1], &r = par[2], &l = par[3];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);
    const auto [sin_phi, cos_phi] = sincos(phi);

    // Outputs
    const Real z0 = r * cos_phi;
    const Real z1 = phi_dot * cos_phi;
    const Real z2 = r * z1;
    const Real z3 = r * sin_phi;
    const Real z4 = phi_dot * sin_phi;
    const Real z5 = r * z4;
    const Real z6 = l * sin_theta;
    const Real z7 = l * theta_dot * cos_theta;
    const Real z8 = z5 + (z6 * z1 + z7 * sin_phi);
    const Real z9 = (z3 + z6 * cos_phi) * z8;
    const Real z10 = z2 - (z6 * z4 - z7 * cos_phi);
    const Real z11 = m * (z9 + (z0 - z6 * sin_phi) * z10);
    const Real momentum = M * (z0 * z2 + z3 * z5) + z11;

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

constexpr const char* coordinate_names[] = { "phi", "theta", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "M", "m", "r", "l", "g", "tau0", "w", nullptr};
constexpr const char* output_names[] = { "momentum", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.6, 0.3, 0.25, 0.35, 9.81, 0.05, 4, 0};

constexpr alembert_solver_table table{
    3, 2, 2, 7, 7, 1, 0, 0, "furuta_points", "lagrange, textbook form",
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
