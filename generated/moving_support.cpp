// Equations of motion of 'moving_support': lagrange, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
//   state  phi [rad], then their rates
//   par    m [kg], l [m], a [m], gamma [rad/s], g [m/s^2]
//   cost   18 operations a right-hand side: 2 additions, 12 multiplications, 0 divisions, 4 functions
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
    const Real &m = par[0], &l = par[1], &g = par[4];

    // Constants
    const Real M00 = m * l * l;
    const Real k0 = m * l;
    const Real k1 = m * l * g;
    const Real k2 = Real(1) / M00;
    const Real k3 = Real(0.5) * M00;
    const Real k4 = Real(0.5) * m;
    const Real k5 = m * g;

    // Result
    par[5] = M00;
    par[6] = k0;
    par[7] = k1;
    par[8] = k2;
    par[9] = k3;
    par[10] = k4;
    par[11] = k5;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate) {
    const Real &phi = state[0], &phi_dot = state[1];
    const Real &a = par[2], &gamma = par[3], &M00 = par[5], &k0 = par[6], &k1 = par[7], &k2 = par[8];

    // Trigonometry
    const Real phi0 = gamma * t;
    const auto [sin_phi0, cos_phi0] = sincos(phi0);
    const auto [sin_phi, cos_phi] = sincos(phi);

    // Forcing f
    const Real z0 = k0 * a * gamma * gamma * cos_phi0 * cos_phi;
    const Real z1 = k1 - k0 * a * gamma * gamma * sin_phi0;
    const Real f0 = z0 - z1 * sin_phi;

    // Solve M q'' = f with M = L D L^T
    const Real phi_ddot = k2 * f0;

    // Result
    rate[0] = phi_dot;
    rate[1] = phi_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, Real* mass, Real* forcing) {
    const Real &phi = state[0];
    const Real &a = par[2], &gamma = par[3], &M00 = par[5], &k0 = par[6], &k1 = par[7];

    // Trigonometry
    const Real phi0 = gamma * t;
    const auto [sin_phi0, cos_phi0] = sincos(phi0);
    const auto [sin_phi, cos_phi] = sincos(phi);

    // Forcing f
    const Real z0 = k0 * a * gamma * gamma * cos_phi0 * cos_phi;
    const Real z1 = k1 - k0 * a * gamma * gamma * sin_phi0;
    const Real f0 = z0 - z1 * sin_phi;

    // Result
    mass[0] = M00;
    forcing[0] = f0;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, Real* energy, Real* jacobi) {
    const Real &phi = state[0], &phi_dot = state[1];
    const Real &phi_ddot = rate[1];
    const Real &m = par[0], &a = par[2], &gamma = par[3], &k0 = par[6], &k1 = par[7], &k3 = par[9], &k4 = par[10];
    const Real &k5 = par[11];

    // Trigonometry
    const Real phi0 = gamma * t;
    const auto [sin_phi0, cos_phi0] = sincos(phi0);
    const auto [sin_phi, cos_phi] = sincos(phi);

    // Energy
    const Real z0 = gamma * cos_phi0;
    const Real z1 = gamma * sin_phi0;
    const Real z2 = k3 * phi_dot * phi_dot;
    const Real z3 = a * z0;
    const Real z4 = k4 * z3 * z3;
    const Real z5 = a * z1;
    const Real z6 = k4 * z5 * z5;
    const Real z7 = z5 * cos_phi - z3 * sin_phi;
    const Real T = (z2 + z4 + z6) - k0 * phi_dot * z7;
    const Real z8 = k1 * cos_phi;
    const Real z9 = k5 * a * sin_phi0;
    const Real z10 = z8 - z9;
    const Real V = -z10;
    const Real E = T - z10;
    const Real z11 = z5 * a * gamma * z0;
    const Real z12 = m * (z11 - z3 * a * gamma * z1);
    const Real z13 = phi_dot * phi_dot * (z3 * cos_phi + z5 * sin_phi);
    const Real z14 = k5 * z3 + k0 * (z13 - phi_ddot * z7);
    const Real P = z12 + z14;
    const Real h = z2 - z8 + z9 - z4 - z6;

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
    const Real &phi = state[0];
    const Real &l = par[1], &a = par[2], &gamma = par[3];

    // Trigonometry
    const Real phi0 = gamma * t;
    const auto [sin_phi0, cos_phi0] = sincos(phi0);
    const auto [sin_phi, cos_phi] = sincos(phi);

    // Outputs
    const Real z0 = l * cos_phi - a * sin_phi0;
    const Real z1 = l * sin_phi + a * cos_phi0;
    const Real reach = sqrt(z0 * z0 + z1 * z1);

    // Result
    out[0] = reach;
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

constexpr const char* coordinate_names[] = { "phi", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "l", "a", "gamma", "g", nullptr};
constexpr const char* output_names[] = { "reach", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 0.7, 0.15, 5, 9.81, 0};

constexpr alembert_solver_table table{
    3, 1, 1, 5, 7, 1, 0, 0, "moving_support", "lagrange, textbook form",
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
