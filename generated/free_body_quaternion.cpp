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
template <typename Real> Real sign(const Real& x) { return Real(x > Real(0)) - Real(x < Real(0)); }
template <typename Real> Real min(const Real& x, const Real& y) { return y < x ? y : x; }
template <typename Real> Real max(const Real& x, const Real& y) { return x < y ? y : x; }


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
    const Real k7 = Real(0.5) * C;
    const Real k8 = Real(0.5) * B;

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
    const Real z0 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z1 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z2 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z3 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z4 = Real(1) / (e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3);
    const Real z5 = A * e1 * e1 + B * e2 * e2 + C * e3 * e3;
    const Real z6 = z5 * z4 * z4 * z2 * z2;
    const Real z7 = A * e2 * e2 + B * e1 * e1 + C * e0 * e0;
    const Real z8 = z7 * z1 * z1 * z4 * z4;
    const Real z9 = A * e0 * e0 + B * e3 * e3 + C * e2 * e2;
    const Real z10 = z9 * z3 * z3 * z4 * z4;
    const Real z11 = A * e3 * e3 + B * e0 * e0 + C * e1 * e1;
    const Real z12 = z11 * z0 * z0 * z4 * z4;
    const Real z13 = k2 * e0 * e3 - C * e1 * e2;
    const Real z14 = z13 * z3 * z0 * z4 * z4;
    const Real z15 = k1 * e0 * e2 + B * e1 * e3;
    const Real z16 = z15 * z3 * z1 * z4 * z4;
    const Real z17 = k2 * e1 * e2 - C * e0 * e3;
    const Real z18 = z17 * z1 * z4 * z4 * z2;
    const Real z19 = A * e0 * e1 - k0 * e2 * e3;
    const Real z20 = z19 * z3 * z4 * z4 * z2;
    const Real z21 = A * e2 * e3 - k0 * e0 * e1;
    const Real z22 = z21 * z1 * z0 * z4 * z4;
    const Real z23 = k1 * e1 * e3 + B * e0 * e2;
    const Real z24 = z23 * z0 * z4 * z4 * z2;
    const Real T = Real(0.5) * z6 + Real(0.5) * z8 + Real(0.5) * z10 + Real(0.5) * z12 + z14 - z16 - z18 + z20
        - z22 + z24;

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
    const Real z2 = e2 * e2;
    const Real z3 = e3 * e3;
    const Real z4 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z5 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z6 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z7 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z8 = Real(1) / (z0 + z1 + z2 + z3);
    const Real z9 = e0 * z7;
    const Real z10 = z9 + e3 * z4 - e2 * z5 + e1 * z6;
    const Real z11 = z8 * z10;
    const Real z12 = e2 * z7;
    const Real z13 = z12 - e1 * z4 + e0 * z5 + e3 * z6;
    const Real z14 = z8 * z13;
    const Real z15 = e3 * z7;
    const Real z16 = z15 - e0 * z4 - e1 * z5 - e2 * z6;
    const Real z17 = z8 * z16;
    const Real z18 = k6 * (z0 + z1 - z2 - z3) * z8 * z11;
    const Real z19 = e0 * e3;
    const Real z20 = e1 * e2;
    const Real z21 = z18 + B * (z19 - z20) * z8 * z17;
    const Real z22 = e0 * e2;
    const Real z23 = e1 * e3;
    const Real Hx = Real(2) * (z21 + C * (z22 + z23) * z8 * z14);
    const Real z24 = k8 * (z0 - z1 + z2 - z3) * z8 * z17;
    const Real z25 = A * (z19 + z20) * z8 * z11 - z24;
    const Real z26 = e0 * e1;
    const Real z27 = e2 * e3;
    const Real Hy = Real(2) * (z25 - C * (z26 - z27) * z8 * z14);
    const Real z28 = A * (z22 - z23) * z8 * z11;
    const Real z29 = z28 + B * (z26 + z27) * z8 * z17;
    const Real z30 = k7 * (z0 - z1 - z2 + z3) * z8 * z14;
    const Real Hz = -Real(2) * (z29 - z30);

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
    const Real z0 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z1 = e2 * z0;
    const Real z2 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z3 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z4 = e0 * w1 + e2 * w3 - e3 * w2;

    // Result
    position[0] = e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3 - Real(1);
    velocity[0] = z1 + e3 * z2 - e0 * z3 + e1 * z4;
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
    const Real z0 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z1 = e2 * z0;
    const Real z2 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z3 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z4 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z5 = z1 + e3 * z2 - e0 * z3 + e1 * z4;
    const Real z6 = k3 * w2 * w3;
    const Real z7 = k4 * w1 * w3;
    const Real z8 = k5 * w1 * w2;
    const Real z9 = Real(1) / (e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3);
    const Real z10 = e1 * z8;
    const Real z11 = e0 * z7;
    const Real z12 = e3 * z6;
    const Real z13 = w3 * z4;
    const Real z14 = Real(0.5) * z10 + Real(0.5) * z11 - Real(0.5) * z12 + Real(0.25) * z13 - Real(0.25) * w1
        * z2 + Real(0.25) * w2 * z3;
    const Real z15 = e2 * z9;
    const Real z16 = A * z15;
    const Real z17 = e3 * z9;
    const Real z18 = e1 * z9;
    const Real z19 = B * z18;
    const Real z20 = e0 * z9;
    const Real z21 = C * z20;
    const Real z22 = z16 * z17 - z19 * z20 + z21 * z18;
    const Real z23 = z14 * z22;
    const Real z24 = e2 * z7;
    const Real z25 = e3 * z8;
    const Real z26 = e1 * z6;
    const Real z27 = w3 * z2;
    const Real z28 = Real(0.5) * z24 - Real(0.5) * z25 - Real(0.5) * z26 - Real(0.25) * z27 - Real(0.25) * w2
        * z0 - Real(0.25) * w1 * z4;
    const Real z29 = z16 * z18 - z19 * z15 - z21 * z17;
    const Real z30 = z28 * z29;
    const Real z31 = e3 * z7;
    const Real z32 = e2 * z8;
    const Real z33 = e0 * z6;
    const Real z34 = w2 * z2;
    const Real z35 = Real(0.5) * z31 + Real(0.5) * z32 + Real(0.5) * z33 - Real(0.25) * z34 + Real(0.25) * w3
        * z0 - Real(0.25) * w1 * z3;
    const Real z36 = z16 * z20 + z19 * z17 - z21 * z15;
    const Real z37 = e2 * z6;
    const Real z38 = e1 * z7;
    const Real z39 = e0 * z8;
    const Real z40 = w2 * z4;
    const Real z41 = Real(0.5) * z37 + Real(0.5) * z38 - Real(0.5) * z39 - Real(0.25) * z40 + Real(0.25) * w1
        * z0 + Real(0.25) * w3 * z3;
    const Real z42 = z16 * z15 + z19 * z18 + z21 * z20;
    const Real z43 = e0 * z4;
    const Real z44 = z43 + e3 * z0 - e2 * z2 + e1 * z3;
    const Real z45 = z9 * z44;
    const Real z46 = k6 * z45;
    const Real z47 = e2 * z4;
    const Real z48 = z47 - e1 * z0 + e0 * z2 + e3 * z3;
    const Real z49 = z9 * z48;
    const Real z50 = k7 * z49;
    const Real z51 = z46 * z49 - z50 * z45;
    const Real z52 = e3 * z4;
    const Real z53 = z52 - e0 * z0 - e1 * z2 - e2 * z3;
    const Real z54 = z9 * z9 * z5;
    const Real z55 = z51 + k8 * z53 * z54;
    const Real z56 = z9 * z53;
    const Real z57 = k8 * z56;
    const Real z58 = z46 * z56 - z57 * z45;
    const Real z59 = z58 - k7 * z48 * z54;
    const Real z60 = z57 * z49 - z50 * z56;
    const Real z61 = k6 * z44 * z54 - z60;
    const Real z62 = z55 * z18 + z59 * z20 + z61 * z15;
    const Real z63 = z23 + z30 - z35 * z36 - z41 * z42 + z62;
    const Real z64 = e3 * z63;
    const Real z65 = A * z20;
    const Real z66 = B * z17;
    const Real z67 = C * z15;
    const Real z68 = z65 * z18 - z66 * z15 + z67 * z17;
    const Real z69 = z35 * z68;
    const Real z70 = A * z18 * z18;
    const Real z71 = B * z15 * z15;
    const Real z72 = z28 * (z70 + z71 + C * z17 * z17);
    const Real z73 = A * z17;
    const Real z74 = B * z20;
    const Real z75 = C * z18;
    const Real z76 = z73 * z18 + z74 * z15 - z75 * z17;
    const Real z77 = z59 * z17 + z55 * z15 - z61 * z18;
    const Real z78 = z69 - z72 - z14 * z76 + z41 * z29 + z77;
    const Real z79 = z65 * z20 + z66 * z17 + z67 * z15;
    const Real z80 = z35 * z79;
    const Real z81 = z73 * z20 - z74 * z17 - z75 * z15;
    const Real z82 = z14 * z81;
    const Real z83 = z61 * z20 - z59 * z15 + z55 * z17;
    const Real z84 = z80 - z82 - z28 * z68 + z41 * z36 - z83;
    const Real z85 = z41 * z22;
    const Real z86 = z73 * z17 + z74 * z20 + z75 * z18;
    const Real z87 = z14 * z86;
    const Real z88 = z55 * z20 - z61 * z17 - z59 * z18;
    const Real z89 = z85 - z87 + z35 * z81 - z28 * z76 + z88;
    const Real z90 = z64 - e0 * z78 + e1 * z84 + e2 * z89;
    const Real lambda_F = Real(2) * z90 * z9;

    // Result
    lambda[0] = lambda_F;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* out, Real* position, [[maybe_unused]] Real* pivots) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];

    // Projection
    const Real z0 = e0 * e0;
    const Real z1 = e1 * e1;
    const Real z2 = e2 * e2;
    const Real z3 = e3 * e3;
    const Real z4 = z0 + z1 + z2 + z3 - Real(1);
    const Real z5 = z0 + z1 + z2 + z3;
    const Real z6 = z4 / z5;

    // Result
    out[0] = e0 - Real(0.5) * e0 * z6;
    out[1] = e1 - Real(0.5) * e1 * z6;
    out[2] = e2 - Real(0.5) * e2 * z6;
    out[3] = e3 - Real(0.5) * e3 * z6;
    out[4] = w1;
    out[5] = w2;
    out[6] = w3;
    position[0] = z4;
    pivots[0] = Real(4) * z5;
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

