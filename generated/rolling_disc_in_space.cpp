// SPDX-License-Identifier: MIT
// Equations of motion of 'rolling_disc_in_space': routh, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//   alembert emit rolling_disc_in_space.toml -o .
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[10]       x [m], y [m], psi [rad], theta [rad], phi [rad], then their rates
//   rate[10]        d state / dt
//   par[15]         m = 1 [kg], r = 0.5 [m], g = 9.81 [m/s^2],
//                   then 12 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[25], M row by row; forcing[5], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   constraints_at  position[2], velocity[2]; rows[10], A row by row
//   rows of A       rim_x, rim_y
//   multipliers_at  lambda[2]: lambda_rim_x, lambda_rim_y
//   project         out[10], position[2], pivots[2]
//   cost            164 operations a right-hand side: 53 additions, 102 multiplications, 5 divisions, 4 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "rolling_disc_in_space.cpp"
//
//   int main() {
//       const double state[10] = {0, 0, 0, 0.3, 0, 3, 0, 0.4, 0.2, 6};
//       double par[15], rate[10];
//       for (int k = 0; k < 3; ++k) par[k] = rolling_disc_in_space::parameter_values[k];
//       rolling_disc_in_space::prepare(par);
//       rolling_disc_in_space::rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // some are for other types of numbers
#pragma GCC diagnostic ignored "-Wpsabi"            // all functions with vectors are inline
namespace rolling_disc_in_space::code_df7628a0 {
namespace {  // seen in this file alone

// Sines and cosines in pairs, of one angle or of several at once; at the end of this file.
template <typename Real> struct pair;
template <typename Real, unsigned count> struct sines;
template <typename Real> pair<Real> sincos(const Real& x);
template <typename Real, typename... Angle> sines<Real, 1 + sizeof...(Angle)> sincos(const Real& first, const Angle&... x);
inline pair<double> sincos(double x);
inline double sin(double x), cos(double x);
inline float sin(float x), cos(float x);
inline long double sin(long double x), cos(long double x);

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m = par[0], &r = par[1], &g = par[2];

    // Constants
    const Real k0 = m * r;
    const Real z0 = m * r * r;
    const Real k1 = Real(0.25) * z0;
    const Real M33 = Real(1.25) * z0;
    const Real M44 = Real(0.5) * z0;
    const Real k2 = Real(2) * k0;
    const Real k3 = Real(2.5) * z0;
    const Real k4 = m * r * g;
    const Real z1 = Real(1) / z0;
    const Real k5 = (Real(4) / Real(5)) * z1;
    const Real k6 = Real(2) * z1;
    const Real k7 = Real(0.625) * z0;
    const Real k8 = Real(0.5) * m;
    const Real k9 = Real(0.125) * z0;

    // Result
    par[3] = k0;
    par[4] = k1;
    par[5] = M33;
    par[6] = M44;
    par[7] = k2;
    par[8] = k3;
    par[9] = k4;
    par[10] = k5;
    par[11] = k6;
    par[12] = k7;
    par[13] = k8;
    par[14] = k9;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &psi = state[2], &theta = state[3], &x_dot = state[5], &y_dot = state[6], &psi_dot = state[7];
    const Real &theta_dot = state[8], &phi_dot = state[9];
    const Real &m = par[0], &r = par[1], &k0 = par[3], &k1 = par[4], &M33 = par[5], &M44 = par[6], &k2 = par[7];
    const Real &k3 = par[8], &k4 = par[9], &k5 = par[10], &k6 = par[11];

    // Trigonometry
    const auto trig0 = sincos(theta, psi);
    const Real sin_theta = trig0.sine[0], cos_theta = trig0.cosine[0], sin_psi = trig0.sine[1],
        cos_psi = trig0.cosine[1];

    // Shared terms
    const Real z0 = k0 * sin_theta;

    // Mass matrix M(q), lower triangle
    // M00 = m, M10 = 0, M11 = m, M32 = 0, M40 = 0, M41 = 0, M43 = 0
    const Real M20 = z0 * cos_psi;
    const Real M21 = z0 * sin_psi;
    const Real M22 = k1 + M33 * sin_theta * sin_theta;
    const Real z1 = k0 * cos_theta;
    const Real M30 = z1 * sin_psi;
    const Real M31 = -z1 * cos_psi;
    const Real M42 = M44 * sin_theta;

    // Forcing f
    const Real z2 = psi_dot * cos_theta;
    const Real z3 = theta_dot * z2;
    const Real z4 = k2 * z3;
    const Real z5 = psi_dot * psi_dot + theta_dot * theta_dot;
    const Real f0 = M21 * z5 - z4 * cos_psi;
    const Real f1 = -z4 * sin_psi - M20 * z5;
    const Real z6 = M44 * phi_dot;
    const Real f2 = -theta_dot * (z6 + k3 * psi_dot * sin_theta) * cos_theta;
    const Real z7 = (k4 + M33 * psi_dot * z2) * sin_theta;
    const Real f3 = z6 * z2 + z7;
    const Real f4 = -M44 * z3;

    // Constraints A q'' = gamma
    const Real z8 = r * cos_psi;
    const Real z9 = psi_dot * phi_dot;
    const Real gamma1 = z8 * z9;

    // Solve M q'' = f + A^T lambda, A q'' = gamma
    const Real z10 = r * sin_psi;
    const Real z11 = k5 * M30;
    const Real z12 = -k5 * M31;
    const Real z13 = M30 * z12;
    const Real z14 = Real(1) / (m + M31 * z12);
    const Real z15 = z13 * z14;
    const Real z16 = (m - M30 * z11) - z13 * z15;
    const Real z17 = M21 * z14;
    const Real z18 = M20 - z13 * z17;
    const Real z19 = k6 * M42;
    const Real z20 = Real(1) / ((M22 - M42 * z19) - M21 * z17);
    const Real z21 = z18 * z20;
    const Real z22 = Real(1) / (z16 - z18 * z21);
    const Real z23 = -f1 - z12 * f3;
    const Real z24 = (z11 * f3 - f0) - z15 * z23;
    const Real z25 = (f4 * z19 - f2) - z17 * z23;
    const Real z26 = z24 - z21 * z25;
    const Real z27 = k6 * z8;
    const Real z28 = M42 * z27;
    const Real z29 = z28 * z20;
    const Real z30 = z18 * z29 - Real(1);
    const Real z31 = z30 * z22;
    const Real z32 = (z27 * z8 + z28 * z29) + z30 * z31;
    const Real z33 = k6 * z10;
    const Real z34 = M42 * z33 - z17;
    const Real z35 = z34 * z20;
    const Real z36 = z15 + z18 * z35;
    const Real z37 = z36 * z22;
    const Real z38 = (z33 * z8 + z28 * z35) + z30 * z37;
    const Real z39 = (z33 * z10 + z14) + z34 * z35;
    const Real z40 = Real(1) / (z39 + z36 * z37);
    const Real z41 = z38 * z40;
    const Real z42 = (z10 * z9 - z27 * f4) - z29 * z25;
    const Real z43 = z14 * z23;
    const Real z44 = ((-z33 * f4 - gamma1) - z43) - z35 * z25;
    const Real z45 = z44 + z26 * z37;
    const Real z46 = (z42 + z31 * z26) - z45 * z41;
    const Real z47 = z46 / (z32 - z38 * z41);
    const Real z48 = z40 * z45 - z41 * z47;
    const Real z49 = z22 * z26 - z31 * z47 - z37 * z48;
    const Real x_ddot = -z49;
    const Real z50 = z20 * z25;
    const Real z51 = z50 + z29 * z47 + z35 * z48 - z21 * z49;
    const Real z52 = z43 + z14 * z48 - z15 * z49 - z17 * z51;
    const Real y_ddot = -z52;
    const Real psi_ddot = -z51;
    const Real theta_ddot = k5 * f3 + z11 * z49 - z12 * z52;
    const Real z53 = -k6 * f4;
    const Real z54 = z53 - z27 * z47 - z33 * z48 - z19 * z51;
    const Real phi_ddot = -z54;

    // Result
    rate[0] = x_dot;
    rate[1] = y_dot;
    rate[2] = psi_dot;
    rate[3] = theta_dot;
    rate[4] = phi_dot;
    rate[5] = x_ddot;
    rate[6] = y_ddot;
    rate[7] = psi_ddot;
    rate[8] = theta_ddot;
    rate[9] = phi_ddot;
}

/// M (n by n, row-major) and f of M q'' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &psi = state[2], &theta = state[3], &psi_dot = state[7], &theta_dot = state[8];
    const Real &phi_dot = state[9];
    const Real &m = par[0], &k0 = par[3], &k1 = par[4], &M33 = par[5], &M44 = par[6], &k2 = par[7], &k3 = par[8];
    const Real &k4 = par[9];

    // Trigonometry
    const auto trig0 = sincos(theta, psi);
    const Real sin_theta = trig0.sine[0], cos_theta = trig0.cosine[0], sin_psi = trig0.sine[1],
        cos_psi = trig0.cosine[1];

    // Mass matrix M(q), lower triangle
    const Real z0 = k0 * sin_theta;
    const Real M20 = z0 * cos_psi;
    const Real M21 = z0 * sin_psi;
    const Real M22 = k1 + M33 * sin_theta * sin_theta;
    const Real z1 = k0 * cos_theta;
    const Real M30 = z1 * sin_psi;
    const Real M31 = -z1 * cos_psi;
    const Real M42 = M44 * sin_theta;

    // Forcing f
    const Real z2 = psi_dot * cos_theta;
    const Real z3 = theta_dot * z2;
    const Real z4 = k2 * z3;
    const Real z5 = psi_dot * psi_dot + theta_dot * theta_dot;
    const Real f0 = M21 * z5 - z4 * cos_psi;
    const Real f1 = -z4 * sin_psi - M20 * z5;
    const Real z6 = M44 * phi_dot;
    const Real z7 = theta_dot * (z6 + k3 * psi_dot * sin_theta) * cos_theta;
    const Real f2 = -z7;
    const Real z8 = (k4 + M33 * psi_dot * z2) * sin_theta;
    const Real f3 = z6 * z2 + z8;
    const Real f4 = -M44 * z3;

    // Result
    mass[0] = m;
    mass[1] = mass[5] = Real(0);
    mass[6] = m;
    mass[2] = mass[10] = M20;
    mass[7] = mass[11] = M21;
    mass[12] = M22;
    mass[3] = mass[15] = M30;
    mass[8] = mass[16] = M31;
    mass[13] = mass[17] = Real(0);
    mass[18] = M33;
    mass[4] = mass[20] = Real(0);
    mass[9] = mass[21] = Real(0);
    mass[14] = mass[22] = M42;
    mass[19] = mass[23] = Real(0);
    mass[24] = M44;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = f2;
    forcing[3] = f3;
    forcing[4] = f4;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &psi = state[2], &theta = state[3], &x_dot = state[5], &y_dot = state[6], &psi_dot = state[7];
    const Real &theta_dot = state[8], &phi_dot = state[9];
    const Real &k0 = par[3], &k1 = par[4], &M44 = par[6], &k4 = par[9], &k7 = par[12], &k8 = par[13];
    const Real &k9 = par[14];

    // Trigonometry
    const auto trig0 = sincos(theta, psi);
    const Real sin_theta = trig0.sine[0], cos_theta = trig0.cosine[0], sin_psi = trig0.sine[1],
        cos_psi = trig0.cosine[1];

    // Energy
    const Real z0 = theta_dot * cos_theta;
    const Real z1 = (x_dot * cos_psi + y_dot * sin_psi) * psi_dot * sin_theta;
    const Real z2 = y_dot * cos_psi * z0 - (x_dot * sin_psi * z0 + z1);
    const Real z3 = k8 * (x_dot * x_dot + y_dot * y_dot);
    const Real z4 = k1 * phi_dot * phi_dot + k7 * theta_dot * theta_dot + z3;
    const Real z5 = k9 * psi_dot * (Real(5) * sin_theta * sin_theta + Real(1));
    const Real z6 = z4 + psi_dot * (M44 * phi_dot * sin_theta + z5);
    const Real z7 = k0 * z2 - z6;
    const Real T = -z7;
    const Real V = k4 * cos_theta;
    const Real E = V - z7;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = Real(0);
    jacobi[0] = E;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real* par, Real* position, Real* velocity, Real* rows) {
    const Real &psi = state[2], &x_dot = state[5], &y_dot = state[6], &phi_dot = state[9];
    const Real &r = par[1];

    // Trigonometry
    const auto [sin_psi, cos_psi] = sincos(psi);

    // Constraints
    const Real z0 = r * cos_psi;
    const Real z1 = r * sin_psi;

    // Result
    position[0] = Real(0);
    position[1] = Real(0);
    velocity[0] = x_dot - phi_dot * z0;
    velocity[1] = y_dot - phi_dot * z1;
    rows[0] = Real(1);
    rows[1] = Real(0);
    rows[2] = Real(0);
    rows[3] = Real(0);
    rows[4] = -z0;
    rows[5] = Real(0);
    rows[6] = Real(1);
    rows[7] = Real(0);
    rows[8] = Real(0);
    rows[9] = -z1;
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real* state, const Real* par, Real* lambda) {
    const Real &psi = state[2], &theta = state[3], &psi_dot = state[7], &theta_dot = state[8];
    const Real &phi_dot = state[9];
    const Real &m = par[0], &r = par[1], &k0 = par[3], &k1 = par[4], &M33 = par[5], &M44 = par[6], &k2 = par[7];
    const Real &k3 = par[8], &k4 = par[9], &k5 = par[10], &k6 = par[11];

    // Trigonometry
    const auto trig0 = sincos(theta, psi);
    const Real sin_theta = trig0.sine[0], cos_theta = trig0.cosine[0], sin_psi = trig0.sine[1],
        cos_psi = trig0.cosine[1];

    // Multipliers
    const Real z0 = k0 * sin_theta;
    const Real z1 = z0 * cos_psi;
    const Real z2 = z0 * sin_psi;
    const Real z3 = k0 * cos_theta;
    const Real z4 = z3 * sin_psi;
    const Real z5 = z3 * cos_psi;
    const Real z6 = M44 * sin_theta;
    const Real z7 = psi_dot * cos_theta;
    const Real z8 = theta_dot * z7;
    const Real z9 = k2 * z8;
    const Real z10 = psi_dot * psi_dot + theta_dot * theta_dot;
    const Real z11 = M44 * phi_dot;
    const Real z12 = theta_dot * (z11 + k3 * psi_dot * sin_theta) * cos_theta;
    const Real z13 = (k4 + M33 * psi_dot * z7) * sin_theta;
    const Real z14 = z11 * z7 + z13;
    const Real z15 = M44 * z8;
    const Real z16 = r * cos_psi;
    const Real z17 = r * sin_psi;
    const Real z18 = psi_dot * phi_dot;
    const Real z19 = k5 * z4;
    const Real z20 = k5 * z5;
    const Real z21 = z4 * z20;
    const Real z22 = Real(1) / (m - z5 * z20);
    const Real z23 = z21 * z22;
    const Real z24 = (m - z4 * z19) - z21 * z23;
    const Real z25 = z2 * z22;
    const Real z26 = z1 - z21 * z25;
    const Real z27 = k6 * z6;
    const Real z28 = (k1 + M33 * sin_theta * sin_theta) - z6 * z27;
    const Real z29 = Real(1) / (z28 - z2 * z25);
    const Real z30 = z26 * z29;
    const Real z31 = Real(1) / (z24 - z26 * z30);
    const Real z32 = (z9 * cos_psi - z2 * z10) + z19 * z14;
    const Real z33 = (z9 * sin_psi + z1 * z10) - z20 * z14;
    const Real z34 = (z12 - z15 * z27) - z25 * z33;
    const Real z35 = (z32 - z23 * z33) - z30 * z34;
    const Real z36 = k6 * z16;
    const Real z37 = z6 * z36;
    const Real z38 = z37 * z29;
    const Real z39 = z26 * z38 - Real(1);
    const Real z40 = z39 * z31;
    const Real z41 = (z36 * z16 + z37 * z38) + z39 * z40;
    const Real z42 = k6 * z17;
    const Real z43 = z6 * z42 - z25;
    const Real z44 = z43 * z29;
    const Real z45 = z23 + z26 * z44;
    const Real z46 = z45 * z31;
    const Real z47 = (z42 * z16 + z37 * z44) + z39 * z46;
    const Real z48 = (z42 * z17 + z22) + z43 * z44;
    const Real z49 = Real(1) / (z48 + z45 * z46);
    const Real z50 = z47 * z49;
    const Real z51 = (z36 * z15 + z17 * z18) - z38 * z34;
    const Real z52 = (z42 * z15 - z16 * z18) - z22 * z33;
    const Real z53 = (z52 - z44 * z34) + z35 * z46;
    const Real z54 = (z51 + z40 * z35) - z53 * z50;
    const Real z55 = z54 / (z41 - z47 * z50);
    const Real lambda_rim_x = -z55;
    const Real lambda_rim_y = z50 * z55 - z49 * z53;

    // Result
    lambda[0] = lambda_rim_x;
    lambda[1] = lambda_rim_y;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &x = state[0], &y = state[1], &psi = state[2], &theta = state[3], &phi = state[4];
    const Real &x_dot = state[5], &y_dot = state[6], &psi_dot = state[7], &theta_dot = state[8];
    const Real &phi_dot = state[9];
    const Real &m = par[0], &r = par[1], &k0 = par[3], &k1 = par[4], &M33 = par[5], &M44 = par[6], &k5 = par[10];
    const Real &k6 = par[11];

    // Trigonometry
    const auto trig0 = sincos(theta, psi);
    const Real sin_theta = trig0.sine[0], cos_theta = trig0.cosine[0], sin_psi = trig0.sine[1],
        cos_psi = trig0.cosine[1];

    // Projection
    const Real z0 = k0 * sin_theta;
    const Real z1 = z0 * sin_psi;
    const Real z2 = k0 * cos_theta;
    const Real z3 = z2 * sin_psi;
    const Real z4 = z2 * cos_psi;
    const Real z5 = M44 * sin_theta;
    const Real z6 = r * cos_psi;
    const Real z7 = r * sin_psi;
    const Real z8 = y_dot - phi_dot * z7;
    const Real z9 = k5 * z3;
    const Real z10 = k5 * z4;
    const Real z11 = z3 * z10;
    const Real z12 = Real(1) / (m - z4 * z10);
    const Real z13 = z11 * z12;
    const Real z14 = (m - z3 * z9) - z11 * z13;
    const Real z15 = z1 * z12;
    const Real z16 = z0 * cos_psi - z11 * z15;
    const Real z17 = k6 * z5;
    const Real z18 = (k1 + M33 * sin_theta * sin_theta) - z5 * z17;
    const Real z19 = Real(1) / (z18 - z1 * z15);
    const Real z20 = z16 * z19;
    const Real z21 = Real(1) / (z14 - z16 * z20);
    const Real z22 = k6 * z6;
    const Real z23 = z5 * z22;
    const Real z24 = z23 * z19;
    const Real z25 = z16 * z24 - Real(1);
    const Real z26 = z25 * z21;
    const Real z27 = (z22 * z6 + z23 * z24) + z25 * z26;
    const Real z28 = k6 * z7;
    const Real z29 = z5 * z28 - z15;
    const Real z30 = z29 * z19;
    const Real z31 = z13 + z16 * z30;
    const Real z32 = z31 * z21;
    const Real z33 = (z28 * z6 + z23 * z30) + z25 * z32;
    const Real z34 = (z28 * z7 + z12) + z29 * z30;
    const Real z35 = z34 + z31 * z32;
    const Real z36 = Real(1) / z35;
    const Real z37 = z33 * z36;
    const Real z38 = z27 - z33 * z37;
    const Real z39 = z37 * z8 - (x_dot - phi_dot * z6);
    const Real z40 = z39 / z38;
    const Real z41 = z36 * z8 + z37 * z40;
    const Real z42 = z26 * z40 - z32 * z41;
    const Real z43 = z24 * z40 - z30 * z41 + z20 * z42;
    const Real z44 = z12 * z41 - z13 * z42 + z15 * z43;
    const Real z45 = z22 * z40 - z28 * z41 + z17 * z43;

    // Result
    out[0] = x;
    out[1] = y;
    out[2] = psi;
    out[3] = theta;
    out[4] = phi;
    out[5] = x_dot - z42;
    out[6] = y_dot - z44;
    out[7] = psi_dot + z43;
    out[8] = theta_dot + (z9 * z42 - z10 * z44);
    out[9] = phi_dot - z45;
    position[0] = Real(0);
    position[1] = Real(0);
    pivots[0] = z38;
    pivots[1] = z35;
}

/// gamma of A q'' = gamma.
template <typename Real>
void gamma_at(const Real&, const Real* state, const Real* par, Real* out) {
    const Real &psi = state[2], &psi_dot = state[7], &phi_dot = state[9];
    const Real &r = par[1];

    // Trigonometry
    const auto [sin_psi, cos_psi] = sincos(psi);

    // Constraints
    const Real z0 = psi_dot * phi_dot;
    const Real gamma0 = -r * sin_psi * z0;
    const Real gamma1 = r * cos_psi * z0;

    // Result
    out[0] = gamma0;
    out[1] = gamma1;
}

// Sines and cosines of several angles at once, each within 2 ulp; lanes of a vector are angles.
//
//   x = k pi/2 + r, |r| <= pi/4: pi/2 in three parts of 53 bits where multiplication and addition fuse, so that x - k pi/2 is exact
//   up to the roundings of the last two steps, of which the last counts only where r is tiny; else in four, the first three of
//   27 bits, so that their products with k are exact and so is all of r but one rounding of hi and the last part, lo (Cody & Waite
//   1980, ch. 8);
//   sin r = r - r^3 P(r^2), cos r = 1 - r^2/2 + r^4 Q(r^2), minimax polynomials; k mod 4 says which goes where.
//
// Angles beyond 1e8, infinities and NaN go to libm.

using real2 = double __attribute__((vector_size(16)));
using real4 = double __attribute__((vector_size(32)));
using real8 = double __attribute__((vector_size(64)));
using bits2 = long long __attribute__((vector_size(16)));
using bits4 = long long __attribute__((vector_size(32)));
using bits8 = long long __attribute__((vector_size(64)));

template <typename Real> struct pair { Real s, c; };
template <typename Real, unsigned count> struct sines { Real sine[count], cosine[count]; };

/// Stands where a sum has to be made as it is written, also for a compiler that may make it in another order.
#if defined(__FAST_MATH__) || defined(ALEMBERT_REASSOCIATES)
template <typename Real> [[gnu::always_inline]] inline Real&& as_written(Real&& x) {
#if defined(__AVX512F__)
    constexpr unsigned widest = 64;
#elif defined(__AVX__)
    constexpr unsigned widest = 32;
#else
    constexpr unsigned widest = 16;
#endif
    if constexpr (sizeof x > widest)
        __asm__("" : "+m"(x));
    else
#if defined(__x86_64__)
        __asm__("" : "+v"(x));
#elif defined(__aarch64__)
        __asm__("" : "+w"(x));
#else
        __asm__("" : "+m"(x));
#endif
    return static_cast<Real&&>(x);
}
#else
template <typename Real> [[gnu::always_inline]] inline const Real& as_written(const Real& x) { return x; }
#endif
constexpr double farthest = 1e8;
[[gnu::always_inline]] inline bool is_near(double x) { return __builtin_fabs(x) <= farthest; }
/// Are all angles near whose squares make this sum? (If not, some may be.)
[[gnu::always_inline]] inline bool is_near_all(double squares) { return squares <= farthest * farthest; }
[[gnu::always_inline]] inline double sum_of(const real2& x) { return x[0] + x[1]; }
[[gnu::always_inline]] inline double sum_of(const real4& x) { return sum_of(__builtin_shufflevector(x, x, 0, 1) + __builtin_shufflevector(x, x, 2, 3)); }
[[gnu::always_inline]] inline double sum_of(const real8& x) { return sum_of(__builtin_shufflevector(x, x, 0, 1, 2, 3) + __builtin_shufflevector(x, x, 4, 5, 6, 7)); }

/// a b + c with one rounding, where the processor has that.
#if defined(__FMA__)
[[gnu::always_inline]] inline double fused(double a, double b, double c) { return __builtin_fma(a, b, c); }
[[gnu::always_inline]] inline real2 fused(const real2& a, double b, const real2& c) { return __builtin_ia32_vfmaddpd(a, real2{b, b}, c); }
[[gnu::always_inline]] inline real4 fused(const real4& a, double b, const real4& c) { return __builtin_ia32_vfmaddpd256(a, real4{b, b, b, b}, c); }
#if defined(__AVX512F__)
[[gnu::always_inline]] inline real8 fused(const real8& a, double b, const real8& c) {
    return __builtin_ia32_vfmaddpd512_mask(a, real8{b, b, b, b, b, b, b, b}, c, static_cast<unsigned char>(-1), 4);
}
#endif
#endif
#if !defined(__FMA__)
template <typename Real> constexpr bool fuses = false;
#elif defined(__AVX512F__)
template <typename Real> constexpr bool fuses = __is_same(Real, double) || __is_same(Real, real2) || __is_same(Real, real4) || __is_same(Real, real8);
#else
template <typename Real> constexpr bool fuses = __is_same(Real, double) || __is_same(Real, real2) || __is_same(Real, real4);
#endif

template <typename Bits, typename Real>
[[gnu::always_inline]] inline void sines_near(const Real& x, Real& sine, Real& cosine) {
    constexpr double shift = 0x1.8p52;  // adding it rounds to a whole number, in the last bits
    const Real shifted = as_written(x * 0x1.45f306dc9c883p-1 + shift), turns = as_written(shifted - shift);
    const Bits k = __builtin_bit_cast(Bits, shifted);
    Real hi, lo;
    if constexpr (fuses<Real>) {
        hi = fused(turns, -0x1.1a62633145c06p-54, as_written(fused(turns, -0x1.921fb54442d18p0, x)));
        hi = fused(turns, -0x1.c1cd129024e09p-107, as_written(hi));
    } else {
        hi = as_written(as_written(x - turns * 0x1.921fb54p0) - turns * 0x1.10b46p-30) - turns * 0x1.1a62630p-54;
        lo = turns * 0x1.8a2e03707344ap-81;
    }
    const Real z = hi * hi, zz = z * z;
    const Real P = (0.1666666666666663 - 0.008333333333322118 * z) +
                   zz * ((0.00019841269829589533 - 2.7557313621383334e-06 * z) + zz * (2.505074776244275e-08 - 1.5896230131492603e-10 * z));
    const Real Q = (0.041666666666666595 - 0.0013888888888873056 * z) +
                   zz * ((2.4801587288851683e-05 - 2.755731417929107e-07 * z) + zz * (2.0875700841213046e-09 - 1.13585364822807e-11 * z));
    Real s;
    if constexpr (fuses<Real>)
        s = hi * as_written(1 - z * P);
    else
        s = hi - as_written(hi * z * P + lo);
    const Real c = (1 - 0.5 * z) + zz * Q;
    constexpr Bits top = Bits{} + (-0x7fffffffffffffff - 1);
    const Bits s_sign = (k << 62) & top, odd = k & 1;
    if constexpr (sizeof(Real) == 64) {  // a subtraction under a mask is one instruction there
        sine = __builtin_bit_cast(Real, __builtin_bit_cast(Bits, odd != 0 ? c : s) ^ s_sign);
        cosine = __builtin_bit_cast(Real, __builtin_bit_cast(Bits, odd != 0 ? Real{} - s : c) ^ s_sign);
    } else if constexpr (sizeof(Real) > sizeof(double)) {
        const Bits c_sign = ((k + 1) << 62) & top;
        sine = __builtin_bit_cast(Real, __builtin_bit_cast(Bits, odd != 0 ? c : s) ^ s_sign);
        cosine = __builtin_bit_cast(Real, __builtin_bit_cast(Bits, odd != 0 ? s : c) ^ c_sign);
    } else {
        const Bits c_sign = ((k + 1) << 62) & top;
        const Bits s_bits = __builtin_bit_cast(Bits, s), c_bits = __builtin_bit_cast(Bits, c), differ = (s_bits ^ c_bits) & -odd;
        sine = __builtin_bit_cast(Real, s_bits ^ differ ^ s_sign);
        cosine = __builtin_bit_cast(Real, c_bits ^ differ ^ c_sign);
    }
}

[[gnu::noinline, gnu::cold]] inline void sines_far(double x, double& sine, double& cosine) {
    sine = __builtin_sin(x);
    cosine = __builtin_cos(x);
}

[[gnu::always_inline]] inline pair<double> sincos(double x) {
    pair<double> result;
    if (__builtin_expect(is_near(x), 1))
        sines_near<long long>(x, result.s, result.c);
    else
        sines_far(x, result.s, result.c);
    return result;
}

template <typename Wide, typename Bits, typename... Angle>
[[gnu::always_inline]] inline sines<double, sizeof...(Angle)> sincos_in(Angle... x) {
    sines<double, sizeof...(Angle)> result;
    Wide s, c;
#if defined(__x86_64__)
    // One load for each: a wide load of a state that was just written number by number would wait for the stores.
    const auto alone = [](double& value) { __asm__("" : "+x"(value)); };
    (alone(x), ...);
#endif
    const Wide angles{x...};
    sines_near<Bits>(angles, s, c);
    for (unsigned i = 0; i < sizeof...(Angle); ++i) result.sine[i] = s[i], result.cosine[i] = c[i];
    if (__builtin_expect(is_near_all(sum_of(angles * angles)), 1)) return result;
    int i = 0;
    ((is_near(x) ? void() : sines_far(x, result.sine[i], result.cosine[i]), ++i), ...);
    return result;
}

inline double sin(double x) { return sincos(x).s; }
inline double cos(double x) { return sincos(x).c; }
inline float sin(float x) { return __builtin_sinf(x); }
inline float cos(float x) { return __builtin_cosf(x); }
inline long double sin(long double x) { return __builtin_sinl(x); }
inline long double cos(long double x) { return __builtin_cosl(x); }
template <typename Real> pair<Real> sincos(const Real& x) { return {sin(x), cos(x)}; }

/// Five to eight in two vectors of four at most: with AVX-512, a wide one among scalar code takes one of the two units from all of it.
template <typename... Angle>
[[gnu::always_inline]] inline sines<double, 4 + sizeof...(Angle)> sincos_in_two(double a, double b, double c, double d, Angle... x) {
    constexpr unsigned more = sizeof...(Angle);
    sines<double, 4 + more> result;
    const sines<double, 4> first = sincos_in<real4, bits4>(a, b, c, d);
    for (unsigned i = 0; i < 4; ++i) result.sine[i] = first.sine[i], result.cosine[i] = first.cosine[i];
    const auto add = [&](const sines<double, more>& rest) {
        for (unsigned i = 0; i < more; ++i) result.sine[4 + i] = rest.sine[i], result.cosine[4 + i] = rest.cosine[i];
    };
    if constexpr (more > 2)
        add(sincos_in<real4, bits4>(x...));
    else
        add(sincos_in<real2, bits2>(x...));
    return result;
}

/// Of two to eight angles.
template <typename Real, typename... Angle>
[[gnu::always_inline]] inline sines<Real, 1 + sizeof...(Angle)> sincos(const Real& first, const Angle&... x) {
    constexpr unsigned count = 1 + sizeof...(Angle);
    if constexpr (!__is_same(Real, double))
        return { {sin(first), sin(x)...}, {cos(first), cos(x)...} };
    else if constexpr (count == 2)
        return sincos_in<real2, bits2>(first, x...);
    else if constexpr (count <= 4)
        return sincos_in<real4, bits4>(first, x...);
    else
        return sincos_in_two(first, x...);
}

// The tables of alembert/native/abi.hpp.

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

constexpr const char* coordinate_names[] = { "x", "y", "psi", "theta", "phi", nullptr};
constexpr const char* const* speed_names = nullptr;
constexpr const char* parameter_names[] = { "m", "r", "g", nullptr};
constexpr const char* output_names[] = { nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 0.5, 9.81, 0};

constexpr alembert_solver_table table{
    4, 5, 5, 3, 12, 0, 0, 2, "rolling_disc_in_space", "routh, textbook form",
    coordinate_names, speed_names, parameter_names, output_names, event_names, parameter_values,
    [](double* par) { prepare(par); },
    [](double t, const double* state, const double* par, double* rate) { rhs(t, state, par, rate); },
    [](double t, const double* state, const double* par, double* mass, double* forcing) {
        mass_forcing(t, state, par, mass, forcing);
    },
    [](double t, const double* state, const double* rate, const double* par, double* e, double* jacobi) {
        energy(t, state, rate, par, e, jacobi);
    },
    [](double, const double*, const double*, const double*, double*) {},
    [](double, const double*, const double*, const double*, double*) {},
    [](double t, const double* state, const double* par, double* position, double* velocity, double* rows) {
        constraints_at(t, state, par, position, velocity, rows);
    },
    [](double t, const double* state, const double* par, double* lambda) { multipliers_at(t, state, par, lambda); },
};

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
    [](double t, const double* state, const double* par, double* gamma) { gamma_at(t, state, par, gamma); },
};

struct alembert_tables {
    const void* solver;
    const void* derivatives;
    const void* projection;
    const void* pack;
    const void* functions;
    int independent_constraints;
};

constexpr alembert_tables all{
    &table, nullptr, &projection, nullptr, nullptr, 2,
};

}  // namespace
}  // namespace rolling_disc_in_space::code_df7628a0
#pragma GCC diagnostic pop

namespace rolling_disc_in_space {
using code_df7628a0::parameter_values;
using code_df7628a0::coordinate_names;
using code_df7628a0::speed_names;
using code_df7628a0::parameter_names;
using code_df7628a0::output_names;
using code_df7628a0::event_names;
using code_df7628a0::table;
using code_df7628a0::prepare;
using code_df7628a0::rhs;
using code_df7628a0::mass_forcing;
using code_df7628a0::energy;
using code_df7628a0::constraints_at;
using code_df7628a0::multipliers_at;
using code_df7628a0::project;
using code_df7628a0::gamma_at;
}  // namespace rolling_disc_in_space

using namespace rolling_disc_in_space;

#ifndef ALEMBERT_rolling_disc_in_space_df7628a0  // once in a unit, however many namespaces include this file
#define ALEMBERT_rolling_disc_in_space_df7628a0
// What rolling_disc_in_space.hpp declares: under names that begin with that of the scene and end with a fingerprint of this file and its
// header, so that many systems can be in one program, and no header is linked with another file than its own.
extern "C" __attribute__((weak, visibility("default"))) void rolling_disc_in_space_prepare_df7628a0(double* par) {
    rolling_disc_in_space::code_df7628a0::table.prepare(par);
}
extern "C" __attribute__((weak, visibility("default"))) void rolling_disc_in_space_rhs_df7628a0(double t, const double* state, const double* par, double* rate) {
    rolling_disc_in_space::code_df7628a0::table.rhs(t, state, par, rate);
}
extern "C" __attribute__((weak, visibility("default"))) void rolling_disc_in_space_mass_forcing_df7628a0(double t, const double* state, const double* par, double* mass, double* forcing) {
    rolling_disc_in_space::code_df7628a0::table.mass_forcing(t, state, par, mass, forcing);
}
extern "C" __attribute__((weak, visibility("default"))) void rolling_disc_in_space_energy_df7628a0(double t, const double* state, const double* rate, const double* par, double* energy, double* jacobi) {
    rolling_disc_in_space::code_df7628a0::table.energy(t, state, rate, par, energy, jacobi);
}
extern "C" __attribute__((weak, visibility("default"))) void rolling_disc_in_space_constraints_at_df7628a0(double t, const double* state, const double* par, double* position, double* velocity, double* rows) {
    rolling_disc_in_space::code_df7628a0::table.constraints_at(t, state, par, position, velocity, rows);
}
extern "C" __attribute__((weak, visibility("default"))) void rolling_disc_in_space_multipliers_at_df7628a0(double t, const double* state, const double* par, double* lambda) {
    rolling_disc_in_space::code_df7628a0::table.multipliers_at(t, state, par, lambda);
}
extern "C" __attribute__((weak, visibility("default"))) void rolling_disc_in_space_project_df7628a0(double t, const double* state, const double* par, double* out, double* position, double* pivots) {
    rolling_disc_in_space::code_df7628a0::projection.project(t, state, par, out, position, pivots);
}
extern "C" __attribute__((weak, visibility("default"))) void rolling_disc_in_space_gamma_at_df7628a0(double t, const double* state, const double* par, double* out) {
    rolling_disc_in_space::code_df7628a0::projection.gamma_at(t, state, par, out);
}
extern "C" __attribute__((weak, visibility("default"))) const void* rolling_disc_in_space_tables_df7628a0() {
    return &rolling_disc_in_space::code_df7628a0::all;
}
#endif

#ifndef ALEMBERT_NO_MODULE  // What is looked for in a module that is loaded while a program runs; once in a unit.
#define ALEMBERT_NO_MODULE
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_solver() { return rolling_disc_in_space::code_df7628a0::all.solver; }
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_projection() { return rolling_disc_in_space::code_df7628a0::all.projection; }
#endif
