// Equations of motion of 'watt_governor': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
//   state  alpha [rad], then their rates
//   par    m [kg], M [kg], l [m], Omega [rad/s], g [m/s^2]
//   cost   13 operations a right-hand side: 3 additions, 7 multiplications, 1 divisions, 2 functions
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
    const Real &m = par[0], &M = par[1], &l = par[2], &Omega = par[3], &g = par[4];

    // Constants
    const Real k0 = Real(2) * m * l * l;
    const Real k1 = Real(4) * M * l * l;
    const Real k2 = Real(2) * l * g * (m + M);
    const Real k3 = m * l * l * Omega * Omega;
    const Real k4 = Real(2) * k3;
    const Real k5 = l * l;
    const Real k6 = Real(2) * M;
    const Real k7 = Real(4) * k3;
    const Real k8 = Real(2) * l;

    // Result
    par[5] = k0;
    par[6] = k1;
    par[7] = k2;
    par[8] = k3;
    par[9] = k4;
    par[10] = k5;
    par[11] = k6;
    par[12] = k7;
    par[13] = k8;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate) {
    const Real &alpha = state[0], &alpha_dot = state[1];
    const Real &k0 = par[5], &k1 = par[6], &k2 = par[7], &k4 = par[9];

    // Trigonometry
    const auto [sin_alpha, cos_alpha] = sincos(alpha);

    // Mass matrix M(q), lower triangle
    const Real M00 = k0 + k1 * sin_alpha * sin_alpha;

    // Forcing f
    const Real z0 = (k2 - (k4 - k1 * alpha_dot * alpha_dot) * cos_alpha) * sin_alpha;
    const Real f0 = -z0;

    // Solve M q'' = f with M = L D L^T
    const Real alpha_ddot = -z0 / M00;

    // Result
    rate[0] = alpha_dot;
    rate[1] = alpha_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, Real* mass, Real* forcing) {
    const Real &alpha = state[0], &alpha_dot = state[1];
    const Real &k0 = par[5], &k1 = par[6], &k2 = par[7], &k4 = par[9];

    // Trigonometry
    const auto [sin_alpha, cos_alpha] = sincos(alpha);

    // Mass matrix M(q), lower triangle
    const Real M00 = k0 + k1 * sin_alpha * sin_alpha;

    // Forcing f
    const Real z0 = (k2 - (k4 - k1 * alpha_dot * alpha_dot) * cos_alpha) * sin_alpha;
    const Real f0 = -z0;

    // Result
    mass[0] = M00;
    forcing[0] = f0;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, Real* energy, Real* jacobi) {
    const Real &alpha = state[0], &alpha_dot = state[1];
    const Real &m = par[0], &k2 = par[7], &k3 = par[8], &k5 = par[10], &k6 = par[11], &k7 = par[12];

    // Trigonometry
    const auto [sin_alpha, cos_alpha] = sincos(alpha);

    // Energy
    const Real z0 = k3 * sin_alpha * sin_alpha;
    const Real z1 = k5 * alpha_dot * alpha_dot * (m + k6 * sin_alpha * sin_alpha);
    const Real T = z0 + z1;
    const Real z2 = k2 * cos_alpha;
    const Real V = -z2;
    const Real E = T - z2;
    const Real P = k7 * alpha_dot * sin_alpha * cos_alpha;
    const Real h = z1 - z0 - z2;

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
    const Real &alpha = state[0], &alpha_dot = state[1];
    const Real &m = par[0], &l = par[2], &Omega = par[3], &k8 = par[13];

    // Trigonometry
    const auto [sin_alpha, cos_alpha] = sincos(alpha);
    const Real phi0 = Omega * t;
    const auto [sin_phi0, cos_phi0] = sincos(phi0);

    // Outputs
    const Real lift = k8 - Real(2) * l * cos_alpha;
    const Real z0 = l * sin_alpha;
    const Real z1 = l * alpha_dot * cos_alpha;
    const Real z2 = z1 * sin_phi0 + z0 * Omega * cos_phi0;
    const Real z3 = z0 * Omega * sin_phi0 - z1 * cos_phi0;
    const Real z4 = z0 * cos_phi0 * z2 + z0 * sin_phi0 * z3;
    const Real spin = Real(2) * m * z4;

    // Result
    out[0] = lift;
    out[1] = spin;
}

/// The scene's event functions.
template <typename Real>
void events_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {
    const Real &alpha_dot = state[1];

    // Result
    out[0] = alpha_dot;
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

constexpr const char* coordinate_names[] = { "alpha", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "M", "l", "Omega", "g", nullptr};
constexpr const char* output_names[] = { "lift", "spin", nullptr};
constexpr const char* event_names[] = { "sleeve_turns_back", nullptr};
constexpr double parameter_values[] = { 1, 2, 0.4, 12, 9.81, 0};

constexpr alembert_solver_table table{
    3, 1, 1, 5, 9, 2, 1, 0, "watt_governor", "lagrange, textbook form",
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
