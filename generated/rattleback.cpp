// Equations of motion of 'rattleback': kane, intermediate symbols.
// Written by alembert 0.1.0 from a scene; may be used, changed and passed on freely (MIT).
//
//   state  x [m], y [m], e0, e1, e2, e3, then w1 [rad/s], w2 [rad/s], w3 [rad/s]
//   par    m [kg], g [m/s^2], a [m], b [m], c [m], h [m], A [kg m^2], B [kg m^2], C [kg m^2],
//          D [kg m^2]
//   cost   1026 operations a right-hand side: 346 additions, 673 multiplications, 6 divisions, 1 functions
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
    const Real &m = par[0], &g = par[1], &a = par[2], &b = par[3], &c = par[4], &h = par[5], &A = par[6];
    const Real &B = par[7], &C = par[8], &D = par[9];

    // Constants
    const Real k0 = a * a;
    const Real k1 = Real(4) * k0;
    const Real k2 = b * b;
    const Real k3 = Real(4) * k2;
    const Real k4 = c * c;
    const Real k5 = Real(4) * (k2 - k4);
    const Real k6 = Real(2) * h;
    const Real k7 = Real(0.5) * m;
    const Real k8 = Real(2) * k2;
    const Real k9 = Real(2) * k0;
    const Real k10 = Real(4) * (k0 - k4);
    const Real k11 = Real(8) * (k0 - k2);
    const Real k12 = m * g;
    const Real k13 = h * k12;
    const Real k14 = Real(2) * k4;
    const Real k15 = Real(0.5) * k4;
    const Real k16 = Real(4) * k4;
    const Real k17 = Real(2) * A;
    const Real k18 = Real(2) * D;
    const Real k19 = Real(2) * B;
    const Real k20 = Real(0.5) * C;
    const Real k21 = Real(0.5) * A;
    const Real k22 = Real(0.5) * B;

    // Result
    par[10] = k0;
    par[11] = k1;
    par[12] = k2;
    par[13] = k3;
    par[14] = k4;
    par[15] = k5;
    par[16] = k6;
    par[17] = k7;
    par[18] = k8;
    par[19] = k9;
    par[20] = k10;
    par[21] = k11;
    par[22] = k12;
    par[23] = k13;
    par[24] = k14;
    par[25] = k15;
    par[26] = k16;
    par[27] = k17;
    par[28] = k18;
    par[29] = k19;
    par[30] = k20;
    par[31] = k21;
    par[32] = k22;
}

/// rate = (q', u') at t and state = (q, u).
template <typename Real>
void rhs([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* rate) {
    const Real &e0 = state[2], &e1 = state[3], &e2 = state[4], &e3 = state[5], &w1 = state[6], &w2 = state[7];
    const Real &w3 = state[8];
    const Real &m = par[0], &h = par[5], &A = par[6], &B = par[7], &C = par[8], &D = par[9], &k0 = par[10];
    const Real &k1 = par[11], &k2 = par[12], &k3 = par[13], &k4 = par[14], &k5 = par[15], &k6 = par[16];
    const Real &k7 = par[17], &k8 = par[18], &k9 = par[19], &k10 = par[20], &k11 = par[21], &k12 = par[22];
    const Real &k13 = par[23], &k14 = par[24], &k15 = par[25];

    // All else, in the order in which it is ready
    const Real z0 = e0 * e0;
    const Real z1 = e1 * e1;
    const Real z2 = e2 * e2;
    const Real z3 = e3 * e3;
    const Real z4 = e0 * e2;
    const Real z5 = e1 * e3;
    const Real z6 = e0 * e1;
    const Real z7 = e2 * e3;
    const Real z8 = z0 + z1;
    const Real z9 = z0 - z1;
    const Real z10 = z2 + z3;
    const Real z11 = z2 - z3;
    const Real z12 = z4 - z5;
    const Real z13 = z6 + z7;
    const Real z14 = z9 - z11;
    const Real z15 = Real(1) / (z8 + z10);
    const Real z16 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z17 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z18 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z19 = e0 * e3;
    const Real z20 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z21 = e1 * z17;
    const Real z22 = e3 * z16;
    const Real z23 = e2 * z18;
    const Real z24 = e0 * z20;
    const Real z25 = z21 + z23;
    const Real z26 = e1 * z16 + e3 * z17;
    const Real z27 = z24 - z22;
    const Real z28 = e0 * z18 - e2 * z20;
    const Real z29 = z12 * z15;
    const Real z30 = z13 * z15;
    const Real z31 = z14 * z15;
    const Real z32 = z15 * z15;
    const Real z33 = e0 * z17 - e1 * z20;
    const Real z34 = e3 * z18 + e2 * z16;
    const Real z35 = z25 - z27;
    const Real z36 = z26 - z28;
    const Real z37 = k1 * z29;
    const Real z38 = k3 * z30;
    const Real z39 = k4 * z31;
    const Real z40 = z25 + z27;
    const Real z41 = z33 + z34;
    const Real z42 = e1 * e2;
    const Real z43 = z35 * z32;
    const Real z44 = k8 * z30;
    const Real z45 = z19 - z42;
    const Real z46 = z29 * z37 + z30 * z38 + z31 * z39;
    const Real z47 = k9 * z29;
    const Real z48 = z8 - z10;
    const Real z49 = z4 + z5;
    const Real z50 = z19 + z42;
    const Real z51 = z9 + z11;
    const Real z52 = z6 - z7;
    const Real z53 = sqrt(z46);
    const Real z54 = z36 * z15 + Real(2) * z12 * z43;
    const Real z55 = z41 * z15 - Real(2) * z13 * z43;
    const Real z56 = k14 * z31;
    const Real z57 = z40 * z15 + z14 * z43;
    const Real z58 = z45 * z15;
    const Real z59 = z48 * z15;
    const Real z60 = z49 * z15;
    const Real z61 = z50 * z15;
    const Real z62 = z51 * z15;
    const Real z63 = z52 * z15;
    const Real z64 = Real(1) / z46;
    const Real z65 = e1 * z18;
    const Real z66 = e0 * z16;
    const Real z67 = e2 * z17;
    const Real z68 = e3 * z20;
    const Real z69 = z21 - z23;
    const Real z70 = z24 + z22;
    const Real z71 = z56 * z57 + z37 * z54 - z38 * z55;
    const Real z72 = ((z67 + z68) + (z65 - z66)) * z15;
    const Real z73 = z15 * (z65 + z66 + z67 - z68) - Real(2) * z50 * z43;
    const Real z74 = (z69 + z70) * z15 + z51 * z43;
    const Real z75 = (z33 - z34) * z15 - Real(2) * z52 * z43;
    const Real z76 = (z69 - z70) * z15 - z48 * z43;
    const Real z77 = z72 + Real(2) * z45 * z43;
    const Real z78 = (z26 + z28) * z15 - Real(2) * z49 * z43;
    const Real z79 = (w2 * z18 + w1 * z17) + w3 * z16;
    const Real z80 = (w3 * z18 - w2 * z16) - w1 * z20;
    const Real z81 = (w2 * z17 - w1 * z18) - w3 * z20;
    const Real z82 = (w1 * z16 - w3 * z17) - w2 * z20;
    const Real z83 = z17 * z17 + z18 * z18;
    const Real z84 = Real(1) / z53;
    const Real z85 = z64 * z53;
    const Real z86 = z16 * z16 + z20 * z20;
    const Real z87 = z71 * z85;
    const Real z88 = z29 * k11 * z30 * z85;
    const Real z89 = e0 * z79 - e3 * z81;
    const Real z90 = e1 * z80 + e2 * z82;
    const Real z91 = z64 * z87;
    const Real z92 = m * z88;
    const Real z93 = e2 * z79;
    const Real z94 = e3 * z80;
    const Real z95 = z44 * z84;
    const Real z96 = z47 * z84;
    const Real z97 = h - z39 * z84;
    const Real z98 = k4 * z57 * z84 - k15 * z31 * z91;
    const Real z99 = z73 * z96;
    const Real z100 = k0 * (z54 * z84 - z29 * z91);
    const Real z101 = z74 * z95;
    const Real z102 = z59 * z96 + Real(2) * z58 * z95 + Real(2) * z60 * z97;
    const Real z103 = Real(2) * z29 * z96 - z31 * z97 + Real(2) * z30 * z95;
    const Real z104 = Real(2) * z61 * z96 - z62 * z95 - Real(2) * z63 * z97;
    const Real z105 = k2 * (z30 * z91 + z55 * z84);
    const Real z106 = z75 * z97;
    const Real z107 = z30 * z102 - z58 * z103;
    const Real z108 = Real(4) * z29 * z102 - Real(2) * z59 * z103;
    const Real z109 = Real(4) * z60 * z103 + Real(2) * z31 * z102;
    const Real z110 = z29 * z104 - z61 * z103;
    const Real z111 = Real(4) * z30 * z104 + Real(2) * z62 * z103;
    const Real z112 = z61 * z100;
    const Real z113 = Real(4) * z63 * z103 - Real(2) * z31 * z104;
    const Real z114 = z15 * z107;
    const Real z115 = z15 * z108;
    const Real z116 = z15 * z109;
    const Real z117 = z15 * z110;
    const Real z118 = z15 * z111;
    const Real z119 = z15 * z113;
    const Real z120 = z55 * z95;
    const Real z121 = Real(4) * e1 * z114 + e2 * z115 + e0 * z116;
    const Real z122 = Real(4) * e3 * z114 + e0 * z115 - e2 * z116;
    const Real z123 = Real(4) * e2 * z114 + e3 * z116 - e1 * z115;
    const Real z124 = Real(4) * e0 * z114 - e1 * z116 - e3 * z115;
    const Real z125 = Real(4) * e2 * z117 + e1 * z118 - e0 * z119;
    const Real z126 = Real(4) * e0 * z117 + e2 * z119 + e3 * z118;
    const Real z127 = Real(4) * e3 * z117 - e0 * z118 - e1 * z119;
    const Real z128 = Real(4) * e1 * z117 - e2 * z118 + e3 * z119;
    const Real z129 = z54 * z96;
    const Real z130 = z57 * z97;
    const Real z131 = z30 * z105;
    const Real z132 = z77 * z95;
    const Real z133 = z76 * z96;
    const Real z134 = z78 * z97;
    const Real z135 = z58 * z105;
    const Real z136 = e1 * z127;
    const Real z137 = e1 * z124;
    const Real z138 = z99 + z101 - z106 - z62 * z105 - Real(2) * z63 * z98 - Real(2) * z112;
    const Real z139 = z120 - z129 + z130 - z31 * z98 + Real(2) * z131 - Real(2) * z29 * z100;
    const Real z140 = z132 - z133 - z134 + z59 * z100 - Real(2) * z60 * z98 - Real(2) * z135;
    const Real z141 = z136 - e2 * z126 + e0 * z125 - e3 * z128;
    const Real z142 = z137 - e3 * z123 + e2 * z122 - e0 * z121;
    const Real z143 = k7 * z141;
    const Real z144 = k7 * z142;
    const Real z145 = z54 * z104 - Real(2) * z29 * z138;
    const Real z146 = z55 * z104 + Real(2) * z30 * z138;
    const Real z147 = z75 * z103 + Real(2) * z63 * z139;
    const Real z148 = z77 * z103 - Real(2) * z58 * z139;
    const Real z149 = z54 * z102 + Real(2) * z29 * z140;
    const Real z150 = z78 * z103 + Real(2) * z60 * z139;
    const Real z151 = Real(0.25) * z88 * z92 + Real(0.5) * z141 * z143 + Real(0.5) * z142 * z144;
    const Real z152 = z15 * (z145 + (z73 * z103 + Real(2) * z61 * z139));
    const Real z153 = z15 * (z146 - (z74 * z103 - z62 * z139));
    const Real z154 = z15 * ((z57 * z104 - z31 * z138) + z147);
    const Real z155 = z15 * (z148 + (z55 * z102 - Real(2) * z30 * z140));
    const Real z156 = z15 * ((z76 * z103 + z59 * z139) + z149);
    const Real z157 = z15 * (z150 - (z57 * z102 + z31 * z140));
    const Real M22 = C + z151;
    const Real z158 = e3 * z126;
    const Real z159 = e0 * z124;
    const Real z160 = z18 * z20 + z17 * z16;
    const Real z161 = z32 * ((z83 + z86) - z89 + z90);
    const Real z162 = e1 * z79;
    const Real z163 = e2 * z81;
    const Real z164 = z16 * z18 - z17 * z20;
    const Real z165 = Real(4) * z43 * z110 + Real(2) * z152;
    const Real z166 = z43 * z111 - Real(2) * z153;
    const Real z167 = z43 * z113 - Real(2) * z154;
    const Real z168 = Real(4) * z43 * z107 - Real(2) * z155;
    const Real z169 = z43 * z108 + Real(2) * z156;
    const Real z170 = z43 * z109 - Real(2) * z157;
    const Real z171 = k6 * z29 + Real(0.5) * z29 * k10 * z31 * z85;
    const Real z172 = z158 + e1 * z125 - e0 * z127 - e2 * z128;
    const Real z173 = z159 + e1 * z121 + e2 * z123 + e3 * z122;
    const Real z174 = k12 * z85;
    const Real z175 = z160 + Real(0.5) * z93 + Real(0.5) * z94 + Real(0.5) * e1 * z81 - Real(0.5) * e0 * z82;
    const Real z176 = Real(2) * z35 * z15 * z43 - Real(0.5) * z161;
    const Real z177 = Real(0.5) * z162 - z164 - Real(0.5) * z163 - Real(0.5) * e3 * z82 - Real(0.5) * e0 * z80;
    const Real z178 = m * z171;
    const Real z179 = k7 * z172;
    const Real z180 = k7 * z173;
    const Real z181 = z15 * ((z83 - z86) + z89 + z90);
    const Real z182 = Real(2) * z17 * z117 - e1 * z165;
    const Real z183 = Real(0.5) * z18 * z118 - e2 * z166;
    const Real z184 = Real(2) * z16 * z117 - e3 * z165;
    const Real z185 = Real(0.5) * z17 * z119 - e1 * z167;
    const Real z186 = Real(2) * z18 * z117 - e2 * z165;
    const Real z187 = Real(0.5) * z17 * z118 - e1 * z166;
    const Real z188 = Real(2) * z20 * z117 + e0 * z165;
    const Real z189 = Real(0.5) * z18 * z119 - e2 * z167;
    const Real z190 = Real(2) * z16 * z114 - e3 * z168;
    const Real z191 = Real(0.5) * z20 * z115 + e0 * z169;
    const Real z192 = Real(2) * z20 * z114 + e0 * z168;
    const Real z193 = Real(0.5) * z17 * z116 - e1 * z170;
    const Real z194 = Real(2) * z18 * z114 - e2 * z168;
    const Real z195 = Real(0.5) * z16 * z116 - e3 * z170;
    const Real z196 = Real(2) * z17 * z114 - e1 * z168;
    const Real z197 = Real(0.5) * z20 * z116 + e0 * z170;
    const Real z198 = z92 * z171 - z172 * z143 + z173 * z144;
    const Real z199 = z47 * z174;
    const Real z200 = z44 * z174;
    const Real z201 = k13 - z39 * z174;
    const Real z202 = Real(2) * z36 * z43 - z15 * z175 + Real(2) * z12 * z176;
    const Real z203 = Real(2) * z41 * z43 + z15 * z177 - Real(2) * z13 * z176;
    const Real z204 = Real(2) * z40 * z43 - Real(0.5) * z181 + z14 * z176;
    const Real z205 = z182 - z183 + (Real(0.5) * z16 * z119 - e3 * z167);
    const Real z206 = z184 - z185 + (Real(0.5) * z20 * z118 + e0 * z166);
    const Real z207 = z186 + z187 + (Real(0.5) * z20 * z119 + e0 * z167);
    const Real z208 = z188 - z189 - (Real(0.5) * z16 * z118 - e3 * z166);
    const Real z209 = z190 - z191 - (Real(0.5) * z18 * z116 - e2 * z170);
    const Real z210 = z192 + z193 + (Real(0.5) * z16 * z115 - e3 * z169);
    const Real z211 = z194 + z195 - (Real(0.5) * z17 * z115 - e1 * z169);
    const Real z212 = z196 - z197 + (Real(0.5) * z18 * z115 - e2 * z169);
    const Real z213 = Real(1) / M22;
    const Real z214 = z171 * z178 + Real(0.5) * z173 * z180 + Real(0.5) * z172 * z179;
    const Real z215 = (k9 * z54 * z54 + k8 * z55 * z55) + k14 * z57 * z57;
    const Real z216 = z20 * z126;
    const Real z217 = z17 * z128;
    const Real z218 = z18 * z125;
    const Real z219 = z16 * z127;
    const Real z220 = e1 * z205;
    const Real z221 = e0 * z208;
    const Real z222 = e3 * z206;
    const Real z223 = z17 * z125;
    const Real z224 = z16 * z126;
    const Real z225 = z18 * z128;
    const Real z226 = z20 * z127;
    const Real z227 = e1 * z207;
    const Real z228 = e0 * z206;
    const Real z229 = e2 * z205;
    const Real z230 = z20 * z124;
    const Real z231 = z16 * z122;
    const Real z232 = z17 * z121;
    const Real z233 = z18 * z123;
    const Real z234 = e3 * z209;
    const Real z235 = e2 * z211;
    const Real z236 = e1 * z212;
    const Real z237 = z17 * z124;
    const Real z238 = z16 * z123;
    const Real z239 = z20 * z121;
    const Real z240 = z18 * z122;
    const Real z241 = e2 * z209;
    const Real z242 = e3 * z211;
    const Real z243 = e1 * z210;
    const Real z244 = z198 * z213;
    const Real z245 = e2 * z121;
    const Real z246 = e2 * z125;
    const Real M11 = B + z214;
    const Real z247 = Real(2) * z12 * z199 - z14 * z201 + Real(2) * z13 * z200;
    const Real z248 = z56 * z204 + z37 * z202 - z38 * z203 + z215;
    const Real z249 = z20 * z125;
    const Real z250 = z17 * z127;
    const Real z251 = z18 * z126;
    const Real z252 = z16 * z128;
    const Real z253 = e3 * z205;
    const Real z254 = e1 * z206;
    const Real z255 = e0 * z207;
    const Real z256 = Real(0.25) * z216 - Real(0.25) * z217 - Real(0.25) * z218 - Real(0.25) * z219 - Real(0.5)
        * z220 + Real(0.5) * z221 - Real(0.5) * z222 - Real(0.5) * e2 * z207;
    const Real z257 = Real(0.25) * z223 + Real(0.25) * z224 - Real(0.25) * z225 + Real(0.25) * z226 + Real(0.5)
        * z227 - Real(0.5) * z228 - Real(0.5) * z229 - Real(0.5) * e3 * z208;
    const Real z258 = z18 * z121;
    const Real z259 = z20 * z122;
    const Real z260 = z17 * z123;
    const Real z261 = z16 * z124;
    const Real z262 = e0 * z209;
    const Real z263 = e3 * z210;
    const Real z264 = e1 * z211;
    const Real z265 = Real(0.25) * z230 - Real(0.25) * z231 - Real(0.25) * z232 - Real(0.25) * z233 - Real(0.5)
        * z234 - Real(0.5) * z235 - Real(0.5) * z236 + Real(0.5) * e0 * z210;
    const Real z266 = Real(0.25) * z237 - Real(0.25) * z238 + Real(0.25) * z239 + Real(0.25) * z240 + Real(0.5)
        * z241 - Real(0.5) * z242 - Real(0.5) * z243 - Real(0.5) * e0 * z212;
    const Real z267 = k6 * z30 + Real(0.5) * z30 * k5 * z31 * z85;
    const Real z268 = z245 + e0 * z122 - e1 * z123 - e3 * z124;
    const Real z269 = z246 + e0 * z126 + e3 * z127 + e1 * z128;
    const Real z270 = z15 * z199;
    const Real z271 = z15 * z200;
    const Real z272 = z15 * z201;
    const Real z273 = z32 * z247;
    const Real z274 = z71 * z64 * z87 - Real(0.5) * z71 * z91;
    const Real z275 = Real(0.25) * z249 - Real(0.25) * z250 + Real(0.25) * z251 + Real(0.25) * z252 + Real(0.5)
        * z253 - Real(0.5) * z254 - Real(0.5) * z255 - Real(0.5) * e2 * z208;
    const Real z276 = Real(0.25) * z258 - Real(0.25) * z259 - Real(0.25) * z260 - Real(0.25) * z261 + Real(0.5)
        * z262 + Real(0.5) * z263 - Real(0.5) * z264 + Real(0.5) * e2 * z212;
    const Real z277 = z272 - z273;
    const Real z278 = z272 + z273;
    const Real z279 = z267 * z178 - Real(0.5) * z269 * z179 - Real(0.5) * z268 * z180;
    const Real z280 = z92 * z267 + z269 * z143 - z268 * z144;
    const Real z281 = w3 * z275 - (w1 * z256 + w2 * z257);
    const Real z282 = (w2 * z265 + w3 * z266) + w1 * z276;
    const Real z283 = z267 * m * z267;
    const Real z284 = z268 * k7 * z268;
    const Real M10 = D + z279;
    const Real z285 = (e0 * z270 + e3 * z271) + e2 * z277;
    const Real z286 = (e2 * z270 + e1 * z271) - e0 * z278;
    const Real z287 = (e2 * z271 - e1 * z270) - e3 * z278;
    const Real z288 = (e0 * z271 - e3 * z270) + e1 * z277;
    const Real z289 = m * (h * z204 + Real(0.5) * (z274 - z248 * z85));
    const Real z290 = m * z281;
    const Real z291 = m * z282;
    const Real z292 = B * w2 + D * w1;
    const Real z293 = A * w1 + D * w2;
    const Real z294 = z280 * z213;
    const Real z295 = M10 - Real(0.25) * z280 * z244;
    const Real z296 = Real(1) / (M11 - Real(0.25) * z198 * z244);
    const Real z297 = C * w3;
    const Real z298 = e2 * z288;
    const Real M00 = A + (z283 + Real(0.5) * z284 + Real(0.5) * z269 * k7 * z269);
    const Real z299 = e2 * z286;
    const Real z300 = z298 + e0 * z287 - e1 * z285 - e3 * z286;
    const Real z301 = z88 * z289 - z141 * z290 + z142 * z291;
    const Real z302 = z295 * z296;
    const Real z303 = e3 * z285;
    const Real z304 = z299 + e3 * z288 - e1 * z287 - e0 * z285;
    const Real z305 = z171 * z289 + Real(0.5) * z172 * z290 + Real(0.5) * z173 * z291;
    const Real z306 = z300 - (w2 * z293 - w1 * z292) + Real(0.5) * z301;
    const Real z307 = z303 - e1 * z286 - e2 * z287 + e0 * z288;
    const Real z308 = z267 * z289 - Real(0.5) * z269 * z290 - Real(0.5) * z268 * z291;
    const Real f1 = z304 - (w3 * z293 - w1 * z297) + z305;
    const Real z309 = Real(1) / ((M00 - Real(0.25) * z280 * z294) - z295 * z302);
    const Real z310 = z307 - (w3 * z292 - w2 * z297) - z308;
    const Real z311 = f1 - Real(0.5) * z244 * z306;
    const Real e0_dot = -Real(0.5) * z20;
    const Real e1_dot = Real(0.5) * z17;
    const Real x_dot = Real(0.5) * (w2 * z172 - w1 * z269 + w3 * z141);
    const Real e2_dot = Real(0.5) * z18;
    const Real e3_dot = Real(0.5) * z16;
    const Real y_dot = -Real(0.5) * (w2 * z173 - w3 * z142 - w1 * z268);
    const Real z312 = ((z310 + Real(0.5) * z294 * z306) + z311 * z302) * z309;
    const Real w1_dot = -z312;
    const Real w2_dot = z311 * z296 + z302 * z312;
    const Real w3_dot = -z213 * z306 - Real(0.5) * z294 * z312 + Real(0.5) * z244 * w2_dot;

    // Result
    rate[0] = x_dot;
    rate[1] = y_dot;
    rate[2] = e0_dot;
    rate[3] = e1_dot;
    rate[4] = e2_dot;
    rate[5] = e3_dot;
    rate[6] = w1_dot;
    rate[7] = w2_dot;
    rate[8] = w3_dot;
}

/// M (s by s, row-major) and f of M u' = f.
template <typename Real>
void mass_forcing([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, Real* mass, Real* forcing) {
    const Real &e0 = state[2], &e1 = state[3], &e2 = state[4], &e3 = state[5], &w1 = state[6], &w2 = state[7];
    const Real &w3 = state[8];
    const Real &m = par[0], &h = par[5], &A = par[6], &B = par[7], &C = par[8], &D = par[9], &k0 = par[10];
    const Real &k1 = par[11], &k2 = par[12], &k3 = par[13], &k4 = par[14], &k5 = par[15], &k6 = par[16];
    const Real &k7 = par[17], &k8 = par[18], &k9 = par[19], &k10 = par[20], &k11 = par[21], &k12 = par[22];
    const Real &k13 = par[23], &k14 = par[24], &k15 = par[25];

    // All else, in the order in which it is ready
    const Real z0 = e0 * e0;
    const Real z1 = e1 * e1;
    const Real z2 = e2 * e2;
    const Real z3 = e3 * e3;
    const Real z4 = e0 * e2;
    const Real z5 = e1 * e3;
    const Real z6 = e0 * e1;
    const Real z7 = e2 * e3;
    const Real z8 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z9 = z0 + z1;
    const Real z10 = z2 + z3;
    const Real z11 = z0 - z1;
    const Real z12 = z2 - z3;
    const Real z13 = z4 - z5;
    const Real z14 = z6 + z7;
    const Real z15 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z16 = Real(1) / (z9 + z10);
    const Real z17 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z18 = z11 - z12;
    const Real z19 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z20 = e0 * e3;
    const Real z21 = e1 * e2;
    const Real z22 = z9 - z10;
    const Real z23 = z4 + z5;
    const Real z24 = z11 + z12;
    const Real z25 = z6 - z7;
    const Real z26 = B * w2 + D * w1;
    const Real z27 = C * w3;
    const Real z28 = A * w1 + D * w2;
    const Real z29 = z20 + z21;
    const Real z30 = z20 - z21;
    const Real z31 = e3 * z8;
    const Real z32 = e0 * z8;
    const Real z33 = e1 * z15;
    const Real z34 = e1 * z8 + e3 * z15;
    const Real z35 = e2 * z15;
    const Real z36 = e2 * z17;
    const Real z37 = e3 * z17 + e2 * z8;
    const Real z38 = e1 * z17;
    const Real z39 = (w2 * z17 + w1 * z15) + w3 * z8;
    const Real z40 = e0 * z19;
    const Real z41 = e0 * z17 - e2 * z19;
    const Real z42 = z33 + z36;
    const Real z43 = e0 * z15 - e1 * z19;
    const Real z44 = z33 - z36;
    const Real z45 = z13 * z16;
    const Real z46 = k1 * z45;
    const Real z47 = z14 * z16;
    const Real z48 = k3 * z47;
    const Real z49 = z18 * z16;
    const Real z50 = k4 * z49;
    const Real z51 = z45 * z46 + z47 * z48 + z49 * z50;
    const Real z52 = k8 * z47;
    const Real z53 = k9 * z45;
    const Real z54 = z30 * z16;
    const Real z55 = z22 * z16;
    const Real z56 = z23 * z16;
    const Real z57 = z29 * z16;
    const Real z58 = z24 * z16;
    const Real z59 = z25 * z16;
    const Real z60 = z16 * z16;
    const Real z61 = z40 - z31;
    const Real z62 = z40 + z31;
    const Real z63 = z42 - z61;
    const Real z64 = z42 + z61;
    const Real z65 = z63 * z60;
    const Real z66 = (z43 - z37) * z16 - Real(2) * z25 * z65;
    const Real z67 = z43 + z37;
    const Real z68 = (z44 + z62) * z16 + z24 * z65;
    const Real z69 = (z34 + z41) * z16 - Real(2) * z23 * z65;
    const Real z70 = z34 - z41;
    const Real z71 = (z44 - z62) * z16 - z22 * z65;
    const Real z72 = sqrt(z51);
    const Real z73 = Real(1) / z51;
    const Real z74 = Real(1) / z72;
    const Real z75 = z73 * z72;
    const Real z76 = z70 * z16 + Real(2) * z13 * z65;
    const Real z77 = z67 * z16 - Real(2) * z14 * z65;
    const Real z78 = z64 * z16 + z18 * z65;
    const Real z79 = k14 * z49;
    const Real z80 = z79 * z78 + z46 * z76 - z48 * z77;
    const Real z81 = e3 * z19;
    const Real z82 = z16 * (z38 + z32 + z35 - z81) - Real(2) * z29 * z65;
    const Real z83 = ((z35 + z81) + (z38 - z32)) * z16;
    const Real z84 = z83 + Real(2) * z30 * z65;
    const Real z85 = (w2 * z15 - w1 * z17) - w3 * z19;
    const Real z86 = (w3 * z17 - w2 * z8) - w1 * z19;
    const Real z87 = (w1 * z8 - w3 * z15) - w2 * z19;
    const Real z88 = e0 * z39 - e3 * z85;
    const Real z89 = z15 * z15 + z17 * z17;
    const Real z90 = z8 * z8 + z19 * z19;
    const Real z91 = e1 * z86 + e2 * z87;
    const Real z92 = h - z50 * z74;
    const Real z93 = z52 * z74;
    const Real z94 = z53 * z74;
    const Real z95 = k6 * z47 + Real(0.5) * z47 * k5 * z49 * z75;
    const Real z96 = k6 * z45 + Real(0.5) * z45 * k10 * z49 * z75;
    const Real z97 = z45 * k11 * z47 * z75;
    const Real z98 = z80 * z75;
    const Real z99 = z73 * z98;
    const Real z100 = z80 * z73 * z98 - Real(0.5) * z80 * z99;
    const Real z101 = z82 * z94;
    const Real z102 = z55 * z94 + Real(2) * z54 * z93 + Real(2) * z56 * z92;
    const Real z103 = Real(2) * z45 * z94 - z49 * z92 + Real(2) * z47 * z93;
    const Real z104 = Real(2) * z57 * z94 - z58 * z93 - Real(2) * z59 * z92;
    const Real z105 = m * z97;
    const Real z106 = k0 * (z76 * z74 - z45 * z99);
    const Real z107 = k4 * z78 * z74 - k15 * z49 * z99;
    const Real z108 = k2 * (z47 * z99 + z77 * z74);
    const Real z109 = z95 * m * z95;
    const Real z110 = m * z96;
    const Real z111 = z66 * z92;
    const Real z112 = z68 * z93;
    const Real z113 = z78 * z92;
    const Real z114 = z69 * z92;
    const Real z115 = z77 * z93;
    const Real z116 = z84 * z93;
    const Real z117 = z76 * z94;
    const Real z118 = z71 * z94;
    const Real z119 = z60 * ((z89 + z90) - z88 + z91);
    const Real z120 = z16 * ((z89 - z90) + z88 + z91);
    const Real z121 = Real(2) * z63 * z16 * z65 - Real(0.5) * z119;
    const Real z122 = Real(2) * z64 * z65 - Real(0.5) * z120 + z18 * z121;
    const Real z123 = z47 * z102 - z54 * z103;
    const Real z124 = Real(4) * z45 * z102 - Real(2) * z55 * z103;
    const Real z125 = Real(4) * z56 * z103 + Real(2) * z49 * z102;
    const Real z126 = z45 * z104 - z57 * z103;
    const Real z127 = Real(4) * z47 * z104 + Real(2) * z58 * z103;
    const Real z128 = Real(4) * z59 * z103 - Real(2) * z49 * z104;
    const Real z129 = z57 * z106;
    const Real z130 = z101 + z112 - z111 - z58 * z108 - Real(2) * z59 * z107 - Real(2) * z129;
    const Real z131 = z47 * z108;
    const Real z132 = z115 - z117 + z113 - z49 * z107 + Real(2) * z131 - Real(2) * z45 * z106;
    const Real z133 = z54 * z108;
    const Real z134 = z116 - z118 - z114 + z55 * z106 - Real(2) * z56 * z107 - Real(2) * z133;
    const Real z135 = z66 * z103 + Real(2) * z59 * z132;
    const Real z136 = z16 * ((z78 * z104 - z49 * z130) + z135);
    const Real z137 = z65 * z128 - Real(2) * z136;
    const Real z138 = z16 * z128;
    const Real z139 = z84 * z103 - Real(2) * z54 * z132;
    const Real z140 = z16 * (z139 + (z77 * z102 - Real(2) * z47 * z134));
    const Real z141 = z77 * z104 + Real(2) * z47 * z130;
    const Real z142 = z76 * z104 - Real(2) * z45 * z130;
    const Real z143 = z76 * z102 + Real(2) * z45 * z134;
    const Real z144 = z69 * z103 + Real(2) * z56 * z132;
    const Real z145 = (k9 * z76 * z76 + k8 * z77 * z77) + k14 * z78 * z78;
    const Real z146 = z16 * (z142 + (z82 * z103 + Real(2) * z57 * z132));
    const Real z147 = Real(4) * z65 * z126 + Real(2) * z146;
    const Real z148 = z16 * z126;
    const Real z149 = z16 * (z141 - (z68 * z103 - z58 * z132));
    const Real z150 = z65 * z127 - Real(2) * z149;
    const Real z151 = z16 * z127;
    const Real z152 = Real(4) * z65 * z123 - Real(2) * z140;
    const Real z153 = z16 * z123;
    const Real z154 = z16 * (z144 - (z78 * z102 + z49 * z134));
    const Real z155 = z16 * ((z71 * z103 + z55 * z132) + z143);
    const Real z156 = z65 * z124 + Real(2) * z155;
    const Real z157 = z16 * z124;
    const Real z158 = z65 * z125 - Real(2) * z154;
    const Real z159 = z16 * z125;
    const Real z160 = Real(4) * e1 * z153 + e2 * z157 + e0 * z159;
    const Real z161 = Real(4) * e3 * z153 + e0 * z157 - e2 * z159;
    const Real z162 = Real(4) * e2 * z153 + e3 * z159 - e1 * z157;
    const Real z163 = Real(4) * e0 * z153 - e1 * z159 - e3 * z157;
    const Real z164 = Real(4) * e2 * z148 + e1 * z151 - e0 * z138;
    const Real z165 = e2 * z160;
    const Real z166 = z165 + e0 * z161 - e1 * z162 - e3 * z163;
    const Real z167 = Real(4) * e0 * z148 + e2 * z138 + e3 * z151;
    const Real z168 = e2 * z164;
    const Real z169 = Real(4) * e3 * z148 - e0 * z151 - e1 * z138;
    const Real z170 = Real(4) * e1 * z148 - e2 * z151 + e3 * z138;
    const Real z171 = z168 + e0 * z167 + e3 * z169 + e1 * z170;
    const Real z172 = e3 * z167;
    const Real z173 = z172 + e1 * z164 - e0 * z169 - e2 * z170;
    const Real z174 = e0 * z163;
    const Real z175 = z174 + e1 * z160 + e2 * z162 + e3 * z161;
    const Real z176 = e1 * z169;
    const Real z177 = z176 - e2 * z167 + e0 * z164 - e3 * z170;
    const Real z178 = e1 * z163;
    const Real z179 = z178 - e3 * z162 + e2 * z161 - e0 * z160;
    const Real z180 = Real(2) * z15 * z148 - e1 * z147;
    const Real z181 = Real(0.5) * z17 * z151 - e2 * z150;
    const Real z182 = z180 - z181 + (Real(0.5) * z8 * z138 - e3 * z137);
    const Real z183 = z166 * k7 * z166;
    const Real M00 = A + (z109 + Real(0.5) * z183 + Real(0.5) * z171 * k7 * z171);
    const Real z184 = k7 * z175;
    const Real z185 = k7 * z179;
    const Real z186 = Real(2) * z19 * z148 + e0 * z147;
    const Real z187 = Real(0.5) * z17 * z138 - e2 * z137;
    const Real z188 = z186 - z187 - (Real(0.5) * z8 * z151 - e3 * z150);
    const Real z189 = k7 * z173;
    const Real z190 = k7 * z177;
    const Real M20 = -Real(0.5) * (z105 * z95 + z171 * z190 - z166 * z185);
    const Real M21 = -Real(0.5) * (z105 * z96 - z173 * z190 + z175 * z185);
    const Real z191 = Real(0.25) * z97 * z105 + Real(0.5) * z177 * z190 + Real(0.5) * z179 * z185;
    const Real M22 = C + z191;
    const Real z192 = z95 * z110 - Real(0.5) * z171 * z189 - Real(0.5) * z166 * z184;
    const Real z193 = z96 * z110 + Real(0.5) * z175 * z184 + Real(0.5) * z173 * z189;
    const Real M10 = D + z192;
    const Real M11 = B + z193;
    const Real z194 = Real(2) * z8 * z148 - e3 * z147;
    const Real z195 = Real(2) * z17 * z148 - e2 * z147;
    const Real z196 = e1 * z182;
    const Real z197 = Real(0.5) * z15 * z138 - e1 * z137;
    const Real z198 = z194 - z197 + (Real(0.5) * z19 * z151 + e0 * z150);
    const Real z199 = Real(0.5) * z15 * z151 - e1 * z150;
    const Real z200 = z195 + z199 + (Real(0.5) * z19 * z138 + e0 * z137);
    const Real z201 = e0 * z188;
    const Real z202 = z19 * z167;
    const Real z203 = z15 * z170;
    const Real z204 = z17 * z164;
    const Real z205 = z8 * z169;
    const Real z206 = e2 * z182;
    const Real z207 = e3 * z182;
    const Real z208 = z15 * z164;
    const Real z209 = z19 * z164;
    const Real z210 = z8 * z167;
    const Real z211 = z17 * z167;
    const Real z212 = z17 * z170;
    const Real z213 = z8 * z170;
    const Real z214 = z19 * z169;
    const Real z215 = z15 * z169;
    const Real z216 = Real(2) * z8 * z153 - e3 * z152;
    const Real z217 = Real(0.5) * z19 * z157 + e0 * z156;
    const Real z218 = z216 - z217 - (Real(0.5) * z17 * z159 - e2 * z158);
    const Real z219 = Real(2) * z17 * z153 - e2 * z152;
    const Real z220 = e3 * z198;
    const Real z221 = Real(0.25) * z202 - Real(0.25) * z203 - Real(0.25) * z204 - Real(0.25) * z205 - Real(0.5)
        * z196 + Real(0.5) * z201 - Real(0.5) * z220 - Real(0.5) * e2 * z200;
    const Real z222 = e1 * z200;
    const Real z223 = e0 * z200;
    const Real z224 = e0 * z198;
    const Real z225 = e1 * z198;
    const Real z226 = Real(0.25) * z208 + Real(0.25) * z210 - Real(0.25) * z212 + Real(0.25) * z214 + Real(0.5)
        * z222 - Real(0.5) * z224 - Real(0.5) * z206 - Real(0.5) * e3 * z188;
    const Real z227 = Real(0.25) * z209 - Real(0.25) * z215 + Real(0.25) * z211 + Real(0.25) * z213 + Real(0.5)
        * z207 - Real(0.5) * z225 - Real(0.5) * z223 - Real(0.5) * e2 * z188;
    const Real z228 = w3 * z227 - (w1 * z221 + w2 * z226);
    const Real z229 = m * z228;
    const Real z230 = Real(0.5) * z8 * z159 - e3 * z158;
    const Real z231 = z219 + z230 - (Real(0.5) * z15 * z157 - e1 * z156);
    const Real z232 = e3 * z218;
    const Real z233 = Real(2) * z15 * z153 - e1 * z152;
    const Real z234 = Real(2) * z19 * z153 + e0 * z152;
    const Real z235 = Real(0.5) * z19 * z159 + e0 * z158;
    const Real z236 = z233 - z235 + (Real(0.5) * z17 * z157 - e2 * z156);
    const Real z237 = Real(0.5) * z15 * z159 - e1 * z158;
    const Real z238 = z234 + z237 + (Real(0.5) * z8 * z157 - e3 * z156);
    const Real z239 = z19 * z163;
    const Real z240 = z8 * z161;
    const Real z241 = z15 * z160;
    const Real z242 = z17 * z162;
    const Real z243 = e2 * z218;
    const Real z244 = e0 * z218;
    const Real z245 = z15 * z163;
    const Real z246 = z8 * z163;
    const Real z247 = z8 * z162;
    const Real z248 = z15 * z162;
    const Real z249 = z19 * z160;
    const Real z250 = z17 * z160;
    const Real z251 = z17 * z161;
    const Real z252 = z19 * z161;
    const Real z253 = e2 * z231;
    const Real z254 = e3 * z231;
    const Real z255 = e1 * z231;
    const Real z256 = e2 * z39;
    const Real z257 = e1 * z39;
    const Real z258 = e3 * z86;
    const Real z259 = z17 * z19 + z15 * z8;
    const Real z260 = z259 + Real(0.5) * z256 + Real(0.5) * z258 + Real(0.5) * e1 * z85 - Real(0.5) * e0 * z87;
    const Real z261 = e2 * z85;
    const Real z262 = z8 * z17 - z15 * z19;
    const Real z263 = Real(0.5) * z257 - z262 - Real(0.5) * z261 - Real(0.5) * e3 * z87 - Real(0.5) * e0 * z86;
    const Real z264 = Real(2) * z70 * z65 - z16 * z260 + Real(2) * z13 * z121;
    const Real z265 = Real(2) * z67 * z65 + z16 * z263 - Real(2) * z14 * z121;
    const Real z266 = z79 * z122 + z46 * z264 - z48 * z265 + z145;
    const Real z267 = m * (h * z122 + Real(0.5) * (z100 - z266 * z75));
    const Real z268 = k12 * z75;
    const Real z269 = k13 - z50 * z268;
    const Real z270 = z53 * z268;
    const Real z271 = z52 * z268;
    const Real z272 = Real(2) * z13 * z270 - z18 * z269 + Real(2) * z14 * z271;
    const Real z273 = z16 * z269;
    const Real z274 = z16 * z270;
    const Real z275 = z16 * z271;
    const Real z276 = z60 * z272;
    const Real z277 = e1 * z236;
    const Real z278 = Real(0.25) * z239 - Real(0.25) * z240 - Real(0.25) * z241 - Real(0.25) * z242 - Real(0.5)
        * z232 - Real(0.5) * z253 - Real(0.5) * z277 + Real(0.5) * e0 * z238;
    const Real z279 = e1 * z238;
    const Real z280 = Real(0.25) * z245 - Real(0.25) * z247 + Real(0.25) * z249 + Real(0.25) * z251 + Real(0.5)
        * z243 - Real(0.5) * z254 - Real(0.5) * z279 - Real(0.5) * e0 * z236;
    const Real z281 = e3 * z238;
    const Real z282 = Real(0.25) * z250 - Real(0.25) * z252 - Real(0.25) * z248 - Real(0.25) * z246 + Real(0.5)
        * z244 + Real(0.5) * z281 - Real(0.5) * z255 + Real(0.5) * e2 * z236;
    const Real z283 = (w2 * z278 + w3 * z280) + w1 * z282;
    const Real z284 = z273 - z276;
    const Real z285 = z273 + z276;
    const Real z286 = (e0 * z274 + e3 * z275) + e2 * z284;
    const Real z287 = (e2 * z274 + e1 * z275) - e0 * z285;
    const Real z288 = (e0 * z275 - e3 * z274) + e1 * z284;
    const Real z289 = (e2 * z275 - e1 * z274) - e3 * z285;
    const Real z290 = m * z283;
    const Real z291 = e3 * z286;
    const Real z292 = e2 * z287;
    const Real z293 = e2 * z288;
    const Real z294 = z291 - e1 * z287 - e2 * z289 + e0 * z288;
    const Real z295 = z292 + e3 * z288 - e1 * z289 - e0 * z286;
    const Real z296 = z293 + e0 * z289 - e1 * z286 - e3 * z287;
    const Real z297 = z95 * z267 - Real(0.5) * z171 * z229 - Real(0.5) * z166 * z290;
    const Real z298 = z97 * z267 - z177 * z229 + z179 * z290;
    const Real z299 = z96 * z267 + Real(0.5) * z173 * z229 + Real(0.5) * z175 * z290;
    const Real f0 = (w3 * z26 - w2 * z27) - z294 + z297;
    const Real f2 = (w2 * z28 - w1 * z26) - z296 - Real(0.5) * z298;
    const Real f1 = z295 - (w3 * z28 - w1 * z27) + z299;

    // Result
    mass[0] = M00;
    mass[1] = mass[3] = M10;
    mass[4] = M11;
    mass[2] = mass[6] = M20;
    mass[5] = mass[7] = M21;
    mass[8] = M22;
    forcing[0] = f0;
    forcing[1] = f1;
    forcing[2] = f2;
}

/// T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.
template <typename Real>
void energy([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, Real* energy, Real* jacobi) {
    const Real &e0 = state[2], &e1 = state[3], &e2 = state[4], &e3 = state[5], &w1 = state[6], &w2 = state[7];
    const Real &w3 = state[8];
    const Real &m = par[0], &h = par[5], &D = par[9], &k1 = par[11], &k3 = par[13], &k4 = par[14], &k7 = par[17];
    const Real &k8 = par[18], &k9 = par[19], &k12 = par[22], &k14 = par[24], &k17 = par[27], &k18 = par[28];
    const Real &k19 = par[29], &k20 = par[30], &k21 = par[31], &k22 = par[32];

    // All else, in the order in which it is ready
    const Real z0 = e0 * e0;
    const Real z1 = e1 * e1;
    const Real z2 = e2 * e2;
    const Real z3 = e3 * e3;
    const Real z4 = e0 * e2;
    const Real z5 = e1 * e3;
    const Real z6 = e0 * e1;
    const Real z7 = e2 * e3;
    const Real z8 = z0 + z1;
    const Real z9 = z0 - z1;
    const Real z10 = z2 + z3;
    const Real z11 = z2 - z3;
    const Real z12 = z4 - z5;
    const Real z13 = z6 + z7;
    const Real z14 = z9 - z11;
    const Real z15 = Real(1) / (z8 + z10);
    const Real z16 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z17 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z18 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z19 = e0 * e3;
    const Real z20 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z21 = e1 * z16;
    const Real z22 = e3 * z17;
    const Real z23 = e0 * z18;
    const Real z24 = e2 * z20;
    const Real z25 = e0 * z17;
    const Real z26 = e1 * z20;
    const Real z27 = e1 * z17 + e2 * z18;
    const Real z28 = e3 * z18;
    const Real z29 = e2 * z16;
    const Real z30 = e0 * z20 - e3 * z16;
    const Real z31 = z12 * z15;
    const Real z32 = z13 * z15;
    const Real z33 = z14 * z15;
    const Real z34 = z15 * z15;
    const Real z35 = k1 * z31;
    const Real z36 = k3 * z32;
    const Real z37 = k4 * z33;
    const Real z38 = e1 * e2;
    const Real z39 = (z27 - z30) * z34;
    const Real z40 = ((z21 + z22) - (z23 - z24)) * z15;
    const Real z41 = ((z25 - z26) + (z28 + z29)) * z15;
    const Real z42 = k8 * z32;
    const Real z43 = z31 * z35 + z32 * z36 + z33 * z37;
    const Real z44 = k9 * z31;
    const Real z45 = (z27 + z30) * z15 + z14 * z39;
    const Real z46 = sqrt(z43);
    const Real z47 = z35 * (z40 + Real(2) * z12 * z39);
    const Real z48 = z36 * (z41 - Real(2) * z13 * z39);
    const Real z49 = (z19 - z38) * z15;
    const Real z50 = (z8 - z10) * z15;
    const Real z51 = (z4 + z5) * z15;
    const Real z52 = (z19 + z38) * z15;
    const Real z53 = (z9 + z11) * z15;
    const Real z54 = (z6 - z7) * z15;
    const Real z55 = e2 * z17 + e3 * z20;
    const Real z56 = z15 * (z28 - z29 + z25 + z26);
    const Real z57 = z15 * (z21 + z23 - z22 + z24);
    const Real z58 = (z55 - (e1 * z18 - e0 * z16)) * z15;
    const Real z59 = k20 * z58;
    const Real z60 = z15 * (k17 * z56 + k18 * z57);
    const Real z61 = z15 * (k19 * z57 + k18 * z56);
    const Real z62 = z56 * (k21 * z56 + D * z57);
    const Real z63 = z15 * z59;
    const Real z64 = Real(1) / z46;
    const Real z65 = z46 / z43;
    const Real z66 = (k14 * z33 * z45 + z47 - z48) * z65;
    const Real V = k12 * (z46 - h * z33);
    const Real z67 = Real(0.5) * z66 - h * z45;
    const Real z68 = m * z67;
    const Real z69 = z42 * z64;
    const Real z70 = z44 * z64;
    const Real z71 = z65 * z68;
    const Real z72 = h - z37 * z64;
    const Real z73 = z42 * z71;
    const Real z74 = z44 * z71;
    const Real z75 = h * z68 - z37 * z71;
    const Real z76 = z50 * z70 + Real(2) * z49 * z69 + Real(2) * z51 * z72;
    const Real z77 = Real(2) * z31 * z70 - z33 * z72 + Real(2) * z32 * z69;
    const Real z78 = Real(2) * z52 * z70 - z53 * z69 - Real(2) * z54 * z72;
    const Real z79 = z15 * z73;
    const Real z80 = z15 * (z32 * z76 - z49 * z77);
    const Real z81 = z15 * (Real(4) * z31 * z76 - Real(2) * z50 * z77);
    const Real z82 = z15 * (Real(4) * z51 * z77 + Real(2) * z33 * z76);
    const Real z83 = z15 * (z31 * z78 - z52 * z77);
    const Real z84 = z15 * (Real(4) * z32 * z78 + Real(2) * z53 * z77);
    const Real z85 = Real(2) * z12 * z74 - z14 * z75 + Real(2) * z13 * z73;
    const Real z86 = z15 * (Real(4) * z54 * z77 - Real(2) * z33 * z78);
    const Real z87 = Real(4) * e1 * z80 + e2 * z81 + e0 * z82;
    const Real z88 = Real(4) * e3 * z80 + e0 * z81 - e2 * z82;
    const Real z89 = Real(4) * e2 * z80 + e3 * z82 - e1 * z81;
    const Real z90 = Real(4) * e0 * z80 - e1 * z82 - e3 * z81;
    const Real z91 = Real(4) * e2 * z83 + e1 * z84 - e0 * z86;
    const Real z92 = Real(4) * e0 * z83 + e2 * z86 + e3 * z84;
    const Real z93 = Real(4) * e3 * z83 - e0 * z84 - e1 * z86;
    const Real z94 = Real(4) * e1 * z83 - e2 * z84 + e3 * z86;
    const Real z95 = e2 * z87;
    const Real z96 = e2 * z91;
    const Real z97 = e3 * z92;
    const Real z98 = e0 * z90;
    const Real z99 = e1 * z93;
    const Real z100 = e1 * z90;
    const Real z101 = z95 + e0 * z88 - e1 * z89 - e3 * z90;
    const Real z102 = z96 + e0 * z92 + e3 * z93 + e1 * z94;
    const Real z103 = z97 + e1 * z91 - e0 * z93 - e2 * z94;
    const Real z104 = z98 + e1 * z87 + e2 * z89 + e3 * z88;
    const Real z105 = z99 - e2 * z92 + e0 * z91 - e3 * z94;
    const Real z106 = z100 - e3 * z89 + e2 * z88 - e0 * z87;
    const Real z107 = z15 * z74;
    const Real z108 = z15 * z75;
    const Real z109 = z34 * z85;
    const Real z110 = Real(2) * z79 - z60;
    const Real z111 = Real(2) * z107 - z61;
    const Real z112 = z60 + Real(2) * z79;
    const Real z113 = z108 + z109;
    const Real z114 = w2 * z103 - w1 * z102 + w3 * z105;
    const Real z115 = z108 - z109;
    const Real z116 = w2 * z104 - w3 * z106 - w1 * z101;
    const Real z117 = z61 + Real(2) * z107;
    const Real z118 = (Real(4) * e2 * z63 + e3 * z111) - Real(2) * e1 * z115;
    const Real z119 = (Real(4) * e1 * z63 + e3 * z110) + Real(2) * e2 * z115;
    const Real z120 = (Real(4) * e3 * z63 + e1 * z112) + e2 * z117;
    const Real z121 = (Real(4) * e0 * z63 + Real(2) * e3 * z113) + e1 * z117;
    const Real z122 = m * (z67 * z67 + Real(0.25) * z114 * z114 + Real(0.25) * z116 * z116);
    const Real T = ((z58 * z59 + k22 * z57 * z57) + z62) + Real(0.5) * z122;
    const Real z123 = z17 * (e0 * z110 - z118);
    const Real z124 = z114 * k7 * z114;
    const Real z125 = z18 * (z119 + e0 * z111);
    const Real z126 = z20 * (z120 - Real(2) * e0 * z113);
    const Real z127 = z16 * (e2 * z112 - z121);
    const Real E = V + T;
    const Real z128 = z123 - z126 + z125 + z127 - z124 - z116 * k7 * z116;
    const Real h_ = (V - T) - Real(0.5) * z128;

    // Result
    energy[0] = T;
    energy[1] = V;
    energy[2] = E;
    energy[3] = Real(0);
    jacobi[0] = h_;
}

/// The scene's outputs.
template <typename Real>
void outputs_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {
    const Real &e0 = state[2], &e1 = state[3], &e2 = state[4], &e3 = state[5], &w1 = state[6], &w2 = state[7];
    const Real &w3 = state[8];

    // Outputs
    const Real z0 = e0 * e0;
    const Real z1 = e1 * e1;
    const Real z2 = e2 * e2;
    const Real z3 = e3 * e3;
    const Real z4 = Real(1) / ((z0 + z1) + (z2 + z3));
    const Real z5 = (e0 * e2 - e1 * e3) * z4;
    const Real z6 = (e0 * e1 + e2 * e3) * z4;
    const Real z7 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z8 = e1 * z7;
    const Real z9 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z10 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z11 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z12 = e3 * z10;
    const Real z13 = e2 * z9 + e3 * z11;
    const Real z14 = z12 - e2 * z7 + e0 * z9 + e1 * z11;
    const Real z15 = z8 + e0 * z10 - e3 * z9 + e2 * z11;
    const Real z16 = (z13 - (e1 * z10 - e0 * z7)) * z4;
    const Real z17 = z6 * z4 * z15;
    const Real z18 = ((z0 - z1) - (z2 - z3)) * z4 * z16;
    const Real spin = z18 + Real(2) * z17 - Real(2) * z5 * z4 * z14;

    // Result
    out[0] = spin;
    out[1] = w1;
    out[2] = w2;
    out[3] = w3;
}

/// The scene's event functions.
template <typename Real>
void events_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* rate, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* out) {


}

/// f(q,t) of holonomic constraints, A q' + b of all, and A.
template <typename Real>
void constraints_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* position, [[maybe_unused]] Real* velocity, [[maybe_unused]] Real* rows) {
    const Real &e0 = state[2], &e1 = state[3], &e2 = state[4], &e3 = state[5], &w1 = state[6], &w2 = state[7];
    const Real &w3 = state[8];
    const Real &h = par[5], &k1 = par[11], &k3 = par[13], &k4 = par[14], &k8 = par[18], &k9 = par[19];

    // All else, in the order in which it is ready
    const Real z0 = e0 * e0;
    const Real z1 = e1 * e1;
    const Real z2 = e2 * e2;
    const Real z3 = e3 * e3;
    const Real z4 = e0 * e2;
    const Real z5 = e1 * e3;
    const Real z6 = e0 * e1;
    const Real z7 = e2 * e3;
    const Real z8 = z0 + z1;
    const Real z9 = z0 - z1;
    const Real z10 = z2 + z3;
    const Real z11 = z2 - z3;
    const Real z12 = e0 * e3;
    const Real z13 = e1 * e2;
    const Real z14 = z8 + z10;
    const Real z15 = Real(1) / z14;
    const Real z16 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z17 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z18 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z19 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z20 = (z4 - z5) * z15;
    const Real z21 = (z6 + z7) * z15;
    const Real z22 = (z9 - z11) * z15;
    const Real z23 = (z12 - z13) * z15;
    const Real z24 = (z8 - z10) * z15;
    const Real z25 = (z4 + z5) * z15;
    const Real z26 = (z12 + z13) * z15;
    const Real z27 = (z9 + z11) * z15;
    const Real z28 = k4 * z22;
    const Real z29 = (z6 - z7) * z15;
    const Real z30 = e1 * z17 + e2 * z18;
    const Real z31 = z20 * k1 * z20;
    const Real z32 = sqrt(z31 + z21 * k3 * z21 + z22 * z28);
    const Real z33 = Real(1) / z32;
    const Real z34 = k8 * z21 * z33;
    const Real z35 = k9 * z20 * z33;
    const Real z36 = h - z28 * z33;
    const Real z37 = z24 * z35 + Real(2) * z23 * z34 + Real(2) * z25 * z36;
    const Real z38 = Real(2) * z20 * z35 - z22 * z36 + Real(2) * z21 * z34;
    const Real z39 = Real(2) * z26 * z35 - z27 * z34 - Real(2) * z29 * z36;
    const Real z40 = z15 * (z21 * z37 - z23 * z38);
    const Real z41 = z15 * (Real(4) * z20 * z37 - Real(2) * z24 * z38);
    const Real z42 = z15 * (Real(4) * z25 * z38 + Real(2) * z22 * z37);
    const Real z43 = z15 * (z20 * z39 - z26 * z38);
    const Real z44 = z15 * (Real(4) * z21 * z39 + Real(2) * z27 * z38);
    const Real z45 = z15 * (Real(4) * z29 * z38 - Real(2) * z22 * z39);
    const Real z46 = Real(4) * e1 * z40 + e2 * z41 + e0 * z42;
    const Real z47 = Real(4) * e3 * z40 + e0 * z41 - e2 * z42;
    const Real z48 = Real(4) * e2 * z40 + e3 * z42 - e1 * z41;
    const Real z49 = Real(4) * e0 * z40 - e1 * z42 - e3 * z41;
    const Real z50 = Real(4) * e2 * z43 + e1 * z44 - e0 * z45;
    const Real z51 = Real(4) * e0 * z43 + e2 * z45 + e3 * z44;
    const Real z52 = Real(4) * e3 * z43 - e0 * z44 - e1 * z45;
    const Real z53 = Real(4) * e1 * z43 - e2 * z44 + e3 * z45;
    const Real z54 = e2 * z46;
    const Real z55 = e2 * z50;
    const Real z56 = e3 * z51;
    const Real z57 = e0 * z49;
    const Real z58 = e1 * z52;
    const Real z59 = e1 * z49;
    const Real z60 = z54 + e0 * z47 - e1 * z48 - e3 * z49;
    const Real z61 = z55 + e0 * z51 + e3 * z52 + e1 * z53;
    const Real z62 = z56 + e1 * z50 - e0 * z52 - e2 * z53;
    const Real z63 = z57 + e1 * z46 + e2 * z48 + e3 * z47;
    const Real z64 = z58 - e2 * z51 + e0 * z50 - e3 * z53;
    const Real z65 = z59 - e3 * z48 + e2 * z47 - e0 * z46;
    const Real z66 = z19 * z53;
    const Real z67 = z18 * z52;
    const Real z68 = w2 * z62 - w1 * z61 + w3 * z64;
    const Real z69 = z17 * z47;
    const Real z70 = z16 * z46;
    const Real z71 = w2 * z63 - w3 * z65 - w1 * z60;

    // Result
    position[0] = z14 - Real(1);
    position[1] = Real(0);
    position[2] = Real(0);
    velocity[0] = z30 - (e0 * z19 - e3 * z16);
    velocity[1] = Real(0.5) * (z66 + z67 + z17 * z51 - z16 * z50 + z68);
    velocity[2] = -Real(0.5) * (z69 - z70 - z19 * z48 - z18 * z49 + z71);
    rows[0] = Real(0);
    rows[1] = Real(0);
    rows[2] = Real(2) * e0;
    rows[3] = Real(2) * e1;
    rows[4] = Real(2) * e2;
    rows[5] = Real(2) * e3;
    rows[6] = Real(1);
    rows[7] = Real(0);
    rows[8] = -z53;
    rows[9] = z51;
    rows[10] = z52;
    rows[11] = -z50;
    rows[12] = Real(0);
    rows[13] = Real(1);
    rows[14] = -z48;
    rows[15] = -z47;
    rows[16] = z49;
    rows[17] = z46;
    rows[18] = Real(0);
    rows[19] = Real(0);
    rows[20] = Real(0);
    rows[21] = Real(0);
    rows[22] = Real(0);
    rows[23] = Real(0);
    rows[24] = Real(0);
    rows[25] = Real(0);
    rows[26] = Real(0);
}

/// The multipliers lambda of M q'' = f + A^T lambda.
template <typename Real>
void multipliers_at([[maybe_unused]] const Real& t, [[maybe_unused]] const Real* state, [[maybe_unused]] const Real* par, [[maybe_unused]] Real* lambda) {
    const Real &e0 = state[2], &e1 = state[3], &e2 = state[4], &e3 = state[5], &w1 = state[6], &w2 = state[7];
    const Real &w3 = state[8];
    const Real &m = par[0], &h = par[5], &A = par[6], &B = par[7], &C = par[8], &D = par[9], &k0 = par[10];
    const Real &k1 = par[11], &k2 = par[12], &k3 = par[13], &k4 = par[14], &k5 = par[15], &k6 = par[16];
    const Real &k7 = par[17], &k8 = par[18], &k9 = par[19], &k10 = par[20], &k11 = par[21], &k12 = par[22];
    const Real &k13 = par[23], &k14 = par[24], &k15 = par[25], &k16 = par[26], &k17 = par[27], &k18 = par[28];
    const Real &k19 = par[29], &k20 = par[30];

    // All else, in the order in which it is ready
    const Real z0 = e0 * e0;
    const Real z1 = e1 * e1;
    const Real z2 = e2 * e2;
    const Real z3 = e3 * e3;
    const Real z4 = e0 * e2;
    const Real z5 = e1 * e3;
    const Real z6 = e0 * e1;
    const Real z7 = e2 * e3;
    const Real z8 = e0 * w3 + e1 * w2 - e2 * w1;
    const Real z9 = z0 + z1;
    const Real z10 = z2 + z3;
    const Real z11 = z0 - z1;
    const Real z12 = z2 - z3;
    const Real z13 = z4 - z5;
    const Real z14 = z6 + z7;
    const Real z15 = e0 * w1 + e2 * w3 - e3 * w2;
    const Real z16 = z9 + z10;
    const Real z17 = e0 * w2 - e1 * w3 + e3 * w1;
    const Real z18 = z11 - z12;
    const Real z19 = e1 * w1 + e2 * w2 + e3 * w3;
    const Real z20 = Real(1) / z16;
    const Real z21 = e0 * e3;
    const Real z22 = e1 * e2;
    const Real z23 = z9 - z10;
    const Real z24 = z4 + z5;
    const Real z25 = z11 + z12;
    const Real z26 = z6 - z7;
    const Real z27 = B * w2 + D * w1;
    const Real z28 = A * w1 + D * w2;
    const Real z29 = z21 - z22;
    const Real z30 = z21 + z22;
    const Real z31 = e3 * z8;
    const Real z32 = e1 * z8;
    const Real z33 = e2 * z8;
    const Real z34 = e0 * z8;
    const Real z35 = C * w3;
    const Real z36 = e1 * z15;
    const Real z37 = e3 * z15;
    const Real z38 = e0 * z15;
    const Real z39 = e2 * z15;
    const Real z40 = e2 * z17;
    const Real z41 = e0 * z17;
    const Real z42 = e3 * z17;
    const Real z43 = e1 * z17;
    const Real z44 = z13 * z20;
    const Real z45 = k1 * z44;
    const Real z46 = z14 * z20;
    const Real z47 = k3 * z46;
    const Real z48 = z18 * z20;
    const Real z49 = k4 * z48;
    const Real z50 = z44 * z45 + z46 * z47 + z48 * z49;
    const Real z51 = z20 * z20;
    const Real z52 = z36 + z40;
    const Real z53 = z36 - z40;
    const Real z54 = e0 * z19;
    const Real z55 = z54 - z31;
    const Real z56 = z54 + z31;
    const Real z57 = z52 - z55;
    const Real z58 = z52 + z55;
    const Real z59 = z57 * z51;
    const Real z60 = z57 * z20 * z59;
    const Real z61 = z32 + z37;
    const Real z62 = e2 * z19;
    const Real z63 = z32 + z41 - z37 + z62;
    const Real z64 = z41 - z62;
    const Real z65 = z61 - z64;
    const Real z66 = (z61 + z64) * z20 - Real(2) * z24 * z59;
    const Real z67 = z24 * z20;
    const Real z68 = z65 * z20 + Real(2) * z13 * z59;
    const Real z69 = z65 * z59;
    const Real z70 = Real(1) / z50;
    const Real z71 = sqrt(z50);
    const Real z72 = e1 * z19;
    const Real z73 = z38 - z72;
    const Real z74 = z42 - z33 + z38 + z72;
    const Real z75 = z42 + z33;
    const Real z76 = z73 + z75;
    const Real z77 = (z73 - z75) * z20 - Real(2) * z26 * z59;
    const Real z78 = z26 * z20;
    const Real z79 = z76 * z20 - Real(2) * z14 * z59;
    const Real z80 = z76 * z59;
    const Real z81 = z58 * z20 + z18 * z59;
    const Real z82 = z58 * z59;
    const Real z83 = k14 * z48;
    const Real z84 = Real(1) / z71;
    const Real z85 = z70 * z71;
    const Real z86 = z30 * z20;
    const Real z87 = k9 * z44;
    const Real z88 = e3 * z19;
    const Real z89 = z20 * (z43 + z34 + z39 - z88) - Real(2) * z30 * z59;
    const Real z90 = z43 - z34;
    const Real z91 = z39 + z88;
    const Real z92 = z83 * z81 + z45 * z68 - z47 * z79;
    const Real z93 = k8 * z46;
    const Real z94 = (z53 + z56) * z20 + z25 * z59;
    const Real z95 = z25 * z20;
    const Real z96 = (z53 - z56) * z20 - z23 * z59;
    const Real z97 = z23 * z20;
    const Real z98 = (z91 + z90) * z20 + Real(2) * z29 * z59;
    const Real z99 = z29 * z20;
    const Real z100 = z91 - z90;
    const Real z101 = (w2 * z17 + w1 * z15) + w3 * z8;
    const Real z102 = h - z49 * z84;
    const Real z103 = z87 * z84;
    const Real z104 = z93 * z84;
    const Real z105 = (w2 * z15 - w1 * z17) - w3 * z19;
    const Real z106 = z89 * z103;
    const Real z107 = z94 * z104;
    const Real z108 = z79 * z104;
    const Real z109 = z68 * z103;
    const Real z110 = z98 * z104;
    const Real z111 = z96 * z103;
    const Real z112 = z92 * z85;
    const Real z113 = z77 * z102;
    const Real z114 = Real(2) * z86 * z103 - z95 * z104 - Real(2) * z78 * z102;
    const Real z115 = z81 * z102;
    const Real z116 = Real(2) * z44 * z103 - z48 * z102 + Real(2) * z46 * z104;
    const Real z117 = z97 * z103 + Real(2) * z99 * z104 + Real(2) * z67 * z102;
    const Real z118 = z66 * z102;
    const Real z119 = z70 * z112;
    const Real z120 = z92 * z70 * z112 - Real(0.5) * z92 * z119;
    const Real z121 = k0 * (z68 * z84 - z44 * z119);
    const Real z122 = k4 * z81 * z84 - k15 * z48 * z119;
    const Real z123 = k2 * (z46 * z119 + z79 * z84);
    const Real z124 = e0 * z101 - e3 * z105;
    const Real z125 = (w3 * z17 - w2 * z8) - w1 * z19;
    const Real z126 = (w1 * z8 - w3 * z15) - w2 * z19;
    const Real z127 = z15 * z15 + z17 * z17;
    const Real z128 = z44 * z114 - z86 * z116;
    const Real z129 = Real(4) * z46 * z114 + Real(2) * z95 * z116;
    const Real z130 = Real(4) * z78 * z116 - Real(2) * z48 * z114;
    const Real z131 = z46 * z117 - z99 * z116;
    const Real z132 = Real(4) * z44 * z117 - Real(2) * z97 * z116;
    const Real z133 = Real(4) * z67 * z116 + Real(2) * z48 * z117;
    const Real z134 = e1 * z125 + e2 * z126;
    const Real z135 = z8 * z8 + z19 * z19;
    const Real z136 = z86 * z121;
    const Real z137 = z106 + z107 - z113 - z95 * z123 - Real(2) * z78 * z122 - Real(2) * z136;
    const Real z138 = z46 * z123;
    const Real z139 = z99 * z123;
    const Real z140 = z108 - z109 + z115 - z48 * z122 + Real(2) * z138 - Real(2) * z44 * z121;
    const Real z141 = z110 - z111 - z118 + z97 * z121 - Real(2) * z67 * z122 - Real(2) * z139;
    const Real z142 = z77 * z116 + Real(2) * z78 * z140;
    const Real z143 = z20 * ((z81 * z114 - z48 * z137) + z142);
    const Real z144 = z59 * z130 - Real(2) * z143;
    const Real z145 = z20 * z130;
    const Real z146 = z98 * z116 - Real(2) * z99 * z140;
    const Real z147 = z20 * (z146 + (z79 * z117 - Real(2) * z46 * z141));
    const Real z148 = Real(4) * z59 * z131 - Real(2) * z147;
    const Real z149 = z20 * z131;
    const Real z150 = z66 * z116 + Real(2) * z67 * z140;
    const Real z151 = z20 * (z150 - (z81 * z117 + z48 * z141));
    const Real z152 = (k9 * z68 * z68 + k8 * z79 * z79) + k14 * z81 * z81;
    const Real z153 = z79 * z114 + Real(2) * z46 * z137;
    const Real z154 = z68 * z114 - Real(2) * z44 * z137;
    const Real z155 = z68 * z117 + Real(2) * z44 * z141;
    const Real z156 = z20 * (z154 + (z89 * z116 + Real(2) * z86 * z140));
    const Real z157 = Real(4) * z59 * z128 + Real(2) * z156;
    const Real z158 = z20 * z128;
    const Real z159 = z20 * (z153 - (z94 * z116 - z95 * z140));
    const Real z160 = z59 * z129 - Real(2) * z159;
    const Real z161 = z20 * z129;
    const Real z162 = z20 * ((z96 * z116 + z97 * z140) + z155);
    const Real z163 = z59 * z132 + Real(2) * z162;
    const Real z164 = z20 * z132;
    const Real z165 = z59 * z133 - Real(2) * z151;
    const Real z166 = z20 * z133;
    const Real z167 = Real(4) * e0 * z158 + e2 * z145 + e3 * z161;
    const Real z168 = Real(4) * e1 * z158 - e2 * z161 + e3 * z145;
    const Real z169 = Real(4) * e2 * z158 + e1 * z161 - e0 * z145;
    const Real z170 = z19 * z167;
    const Real z171 = Real(4) * e3 * z158 - e0 * z161 - e1 * z145;
    const Real z172 = z15 * z168;
    const Real z173 = z17 * z169;
    const Real z174 = z15 * z169;
    const Real z175 = z8 * z167;
    const Real z176 = z17 * z168;
    const Real z177 = z8 * z171;
    const Real z178 = z19 * z171;
    const Real z179 = z19 * z169;
    const Real z180 = z15 * z171;
    const Real z181 = z17 * z167;
    const Real z182 = z8 * z168;
    const Real z183 = Real(4) * e0 * z149 - e1 * z166 - e3 * z164;
    const Real z184 = Real(4) * e3 * z149 + e0 * z164 - e2 * z166;
    const Real z185 = Real(4) * e1 * z149 + e2 * z164 + e0 * z166;
    const Real z186 = z19 * z183;
    const Real z187 = Real(4) * e2 * z149 + e3 * z166 - e1 * z164;
    const Real z188 = z8 * z184;
    const Real z189 = z15 * z185;
    const Real z190 = z15 * z183;
    const Real z191 = z19 * z185;
    const Real z192 = z17 * z184;
    const Real z193 = z17 * z187;
    const Real z194 = z8 * z187;
    const Real z195 = z17 * z185;
    const Real z196 = z19 * z184;
    const Real z197 = z15 * z187;
    const Real z198 = z8 * z183;
    const Real z199 = e1 * z171;
    const Real z200 = z199 - e2 * z167 + e0 * z169 - e3 * z168;
    const Real z201 = Real(2) * z15 * z158 - e1 * z157;
    const Real z202 = Real(0.5) * z17 * z161 - e2 * z160;
    const Real z203 = z201 - z202 + (Real(0.5) * z8 * z145 - e3 * z144);
    const Real z204 = Real(2) * z19 * z158 + e0 * z157;
    const Real z205 = Real(0.5) * z17 * z145 - e2 * z144;
    const Real z206 = z204 - z205 - (Real(0.5) * z8 * z161 - e3 * z160);
    const Real z207 = Real(2) * z8 * z158 - e3 * z157;
    const Real z208 = Real(2) * z17 * z158 - e2 * z157;
    const Real z209 = Real(0.5) * z15 * z145 - e1 * z144;
    const Real z210 = z207 - z209 + (Real(0.5) * z19 * z161 + e0 * z160);
    const Real z211 = Real(0.5) * z15 * z161 - e1 * z160;
    const Real z212 = z208 + z211 + (Real(0.5) * z19 * z145 + e0 * z144);
    const Real z213 = Real(2) * z8 * z149 - e3 * z148;
    const Real z214 = Real(0.5) * z19 * z164 + e0 * z163;
    const Real z215 = z213 - z214 - (Real(0.5) * z17 * z166 - e2 * z165);
    const Real z216 = Real(2) * z17 * z149 - e2 * z148;
    const Real z217 = Real(0.5) * z8 * z166 - e3 * z165;
    const Real z218 = z216 + z217 - (Real(0.5) * z15 * z164 - e1 * z163);
    const Real z219 = Real(2) * z15 * z149 - e1 * z148;
    const Real z220 = Real(2) * z19 * z149 + e0 * z148;
    const Real z221 = Real(0.5) * z19 * z166 + e0 * z165;
    const Real z222 = z219 - z221 + (Real(0.5) * z17 * z164 - e2 * z163);
    const Real z223 = Real(0.5) * z15 * z166 - e1 * z165;
    const Real z224 = z220 + z223 + (Real(0.5) * z8 * z164 - e3 * z163);
    const Real z225 = e1 * z183;
    const Real z226 = z225 - e3 * z187 + e2 * z184 - e0 * z185;
    const Real z227 = e1 * z203;
    const Real z228 = e0 * z206;
    const Real z229 = e3 * z210;
    const Real z230 = Real(0.25) * z170 - Real(0.25) * z172 - Real(0.25) * z173 - Real(0.25) * z177 - Real(0.5)
        * z227 + Real(0.5) * z228 - Real(0.5) * z229 - Real(0.5) * e2 * z212;
    const Real z231 = e1 * z212;
    const Real z232 = e0 * z212;
    const Real z233 = e0 * z210;
    const Real z234 = e1 * z210;
    const Real z235 = e2 * z203;
    const Real z236 = Real(0.25) * z174 + Real(0.25) * z175 - Real(0.25) * z176 + Real(0.25) * z178 + Real(0.5)
        * z231 - Real(0.5) * z233 - Real(0.5) * z235 - Real(0.5) * e3 * z206;
    const Real z237 = e3 * z203;
    const Real z238 = Real(0.25) * z179 - Real(0.25) * z180 + Real(0.25) * z181 + Real(0.25) * z182 + Real(0.5)
        * z237 - Real(0.5) * z234 - Real(0.5) * z232 - Real(0.5) * e2 * z206;
    const Real z239 = w3 * z238 - (w1 * z230 + w2 * z236);
    const Real z240 = e3 * z215;
    const Real z241 = e2 * z218;
    const Real z242 = e1 * z222;
    const Real z243 = Real(0.25) * z186 - Real(0.25) * z188 - Real(0.25) * z189 - Real(0.25) * z193 - Real(0.5)
        * z240 - Real(0.5) * z241 - Real(0.5) * z242 + Real(0.5) * e0 * z224;
    const Real z244 = e2 * z215;
    const Real z245 = e0 * z215;
    const Real z246 = e3 * z218;
    const Real z247 = e1 * z218;
    const Real z248 = e1 * z224;
    const Real z249 = Real(0.25) * z190 - Real(0.25) * z194 + Real(0.25) * z191 + Real(0.25) * z192 + Real(0.5)
        * z244 - Real(0.5) * z246 - Real(0.5) * z248 - Real(0.5) * e0 * z222;
    const Real z250 = e3 * z224;
    const Real z251 = Real(0.25) * z195 - Real(0.25) * z196 - Real(0.25) * z197 - Real(0.25) * z198 + Real(0.5)
        * z245 + Real(0.5) * z250 - Real(0.5) * z247 + Real(0.5) * e2 * z222;
    const Real z252 = (w2 * z243 + w3 * z249) + w1 * z251;
    const Real z253 = z127 + z135;
    const Real z254 = z127 - z135;
    const Real z255 = Real(2) * z60 - Real(0.5) * z51 * (z253 - z124 + z134);
    const Real z256 = Real(0.5) * z253 * z51 - Real(2) * z60;
    const Real z257 = Real(2) * z82 - Real(0.5) * z20 * (z254 + z124 + z134) + z18 * z255;
    const Real z258 = Real(0.5) * z254 * z20 - Real(2) * z82 + z18 * z256;
    const Real z259 = e2 * z101;
    const Real z260 = e3 * z125;
    const Real z261 = z17 * z19 + z15 * z8;
    const Real z262 = z261 + Real(0.5) * z259 + Real(0.5) * z260 + Real(0.5) * e1 * z105 - Real(0.5) * e0 * z126;
    const Real z263 = z8 * z17 - z15 * z19;
    const Real z264 = z45 * (z261 * z20 - Real(2) * z69 + Real(2) * z13 * z256);
    const Real z265 = z47 * (z263 * z20 - Real(2) * z80 - Real(2) * z14 * z256);
    const Real z266 = z45 * (Real(2) * z69 - z20 * z262 + Real(2) * z13 * z255);
    const Real z267 = z120 + (z83 * z258 + z264 - z265 - z152) * z85;
    const Real z268 = m * (Real(0.5) * z267 - h * z258);
    const Real z269 = m * z239;
    const Real z270 = e1 * z101;
    const Real z271 = e2 * z105;
    const Real z272 = Real(0.5) * z270 - z263 - Real(0.5) * z271 - Real(0.5) * e3 * z126 - Real(0.5) * e0 * z125;
    const Real z273 = z47 * (Real(2) * z80 + z20 * z272 - Real(2) * z14 * z255);
    const Real z274 = z120 - (z83 * z257 + z266 - z273 + z152) * z85;
    const Real z275 = m * (h * z257 + Real(0.5) * z274);
    const Real z276 = m * z252;
    const Real z277 = z44 * k11 * z46 * z85;
    const Real z278 = k6 * z44 + Real(0.5) * z44 * k10 * z48 * z85;
    const Real z279 = k6 * z46 + Real(0.5) * z46 * k5 * z48 * z85;
    const Real z280 = k16 * z48;
    const Real z281 = k12 * z85;
    const Real z282 = k13 - z49 * z281;
    const Real z283 = z87 * z281;
    const Real z284 = z93 * z281;
    const Real z285 = Real(2) * z13 * z283 - z18 * z282 + Real(2) * z14 * z284;
    const Real z286 = z20 * z282;
    const Real z287 = z20 * z283;
    const Real z288 = z20 * z284;
    const Real z289 = z51 * z285;
    const Real z290 = e3 * z167;
    const Real z291 = z290 + e1 * z169 - e0 * z171 - e2 * z168;
    const Real z292 = e0 * z183;
    const Real z293 = z292 + e1 * z185 + e2 * z187 + e3 * z184;
    const Real z294 = k7 * z200;
    const Real z295 = k7 * z226;
    const Real z296 = m * z277;
    const Real z297 = Real(0.25) * z277 * z296 + Real(0.5) * z200 * z294 + Real(0.5) * z226 * z295;
    const Real z298 = z277 * z275 - z200 * z269 + z226 * z276;
    const Real z299 = Real(1) / (C + z297);
    const Real z300 = k7 * z291;
    const Real z301 = m * z278;
    const Real z302 = z296 * z278 - z291 * z294 + z293 * z295;
    const Real z303 = k7 * z293;
    const Real z304 = e2 * z185;
    const Real z305 = z304 + e0 * z184 - e1 * z187 - e3 * z183;
    const Real z306 = z286 - z289;
    const Real z307 = z286 + z289;
    const Real z308 = z278 * z301 + Real(0.5) * z293 * z303 + Real(0.5) * z291 * z300;
    const Real z309 = z278 * z275 + Real(0.5) * z291 * z269 + Real(0.5) * z293 * z276;
    const Real z310 = (e0 * z288 - e3 * z287) + e1 * z306;
    const Real z311 = (e0 * z287 + e3 * z288) + e2 * z306;
    const Real z312 = (e2 * z287 + e1 * z288) - e0 * z307;
    const Real z313 = (e2 * z288 - e1 * z287) - e3 * z307;
    const Real z314 = e2 * z169;
    const Real z315 = z314 + e0 * z167 + e3 * z171 + e1 * z168;
    const Real z316 = z279 * z301 - Real(0.5) * z315 * z300 - Real(0.5) * z305 * z303;
    const Real z317 = z296 * z279 + z315 * z294 - z305 * z295;
    const Real z318 = z279 * z275 - Real(0.5) * z315 * z269 - Real(0.5) * z305 * z276;
    const Real z319 = z279 * m * z279;
    const Real z320 = z305 * k7 * z305;
    const Real z321 = A + (z319 + Real(0.5) * z320 + Real(0.5) * z315 * k7 * z315);
    const Real z322 = e2 * z310;
    const Real z323 = z322 + e0 * z313 - e1 * z311 - e3 * z312;
    const Real z324 = z323 - (w2 * z28 - w1 * z27) + Real(0.5) * z298;
    const Real z325 = e2 * z312;
    const Real z326 = z325 + e3 * z310 - e1 * z313 - e0 * z311;
    const Real z327 = z326 - (w3 * z28 - w1 * z35) + z309;
    const Real z328 = z302 * z299;
    const Real z329 = Real(1) / ((B + z308) - Real(0.25) * z302 * z328);
    const Real z330 = z327 - Real(0.5) * z328 * z324;
    const Real z331 = (D + z316) - Real(0.25) * z317 * z328;
    const Real z332 = e3 * z311;
    const Real z333 = z332 - e1 * z312 - e2 * z313 + e0 * z310;
    const Real z334 = z333 - (w3 * z27 - w2 * z35) - z318;
    const Real z335 = z317 * z299;
    const Real z336 = e0 * z51;
    const Real z337 = e2 * z20;
    const Real z338 = z45 * (Real(2) * z337 - Real(4) * z13 * z336);
    const Real z339 = e1 * z20;
    const Real z340 = z47 * (Real(2) * z339 - Real(4) * z14 * z336);
    const Real z341 = e0 * z20;
    const Real z342 = z341 - z18 * z336;
    const Real z343 = (z280 * z342 + z338 + z340) * z85;
    const Real z344 = Real(0.5) * z343 - k6 * z342;
    const Real z345 = k18 * z337;
    const Real z346 = z339 * (z345 + k17 * z339);
    const Real z347 = k19 * z339 - z345;
    const Real z348 = k18 * z339;
    const Real z349 = z337 * (z348 + k19 * z337);
    const Real z350 = k17 * z337 - z348;
    const Real z351 = e3 * z20;
    const Real z352 = Real(4) * z351 * C * z351 + Real(2) * z346 + Real(2) * z349;
    const Real z353 = e3 * z51;
    const Real z354 = z45 * (Real(2) * z339 + Real(4) * z13 * z353);
    const Real z355 = z47 * (Real(2) * z337 - Real(4) * z14 * z353);
    const Real z356 = z351 - z18 * z353;
    const Real z357 = (z354 - z280 * z356 - z355) * z85;
    const Real z358 = k6 * z356 + Real(0.5) * z357;
    const Real z359 = C * z341;
    const Real z360 = Real(2) * z339 * z350 - Real(4) * z351 * z359 - Real(2) * z337 * z347;
    const Real z361 = e2 * z51;
    const Real z362 = e1 * z51;
    const Real z363 = z45 * (Real(2) * z341 - Real(4) * z13 * z361);
    const Real z364 = z45 * (Real(2) * z351 + Real(4) * z13 * z362);
    const Real z365 = z331 * z329;
    const Real z366 = Real(1) / ((z321 - Real(0.25) * z317 * z335) - z331 * z365);
    const Real z367 = ((z334 + Real(0.5) * z335 * z324) + z330 * z365) * z366;
    const Real z368 = z330 * z329 + z365 * z367;
    const Real z369 = z299 * z324 + Real(0.5) * z335 * z367 - Real(0.5) * z328 * z368;
    const Real z370 = Real(0.5) * e1 * z367 - Real(0.25) * z101 - Real(0.5) * e2 * z368 + Real(0.5) * e3 * z369;
    const Real z371 = (z352 + z344 * m * z344) * z370;
    const Real z372 = Real(0.25) * z105 + Real(0.5) * e2 * z367 + Real(0.5) * e1 * z368 - Real(0.5) * e0 * z369;
    const Real z373 = Real(0.5) * e3 * z367 - Real(0.25) * z126 - Real(0.5) * e0 * z368 - Real(0.5) * e1 * z369;
    const Real z374 = Real(0.5) * e0 * z367 - Real(0.25) * z125 + Real(0.5) * e3 * z368 + Real(0.5) * e2 * z369;
    const Real z375 = Real(0.5) * z305 * z367 - z252 + Real(0.5) * z293 * z368 + Real(0.5) * z226 * z369;
    const Real z376 = m * z375;
    const Real z377 = Real(0.5) * z315 * z367 - z239 + Real(0.5) * z291 * z368 - Real(0.5) * z200 * z369;
    const Real z378 = m * z377;
    const Real z379 = m * z358;
    const Real z380 = z344 * z379 - z360;
    const Real z381 = z47 * (Real(2) * z351 - Real(4) * z14 * z361);
    const Real z382 = z337 + z18 * z361;
    const Real z383 = (z363 - z280 * z382 + z381) * z85;
    const Real z384 = z47 * (Real(2) * z341 - Real(4) * z14 * z362);
    const Real z385 = z339 + z18 * z362;
    const Real z386 = (z280 * z385 + z364 - z384) * z85;
    const Real z387 = k6 * z382 + Real(0.5) * z383;
    const Real z388 = Real(0.5) * z386 - k6 * z385;
    const Real z389 = k18 * z341;
    const Real z390 = z389 + k17 * z351;
    const Real z391 = k19 * z351 - z389;
    const Real z392 = k18 * z351;
    const Real z393 = z392 + k19 * z341;
    const Real z394 = k17 * z341 - z392;
    const Real z395 = C * z339;
    const Real z396 = Real(2) * z339 * z390 - Real(4) * z351 * z395 + Real(2) * z337 * z393;
    const Real z397 = z344 * z268;
    const Real z398 = C * z337;
    const Real z399 = Real(4) * z351 * z398 + Real(2) * z339 * z394 - Real(2) * z337 * z391;
    const Real z400 = Real(4) * z337 * z398 + Real(2) * z341 * z394 + Real(2) * z351 * z391;
    const Real z401 = z20 * z74;
    const Real z402 = z74 * z59;
    const Real z403 = z20 * z63;
    const Real z404 = z100 * z20;
    const Real z405 = z63 * z59;
    const Real z406 = A * z401 + D * z403;
    const Real z407 = k20 * z404;
    const Real z408 = B * z403 + D * z401;
    const Real z409 = A * z402 + D * z405;
    const Real z410 = z409 + (z404 * z408 - Real(2) * z403 * z407);
    const Real z411 = z404 * z406 - Real(2) * z401 * z407;
    const Real z412 = z403 * z406 - z401 * z408;
    const Real z413 = z411 - (B * z405 + D * z402);
    const Real z414 = z412 + Real(2) * k20 * z100 * z59;
    const Real z415 = m * z387;
    const Real z416 = z344 * z415 - z396;
    const Real z417 = m * z388;
    const Real z418 = z399 + z344 * z417;
    const Real z419 = (z400 + z388 * z417) * z374;
    const Real z420 = Real(2) * z341 * z390 - Real(4) * z337 * z395 - Real(2) * z351 * z393;
    const Real z421 = Real(4) * z339 * z395 + Real(2) * z351 * z390 + Real(2) * z341 * z393;
    const Real z422 = z388 * z415 - z420;
    const Real z423 = (z421 + z387 * z415) * z373;
    const Real z424 = Real(2) * z341 * z350 - Real(4) * z337 * z359 + Real(2) * z351 * z347;
    const Real z425 = z388 * z379 - z424;
    const Real z426 = z388 * z268;
    const Real z427 = z387 * z268;
    const Real z428 = z358 * z268;
    const Real z429 = Real(4) * z339 * z359 + Real(2) * z351 * z350 - Real(2) * z341 * z347;
    const Real z430 = Real(4) * z341 * z359 + Real(2) * z337 * z350 + Real(2) * z339 * z347;
    const Real z431 = z429 + z387 * z379;
    const Real z432 = (z430 + z358 * z379) * z372;
    const Real z433 = z184 * z167;
    const Real z434 = z433 - z187 * z168 - z171 * z183 + z185 * z169;
    const Real z435 = Real(1) + z168 * z168 + z167 * z167 + z171 * z171 + z169 * z169;
    const Real z436 = Real(1) + z183 * z183 + z184 * z184 + z185 * z185 + z187 * z187;
    const Real z437 = e3 * z185;
    const Real z438 = z437 - e1 * z184 + e2 * z183 - e0 * z187;
    const Real z439 = z339 * z410 - z337 * z413 + z351 * z414;
    const Real z440 = z351 * z413 + z341 * z410 + z337 * z414;
    const Real z441 = z341 * z413 - z351 * z410 + z339 * z414;
    const Real z442 = -z339 * z413 - z337 * z410 + z341 * z414;
    const Real z443 = z434 * z434 - z435 * z436;
    const Real z444 = e3 * z169;
    const Real z445 = z444 - e1 * z167 + e0 * z168 - e2 * z171;
    const Real z446 = z380 * z372;
    const Real z447 = z416 * z373;
    const Real z448 = Real(2) * z439 - z397 + Real(2) * z312 - z446 - z447 + z418 * z374 + z371;
    const Real z449 = z416 * z370;
    const Real z450 = z168 * z448;
    const Real z451 = z422 * z373;
    const Real z452 = z422 * z374;
    const Real z453 = Real(2) * z441 - z427 + Real(2) * z311 - z423 + z452 + z449 - z431 * z372;
    const Real z454 = z425 * z372;
    const Real z455 = z426 - Real(2) * z440 + Real(2) * z310 + z451 + z454 - z419 - z418 * z370;
    const Real z456 = z184 * z455;
    const Real z457 = z183 * z453;
    const Real z458 = z431 * z373;
    const Real z459 = z435 * z438 - z445 * z434;
    const Real z460 = z425 * z374;
    const Real z461 = z436 * z445 - z438 * z434;
    const Real z462 = z428 - Real(2) * z442 + Real(2) * z313 + z458 + z432 - z460 - z380 * z370;
    const Real z463 = Real(1) / (z16 * z443 + z438 * z459 + z445 * z461);
    const Real z464 = z169 * z462;
    const Real z465 = e3 * z462;
    const Real z466 = z376 + z456 - z457 + z187 * z448 - z185 * z462;
    const Real z467 = z465 + e2 * z453 + e0 * z448 + e1 * z455;
    const Real z468 = z378 - z464 - z450 + z167 * z455 + z171 * z453;
    const Real z469 = z461 * z463;
    const Real z470 = z459 * z463;
    const Real z471 = (z16 * z434 - z445 * z438) * z463;
    const Real z472 = (z445 * z445 - z16 * z435) * z463 * z466;
    const Real z473 = z443 * z463 * z467;
    const Real z474 = (z438 * z438 - z16 * z436) * z463 * z468;
    const Real lambda_F = Real(0.5) * (z473 - z469 * z468 - z470 * z466);
    const Real lambda_rolling_y = z470 * z467 - z472 - z471 * z468;
    const Real lambda_rolling_x = z474 - z469 * z467 + z471 * z466;

    // Result
    lambda[0] = lambda_F;
    lambda[1] = lambda_rolling_x;
    lambda[2] = lambda_rolling_y;
}

/// One step of Newton's method to the constraints; f(q, t) before it, and what the eliminations divide by.
template <typename Real>
void project([[maybe_unused]] const Real& t, const Real* state, [[maybe_unused]] const Real* par, Real* out, Real* position, [[maybe_unused]] Real* pivots) {
    const Real &x = state[0], &y = state[1], &e0 = state[2], &e1 = state[3], &e2 = state[4], &e3 = state[5];
    const Real &w1 = state[6], &w2 = state[7], &w3 = state[8];

    // Projection
    const Real z0 = (e0 * e0 + e1 * e1) + (e2 * e2 + e3 * e3);
    const Real z1 = z0 - Real(1);
    const Real z2 = Real(0.5) * z1 / z0 - Real(1);

    // Result
    out[0] = x;
    out[1] = y;
    out[2] = -e0 * z2;
    out[3] = -e1 * z2;
    out[4] = -e2 * z2;
    out[5] = -e3 * z2;
    out[6] = w1;
    out[7] = w2;
    out[8] = w3;
    position[0] = z1;
    position[1] = Real(0);
    position[2] = Real(0);
    pivots[0] = Real(4) * z0;
    pivots[1] = Real(0);
    pivots[2] = Real(0);
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

constexpr const char* coordinate_names[] = { "x", "y", "e0", "e1", "e2", "e3", nullptr};
constexpr const char* speed_names[] = { "w1", "w2", "w3", nullptr};
constexpr const char* parameter_names[] = { "m", "g", "a", "b", "c", "h", "A", "B", "C", "D", nullptr};
constexpr const char* output_names[] = { "spin", "w1", "w2", "w3", nullptr};
constexpr const char* event_names[] = { nullptr};
constexpr double parameter_values[] = { 1, 9.81, 0.2, 0.03, 0.02, 0.01, 0.0002, 0.0016, 0.0017, -2e-05, 0};

constexpr alembert_solver_table table{
    4, 6, 3, 10, 23, 4, 0, 3, "rattleback", "kane, intermediate symbols",
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

