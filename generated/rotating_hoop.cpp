// Equations of motion of 'rotating_hoop': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
//   state  theta [rad], then their rates
//   par    m [kg], R [m], Omega [rad/s], g [m/s^2]
//   cost   6 operations a right-hand side: 1 additions, 3 multiplications, 0 divisions, 2 functions
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
    const Real &m = par[0], &R = par[1], &Omega = par[2], &g = par[3];

    // Constants
    const Real M00 = m * R * R;
    const Real k0 = m * R * g;
    const Real k1 = m * R * R * Omega * Omega;
    const Real k2 = Real(1) / M00;
    const Real k3 = Real(0.5) * M00;
    const Real k4 = Real(0.5) * k1;
    const Real k5 = Real(2) * k1;

    // Result
    par[4] = M00;
    par[5] = k0;
    par[6] = k1;
    par[7] = k2;
    par[8] = k3;
    par[9] = k4;
    par[10] = k5;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate) {
    const Real &theta = state[0], &theta_dot = state[1];
    const Real &M00 = par[4], &k0 = par[5], &k1 = par[6], &k2 = par[7];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);

    // Forcing f
    const Real z0 = (k0 - k1 * cos_theta) * sin_theta;
    const Real f0 = -z0;

    // Solve M q'' = f with M = L D L^T
    const Real theta_ddot = -k2 * z0;

    // Result
    rate[0] = theta_dot;
    rate[1] = theta_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, Real* mass, Real* forcing) {
    const Real &theta = state[0];
    const Real &M00 = par[4], &k0 = par[5], &k1 = par[6];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);

    // Forcing f
    const Real f0 = -(k0 - k1 * cos_theta) * sin_theta;

    // Result
    mass[0] = M00;
    forcing[0] = f0;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, Real* energy, Real* jacobi) {
    const Real &theta = state[0], &theta_dot = state[1];
    const Real &k0 = par[5], &k3 = par[8], &k4 = par[9], &k5 = par[10];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);

    // Energy
    const Real z0 = k3 * theta_dot * theta_dot;
    const Real z1 = k4 * sin_theta * sin_theta;
    const Real T = z0 + z1;
    const Real z2 = k0 * cos_theta;
    const Real V = -z2;
    const Real E = T - z2;
    const Real P = k5 * theta_dot * sin_theta * cos_theta;
    const Real h = z0 - z2 - z1;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = P;
    jacobi[0] = h;
}

/// The scene's outputs.
template <typename Real>
void outputs_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {
    const Real &theta = state[0], &theta_dot = state[1];
    const Real &m = par[0], &R = par[1], &Omega = par[2];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);
    const Real phi0 = Omega * t;
    const auto [sin_phi0, cos_phi0] = sincos(phi0);

    // Outputs
    const Real height = -R * (cos_theta - Real(1));
    const Real z0 = R * theta_dot * sin_theta * sin_theta;
    const Real z1 = theta_dot * cos_theta;
    const Real z2 = R * (cos_phi0 * z1 - Omega * sin_phi0 * sin_theta);
    const Real z3 = z2 * cos_phi0 * cos_theta;
    const Real z4 = R * (sin_phi0 * z1 + Omega * cos_phi0 * sin_theta);
    const Real speed_on_hoop = z0 + z3 + z4 * sin_phi0 * cos_theta;
    const Real z5 = R * sin_phi0 * sin_theta * z2;
    const Real z6 = m * (z5 - R * cos_phi0 * sin_theta * z4);
    const Real drive = -z6;

    // Result
    out[0] = height;
    out[1] = speed_on_hoop;
    out[2] = drive;
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

constexpr const char* coordinate_names[] = { "theta", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "R", "Omega", "g", nullptr};
constexpr const char* output_names[] = { "height", "speed_on_hoop", "drive", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.2, 0.5, 6, 9.81, 0};

constexpr alembert_solver_table table{
    3, 1, 1, 4, 7, 3, 0, 0, "rotating_hoop", "lagrange, textbook form",
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
