// Equations of motion of 'cart_pole': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
//   state  x [m], theta [rad], then their rates
//   par    M [kg], m [kg], l [m], b [N s/m], F0 [N], w [rad/s], g [m/s^2]
//   cost   23 operations a right-hand side: 5 additions, 14 multiplications, 1 divisions, 3 functions
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
    const Real &M = par[0], &m = par[1], &l = par[2], &g = par[6];

    // Constants
    const Real M00 = M + m;
    const Real k0 = m * l;
    const Real M11 = m * l * l;
    const Real k1 = m * l * g;
    const Real k2 = Real(1) / M11;
    const Real k3 = Real(0.5) * M00;
    const Real k4 = Real(0.5) * M11;

    // Result
    par[7] = M00;
    par[8] = k0;
    par[9] = M11;
    par[10] = k1;
    par[11] = k2;
    par[12] = k3;
    par[13] = k4;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate) {
    const Real &theta = state[1], &x_dot = state[2], &theta_dot = state[3];
    const Real &b = par[3], &F0 = par[4], &w = par[5], &M00 = par[7], &k0 = par[8], &M11 = par[9], &k1 = par[10];
    const Real &k2 = par[11];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);
    const Real phi0 = w * t;
    const Real cos_phi0 = cos(phi0);

    // Mass matrix M(q), lower triangle
    const Real M10 = k0 * cos_theta;

    // Forcing f
    const Real f0 = k0 * theta_dot * theta_dot * sin_theta - b * x_dot + F0 * cos_phi0;
    const Real f1 = k1 * sin_theta;

    // Solve M q'' = f with M = L D L^T
    const Real z0 = k2 * M10;
    const Real z1 = Real(1) / (M00 - M10 * z0);
    const Real x_ddot = z1 * (f0 - f1 * z0);
    const Real theta_ddot = k2 * f1 - x_ddot * z0;

    // Result
    rate[0] = x_dot;
    rate[1] = theta_dot;
    rate[2] = x_ddot;
    rate[3] = theta_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, Real* mass, Real* forcing) {
    const Real &theta = state[1], &x_dot = state[2], &theta_dot = state[3];
    const Real &b = par[3], &F0 = par[4], &w = par[5], &M00 = par[7], &k0 = par[8], &M11 = par[9], &k1 = par[10];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);
    const Real phi0 = w * t;
    const Real cos_phi0 = cos(phi0);

    // Mass matrix M(q), lower triangle
    const Real M10 = k0 * cos_theta;

    // Forcing f
    const Real f0 = k0 * theta_dot * theta_dot * sin_theta - b * x_dot + F0 * cos_phi0;
    const Real f1 = k1 * sin_theta;

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
    const Real &theta = state[1], &x_dot = state[2], &theta_dot = state[3];
    const Real &b = par[3], &F0 = par[4], &w = par[5], &k0 = par[8], &k1 = par[10], &k3 = par[12], &k4 = par[13];

    // Trigonometry
    const Real cos_theta = cos(theta);
    const Real phi0 = w * t;
    const Real cos_phi0 = cos(phi0);

    // Energy
    const Real z0 = k0 * x_dot * theta_dot * cos_theta;
    const Real T = k3 * x_dot * x_dot + k4 * theta_dot * theta_dot + z0;
    const Real V = k1 * cos_theta;
    const Real E = T + V;
    const Real P = x_dot * F0 * cos_phi0 - b * x_dot * x_dot;

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
    const Real &theta = state[1], &x_dot = state[2];
    const Real &l = par[2], &F0 = par[4], &w = par[5];

    // Trigonometry
    const Real cos_theta = cos(theta);
    const Real phi0 = w * t;
    const Real cos_phi0 = cos(phi0);

    // Outputs
    const Real power = x_dot * F0 * cos_phi0;
    const Real height = l * cos_theta;

    // Result
    out[0] = height;
    out[1] = power;
}

/// The scene's event functions.
template <typename Real>
void events_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {
    const Real &theta = state[1];

    // Trigonometry
    const Real cos_theta = cos(theta);

    // Result
    out[0] = cos_theta;
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

constexpr const char* coordinate_names[] = { "x", "theta", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "M", "m", "l", "b", "F0", "w", "g", nullptr};
constexpr const char* output_names[] = { "height", "power", nullptr};
constexpr const char* event_names[] = { "pole_level", nullptr};
constexpr double parameter_values[] = { 1, 0.3, 0.5, 0.2, 2, 4, 9.81, 0};

constexpr alembert_solver_table table{
    3, 2, 2, 7, 7, 2, 1, 0, "cart_pole", "lagrange, textbook form",
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
