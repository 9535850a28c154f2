// Equations of motion of 'free_body_quaternion': kane, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
//   state  e0, e1, e2, e3, then w1 [rad/s], w2 [rad/s], w3 [rad/s]
//   par    A [kg m^2], B [kg m^2], C [kg m^2]
//   cost   30 operations a right-hand side: 8 additions, 22 multiplications, 0 divisions, 0 functions
//
// M(q) u' = f(q, u, t), q' = h(q, u, t). This file includes nothing and allocates nothing.

namespace {

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
// These pass a NaN on, whichever argument it is.
template <typename Real> Real sign(const Real& x) { return x != x ? x : Real(x > Real(0)) - Real(x < Real(0)); }
template <typename Real> Real min(const Real& x, const Real& y) { return y < x || y != y ? y : x; }
template <typename Real> Real max(const Real& x, const Real& y) { return x < y || y != y ? y : x; }


/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &A = par[0], &B = par[1], &C = par[2];

    // Constants
    const Real k0 = B - C;
    const Real k1 = A - C;
    const Real k2 = A - B;
    const Real k3 = k0 / A;
    const Real k4 = k1 / B;
    const Real k5 = k2 / C;
    const Real k6 = Real(0.5) * A;
    const Real k7 = Real(0.5) * B;
    const Real k8 = Real(0.5) * C;

    // Result
    par[3] = k0;
    par[4] = k1;
    par[5] = k2;
    par[6] = k3;
    par[7] = k4;
    par[8] = k5;
    par[9] = k6;
    par[10] = k7;
    par[11] = k8;
}

/// rate = (q', u') at t and state = (q, u).
template <typename Real>
void rhs([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];
    const Real &A = par[0], &B = par[1], &C = par[2], &k3 = par[6], &k4 = par[7], &k5 = par[8];

    // Kinematics q' = h(q, u, t)
    const Real e0_dot = -Real(0.5) * (e1 * w1 + e2 * w2 + e3 * w3);
    const Real e1_dot = Real(0.5) * (e0 * w1 + e2 * w3 - e3 * w2);
    const Real e2_dot = Real(0.5) * (e0 * w2 - e1 * w3 + e3 * w1);
    const Real e3_dot = Real(0.5) * (e0 * w3 + e1 * w2 - e2 * w1);

    // Solve M u' = f with M = L D L^T
    const Real w1_dot = k3 * w2 * w3;
    const Real w2_dot = -k4 * w1 * w3;
    const Real w3_dot = k5 * w1 * w2;

    // Result
    rate[0] = e0_dot;
    rate[1] = e1_dot;
    rate[2] = e2_dot;
    rate[3] = e3_dot;
    rate[4] = w1_dot;
    rate[5] = w2_dot;
    rate[6] = w3_dot;
}

/// M (s by s, row-major) and f of M u' = f.
template <typename Real>
void mass_forcing([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, Real* mass, Real* forcing) {
    const Real &w1 = state[4], &w2 = state[5], &w3 = state[6];
    const Real &A = par[0], &B = par[1], &C = par[2], &k0 = par[3], &k1 = par[4], &k2 = par[5];

    // Forcing f
    const Real f0 = k0 * w2 * w3;
    const Real f1 = -k1 * w1 * w3;
    const Real f2 = k2 * w1 * w2;

    // Result
    mass[0] = A;
    mass[1] = mass[3] = Real(0);
    mass[4] = B;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = C;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = f2;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, Real* energy, Real* jacobi) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];
    const Real &A = par[0], &B = par[1], &C = par[2], &k0 = par[3], &k1 = par[4], &k2 = par[5];

    // Energy
    const Real z0 = e0 * e0;
    const Real z1 = e1 * e1;
    const Real z2 = e2 * e2;
    const Real z3 = e3 * e3;
    const Real z4 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z5 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z6 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z7 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z8 = Real(1) / ((z0 + z1) + (z2 + z3));
    const Real z9 = z8 * z8;
    const Real z10 = A * z3 + B * z0 + C * z1;
    const Real z11 = z10 * z4 * z4 * z9;
    const Real z12 = e0 * e2;
    const Real z13 = e1 * e3;
    const Real z14 = z5 * z9;
    const Real z15 = (k1 * z12 + B * z13) * z7 * z14;
    const Real z16 = A * z2 + B * z1 + C * z0;
    const Real z17 = z16 * z5 * z14;
    const Real z18 = e2 * e3;
    const Real z19 = e0 * e1;
    const Real z20 = (A * z18 - k0 * z19) * z4 * z14;
    const Real z21 = e1 * e2;
    const Real z22 = e0 * e3;
    const Real z23 = z9 * z6;
    const Real z24 = (k2 * z21 - C * z22) * z5 * z23;
    const Real z25 = A * z1 + B * z2 + C * z3;
    const Real z26 = z25 * z23 * z6;
    const Real z27 = (k1 * z13 + B * z12) * z4 * z23;
    const Real z28 = (A * z19 - k0 * z18) * z7 * z23;
    const Real z29 = z7 * z9;
    const Real z30 = (k2 * z22 - C * z21) * z4 * z29;
    const Real z31 = A * z0 + B * z3 + C * z2;
    const Real z32 = z31 * z7 * z29;
    const Real T = Real(0.5) * z11 - z15 + Real(0.5) * z17 - z20 - z24 + Real(0.5) * z26 + z27 + z28 + z30
        + Real(0.5) * z32;

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
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];
    const Real &A = par[0], &B = par[1], &C = par[2], &k6 = par[9], &k7 = par[10], &k8 = par[11];

    // Outputs
    const Real z0 = e0 * e0;
    const Real z1 = e1 * e1;
    const Real z2 = z0 + z1;
    const Real z3 = e2 * e2;
    const Real z4 = e3 * e3;
    const Real z5 = z3 + z4;
    const Real z6 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z7 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z8 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z9 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z10 = Real(1) / (z2 + z5);
    const Real z11 = e0 * z9;
    const Real z12 = z11 + e3 * z6 - e2 * z7 + e1 * z8;
    const Real z13 = e3 * z9;
    const Real z14 = z13 - e0 * z6 - e1 * z7 - e2 * z8;
    const Real z15 = z10 * z14;
    const Real z16 = e2 * z9;
    const Real z17 = z16 - e1 * z6 + e0 * z7 + e3 * z8;
    const Real z18 = z10 * z17;
    const Real z19 = z10 * z12;
    const Real z20 = e0 * e2;
    const Real z21 = e1 * e3;
    const Real z22 = e2 * e3;
    const Real z23 = e0 * e1;
    const Real z24 = e1 * e2;
    const Real z25 = e0 * e3;
    const Real z26 = k6 * z19 * (z2 - z5) * z10;
    const Real z27 = B * z15;
    const Real z28 = z26 + z27 * (z25 - z24) * z10;
    const Real z29 = C * z18;
    const Real Hx = Real(2) * (z28 + z29 * (z20 + z21) * z10);
    const Real z30 = A * z19;
    const Real z31 = z0 - z1;
    const Real z32 = z3 - z4;
    const Real z33 = k7 * z15 * (z31 + z32) * z10;
    const Real z34 = z30 * (z25 + z24) * z10 - z33;
    const Real Hy = Real(2) * (z34 - z29 * (z23 - z22) * z10);
    const Real z35 = z30 * (z20 - z21) * z10;
    const Real z36 = z35 + z27 * (z23 + z22) * z10;
    const Real z37 = z36 - k8 * z18 * (z31 - z32) * z10;
    const Real Hz = -Real(2) * z37;

    // Result
    out[0] = Hx;
    out[1] = Hy;
    out[2] = Hz;
    out[3] = w1;
    out[4] = w2;
    out[5] = w3;
}

/// The scene's event functions.
template <typename Real>
void events_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {


}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* position, [[maybe_unused]] Real* velocity, [[maybe_unused]] Real* rows) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];

    // Constraints
    const Real z0 = (e0 * e0 + e1 * e1) + (e2 * e2 + e3 * e3);
    const Real z1 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z2 = e2 * z1;
    const Real z3 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z4 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z5 = e0 * w1 + e2 * w3 - e3 * w2;

    // Result
    position[0] = z0 - Real(1);
    velocity[0] = z2 + e3 * z3 - e0 * z4 + e1 * z5;
    rows[0] = Real(2) * e0;
    rows[1] = Real(2) * e1;
    rows[2] = Real(2) * e2;
    rows[3] = Real(2) * e3;
    rows[4] = Real(0);
    rows[5] = Real(0);
    rows[6] = Real(0);
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* lambda) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];
    const Real &A = par[0], &B = par[1], &C = par[2], &k3 = par[6], &k4 = par[7], &k5 = par[8], &k6 = par[9];
    const Real &k7 = par[10], &k8 = par[11];

    // Multipliers
    const Real z0 = (e0 * e0 + e1 * e1) + (e2 * e2 + e3 * e3);
    const Real z1 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z2 = e2 * z1;
    const Real z3 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z4 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z5 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z6 = z2 + e3 * z3 - e0 * z4 + e1 * z5;
    const Real z7 = k3 * w2 * w3;
    const Real z8 = k4 * w1 * w3;
    const Real z9 = k5 * w1 * w2;
    const Real z10 = Real(1) / z0;
    const Real z11 = (w2 * z5 - w1 * z1) - w3 * z4;
    const Real z12 = Real(0.5) * e2 * z7 + Real(0.5) * e1 * z8 - Real(0.5) * e0 * z9 - Real(0.25) * z11;
    const Real z13 = e2 * z10;
    const Real z14 = A * z13;
    const Real z15 = e0 * z10;
    const Real z16 = e1 * z10;
    const Real z17 = B * z16;
    const Real z18 = e3 * z10;
    const Real z19 = C * z15;
    const Real z20 = z14 * z15 + z17 * z18 - z19 * z13;
    const Real z21 = z12 * z20;
    const Real z22 = (w3 * z5 - w1 * z3) + w2 * z4;
    const Real z23 = Real(0.5) * e1 * z9 + Real(0.5) * e0 * z8 - Real(0.5) * e3 * z7 + Real(0.25) * z22;
    const Real z24 = A * z18;
    const Real z25 = B * z15;
    const Real z26 = C * z16;
    const Real z27 = z24 * z15 - z25 * z18 - z26 * z13;
    const Real z28 = z23 * z27;
    const Real z29 = w1 * z5 + (w3 * z3 + w2 * z1);
    const Real z30 = Real(0.5) * e2 * z8 - Real(0.5) * e3 * z9 - Real(0.5) * e1 * z7 - Real(0.25) * z29;
    const Real z31 = A * z15;
    const Real z32 = B * z18;
    const Real z33 = C * z13;
    const Real z34 = z31 * z16 - z32 * z13 + z33 * z18;
    const Real z35 = (w2 * z3 - w3 * z1) + w1 * z4;
    const Real z36 = Real(0.5) * e3 * z8 + Real(0.5) * e2 * z9 + Real(0.5) * e0 * z7 - Real(0.25) * z35;
    const Real z37 = z31 * z15 + z32 * z18 + z33 * z13;
    const Real z38 = e0 * z5;
    const Real z39 = z38 + e3 * z1 - e2 * z3 + e1 * z4;
    const Real z40 = z10 * z10 * z6;
    const Real z41 = e3 * z5;
    const Real z42 = z41 - e0 * z1 - e1 * z3 - e2 * z4;
    const Real z43 = z10 * z42;
    const Real z44 = k7 * z43;
    const Real z45 = e2 * z5;
    const Real z46 = z45 - e1 * z1 + e0 * z3 + e3 * z4;
    const Real z47 = z10 * z46;
    const Real z48 = k8 * z47;
    const Real z49 = z44 * z47 - z48 * z43;
    const Real z50 = k6 * z39 * z40 - z49;
    const Real z51 = z10 * z39;
    const Real z52 = k6 * z51;
    const Real z53 = z52 * z43 - z44 * z51;
    const Real z54 = z53 - k8 * z46 * z40;
    const Real z55 = z52 * z47 - z48 * z51;
    const Real z56 = z55 + k7 * z42 * z40;
    const Real z57 = z50 * z15 - z54 * z13 + z56 * z18;
    const Real z58 = z21 - z28 - z30 * z34 + z36 * z37 - z57;
    const Real z59 = e1 * z58;
    const Real z60 = z36 * z20;
    const Real z61 = z14 * z13 + z17 * z16 + z19 * z15;
    const Real z62 = z12 * z61;
    const Real z63 = z14 * z16 - z17 * z13 - z19 * z18;
    const Real z64 = z14 * z18 - z17 * z15 + z19 * z16;
    const Real z65 = z50 * z13 + z54 * z15 + z56 * z16;
    const Real z66 = z60 + z62 - z30 * z63 - z23 * z64 - z65;
    const Real z67 = z36 * z34;
    const Real z68 = A * z16 * z16;
    const Real z69 = B * z13 * z13;
    const Real z70 = z30 * (z68 + z69 + C * z18 * z18);
    const Real z71 = z24 * z16 + z25 * z13 - z26 * z18;
    const Real z72 = z54 * z18 - z50 * z16 + z56 * z13;
    const Real z73 = z67 - z70 - z23 * z71 + z12 * z63 + z72;
    const Real z74 = z30 * z71;
    const Real z75 = z12 * z64;
    const Real z76 = z24 * z18 + z25 * z15 + z26 * z16;
    const Real z77 = z50 * z18 - z56 * z15 + z54 * z16;
    const Real z78 = z74 - z75 + z23 * z76 - z36 * z27 + z77;
    const Real z79 = z59 - e3 * z66 - e0 * z73 - e2 * z78;
    const Real lambda_F = Real(2) * z79 * z10;

    // Result
    lambda[0] = lambda_F;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* out, Real* position, [[maybe_unused]] Real* pivots) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];

    // Projection
    const Real z0 = (e0 * e0 + e1 * e1) + (e2 * e2 + e3 * e3);
    const Real z1 = z0 - Real(1);
    const Real z2 = z1 / z0;

    // Result
    out[0] = e0 - Real(0.5) * e0 * z2;
    out[1] = e1 - Real(0.5) * e1 * z2;
    out[2] = e2 - Real(0.5) * e2 * z2;
    out[3] = e3 - Real(0.5) * e3 * z2;
    out[4] = w1;
    out[5] = w2;
    out[6] = w3;
    position[0] = z1;
    pivots[0] = Real(4) * z0;
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

constexpr const char* coordinate_names[] = { "e0", "e1", "e2", "e3", nullptr};
constexpr const char* speed_names[] = { "w1", "w2", "w3", nullptr};
constexpr const char* parameter_names[] = { "A", "B", "C", nullptr};
constexpr const char* output_names[] = { "Hx", "Hy", "Hz", "w1", "w2", "w3", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 2, 3, 0};

constexpr alembert_solver_table table{
    4, 4, 3, 3, 9, 6, 0, 1, "free_body_quaternion", "kane, textbook form",
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

namespace {

struct alembert_projection_table {
    int abi;
    void (*project)(double t, const double* state, const double* par, double* moved, double* position,
                    double* pivots);
    void (*gamma_at)(double t, const double* state, const double* par, double* gamma);
};

constexpr alembert_projection_table projection{
    4,
    [](double t, const double* state, const double* par, double* moved, double* position, double* pivots) {
        project(t, state, par, moved, position, pivots);
    },
    nullptr,
};

}  // namespace

extern "C" __attribute__((visibility("default"))) const void* alembert_projection() { return &projection; }

