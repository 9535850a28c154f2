// Equations of motion of 'ball_on_turntable': kane, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
// M(q) u' = f(q, u, t), q' = h(q, u, t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[8]        x [m], y [m], psi [rad], theta [rad], phi [rad], then wx, wy, wz
//   rate[8]         d state / dt
//   par[15]         m = 0.4 [kg], r = 0.05 [m], Omega = 3 [rad/s],
//                   then 12 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[9], M row by row; forcing[3], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   outputs_at      out[3]: wx, wy, wz
//   constraints_at  position[2], velocity[2]; rows[16], A row by row
//   multipliers_at  lambda[2]
//   cost            28 operations a right-hand side: 7 additions, 16 multiplications, 1 division, 4 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "ball_on_turntable.cpp"
//
//   int main() {
//       const double state[8] = {0.3, -0.1, 0.1, 1.2, 0.4, 1, 4, 0.5};
//       double par[15], rate[8];
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
    const Real &m = par[0], &r = par[1], &Omega = par[2];

    // Constants
    const Real k0 = m * r * r;
    const Real M00 = Real(1.4) * k0;
    const Real M22 = Real(0.4) * k0;
    const Real k1 = m * r * Omega * Omega;
    const Real k2 = m * r * r * Omega;
    const Real k3 = (Real(5) / Real(7)) * Real(1) / k0;
    const Real k4 = r * r;
    const Real k5 = k4 + Real(1);
    const Real k6 = Real(1) / k5;
    const Real k7 = r * r * k6;
    const Real k8 = Real(0.5) * m;
    const Real k9 = Real(0.2) * k0;

    // Result
    par[3] = k0;
    par[4] = M00;
    par[5] = M22;
    par[6] = k1;
    par[7] = k2;
    par[8] = k3;
    par[9] = k4;
    par[10] = k5;
    par[11] = k6;
    par[12] = k7;
    par[13] = k8;
    par[14] = k9;
}

/// rate = (q', u') at t and state = (q, u).
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &x = state[0], &y = state[1], &psi = state[2], &theta = state[3], &wx = state[5], &wy = state[6];
    const Real &wz = state[7];
    const Real &r = par[1], &Omega = par[2], &k1 = par[6], &k2 = par[7], &k3 = par[8];

    // Trigonometry
    const auto trig0 = sincos(psi, theta);
    const Real sin_psi = trig0.sine[0], cos_psi = trig0.cosine[0], sin_theta = trig0.sine[1],
        cos_theta = trig0.cosine[1];

    // Kinematics q' = h(q, u, t)
    const Real x_dot = r * wy - Omega * y;
    const Real phi_dot = (wx * sin_psi - wy * cos_psi) / sin_theta;
    const Real theta_dot = wx * cos_psi + wy * sin_psi;
    const Real psi_dot = wz - phi_dot * cos_theta;
    const Real y_dot = Omega * x - r * wx;

    // Mass matrix M(q), lower triangle
    // M10 = 0, M11 = M00, M20 = 0, M21 = 0

    // Forcing f
    // f2 = 0
    const Real f0 = k2 * wy - k1 * y;
    const Real f1 = k1 * x - k2 * wx;

    // Solve M u' = f with M = L D L^T
    const Real wx_dot = k3 * f0;
    const Real wy_dot = k3 * f1;

    // Result
    rate[0] = x_dot;
    rate[1] = y_dot;
    rate[2] = psi_dot;
    rate[3] = theta_dot;
    rate[4] = phi_dot;
    rate[5] = wx_dot;
    rate[6] = wy_dot;
    rate[7] = Real(0);
}

/// M (s by s, row-major) and f of M u' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &x = state[0], &y = state[1], &wx = state[5], &wy = state[6];
    const Real &M00 = par[4], &M22 = par[5], &k1 = par[6], &k2 = par[7];

    // Forcing f
    const Real f0 = k2 * wy - k1 * y;
    const Real f1 = k1 * x - k2 * wx;

    // Result
    mass[0] = M00;
    mass[1] = mass[3] = Real(0);
    mass[4] = M00;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = M22;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = Real(0);
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &x = state[0], &y = state[1], &psi = state[2], &theta = state[3], &phi = state[4], &wx = state[5];
    const Real &wy = state[6], &wz = state[7];
    const Real &m = par[0], &r = par[1], &Omega = par[2], &k0 = par[3], &M22 = par[5], &k1 = par[6], &k2 = par[7];
    const Real &k3 = par[8], &k4 = par[9], &k5 = par[10], &k6 = par[11], &k7 = par[12], &k8 = par[13];
    const Real &k9 = par[14];

    // Trigonometry
    const auto trig0 = sincos(psi, theta, phi);
    const Real sin_psi = trig0.sine[0], cos_psi = trig0.cosine[0], sin_theta = trig0.sine[1],
        cos_theta = trig0.cosine[1], sin_phi = trig0.sine[2], cos_phi = trig0.cosine[2];

    // Energy
    const Real z0 = r * cos_psi * sin_theta;
    const Real z1 = cos_psi * cos_theta;
    const Real z2 = r * (sin_psi * sin_phi - z1 * cos_phi);
    const Real z3 = r * (sin_psi * cos_phi + z1 * sin_phi);
    const Real z4 = (z2 * cos_phi - z3 * sin_phi) * sin_theta;
    const Real z5 = r * wy - Omega * y;
    const Real z6 = Real(1) / sin_theta;
    const Real z7 = (wx * sin_psi - wy * cos_psi) * z6;
    const Real z8 = wx * cos_psi + wy * sin_psi;
    const Real z9 = wz - z7 * cos_theta;
    const Real z10 = z7 + z9 * cos_theta;
    const Real z11 = z9 * sin_theta;
    const Real z12 = z8 * sin_phi - z11 * cos_phi;
    const Real z13 = z8 * cos_phi + z11 * sin_phi;
    const Real z14 = r * sin_psi * sin_theta;
    const Real z15 = sin_psi * cos_theta;
    const Real z16 = r * (cos_psi * cos_phi - z15 * sin_phi);
    const Real z17 = r * (cos_psi * sin_phi + z15 * cos_phi);
    const Real z18 = (z16 * sin_phi - z17 * cos_phi) * sin_theta;
    const Real z19 = r * wx - Omega * x;
    const Real z20 = k3 * (k1 * y - k2 * wy);
    const Real z21 = k3 * (k1 * x - k2 * wx);
    const Real z22 = m * (r * z20 + Omega * z5);
    const Real z23 = (z21 * cos_psi + z20 * sin_psi) * z6;
    const Real z24 = sin_psi * z9;
    const Real z25 = wy * z24 * z6;
    const Real z26 = cos_psi * z9;
    const Real z27 = z8 * cos_theta;
    const Real z28 = z7 * z6;
    const Real z29 = z23 - (z25 + wx * z26 * z6 - z27 * z28);
    const Real z30 = k0 * cos_theta;
    const Real z31 = z8 * sin_theta;
    const Real z32 = wx * z26 * cos_theta * z6;
    const Real z33 = wy * z24 * cos_theta * z6;
    const Real z34 = z31 * z7 - z32 - z33 + z27 * z28 * cos_theta;
    const Real z35 = z23 * cos_theta + z34;
    const Real z36 = k0 * z12;
    const Real z37 = k0 * z13;
    const Real z38 = z36 * z13 - z37 * z12;
    const Real z39 = k0 * z31 * z9 + z38;
    const Real z40 = M22 * z29 - Real(0.4) * z30 * z35 + Real(0.4) * z39;
    const Real z41 = k0 * sin_phi;
    const Real z42 = k0 * cos_phi;
    const Real z43 = z20 * cos_psi;
    const Real z44 = z43 - z21 * sin_psi - wy * z26 + wx * z24;
    const Real z45 = (z41 * sin_phi + z42 * cos_phi) * z44;
    const Real z46 = sin_theta * sin_phi;
    const Real z47 = sin_theta * cos_phi;
    const Real z48 = z42 * z46 - z41 * z47;
    const Real z49 = z7 * sin_phi;
    const Real z50 = z27 * z9;
    const Real z51 = z7 * cos_phi;
    const Real z52 = z8 * z49 - z50 * sin_phi - z51 * z11;
    const Real z53 = k0 * z10;
    const Real z54 = k0 * z52 - (z36 * z10 - z53 * z12);
    const Real z55 = z8 * z51 - z50 * cos_phi + z49 * z11;
    const Real z56 = k0 * z55 + (z53 * z13 - z37 * z10);
    const Real z57 = z54 * cos_phi - z56 * sin_phi;
    const Real z58 = z45 - z48 * z35 + z57;
    const Real z59 = z58 * (z17 * sin_phi + z16 * cos_phi);
    const Real z60 = k0 * z46 * z46;
    const Real z61 = z30 * cos_theta + z60 + k0 * z47 * z47;
    const Real z62 = z39 * cos_theta + z54 * z46 + z56 * z47;
    const Real z63 = z48 * z44 + z30 * z29 - z61 * z35 + z62;
    const Real z64 = z63 * (z14 * cos_theta + z18);
    const Real z65 = z22 - z40 * z14 - Real(0.4) * z59 - Real(0.4) * z64;
    const Real z66 = Real(1) / (k4 * sin_theta * sin_theta + Real(1));
    const Real z67 = k7 * z66 * sin_psi * cos_psi * cos_theta * cos_theta;
    const Real z68 = m * (r * z21 + Omega * z19);
    const Real z69 = z58 * (z2 * sin_phi + z3 * cos_phi);
    const Real z70 = z63 * (z0 * cos_theta + z4);
    const Real z71 = z68 - z40 * z0 + Real(0.4) * z69 - Real(0.4) * z70;
    const Real z72 = z71 * k6 * z66 * (k5 - k4 * sin_psi * sin_psi * cos_theta * cos_theta);
    const Real z73 = z65 * k6 * z66 * (k5 - k4 * cos_psi * cos_psi * cos_theta * cos_theta);
    const Real z74 = k8 * (z19 * z19 + z5 * z5);
    const Real z75 = k9 * (z8 * z8 + z7 * z7 + z9 * z9);
    const Real T = z74 + M22 * z7 * z9 * cos_theta + z75;
    const Real z76 = x * (z71 * z67 + z73);
    const Real P = Omega * (z76 - y * (z65 * z67 + z72));

    // Result
    energy[0] = T;
    energy[1] = Real(0);
    energy[2] = T;
    energy[3] = P;
    jacobi[0] = T;
}

/// The scene's outputs.
template <typename Real>
void outputs_at(const Real&, const Real* state, const Real*, const Real*, Real* out) {
    const Real &wx = state[5], &wy = state[6], &wz = state[7];

    // Result
    out[0] = wx;
    out[1] = wy;
    out[2] = wz;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real* par, Real* position, Real* velocity, Real* rows) {
    const Real &x = state[0], &y = state[1], &psi = state[2], &theta = state[3], &phi = state[4], &wx = state[5];
    const Real &wy = state[6], &wz = state[7];
    const Real &r = par[1], &Omega = par[2];

    // Trigonometry
    const auto trig0 = sincos(psi, theta, phi);
    const Real sin_psi = trig0.sine[0], cos_psi = trig0.cosine[0], sin_theta = trig0.sine[1],
        cos_theta = trig0.cosine[1], sin_phi = trig0.sine[2], cos_phi = trig0.cosine[2];

    // Constraints
    const Real z0 = cos_psi * sin_theta;
    const Real z1 = r * z0;
    const Real z2 = cos_psi * cos_theta;
    const Real z3 = sin_psi * sin_phi - z2 * cos_phi;
    const Real z4 = r * z3;
    const Real z5 = sin_psi * cos_phi + z2 * sin_phi;
    const Real z6 = r * z5;
    const Real z7 = (z4 * cos_phi - z6 * sin_phi) * sin_theta;
    const Real z8 = z1 * cos_theta + z7;
    const Real z9 = z4 * sin_phi + z6 * cos_phi;
    const Real z10 = Omega * y;
    const Real z11 = r * wy - z10;
    const Real z12 = (wx * sin_psi - wy * cos_psi) / sin_theta;
    const Real z13 = z1 * z12;
    const Real z14 = wx * cos_psi + wy * sin_psi;
    const Real z15 = z9 * z14;
    const Real z16 = wz - z12 * cos_theta;
    const Real z17 = z8 * z16;
    const Real z18 = z12 + z16 * cos_theta;
    const Real z19 = z16 * sin_theta;
    const Real z20 = z14 * sin_phi - z19 * cos_phi;
    const Real z21 = z14 * cos_phi + z19 * sin_phi;
    const Real z22 = z0 * z18 - z3 * z20 - z5 * z21;
    const Real z23 = z11 + z13 - z15 + z17 - (z11 + r * z22 + z10);
    const Real z24 = sin_psi * sin_theta;
    const Real z25 = r * z24;
    const Real z26 = sin_psi * cos_theta;
    const Real z27 = cos_psi * cos_phi - z26 * sin_phi;
    const Real z28 = r * z27;
    const Real z29 = cos_psi * sin_phi + z26 * cos_phi;
    const Real z30 = r * z29;
    const Real z31 = (z28 * sin_phi - z30 * cos_phi) * sin_theta;
    const Real z32 = z25 * cos_theta + z31;
    const Real z33 = z30 * sin_phi + z28 * cos_phi;
    const Real z34 = Omega * x;
    const Real z35 = r * wx - z34;
    const Real z36 = z25 * z12;
    const Real z37 = z33 * z14;
    const Real z38 = z32 * z16;
    const Real z39 = z24 * z18 + z29 * z20 + z27 * z21;
    const Real z40 = z35 - z36 - z37 - z38 - (z35 - r * z39 + z34);

    // Result
    position[0] = Real(0);
    position[1] = Real(0);
    velocity[0] = z11 + z13 - z15 + z17 - z23;
    velocity[1] = z36 - z35 + z37 + z38 + z40;
    rows[0] = Real(1);
    rows[1] = Real(0);
    rows[2] = z8;
    rows[3] = -z9;
    rows[4] = z1;
    rows[5] = Real(0);
    rows[6] = Real(1);
    rows[7] = z32;
    rows[8] = z33;
    rows[9] = z25;
    rows[10] = Real(0);
    rows[11] = Real(0);
    rows[12] = Real(0);
    rows[13] = Real(0);
    rows[14] = Real(0);
    rows[15] = Real(0);
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at(const Real&, const Real* state, const Real* par, Real* lambda) {
    const Real &x = state[0], &y = state[1], &psi = state[2], &theta = state[3], &phi = state[4], &wx = state[5];
    const Real &wy = state[6], &wz = state[7];
    const Real &m = par[0], &r = par[1], &Omega = par[2], &k0 = par[3], &M22 = par[5], &k1 = par[6], &k2 = par[7];
    const Real &k3 = par[8], &k4 = par[9], &k5 = par[10], &k6 = par[11], &k7 = par[12];

    // Trigonometry
    const auto trig0 = sincos(psi, theta, phi);
    const Real sin_psi = trig0.sine[0], cos_psi = trig0.cosine[0], sin_theta = trig0.sine[1],
        cos_theta = trig0.cosine[1], sin_phi = trig0.sine[2], cos_phi = trig0.cosine[2];

    // Multipliers
    const Real z0 = r * cos_psi * sin_theta;
    const Real z1 = cos_psi * cos_theta;
    const Real z2 = r * (sin_psi * sin_phi - z1 * cos_phi);
    const Real z3 = r * (sin_psi * cos_phi + z1 * sin_phi);
    const Real z4 = (z2 * cos_phi - z3 * sin_phi) * sin_theta;
    const Real z5 = Real(1) / sin_theta;
    const Real z6 = (wx * sin_psi - wy * cos_psi) * z5;
    const Real z7 = wx * cos_psi + wy * sin_psi;
    const Real z8 = wz - z6 * cos_theta;
    const Real z9 = z6 + z8 * cos_theta;
    const Real z10 = z8 * sin_theta;
    const Real z11 = z7 * sin_phi - z10 * cos_phi;
    const Real z12 = z7 * cos_phi + z10 * sin_phi;
    const Real z13 = r * sin_psi * sin_theta;
    const Real z14 = sin_psi * cos_theta;
    const Real z15 = r * (cos_psi * cos_phi - z14 * sin_phi);
    const Real z16 = r * (cos_psi * sin_phi + z14 * cos_phi);
    const Real z17 = (z15 * sin_phi - z16 * cos_phi) * sin_theta;
    const Real z18 = k3 * (k1 * y - k2 * wy);
    const Real z19 = k3 * (k1 * x - k2 * wx);
    const Real z20 = Omega * (r * wy - Omega * y);
    const Real z21 = m * (r * z18 + z20);
    const Real z22 = (z19 * cos_psi + z18 * sin_psi) * z5;
    const Real z23 = sin_psi * z8;
    const Real z24 = wy * z23 * z5;
    const Real z25 = cos_psi * z8;
    const Real z26 = z7 * cos_theta;
    const Real z27 = z6 * z5;
    const Real z28 = z22 - (z24 + wx * z25 * z5 - z26 * z27);
    const Real z29 = k0 * cos_theta;
    const Real z30 = z7 * sin_theta;
    const Real z31 = wx * z25 * cos_theta * z5;
    const Real z32 = wy * z23 * cos_theta * z5;
    const Real z33 = z30 * z6 - z31 - z32 + z26 * z27 * cos_theta;
    const Real z34 = z22 * cos_theta + z33;
    const Real z35 = k0 * z11;
    const Real z36 = k0 * z12;
    const Real z37 = z35 * z12 - z36 * z11;
    const Real z38 = k0 * z30 * z8 + z37;
    const Real z39 = M22 * z28 - Real(0.4) * z29 * z34 + Real(0.4) * z38;
    const Real z40 = k0 * sin_phi;
    const Real z41 = k0 * cos_phi;
    const Real z42 = z18 * cos_psi;
    const Real z43 = z42 - z19 * sin_psi - wy * z25 + wx * z23;
    const Real z44 = (z40 * sin_phi + z41 * cos_phi) * z43;
    const Real z45 = sin_theta * sin_phi;
    const Real z46 = sin_theta * cos_phi;
    const Real z47 = z41 * z45 - z40 * z46;
    const Real z48 = z6 * sin_phi;
    const Real z49 = z26 * z8;
    const Real z50 = z6 * cos_phi;
    const Real z51 = z7 * z48 - z49 * sin_phi - z50 * z10;
    const Real z52 = k0 * z9;
    const Real z53 = k0 * z51 - (z35 * z9 - z52 * z11);
    const Real z54 = z7 * z50 - z49 * cos_phi + z48 * z10;
    const Real z55 = k0 * z54 + (z52 * z12 - z36 * z9);
    const Real z56 = z53 * cos_phi - z55 * sin_phi;
    const Real z57 = z44 - z47 * z34 + z56;
    const Real z58 = z57 * (z16 * sin_phi + z15 * cos_phi);
    const Real z59 = k0 * z45 * z45;
    const Real z60 = z29 * cos_theta + z59 + k0 * z46 * z46;
    const Real z61 = z38 * cos_theta + z53 * z45 + z55 * z46;
    const Real z62 = z47 * z43 + z29 * z28 - z60 * z34 + z61;
    const Real z63 = z62 * (z13 * cos_theta + z17);
    const Real z64 = z21 - z39 * z13 - Real(0.4) * z58 - Real(0.4) * z63;
    const Real z65 = Real(1) / (k4 * sin_theta * sin_theta + Real(1));
    const Real z66 = k7 * z65 * sin_psi * cos_psi * cos_theta * cos_theta;
    const Real z67 = Omega * (r * wx - Omega * x);
    const Real z68 = m * (r * z19 + z67);
    const Real z69 = z57 * (z2 * sin_phi + z3 * cos_phi);
    const Real z70 = z62 * (z0 * cos_theta + z4);
    const Real z71 = z68 - z39 * z0 + Real(0.4) * z69 - Real(0.4) * z70;
    const Real z72 = z71 * k6 * z65 * (k5 - k4 * sin_psi * sin_psi * cos_theta * cos_theta);
    const Real lambda_rolling_x = z64 * z66 + z72;
    const Real z73 = z64 * k6 * z65 * (k5 - k4 * cos_psi * cos_psi * cos_theta * cos_theta);
    const Real lambda_rolling_y = z71 * z66 + z73;

    // Result
    lambda[0] = lambda_rolling_x;
    lambda[1] = lambda_rolling_y;
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
constexpr const char* speed_names[] = { "wx", "wy", "wz", nullptr};
constexpr const char* parameter_names[] = { "m", "r", "Omega", nullptr};
constexpr const char* output_names[] = { "wx", "wy", "wz", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 0.4, 0.05, 3, 0};

constexpr alembert_solver_table table{
    4, 5, 3, 3, 12, 3, 0, 2, "ball_on_turntable", "kane, textbook form",
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
    nullptr,
    nullptr,
};

}  // namespace

extern "C" __attribute__((visibility("default"))) const void* alembert_projection() { return &projection; }

