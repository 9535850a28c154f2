// Equations of motion of 'turntable_ball': routh, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) q'' = f(q, q', t) + A^T lambda with A q'' = gamma.
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[10]       x [m], y [m], psi [rad], theta [rad], phi [rad], then their rates
//   rate[10]        d state / dt
//   par[9]          m = 0.5 [kg], a = 0.2 [m], Omega = 3.5 [rad/s],
//                   then 6 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[25], M row by row; forcing[5], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   outputs_at      out[3]: spin, centre_x, centre_y
//   constraints_at  position[2], velocity[2]; rows[10], A row by row
//   multipliers_at  lambda[2]
//   project         out[10], position[2], pivots[2]
//   cost            93 operations a right-hand side: 25 additions, 61 multiplications, 3 divisions, 4 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "turntable_ball.cpp"
//
//   int main() {
//       const double state[10] = {0.53, 0, 1.5707963267948966, 1.5707963267948966, 0, 0, 0.5, 1,
//           4.14849103211e-16, 6.775};
//       double par[9], rate[10];
//       for (int k = 0; k < 3; ++k) par[k] = parameter_values[k];
//       prepare(par);
//       rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

namespace {  // seen in this file alone

// Sines and cosines in pairs, of one angle or of several at once; at the end of this file.
template <typename Real> struct pair;
template <typename Real, unsigned count> struct sines;
template <typename Real> pair<Real> sincos(const Real& x);
template <typename Real, typename... Angle> sines<Real, 1 + sizeof...(Angle)> sincos(const Real& first, const Angle&... x);
inline pair<double> sincos(double x);
inline double sin(double x), cos(double x);

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m = par[0], &a = par[1], &Omega = par[2];

    // Constants
    const Real z0 = m * a * a;
    const Real M22 = Real(0.4) * z0;
    const Real k0 = Real(1) / m;
    const Real k1 = Real(2.5) * Real(1) / z0;
    const Real k2 = Real(0.5) * m;
    const Real k3 = Real(0.2) * z0;
    const Real k4 = Real(3.5) * Real(1) / Omega;

    // Result
    par[3] = M22;
    par[4] = k0;
    par[5] = k1;
    par[6] = k2;
    par[7] = k3;
    par[8] = k4;
}

/// rate = (q', q'') at t and state = (q, q').
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &psi = state[2], &theta = state[3], &x_dot = state[5], &y_dot = state[6], &psi_dot = state[7];
    const Real &theta_dot = state[8], &phi_dot = state[9];
    const Real &a = par[1], &Omega = par[2], &M22 = par[3], &k0 = par[4], &k1 = par[5];

    // Trigonometry
    const auto trig0 = sincos(theta, psi);
    const Real sin_theta = trig0.sine[0], cos_theta = trig0.cosine[0], sin_psi = trig0.sine[1],
        cos_psi = trig0.cosine[1];

    // Shared terms
    const Real z0 = psi_dot * sin_theta;

    // Mass matrix M(q), lower triangle
    // M00 = m, M10 = 0, M11 = m, M20 = 0, M21 = 0, M30 = 0, M31 = 0, M32 = 0, M33 = M22, M40 = 0, M41 = 0, M43 = 0
    // M44 = M22
    const Real M42 = M22 * cos_theta;

    // Forcing f
    // f0 = 0, f1 = 0
    const Real z1 = M22 * phi_dot;
    const Real f2 = theta_dot * z1 * sin_theta;
    const Real f3 = -z1 * z0;
    const Real f4 = M22 * theta_dot * z0;

    // Constraints A q'' = gamma
    const Real A1_3 = a * cos_psi;
    const Real A0_4 = A1_3 * sin_theta;
    const Real z2 = theta_dot * cos_theta;
    const Real z3 = sin_psi * sin_theta;
    const Real A1_4 = a * z3;
    const Real z4 = phi_dot * (sin_psi * z2 + cos_psi * z0);
    const Real z5 = a * (psi_dot * theta_dot * sin_psi - z4);
    const Real gamma1 = z5 + Omega * x_dot;

    // Solve M q'' = f + A^T lambda, A q'' = gamma
    const Real z6 = a * sin_psi;
    const Real z7 = psi_dot * (theta_dot * cos_psi + phi_dot * z3);
    const Real z8 = a * (phi_dot * cos_psi * z2 - z7);
    const Real z9 = k1 * z6;
    const Real z10 = k1 * M42;
    const Real z11 = Real(1) / (M22 - M42 * z10);
    const Real z12 = z11 * A0_4;
    const Real z13 = z9 * z6 + (k0 + z12 * A0_4);
    const Real z14 = k1 * A1_3;
    const Real z15 = z11 * A1_4;
    const Real z16 = z14 * z6 - z15 * A0_4;
    const Real z17 = Real(1) / (z14 * A1_3 + (k0 + z15 * A1_4));
    const Real z18 = z16 * z17;
    const Real z19 = f4 - f2 * z10;
    const Real z20 = z19 * z12 + (z8 + Omega * y_dot);
    const Real z21 = -z14 * f3 - (z19 * z15 - gamma1);
    const Real z22 = (z20 - z9 * f3) - z18 * z21;
    const Real z23 = z22 / (z13 - z16 * z18);
    const Real x_ddot = -k0 * z23;
    const Real z24 = z17 * z21 - z18 * z23;
    const Real y_ddot = k0 * z24;
    const Real phi_ddot = z11 * z19 - z12 * z23 + z15 * z24;
    const Real psi_ddot = k1 * f2 - z10 * phi_ddot;
    const Real theta_ddot = k1 * f3 + z9 * z23 + z14 * z24;

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
    const Real &theta = state[3], &psi_dot = state[7], &theta_dot = state[8], &phi_dot = state[9];
    const Real &m = par[0], &M22 = par[3];

    // Trigonometry
    const auto [sin_theta, cos_theta] = sincos(theta);

    // Mass matrix M(q), lower triangle
    const Real M42 = M22 * cos_theta;

    // Forcing f
    const Real z0 = M22 * phi_dot;
    const Real f2 = theta_dot * z0 * sin_theta;
    const Real z1 = psi_dot * sin_theta;
    const Real f3 = -z0 * z1;
    const Real f4 = M22 * theta_dot * z1;

    // Result
    mass[0] = m;
    mass[1] = mass[5] = Real(0);
    mass[6] = m;
    mass[2] = mass[10] = Real(0);
    mass[7] = mass[11] = Real(0);
    mass[12] = M22;
    mass[3] = mass[15] = Real(0);
    mass[8] = mass[16] = Real(0);
    mass[13] = mass[17] = Real(0);
    mass[18] = M22;
    mass[4] = mass[20] = Real(0);
    mass[9] = mass[21] = Real(0);
    mass[14] = mass[22] = M42;
    mass[19] = mass[23] = Real(0);
    mass[24] = M22;
    forcing[0] = Real(0);
    forcing[1] = Real(0);
    forcing[2] = f2;
    forcing[3] = f3;
    forcing[4] = f4;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &x = state[0], &y = state[1], &psi = state[2], &theta = state[3], &x_dot = state[5];
    const Real &y_dot = state[6], &psi_dot = state[7], &theta_dot = state[8], &phi_dot = state[9];
    const Real &a = par[1], &Omega = par[2], &M22 = par[3], &k0 = par[4], &k1 = par[5], &k2 = par[6];
    const Real &k3 = par[7];

    // Trigonometry
    const auto trig0 = sincos(theta, psi);
    const Real sin_theta = trig0.sine[0], cos_theta = trig0.cosine[0], sin_psi = trig0.sine[1],
        cos_psi = trig0.cosine[1];

    // Energy
    const Real z0 = M22 * cos_theta;
    const Real z1 = M22 * phi_dot;
    const Real z2 = psi_dot * sin_theta;
    const Real z3 = z1 * z2;
    const Real z4 = a * sin_psi;
    const Real z5 = a * cos_psi;
    const Real z6 = z5 * sin_theta;
    const Real z7 = theta_dot * cos_theta;
    const Real z8 = sin_psi * sin_theta;
    const Real z9 = psi_dot * (theta_dot * cos_psi + phi_dot * z8);
    const Real z10 = a * (phi_dot * cos_psi * z7 - z9);
    const Real z11 = a * z8;
    const Real z12 = phi_dot * (sin_psi * z7 + cos_psi * z2);
    const Real z13 = a * (psi_dot * theta_dot * sin_psi - z12);
    const Real z14 = k1 * z4;
    const Real z15 = k1 * z0;
    const Real z16 = Real(1) / (M22 - z0 * z15);
    const Real z17 = z16 * z6;
    const Real z18 = z14 * z4 + (k0 + z17 * z6);
    const Real z19 = k1 * z5;
    const Real z20 = z16 * z11;
    const Real z21 = z19 * z4 - z20 * z6;
    const Real z22 = Real(1) / (z19 * z5 + (k0 + z20 * z11));
    const Real z23 = z21 * z22;
    const Real z24 = M22 * theta_dot * z2 - theta_dot * z1 * sin_theta * z15;
    const Real z25 = z24 * z17 + (z10 + Omega * y_dot);
    const Real z26 = z24 * z20 - (z13 + Omega * x_dot);
    const Real z27 = z19 * z3 - z26;
    const Real z28 = (z14 * z3 + z25) - z23 * z27;
    const Real z29 = z28 / (z18 - z21 * z23);
    const Real z30 = k2 * (x_dot * x_dot + y_dot * y_dot);
    const Real z31 = k3 * (psi_dot * psi_dot + theta_dot * theta_dot + phi_dot * phi_dot);
    const Real T = z30 + z1 * psi_dot * cos_theta + z31;
    const Real z32 = x * (z22 * z27 - z23 * z29);
    const Real P = Omega * (y * z29 + z32);

    // Result
    energy[0] = T;
    energy[1] = Real(0);
    energy[2] = T;
    energy[3] = P;
    jacobi[0] = T;
}

/// The scene's outputs.
template <typename Real>
void outputs_at(const Real&, const Real* state, const Real*, const Real* par, Real* out) {
    const Real &x = state[0], &y = state[1], &theta = state[3], &phi = state[4], &x_dot = state[5];
    const Real &y_dot = state[6], &psi_dot = state[7], &theta_dot = state[8], &phi_dot = state[9];
    const Real &k4 = par[8];

    // Trigonometry
    const auto trig0 = sincos(theta, phi);
    const Real sin_theta = trig0.sine[0], cos_theta = trig0.cosine[0], sin_phi = trig0.sine[1],
        cos_phi = trig0.cosine[1];

    // Outputs
    const Real z0 = psi_dot * sin_theta;
    const Real z1 = sin_theta * sin_phi * (z0 * sin_phi + theta_dot * cos_phi);
    const Real z2 = sin_theta * cos_phi * (z0 * cos_phi - theta_dot * sin_phi);
    const Real spin = cos_theta * (phi_dot + psi_dot * cos_theta) + z1 + z2;
    const Real centre_x = x - k4 * y_dot;
    const Real centre_y = y + k4 * x_dot;

    // Result
    out[0] = spin;
    out[1] = centre_x;
    out[2] = centre_y;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real* par, Real* position, Real* velocity, Real* rows) {
    const Real &x = state[0], &y = state[1], &psi = state[2], &theta = state[3], &phi = state[4];
    const Real &x_dot = state[5], &y_dot = state[6], &psi_dot = state[7], &theta_dot = state[8];
    const Real &phi_dot = state[9];
    const Real &a = par[1], &Omega = par[2];

    // Trigonometry
    const auto trig0 = sincos(theta, psi, phi);
    const Real sin_theta = trig0.sine[0], cos_theta = trig0.cosine[0], sin_psi = trig0.sine[1],
        cos_psi = trig0.cosine[1], sin_phi = trig0.sine[2], cos_phi = trig0.cosine[2];

    // Constraints
    const Real z0 = psi_dot * sin_theta;
    const Real z1 = a * sin_psi;
    const Real z2 = a * cos_psi;
    const Real z3 = z2 * sin_theta;
    const Real z4 = sin_psi * sin_theta;
    const Real z5 = cos_psi * sin_theta;
    const Real z6 = a * z5;
    const Real z7 = cos_psi * cos_theta;
    const Real z8 = sin_psi * sin_phi - z7 * cos_phi;
    const Real z9 = a * z8;
    const Real z10 = sin_psi * cos_phi + z7 * sin_phi;
    const Real z11 = a * z10;
    const Real z12 = theta_dot * (z9 * sin_phi + z11 * cos_phi);
    const Real z13 = (z9 * cos_phi - z11 * sin_phi) * sin_theta;
    const Real z14 = psi_dot * (z6 * cos_theta + z13);
    const Real z15 = phi_dot + psi_dot * cos_theta;
    const Real z16 = z0 * cos_phi - theta_dot * sin_phi;
    const Real z17 = z0 * sin_phi + theta_dot * cos_phi;
    const Real z18 = z5 * z15 + z8 * z16 - z10 * z17;
    const Real z19 = (x_dot + a * z18) + Omega * y;
    const Real z20 = x_dot + phi_dot * z6 - z12 + z14 - z19;
    const Real z21 = a * z4;
    const Real z22 = phi_dot * z21;
    const Real z23 = sin_psi * cos_theta;
    const Real z24 = cos_psi * sin_phi + z23 * cos_phi;
    const Real z25 = a * z24;
    const Real z26 = cos_psi * cos_phi - z23 * sin_phi;
    const Real z27 = a * z26;
    const Real z28 = theta_dot * (z25 * sin_phi + z27 * cos_phi);
    const Real z29 = (z27 * sin_phi - z25 * cos_phi) * sin_theta;
    const Real z30 = psi_dot * (z21 * cos_theta + z29);
    const Real z31 = z4 * z15 - z24 * z16 + z26 * z17;
    const Real z32 = (y_dot + a * z31) - Omega * x;
    const Real z33 = y_dot + z22 + z28 + z30 - z32;

    // Result
    position[0] = Real(0);
    position[1] = Real(0);
    velocity[0] = x_dot - theta_dot * z1 + phi_dot * z3 - z20;
    velocity[1] = y_dot + theta_dot * z2 + z22 - z33;
    rows[0] = Real(1);
    rows[1] = Real(0);
    rows[2] = Real(0);
    rows[3] = -z1;
    rows[4] = z3;
    rows[5] = Real(0);
    rows[6] = Real(1);
    rows[7] = Real(0);
    rows[8] = z2;
    rows[9] = z21;
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real* state, const Real* par, Real* lambda) {
    const Real &psi = state[2], &theta = state[3], &x_dot = state[5], &y_dot = state[6], &psi_dot = state[7];
    const Real &theta_dot = state[8], &phi_dot = state[9];
    const Real &a = par[1], &Omega = par[2], &M22 = par[3], &k0 = par[4], &k1 = par[5];

    // Trigonometry
    const auto trig0 = sincos(theta, psi);
    const Real sin_theta = trig0.sine[0], cos_theta = trig0.cosine[0], sin_psi = trig0.sine[1],
        cos_psi = trig0.cosine[1];

    // Multipliers
    const Real z0 = M22 * cos_theta;
    const Real z1 = M22 * phi_dot;
    const Real z2 = psi_dot * sin_theta;
    const Real z3 = z1 * z2;
    const Real z4 = a * sin_psi;
    const Real z5 = a * cos_psi;
    const Real z6 = z5 * sin_theta;
    const Real z7 = theta_dot * cos_theta;
    const Real z8 = sin_psi * sin_theta;
    const Real z9 = psi_dot * (theta_dot * cos_psi + phi_dot * z8);
    const Real z10 = a * (phi_dot * cos_psi * z7 - z9);
    const Real z11 = a * z8;
    const Real z12 = phi_dot * (sin_psi * z7 + cos_psi * z2);
    const Real z13 = a * (psi_dot * theta_dot * sin_psi - z12);
    const Real z14 = k1 * z4;
    const Real z15 = k1 * z0;
    const Real z16 = Real(1) / (M22 - z0 * z15);
    const Real z17 = z16 * z6;
    const Real z18 = z14 * z4 + (k0 + z17 * z6);
    const Real z19 = k1 * z5;
    const Real z20 = z16 * z11;
    const Real z21 = z19 * z4 - z20 * z6;
    const Real z22 = Real(1) / (z19 * z5 + (k0 + z20 * z11));
    const Real z23 = z21 * z22;
    const Real z24 = M22 * theta_dot * z2 - theta_dot * z1 * sin_theta * z15;
    const Real z25 = z24 * z17 + (z10 + Omega * y_dot);
    const Real z26 = z24 * z20 - (z13 + Omega * x_dot);
    const Real z27 = z19 * z3 - z26;
    const Real z28 = (z14 * z3 + z25) - z23 * z27;
    const Real z29 = z28 / (z18 - z21 * z23);
    const Real lambda_y = z22 * z27 - z23 * z29;
    const Real lambda_x = -z29;

    // Result
    lambda[0] = lambda_x;
    lambda[1] = lambda_y;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real* par, Real* out, Real* position, Real* pivots) {
    const Real &x = state[0], &y = state[1], &psi = state[2], &theta = state[3], &phi = state[4];
    const Real &x_dot = state[5], &y_dot = state[6], &psi_dot = state[7], &theta_dot = state[8];
    const Real &phi_dot = state[9];
    const Real &a = par[1], &Omega = par[2], &M22 = par[3], &k0 = par[4], &k1 = par[5];

    // Trigonometry
    const auto trig0 = sincos(theta, psi, phi);
    const Real sin_theta = trig0.sine[0], cos_theta = trig0.cosine[0], sin_psi = trig0.sine[1],
        cos_psi = trig0.cosine[1], sin_phi = trig0.sine[2], cos_phi = trig0.cosine[2];

    // Projection
    const Real z0 = M22 * cos_theta;
    const Real z1 = psi_dot * sin_theta;
    const Real z2 = a * sin_psi;
    const Real z3 = a * cos_psi;
    const Real z4 = z3 * sin_theta;
    const Real z5 = sin_psi * sin_theta;
    const Real z6 = cos_psi * sin_theta;
    const Real z7 = a * z6;
    const Real z8 = cos_psi * cos_theta;
    const Real z9 = sin_psi * sin_phi - z8 * cos_phi;
    const Real z10 = a * z9;
    const Real z11 = sin_psi * cos_phi + z8 * sin_phi;
    const Real z12 = a * z11;
    const Real z13 = theta_dot * (z10 * sin_phi + z12 * cos_phi);
    const Real z14 = (z10 * cos_phi - z12 * sin_phi) * sin_theta;
    const Real z15 = psi_dot * (z7 * cos_theta + z14);
    const Real z16 = phi_dot + psi_dot * cos_theta;
    const Real z17 = z1 * cos_phi - theta_dot * sin_phi;
    const Real z18 = z1 * sin_phi + theta_dot * cos_phi;
    const Real z19 = z6 * z16 + z9 * z17 - z11 * z18;
    const Real z20 = (x_dot + a * z19) + Omega * y;
    const Real z21 = x_dot + phi_dot * z7 - z13 + z15 - z20;
    const Real z22 = x_dot - theta_dot * z2 + phi_dot * z4 - z21;
    const Real z23 = a * z5;
    const Real z24 = phi_dot * z23;
    const Real z25 = sin_psi * cos_theta;
    const Real z26 = cos_psi * sin_phi + z25 * cos_phi;
    const Real z27 = a * z26;
    const Real z28 = cos_psi * cos_phi - z25 * sin_phi;
    const Real z29 = a * z28;
    const Real z30 = theta_dot * (z27 * sin_phi + z29 * cos_phi);
    const Real z31 = (z29 * sin_phi - z27 * cos_phi) * sin_theta;
    const Real z32 = psi_dot * (z23 * cos_theta + z31);
    const Real z33 = z5 * z16 - z26 * z17 + z28 * z18;
    const Real z34 = (y_dot + a * z33) - Omega * x;
    const Real z35 = y_dot + z24 + z30 + z32 - z34;
    const Real z36 = y_dot + theta_dot * z3 + z24 - z35;
    const Real z37 = k1 * z2;
    const Real z38 = k1 * z0;
    const Real z39 = Real(1) / (M22 - z0 * z38);
    const Real z40 = z39 * z4;
    const Real z41 = z37 * z2 + (k0 + z40 * z4);
    const Real z42 = k1 * z3;
    const Real z43 = z39 * z23;
    const Real z44 = z42 * z2 - z43 * z4;
    const Real z45 = z42 * z3 + (k0 + z43 * z23);
    const Real z46 = Real(1) / z45;
    const Real z47 = z44 * z46;
    const Real z48 = z41 - z44 * z47;
    const Real z49 = (z47 * z36 + z22) / z48;
    const Real z50 = z46 * z36 + z47 * z49;
    const Real z51 = z40 * z49 + z43 * z50;

    // Result
    out[0] = x;
    out[1] = y;
    out[2] = psi;
    out[3] = theta;
    out[4] = phi;
    out[5] = x_dot - k0 * z49;
    out[6] = y_dot - k0 * z50;
    out[7] = psi_dot + z38 * z51;
    out[8] = theta_dot + (z37 * z49 - z42 * z50);
    out[9] = phi_dot - z51;
    position[0] = Real(0);
    position[1] = Real(0);
    pivots[0] = z48;
    pivots[1] = z45;
}

/// gamma of A q'' = gamma.
template <typename Real>
void gamma_at(const Real&, const Real* state, const Real* par, Real* out) {
    const Real &psi = state[2], &theta = state[3], &x_dot = state[5], &y_dot = state[6], &psi_dot = state[7];
    const Real &theta_dot = state[8], &phi_dot = state[9];
    const Real &a = par[1], &Omega = par[2];

    // Trigonometry
    const auto trig0 = sincos(theta, psi);
    const Real sin_theta = trig0.sine[0], cos_theta = trig0.cosine[0], sin_psi = trig0.sine[1],
        cos_psi = trig0.cosine[1];

    // Constraints
    const Real z0 = theta_dot * cos_theta;
    const Real z1 = psi_dot * (theta_dot * cos_psi + phi_dot * sin_psi * sin_theta);
    const Real z2 = a * (phi_dot * cos_psi * z0 - z1);
    const Real gamma0 = -z2 - Omega * y_dot;
    const Real z3 = phi_dot * (sin_psi * z0 + cos_psi * psi_dot * sin_theta);
    const Real z4 = a * (psi_dot * theta_dot * sin_psi - z3);
    const Real gamma1 = z4 + Omega * x_dot;

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

#if defined(__FAST_MATH__) || defined(ALEMBERT_REASSOCIATES)
constexpr bool is_reducible = false;  // the reduction does not survive sums in another order
#else
constexpr bool is_reducible = true;
#endif
constexpr double farthest = 1e8;
[[gnu::always_inline]] inline bool is_near(double x) { return is_reducible && __builtin_fabs(x) <= farthest; }
/// Are all angles near whose squares make this sum? (If not, some may be.)
[[gnu::always_inline]] inline bool is_near_all(double squares) { return is_reducible && squares <= farthest * farthest; }
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
template <typename Real> constexpr bool fuses = requires(const Real& x) { fused(x, 1.0, x); };

template <typename Bits, typename Real>
[[gnu::always_inline]] inline void sines_near(const Real& x, Real& sine, Real& cosine) {
    constexpr double shift = 0x1.8p52;  // adding it rounds to a whole number, in the last bits
    const Real shifted = x * 0x1.45f306dc9c883p-1 + shift, turns = shifted - shift;
    const Bits k = __builtin_bit_cast(Bits, shifted);
    Real hi, lo;
    if constexpr (fuses<Real>) {
        hi = fused(turns, -0x1.1a62633145c06p-54, fused(turns, -0x1.921fb54442d18p0, x));
        hi = fused(turns, -0x1.c1cd129024e09p-107, hi);
    } else {
        hi = ((x - turns * 0x1.921fb54p0) - turns * 0x1.10b46p-30) - turns * 0x1.1a62630p-54;
        lo = turns * 0x1.8a2e03707344ap-81;
    }
    const Real z = hi * hi, zz = z * z;
    const Real P = (0.1666666666666663 - 0.008333333333322118 * z) +
                   zz * ((0.00019841269829589533 - 2.7557313621383334e-06 * z) + zz * (2.505074776244275e-08 - 1.5896230131492603e-10 * z));
    const Real Q = (0.041666666666666595 - 0.0013888888888873056 * z) +
                   zz * ((2.4801587288851683e-05 - 2.755731417929107e-07 * z) + zz * (2.0875700841213046e-09 - 1.13585364822807e-11 * z));
    Real s;
    if constexpr (fuses<Real>)
        s = hi * (1 - z * P);
    else
        s = hi - (hi * z * P + lo);
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

// What the runtime loads (alembert/native/abi.hpp).

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
constexpr const char* parameter_names[] = { "m", "a", "Omega", nullptr};
constexpr const char* output_names[] = { "spin", "centre_x", "centre_y", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.5, 0.2, 3.5, 0};

constexpr alembert_solver_table table{
    4, 5, 5, 3, 6, 3, 0, 2, "turntable_ball", "routh, textbook form",
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
    [](double, const double*, const double*, const double*, double*) {},
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
    [](double t, const double* state, const double* par, double* gamma) { gamma_at(t, state, par, gamma); },
};

}  // namespace

extern "C" __attribute__((visibility("default"))) const void* alembert_projection() { return &projection; }

