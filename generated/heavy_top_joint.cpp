// SPDX-License-Identifier: MIT
// Equations of motion of 'heavy_top_joint': kane, textbook form.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//   alembert emit heavy_top_joint.toml -o .
//
// M(q) u' = f(q, u, t), q' = h(q, u, t).
// This file includes nothing and allocates nothing. Real is double, or another type of numbers with the functions used.
//
//   t               the time [s]
//   state[7]        e0, e1, e2, e3, then w1 [rad/s], w2 [rad/s], w3 [rad/s]
//   rate[7]         d state / dt
//   par[16]         m = 2 [kg], l = 0.5 [m], g = 1 [m/s^2], A = 1 [kg m^2], C = 0.5 [kg m^2], theta0 = 1 [rad],
//                   then 10 numbers that prepare computes from them; call it after each change
//   mass_forcing    mass[9], M row by row; forcing[3], f
//   energy          energy[4]: T, V, E = T + V [J], and the power [W] of loads and prescribed motions; jacobi[1]
//   outputs_at      out[5]: height, vertical, w1, w2, w3
//   constraints_at  position[1], velocity[1]; rows[7], A row by row
//   rows of A       top
//   multipliers_at  lambda[1]: lambda_top
//   project         out[7], position[1], pivots[1]
//   cost            49 operations a right-hand side: 15 additions, 33 multiplications, 1 division, 0 functions
//
// Example: the rates at the scene's initial state. Compile it with c++ -std=c++20 -O2 example.cpp
//
//   #include <cstdio>
//   #include "heavy_top_joint.cpp"
//
//   int main() {
//       const double state[7] = {0.8775825618903728, 0.479425538604203, 0, 0, 0, 0, 4};
//       double par[16], rate[7];
//       for (int k = 0; k < 6; ++k) par[k] = heavy_top_joint::parameter_values[k];
//       heavy_top_joint::prepare(par);
//       heavy_top_joint::rhs(0.0, state, par, rate);
//       for (const double value : rate) std::printf("%.17g\n", value);
//   }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // some are for other types of numbers
#pragma GCC diagnostic ignored "-Wpsabi"            // all functions with vectors are inline
namespace heavy_top_joint::code_78bdc010 {
namespace {  // seen in this file alone

/// What depends on parameters alone, after the parameters.
template <typename Real>
void prepare(Real* par) {
    const Real &m = par[0], &l = par[1], &g = par[2], &A = par[3], &C = par[4];

    // Constants
    const Real k0 = A - C;
    const Real k1 = Real(2) * m * l * g;
    const Real k2 = Real(1) / A;
    const Real k3 = m * g;
    const Real k4 = l * k3;
    const Real k5 = A - m * l * l;
    const Real k6 = Real(2) * l;
    const Real k7 = Real(0.5) * k5;
    const Real k8 = Real(0.5) * C;
    const Real k9 = Real(2) * A;

    // Result
    par[6] = k0;
    par[7] = k1;
    par[8] = k2;
    par[9] = k3;
    par[10] = k4;
    par[11] = k5;
    par[12] = k6;
    par[13] = k7;
    par[14] = k8;
    par[15] = k9;
}

/// rate = (q', u') at t and state = (q, u).
template <typename Real>
void rhs(const Real&, const Real* state, const Real* par, Real* rate) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];
    const Real &k0 = par[6], &k1 = par[7], &k2 = par[8];

    // Kinematics q' = h(q, u, t)
    const Real e0_dot = -Real(0.5) * (e1 * w1 + e2 * w2 + e3 * w3);
    const Real e1_dot = Real(0.5) * (e0 * w1 + e2 * w3 - e3 * w2);
    const Real e2_dot = Real(0.5) * (e0 * w2 - e1 * w3 + e3 * w1);
    const Real e3_dot = Real(0.5) * (e0 * w3 + e1 * w2 - e2 * w1);

    // Mass matrix M(q), lower triangle
    // M00 = A, M10 = 0, M11 = A, M20 = 0, M21 = 0, M22 = C

    // Forcing f
    // f2 = 0
    const Real z0 = (e0 * e0 + e3 * e3) + (e1 * e1 + e2 * e2);
    const Real z1 = k1 / z0;
    const Real z2 = z1 * (e0 * e1 + e2 * e3);
    const Real f0 = z2 + w2 * k0 * w3;
    const Real z3 = z1 * (e0 * e2 - e1 * e3);
    const Real f1 = z3 - w3 * k0 * w1;

    // Solve M u' = f with M = L D L^T
    const Real w1_dot = k2 * f0;
    const Real w2_dot = k2 * f1;

    // Result
    rate[0] = e0_dot;
    rate[1] = e1_dot;
    rate[2] = e2_dot;
    rate[3] = e3_dot;
    rate[4] = w1_dot;
    rate[5] = w2_dot;
    rate[6] = Real(0);
}

/// M (s by s, row-major) and f of M u' = f.
template <typename Real>
void mass_forcing(const Real&, const Real* state, const Real* par, Real* mass, Real* forcing) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];
    const Real &A = par[3], &C = par[4], &k0 = par[6], &k1 = par[7];

    // Forcing f
    const Real z0 = (e0 * e0 + e3 * e3) + (e1 * e1 + e2 * e2);
    const Real z1 = k1 / z0;
    const Real z2 = z1 * (e0 * e1 + e2 * e3);
    const Real f0 = z2 + w2 * k0 * w3;
    const Real z3 = z1 * (e0 * e2 - e1 * e3);
    const Real f1 = z3 - w3 * k0 * w1;

    // Result
    mass[0] = A;
    mass[1] = mass[3] = Real(0);
    mass[4] = A;
    mass[2] = mass[6] = Real(0);
    mass[5] = mass[7] = Real(0);
    mass[8] = C;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = Real(0);
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy(const Real&, const Real* state, const Real*, const Real* par, Real* energy, Real* jacobi) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];
    const Real &l = par[1], &A = par[3], &C = par[4], &k3 = par[9];

    // Energy
    const Real z0 = e0 * e0 + e3 * e3;
    const Real z1 = e1 * e1 + e2 * e2;
    const Real z2 = A * (w1 * w1 + w2 * w2) + C * w3 * w3;
    const Real T = Real(0.5) * z2;
    const Real z3 = l * (z0 - z1) / (z0 + z1);
    const Real V = k3 * z3;
    const Real E = V + Real(0.5) * z2;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = Real(0);
    jacobi[0] = E;
}

/// The scene's outputs.
template <typename Real>
void outputs_at(const Real&, const Real* state, const Real*, const Real* par, Real* out) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];
    const Real &C = par[4], &k9 = par[15];

    // Outputs
    const Real z0 = e0 * e0 + e3 * e3;
    const Real z1 = e1 * e1 + e2 * e2;
    const Real z2 = Real(1) / (z0 + z1);
    const Real z3 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z4 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z5 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z6 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z7 = e0 * z4 - e2 * z5;
    const Real z8 = e3 * z4 - e2 * z6;
    const Real z9 = z2 * (z8 - (e0 * z3 + e1 * z5));
    const Real z10 = e2 * z4;
    const Real z11 = z10 - e1 * z3 + e0 * z5 + e3 * z6;
    const Real z12 = z2 * (z7 + (e3 * z3 + e1 * z6));
    const Real height = (z0 - z1) * z2;
    const Real z13 = (e0 * e2 - e1 * e3) * z2 * z12;
    const Real z14 = (e0 * e1 + e2 * e3) * z2 * z9;
    const Real z15 = C * height * z2 * z11;
    const Real vertical = z15 - k9 * (z13 + z14);

    // Result
    out[0] = height;
    out[1] = vertical;
    out[2] = w1;
    out[3] = w2;
    out[4] = w3;
}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at(const Real&, const Real* state, const Real*, Real* position, Real* velocity, Real* rows) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];

    // Constraints
    const Real z0 = (e0 * e0 + e3 * e3) + (e1 * e1 + e2 * e2);
    const Real z1 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z2 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z3 = e2 * z1 + e1 * z2;
    const Real z4 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z5 = e1 * w1 + e2 * w2 + e3 * w3;

    // Result
    position[0] = z0 - Real(1);
    velocity[0] = z3 + (e3 * z4 - e0 * z5);
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
void multipliers_at(const Real&, const Real* state, const Real* par, Real* lambda) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];
    const Real &m = par[0], &l = par[1], &C = par[4], &k0 = par[6], &k1 = par[7], &k2 = par[8], &k4 = par[10];
    const Real &k5 = par[11], &k6 = par[12], &k7 = par[13], &k8 = par[14];

    // Multipliers
    const Real z0 = e0 * e0 + e3 * e3;
    const Real z1 = e1 * e1 + e2 * e2;
    const Real z2 = Real(1) / (z0 + z1);
    const Real z3 = k1 * z2;
    const Real z4 = e0 * e1;
    const Real z5 = e2 * e3;
    const Real z6 = z3 * (z4 + z5) + w2 * k0 * w3;
    const Real z7 = e0 * e2;
    const Real z8 = e1 * e3;
    const Real z9 = z3 * (z7 - z8) - w3 * k0 * w1;
    const Real z10 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z11 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z12 = e2 * z10 + e1 * z11;
    const Real z13 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z14 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z15 = e3 * z13 - e0 * z14;
    const Real z16 = z12 + z15;
    const Real z17 = k2 * z6;
    const Real z18 = k2 * z9;
    const Real z19 = k4 * z2;
    const Real z20 = z0 - z1;
    const Real z21 = z2 * z2;
    const Real z22 = k4 * z20 * z21;
    const Real z23 = z19 - z22;
    const Real z24 = e0 * z23;
    const Real z25 = (w2 * z13 - w3 * z10) + w1 * z14;
    const Real z26 = Real(0.5) * e0 * z17 - Real(0.5) * e3 * z18 - Real(0.25) * z25;
    const Real z27 = e3 * z2;
    const Real z28 = k5 * z27;
    const Real z29 = e2 * z2;
    const Real z30 = e0 * z2;
    const Real z31 = k5 * z30;
    const Real z32 = e1 * z2;
    const Real z33 = C * z29;
    const Real z34 = z28 * z29 - z31 * z32 - z33 * z27;
    const Real z35 = z4 - z5;
    const Real z36 = e1 * z21;
    const Real z37 = l * (Real(2) * z30 - Real(4) * z35 * z36);
    const Real z38 = m * z37;
    const Real z39 = e0 * z21;
    const Real z40 = l * (Real(2) * z32 - Real(4) * z35 * z39);
    const Real z41 = z7 + z8;
    const Real z42 = l * (Real(2) * z27 - Real(4) * z41 * z36);
    const Real z43 = m * z42;
    const Real z44 = l * (Real(2) * z29 - Real(4) * z41 * z39);
    const Real z45 = k6 * (z32 + z20 * z36);
    const Real z46 = m * z45;
    const Real z47 = k6 * (z30 - z20 * z39);
    const Real z48 = z38 * z40 + z43 * z44 - z46 * z47;
    const Real z49 = Real(4) * z34 + z48;
    const Real z50 = (w2 * z11 - w1 * z10) - w3 * z14;
    const Real z51 = Real(0.5) * e2 * z17 - Real(0.5) * e1 * z18 - Real(0.25) * z50;
    const Real z52 = k5 * z32;
    const Real z53 = k5 * z29;
    const Real z54 = C * z30;
    const Real z55 = z52 * z29 - z53 * z32 + z54 * z27;
    const Real z56 = e3 * z21;
    const Real z57 = l * (Real(2) * z32 - Real(4) * z41 * z56);
    const Real z58 = m * z57;
    const Real z59 = l * (Real(2) * z29 + Real(4) * z35 * z56);
    const Real z60 = m * z59;
    const Real z61 = k6 * (z27 - z20 * z56);
    const Real z62 = m * z61;
    const Real z63 = z58 * z44 - z60 * z40 + z62 * z47;
    const Real z64 = Real(4) * z55 - z63;
    const Real z65 = z51 * z64;
    const Real z66 = (w3 * z11 - w1 * z13) + w2 * z14;
    const Real z67 = Real(0.5) * e3 * z17 + Real(0.5) * e0 * z18 - Real(0.25) * z66;
    const Real z68 = C * z32;
    const Real z69 = z28 * z32 + z31 * z29 - z68 * z27;
    const Real z70 = e2 * z21;
    const Real z71 = l * (Real(2) * z30 - Real(4) * z41 * z70);
    const Real z72 = m * z71;
    const Real z73 = l * (Real(2) * z27 + Real(4) * z35 * z70);
    const Real z74 = m * z73;
    const Real z75 = k6 * (z29 + z20 * z70);
    const Real z76 = m * z75;
    const Real z77 = z72 * z44 - z74 * z40 - z76 * z47;
    const Real z78 = Real(4) * z69 - z77;
    const Real z79 = z67 * z78;
    const Real z80 = w1 * z11 + (w3 * z13 + w2 * z10);
    const Real z81 = Real(0.5) * e2 * z18 + Real(0.5) * e1 * z17 + Real(0.25) * z80;
    const Real z82 = z53 * z29 + z52 * z32;
    const Real z83 = m * z44 * z44;
    const Real z84 = m * z40 * z40;
    const Real z85 = z83 + z84 + m * z47 * z47;
    const Real z86 = z81 * (Real(4) * (z82 + C * z27 * z27) + z85);
    const Real z87 = z2 * (z11 * z14 + z13 * z10);
    const Real z88 = e0 * z11 - e2 * z13;
    const Real z89 = e3 * z10 + e1 * z14;
    const Real z90 = z21 * z16;
    const Real z91 = z13 * z13 + z14 * z14;
    const Real z92 = z11 * z11 + z10 * z10;
    const Real z93 = z2 * z2 * (Real(0.5) * (z91 + z92) - Real(2) * z2 * z16 * z16);
    const Real z94 = z87 + Real(2) * (z88 - z89) * z90 + Real(2) * z35 * z93;
    const Real z95 = m * l * z94;
    const Real z96 = z2 * (z11 * z13 - z10 * z14);
    const Real z97 = e3 * z11 - e2 * z14;
    const Real z98 = e0 * z10 + e1 * z13;
    const Real z99 = z96 - Real(2) * (z97 + z98) * z90 - Real(2) * z41 * z93;
    const Real z100 = m * l * z99;
    const Real z101 = z2 * (z91 - z92);
    const Real z102 = Real(0.5) * z101 + Real(2) * (z12 - z15) * z90 - z20 * z93;
    const Real z103 = m * l * z102;
    const Real z104 = z95 * z40 - z100 * z44 - z103 * z47;
    const Real z105 = z88 + z89;
    const Real z106 = z97 - z98;
    const Real z107 = z2 * z106;
    const Real z108 = k7 * z107;
    const Real z109 = e2 * z11;
    const Real z110 = z109 - e1 * z10 + e0 * z13 + e3 * z14;
    const Real z111 = z2 * z110;
    const Real z112 = k8 * z111;
    const Real z113 = z108 * z111 - z112 * z107;
    const Real z114 = k7 * z105 * z90 - z113;
    const Real z115 = z2 * z105;
    const Real z116 = k7 * z115;
    const Real z117 = z116 * z111 - z112 * z115;
    const Real z118 = k7 * z106 * z90 + z117;
    const Real z119 = z116 * z107 - z108 * z115;
    const Real z120 = z119 - k8 * z110 * z90;
    const Real z121 = z114 * z32 - z118 * z29 - z120 * z27;
    const Real z122 = Real(2) * z24 + z65 - z79 + z26 * z49 - z86 - z104 + Real(4) * z121;
    const Real z123 = z19 + z22;
    const Real z124 = e1 * z123;
    const Real z125 = z28 * z30 - z31 * z27 - z68 * z29;
    const Real z126 = z72 * z42 - z74 * z37 + z76 * z45;
    const Real z127 = Real(4) * z125 + z126;
    const Real z128 = z67 * z127;
    const Real z129 = z53 * z30 + z52 * z27 - z54 * z29;
    const Real z130 = z58 * z42 - z60 * z37 - z62 * z45;
    const Real z131 = Real(4) * z129 - z130;
    const Real z132 = z81 * z49;
    const Real z133 = z28 * z27 + z31 * z30;
    const Real z134 = z38 * z37 + z43 * z42 + z46 * z45;
    const Real z135 = z26 * (Real(4) * (z133 + z33 * z29) + z134);
    const Real z136 = z100 * z42 - z95 * z37 - z103 * z45;
    const Real z137 = z114 * z30 + z118 * z27 - z120 * z29;
    const Real z138 = Real(2) * z124 - z128 + z132 - z51 * z131 - z135 - z136 + Real(4) * z137;
    const Real z139 = e1 * z138;
    const Real z140 = e3 * z23;
    const Real z141 = z26 * z131;
    const Real z142 = z52 * z30 - z53 * z27 - z54 * z32;
    const Real z143 = z60 * z73 + z58 * z71 - z62 * z75;
    const Real z144 = Real(4) * z142 + z143;
    const Real z145 = z67 * z144;
    const Real z146 = z60 * z59 + z58 * z57 + z62 * z61;
    const Real z147 = z51 * (Real(4) * (z82 + z54 * z30) + z146);
    const Real z148 = z95 * z59 + z100 * z57 + z103 * z61;
    const Real z149 = z118 * z32 + z114 * z29 + z120 * z30;
    const Real z150 = Real(2) * z140 - z141 + z145 + z81 * z64 - z147 + z148 + Real(4) * z149;
    const Real z151 = e2 * z123;
    const Real z152 = z51 * z144;
    const Real z153 = z26 * z127;
    const Real z154 = z72 * z71 + z74 * z73 + z76 * z75;
    const Real z155 = z67 * (Real(4) * (z133 + z68 * z32) + z154);
    const Real z156 = z100 * z71 + z95 * z73 - z103 * z75;
    const Real z157 = z114 * z27 - z118 * z30 + z120 * z32;
    const Real z158 = Real(2) * z151 - z153 + z152 - z81 * z78 - z155 - z156 + Real(4) * z157;
    const Real z159 = z139 - e0 * z122 + e2 * z158 - e3 * z150;
    const Real lambda_top = -Real(0.5) * z159 * z2;

    // Result
    lambda[0] = lambda_top;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project(const Real&, const Real* state, const Real*, Real* out, Real* position, Real* pivots) {
    const Real &e0 = state[0], &e1 = state[1], &e2 = state[2], &e3 = state[3], &w1 = state[4], &w2 = state[5];
    const Real &w3 = state[6];

    // Projection
    const Real z0 = (e0 * e0 + e3 * e3) + (e1 * e1 + e2 * e2);
    const Real z1 = z0 - Real(1);
    const Real z2 = Real(0.5) * z1 / z0 - Real(1);

    // Result
    out[0] = -e0 * z2;
    out[1] = -e1 * z2;
    out[2] = -e2 * z2;
    out[3] = -e3 * z2;
    out[4] = w1;
    out[5] = w2;
    out[6] = w3;
    position[0] = z1;
    pivots[0] = Real(4) * z0;
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

constexpr const char* coordinate_names[] = { "e0", "e1", "e2", "e3", nullptr};
constexpr const char* speed_names[] = { "w1", "w2", "w3", nullptr};
constexpr const char* parameter_names[] = { "m", "l", "g", "A", "C", "theta0", nullptr};
constexpr const char* output_names[] = { "height", "vertical", "w1", "w2", "w3", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 2, 0.5, 1, 1, 0.5, 1, 0};

constexpr alembert_solver_table table{
    4, 4, 3, 6, 10, 5, 0, 1, "heavy_top_joint", "kane, textbook form",
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

struct alembert_tables {
    const void* solver;
    const void* derivatives;
    const void* projection;
    const void* pack;
    const void* functions;
    int independent_constraints;
};

constexpr alembert_tables all{
    &table, nullptr, &projection, nullptr, nullptr, 1,
};

}  // namespace
}  // namespace heavy_top_joint::code_78bdc010
#pragma GCC diagnostic pop

namespace heavy_top_joint {
using code_78bdc010::parameter_values;
using code_78bdc010::coordinate_names;
using code_78bdc010::speed_names;
using code_78bdc010::parameter_names;
using code_78bdc010::output_names;
using code_78bdc010::event_names;
using code_78bdc010::table;
using code_78bdc010::prepare;
using code_78bdc010::rhs;
using code_78bdc010::mass_forcing;
using code_78bdc010::energy;
using code_78bdc010::outputs_at;
using code_78bdc010::constraints_at;
using code_78bdc010::multipliers_at;
using code_78bdc010::project;
}  // namespace heavy_top_joint

using namespace heavy_top_joint;

#ifndef ALEMBERT_heavy_top_joint_78bdc010  // once in a unit, however many namespaces include this file
#define ALEMBERT_heavy_top_joint_78bdc010
// What heavy_top_joint.hpp declares: under names that begin with that of the scene and end with a fingerprint of this file and its
// header, so that many systems can be in one program, and no header is linked with another file than its own.
extern "C" __attribute__((weak, visibility("default"))) void heavy_top_joint_prepare_78bdc010(double* par) {
    heavy_top_joint::code_78bdc010::table.prepare(par);
}
extern "C" __attribute__((weak, visibility("default"))) void heavy_top_joint_rhs_78bdc010(double t, const double* state, const double* par, double* rate) {
    heavy_top_joint::code_78bdc010::table.rhs(t, state, par, rate);
}
extern "C" __attribute__((weak, visibility("default"))) void heavy_top_joint_mass_forcing_78bdc010(double t, const double* state, const double* par, double* mass, double* forcing) {
    heavy_top_joint::code_78bdc010::table.mass_forcing(t, state, par, mass, forcing);
}
extern "C" __attribute__((weak, visibility("default"))) void heavy_top_joint_energy_78bdc010(double t, const double* state, const double* rate, const double* par, double* energy, double* jacobi) {
    heavy_top_joint::code_78bdc010::table.energy(t, state, rate, par, energy, jacobi);
}
extern "C" __attribute__((weak, visibility("default"))) void heavy_top_joint_outputs_at_78bdc010(double t, const double* state, const double* rate, const double* par, double* out) {
    heavy_top_joint::code_78bdc010::table.outputs_at(t, state, rate, par, out);
}
extern "C" __attribute__((weak, visibility("default"))) void heavy_top_joint_constraints_at_78bdc010(double t, const double* state, const double* par, double* position, double* velocity, double* rows) {
    heavy_top_joint::code_78bdc010::table.constraints_at(t, state, par, position, velocity, rows);
}
extern "C" __attribute__((weak, visibility("default"))) void heavy_top_joint_multipliers_at_78bdc010(double t, const double* state, const double* par, double* lambda) {
    heavy_top_joint::code_78bdc010::table.multipliers_at(t, state, par, lambda);
}
extern "C" __attribute__((weak, visibility("default"))) void heavy_top_joint_project_78bdc010(double t, const double* state, const double* par, double* out, double* position, double* pivots) {
    heavy_top_joint::code_78bdc010::projection.project(t, state, par, out, position, pivots);
}
extern "C" __attribute__((weak, visibility("default"))) const void* heavy_top_joint_tables_78bdc010() {
    return &heavy_top_joint::code_78bdc010::all;
}
#endif

#ifndef ALEMBERT_NO_MODULE  // What is looked for in a module that is loaded while a program runs; once in a unit.
#define ALEMBERT_NO_MODULE
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_solver() { return heavy_top_joint::code_78bdc010::all.solver; }
extern "C" __attribute__((weak, visibility("default"))) const void* alembert_projection() { return heavy_top_joint::code_78bdc010::all.projection; }
#endif
