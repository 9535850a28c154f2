// Equations of motion of 'four_bar_joints': routh, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
//   state  alpha [rad], beta [rad], gamma [rad], then their rates
//   par    a [m], b [m], c [m], d [m], m1 [kg], m2 [kg], m3 [kg]
//   cost   115 operations a right-hand side: 39 additions, 67 multiplications, 3 divisions, 6 functions
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
    const Real &a = par[0], &b = par[1], &c = par[2], &m1 = par[4], &m2 = par[5], &m3 = par[6];

    // Constants
    const Real k0 = a * a * m1;
    const Real z0 = b * b * m2;
    const Real k1 = a * a * m2 + (Real(1) / Real(3)) * k0 + (Real(1) / Real(3)) * z0;
    const Real k2 = a * b * m2;
    const Real M11 = (Real(1) / Real(3)) * z0;
    const Real k3 = Real(0.5) * k2;
    const Real z1 = c * c * m3;
    const Real M22 = (Real(1) / Real(3)) * z1;
    const Real k4 = Real(2) * c;
    const Real k5 = Real(3) * Real(1) / z0;
    const Real k6 = Real(3) * Real(1) / z1;
    const Real k7 = (Real(1) / Real(6)) * b * m2;
    const Real k8 = Real(2) * b;
    const Real k9 = Real(3) * a;
    const Real k10 = Real(3) * a * a + b * b;
    const Real k11 = Real(3) * a * b;
    const Real k12 = (Real(1) / Real(6)) * z0;
    const Real k13 = (Real(1) / Real(6)) * z1;

    // Result
    par[7] = k0;
    par[8] = k1;
    par[9] = k2;
    par[10] = M11;
    par[11] = k3;
    par[12] = M22;
    par[13] = k4;
    par[14] = k5;
    par[15] = k6;
    par[16] = k7;
    par[17] = k8;
    par[18] = k9;
    par[19] = k10;
    par[20] = k11;
    par[21] = k12;
    par[22] = k13;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate) {
    const Real &alpha = state[0], &beta = state[1], &gamma = state[2], &alpha_dot = state[3];
    const Real &beta_dot = state[4], &gamma_dot = state[5];
    const Real &a = par[0], &c = par[2], &d = par[3], &k1 = par[8], &k2 = par[9], &M11 = par[10], &k3 = par[11];
    const Real &M22 = par[12], &k4 = par[13], &k5 = par[14], &k6 = par[15];

    // Trigonometry
    const auto [sin_beta, cos_beta] = sincos(beta);
    const Real phi0 = alpha + beta;
    const Real phi1 = gamma - phi0;
    const auto [sin_phi1, cos_phi1] = sincos(phi1);
    const auto [sin_phi0, cos_phi0] = sincos(phi0);

    // Mass matrix M(q), lower triangle
    const Real M00 = k1 + k2 * cos_beta;
    const Real M10 = M11 + k3 * cos_beta;

    // Forcing f
    const Real f0 = beta_dot * (k2 * alpha_dot + k3 * beta_dot) * sin_beta;
    const Real z0 = k3 * alpha_dot * alpha_dot * sin_beta;
    const Real f1 = -z0;

    // Constraints A q'' = gamma
    const Real z1 = c * sin_phi1;
    const Real A0_0 = z1 - d * sin_phi0;
    const Real A0_1 = a * sin_beta + A0_0;
    const Real A0_2 = -z1;
    const Real A1_2 = c * cos_phi1;
    const Real z2 = A1_2 + d * cos_phi0;
    const Real A1_1 = a * cos_beta - z2;
    const Real z3 = beta_dot * beta_dot;
    const Real z4 = gamma_dot * (c * gamma_dot - k4 * (alpha_dot + beta_dot));
    const Real z5 = A1_1 * z3 - z4 * cos_phi1;
    const Real z6 = alpha_dot + Real(2) * beta_dot;
    const Real z7 = z5 - alpha_dot * z2 * z6;
    const Real gamma0 = -z7;
    const Real A1_0 = -z2;
    const Real z8 = A0_1 * z3 + z4 * sin_phi1;
    const Real gamma1 = z8 + alpha_dot * A0_0 * z6;

    // Solve M q'' = f + A^T lambda, A q'' = gamma
    const Real z9 = k5 * M10;
    const Real z10 = f0 + z0 * z9;
    const Real z11 = Real(1) / (M00 - M10 * z9);
    const Real z12 = k5 * A0_1;
    const Real z13 = M10 * z12 - A0_0;
    const Real z14 = z11 * z13;
    const Real z15 = k6 * z1;
    const Real z16 = (A0_1 * z12 + z1 * z15) + z13 * z14;
    const Real z17 = k5 * A1_1;
    const Real z18 = k6 * A1_2;
    const Real z19 = M10 * z17 + z2;
    const Real z20 = z11 * z19;
    const Real z21 = (A0_1 * z17 - z1 * z18) + z13 * z20;
    const Real z22 = (A1_1 * z17 + A1_2 * z18) + z19 * z20;
    const Real z23 = Real(1) / z22;
    const Real z24 = z21 * z23;
    const Real z25 = Real(1) / (z16 - z21 * z24);
    const Real z26 = (z0 * z12 - z7) + z10 * z14;
    const Real z27 = (z0 * z17 + gamma1) + z10 * z20;
    const Real z28 = z25 * (z26 - z27 * z24);
    const Real z29 = z23 * z27 - z24 * z28;
    const Real alpha_ddot = z10 * z11 - z14 * z28 - z20 * z29;
    const Real z30 = k5 * z0;
    const Real z31 = z30 - z12 * z28 - z17 * z29 + z9 * alpha_ddot;
    const Real beta_ddot = -z31;
    const Real gamma_ddot = z29 * z18 - z28 * z15;

    // Result
    rate[0] = alpha_dot;
    rate[1] = beta_dot;
    rate[2] = gamma_dot;
    rate[3] = alpha_ddot;
    rate[4] = beta_ddot;
    rate[5] = gamma_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, Real* mass, Real* forcing) {
    const Real &beta = state[1], &alpha_dot = state[3], &beta_dot = state[4];
    const Real &k1 = par[8], &k2 = par[9], &M11 = par[10], &k3 = par[11], &M22 = par[12];

    // Trigonometry
    const auto [sin_beta, cos_beta] = sincos(beta);

    // Mass matrix M(q), lower triangle
    const Real M00 = k1 + k2 * cos_beta;
    const Real M10 = M11 + k3 * cos_beta;

    // Forcing f
    const Real f0 = beta_dot * (k2 * alpha_dot + k3 * beta_dot) * sin_beta;
    const Real f1 = -k3 * alpha_dot * alpha_dot * sin_beta;

    // Result
    mass[0] = M00;
    mass[1] = mass[3] = M10;
    mass[4] = M11;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = M22;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = Real(0);
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, Real* energy, Real* jacobi) {
    const Real &beta = state[1], &alpha_dot = state[3], &beta_dot = state[4], &gamma_dot = state[5];
    const Real &m2 = par[5], &k0 = par[7], &k7 = par[16], &k8 = par[17], &k9 = par[18], &k10 = par[19];
    const Real &k11 = par[20], &k12 = par[21], &k13 = par[22];

    // Trigonometry
    const Real cos_beta = cos(beta);

    // Energy
    const Real z0 = alpha_dot * (k0 + m2 * (k10 + k11 * cos_beta));
    const Real z1 = k7 * beta_dot * (k8 + k9 * cos_beta) + (Real(1) / Real(6)) * z0;
    const Real z2 = k12 * beta_dot * beta_dot + k13 * gamma_dot * gamma_dot;
    const Real T = alpha_dot * z1 + z2;

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


}

/// The scene's event functions.
template <typename Real>
void events_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {


}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* position, [[maybe_unused]] Real* velocity, [[maybe_unused]] Real* rows) {
    const Real &alpha = state[0], &beta = state[1], &gamma = state[2], &alpha_dot = state[3];
    const Real &beta_dot = state[4], &gamma_dot = state[5];
    const Real &a = par[0], &b = par[1], &c = par[2], &d = par[3];

    // Trigonometry
    const auto [sin_beta, cos_beta] = sincos(beta);
    const Real phi0 = alpha + beta;
    const Real phi1 = gamma - phi0;
    const auto [sin_phi1, cos_phi1] = sincos(phi1);
    const auto [sin_phi0, cos_phi0] = sincos(phi0);
    const auto [sin_alpha, cos_alpha] = sincos(alpha);
    const auto [sin_gamma, cos_gamma] = sincos(gamma);

    // Constraints
    const Real z0 = c * sin_phi1;
    const Real z1 = z0 - d * sin_phi0;
    const Real z2 = a * sin_beta + z1;
    const Real z3 = c * cos_phi1;
    const Real z4 = z3 + d * cos_phi0;
    const Real z5 = a * cos_beta - z4;
    const Real z6 = b * sin_phi0;
    const Real z7 = ((a * sin_alpha + Real(0.5) * z6) + Real(0.5) * z6) - c * sin_gamma;
    const Real z8 = b * cos_phi0;
    const Real z9 = (a * cos_alpha + Real(0.5) * z8) + Real(0.5) * z8;
    const Real z10 = c * cos_gamma;
    const Real z11 = z9 - (Real(0.5) * z10 + (d + Real(0.5) * z10));

    // Result
    position[0] = -z7 * sin_phi0 - z11 * cos_phi0;
    position[1] = z11 * sin_phi0 - z7 * cos_phi0;
    velocity[0] = beta_dot * z2 - gamma_dot * z0 + alpha_dot * z1;
    velocity[1] = beta_dot * z5 + gamma_dot * z3 - alpha_dot * z4;
    rows[0] = z1;
    rows[1] = z2;
    rows[2] = -z0;
    rows[3] = -z4;
    rows[4] = z5;
    rows[5] = z3;
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* lambda) {
    const Real &alpha = state[0], &beta = state[1], &gamma = state[2], &alpha_dot = state[3];
    const Real &beta_dot = state[4], &gamma_dot = state[5];
    const Real &a = par[0], &c = par[2], &d = par[3], &k1 = par[8], &k2 = par[9], &M11 = par[10], &k3 = par[11];
    const Real &k4 = par[13], &k5 = par[14], &k6 = par[15];

    // Trigonometry
    const auto [sin_beta, cos_beta] = sincos(beta);
    const Real phi0 = alpha + beta;
    const Real phi1 = gamma - phi0;
    const auto [sin_phi1, cos_phi1] = sincos(phi1);
    const auto [sin_phi0, cos_phi0] = sincos(phi0);

    // Multipliers
    const Real z0 = M11 + k3 * cos_beta;
    const Real z1 = beta_dot * (k2 * alpha_dot + k3 * beta_dot) * sin_beta;
    const Real z2 = k3 * alpha_dot * alpha_dot * sin_beta;
    const Real z3 = c * sin_phi1;
    const Real z4 = z3 - d * sin_phi0;
    const Real z5 = a * sin_beta + z4;
    const Real z6 = c * cos_phi1;
    const Real z7 = z6 + d * cos_phi0;
    const Real z8 = a * cos_beta - z7;
    const Real z9 = beta_dot * beta_dot;
    const Real z10 = gamma_dot * (c * gamma_dot - k4 * (alpha_dot + beta_dot));
    const Real z11 = z8 * z9 - z10 * cos_phi1;
    const Real z12 = alpha_dot + Real(2) * beta_dot;
    const Real z13 = z5 * z9 + z10 * sin_phi1;
    const Real z14 = k5 * z0;
    const Real z15 = z1 + z2 * z14;
    const Real z16 = Real(1) / ((k1 + k2 * cos_beta) - z0 * z14);
    const Real z17 = k5 * z5;
    const Real z18 = z0 * z17 - z4;
    const Real z19 = z16 * z18;
    const Real z20 = z5 * z17 + z3 * k6 * z3;
    const Real z21 = k5 * z8;
    const Real z22 = k6 * z6;
    const Real z23 = z0 * z21 + z7;
    const Real z24 = z16 * z23;
    const Real z25 = (z5 * z21 - z3 * z22) + z18 * z24;
    const Real z26 = (z8 * z21 + z6 * z22) + z23 * z24;
    const Real z27 = Real(1) / z26;
    const Real z28 = z25 * z27;
    const Real z29 = Real(1) / ((z20 + z18 * z19) - z25 * z28);
    const Real z30 = z2 * z17 - (z11 - alpha_dot * z7 * z12);
    const Real z31 = z2 * z21 + (z13 + alpha_dot * z4 * z12);
    const Real z32 = z31 + z15 * z24;
    const Real lambda_J4_1 = z29 * ((z30 + z15 * z19) - z32 * z28);
    const Real lambda_J4_2 = z27 * z32 - z28 * lambda_J4_1;

    // Result
    lambda[0] = lambda_J4_1;
    lambda[1] = lambda_J4_2;
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

constexpr const char* coordinate_names[] = { "alpha", "beta", "gamma", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "a", "b", "c", "d", "m1", "m2", "m3", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 4, 3.5, 3, 1, 2, 1.5, 0};

constexpr alembert_solver_table table{
    3, 3, 3, 7, 16, 0, 0, 2, "four_bar_joints", "routh, textbook form",
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
