// SPDX-License-Identifier: MIT
#pragma once

/// Andrews' squeezer by hand, for verner_peer.cpp: the equations of Hairer & Wanner, Solving Ordinary Differential
/// Equations II, §VII.7, with
///
///     M q″ = f − Gᵀ λ,   G q″ = γ:    (G M⁻¹ Gᵀ) λ = G M⁻¹ f − γ
///
/// M is one number and three blocks of two rows, which are inverted in closed form; the 6 × 6 matrix of the
/// multipliers is factored by Cholesky's method, unrolled. The order is (β, Θ, γ, Φ, δ, Ω, ε).

#include <array>
#include <cmath>

namespace verner_peer {

struct Andrews {
    static constexpr int size = 14;
    static constexpr double end = 0.03;
    std::array<double, 14> start() const {
        return {-0.0617138900142764496, 0,
                0.455279819163070380,   0.222668390165885885,
                0.487364979543842550,   -0.222668390165885885,
                1.23054744454982120};
    }
    [[gnu::always_inline]] void operator()(double, const double* y, double* rate) const;

private:
    static constexpr double m1 = .04325, m2 = .00365, m3 = .02373, m4 = .00706, m5 = .07050, m6 = .00706,
                            m7 = .05498, i1 = 2.194e-6, i2 = 4.410e-7, i3 = 5.255e-6, i4 = 5.667e-7, i5 = 1.169e-5,
                            i6 = 5.667e-7, i7 = 1.912e-5, xb = -.03635, yb = .03273, xc = .014, yc = .072,
                            c0 = 4530, l0 = .07785, d = .028, da = .0115, e = .02, ea = .01421, rr = .007,
                            ra = .00092, ss = .035, sa = .01874, sb = .01043, sc = .018, sd = .02, ta = .02308,
                            tb = .00916, u = .04, ua = .01228, ub = .00449, zf = .02, zt = .04, fa = .01421,
                            mom = .033;

    /// The inverse of a block ((a, b), (b, c)).
    struct Two {
        double a, b, c;
    };
    static Two inverse(double a, double b, double c) {
        const double by = 1 / (a * c - b * b);
        return {c * by, -b * by, a * by};
    }
    [[gnu::always_inline]] static void cholesky(double (&s)[6][6], double (&x)[6]) {
        for (int k = 0; k < 6; ++k) {
            const double root = 1 / std::sqrt(s[k][k]);
            for (int i = k; i < 6; ++i) s[i][k] *= root;
            s[k][k] = root;  // of the diagonal, one over it
            for (int j = k + 1; j < 6; ++j)
                for (int i = j; i < 6; ++i) s[i][j] -= s[i][k] * s[j][k];
        }
        for (int i = 0; i < 6; ++i) {
            for (int j = 0; j < i; ++j) x[i] -= s[i][j] * x[j];
            x[i] *= s[i][i];
        }
        for (int i = 5; i >= 0; --i) {
            for (int j = i + 1; j < 6; ++j) x[i] -= s[j][i] * x[j];
            x[i] *= s[i][i];
        }
    }
};

inline void Andrews::operator()(double, const double* y, double* rate) const {
    double sbe, cbe, sbt, cbt, sth, cth, sga, cga, sph, cph, sde, cde, som, com, sep, cep;
    sincos(y[0], &sbe, &cbe), sincos(y[1], &sth, &cth), sincos(y[2], &sga, &cga), sincos(y[3], &sph, &cph);
    sincos(y[4], &sde, &cde), sincos(y[5], &som, &com), sincos(y[6], &sep, &cep);
    sbt = sbe * cth + cbe * sth, cbt = cbe * cth - sbe * sth;
    const double spd = sph * cde + cph * sde, cpd = cph * cde - sph * sde;
    const double soe = som * cep + com * sep, coe = com * cep - som * sep;
    const double be = y[7], th = y[8], ga = y[9], ph = y[10], de = y[11], om = y[12], ep = y[13];
    const double bt = be + th, pd = ph + de, oe = om + ep, ee = e - ea, zz = zf - fa;
    const Two one = inverse(m1 * ra * ra + m2 * (rr * rr - 2 * da * rr * cth + da * da) + i1 + i2,
                            m2 * (da * da - da * rr * cth) + i2, m2 * da * da + i2);
    constexpr double three = 1 / (m3 * (sa * sa + sb * sb) + i3);
    const Two four = inverse(m4 * ee * ee + i4, m4 * (ee * ee + zt * ee * sph) + i4,
                             m4 * (zt * zt + 2 * zt * ee * sph + ee * ee) + m5 * (ta * ta + tb * tb) + i4 + i5);
    const Two six = inverse(m6 * zz * zz + i6, m6 * (zz * zz - u * zz * som) + i6,
                            m6 * (zz * zz - 2 * u * zz * som + u * u) + m7 * (ua * ua + ub * ub) + i6 + i7);
    const double xd = sd * cga + sc * sga + xb - xc, yd = sd * sga - sc * cga + yb - yc;
    const double length = std::sqrt(xd * xd + yd * yd), force = -c0 * (length - l0) / length;
    const double f[7] = {mom - m2 * da * rr * th * (th + 2 * be) * sth,
                         m2 * da * rr * be * be * sth,
                         force * (xd * (sc * cga - sd * sga) + yd * (sd * cga + sc * sga)),
                         m4 * zt * ee * de * de * cph,
                         -m4 * zt * ee * ph * (ph + 2 * de) * cph,
                         -m6 * u * zz * ep * ep * com,
                         m6 * u * zz * om * (om + 2 * ep) * com};
    // Columns of β and Θ, the same in each pair of rows; then those of γ, of (Φ, δ) and of (Ω, ε).
    const double gb[2] = {-rr * sbe + d * sbt, rr * cbe - d * cbt}, gt[2] = {d * sbt, -d * cbt};
    const double gg[2] = {-ss * cga, -ss * sga};
    const double gp[2] = {-e * cpd, -e * spd}, gd[2] = {-e * cpd + zt * sde, -e * spd - zt * cde};
    const double go[2] = {zf * soe, -zf * coe}, ge[2] = {zf * soe - u * cep, -zf * coe - u * sep};
    const double common[2] = {-rr * cbe * be * be + d * cbt * bt * bt, -rr * sbe * be * be + d * sbt * bt * bt};
    const double own[6] = {ss * sga * ga * ga,
                           -ss * cga * ga * ga,
                           e * spd * pd * pd + zt * cde * de * de,
                           -e * cpd * pd * pd + zt * sde * de * de,
                           zf * coe * oe * oe + u * sep * ep * ep,
                           zf * soe * oe * oe - u * cep * ep * ep};
    const double a0 = one.a * f[0] + one.b * f[1], a1 = one.b * f[0] + one.c * f[1], a2 = three * f[2];
    const double a3 = four.a * f[3] + four.b * f[4], a4 = four.b * f[3] + four.c * f[4];
    const double a5 = six.a * f[5] + six.b * f[6], a6 = six.b * f[5] + six.c * f[6];
    double s[6][6], x[6];
    const auto product = [](const Two& m, double p, double q, double r, double t) {
        return p * (m.a * r + m.b * t) + q * (m.b * r + m.c * t);
    };
    for (int i = 0; i < 2; ++i) {
        const double shared = gb[i] * a0 + gt[i] * a1 + common[i];
        x[i] = shared + gg[i] * a2 + own[i];
        x[2 + i] = shared + gp[i] * a3 + gd[i] * a4 + own[2 + i];
        x[4 + i] = shared + go[i] * a5 + ge[i] * a6 + own[4 + i];
        for (int j = 0; j < 2; ++j) {
            const double both = product(one, gb[i], gt[i], gb[j], gt[j]);
            for (int p = 0; p < 3; ++p)
                for (int q = 0; q < 3; ++q) s[2 * p + i][2 * q + j] = both;
            s[i][j] += gg[i] * gg[j] * three;
            s[2 + i][2 + j] += product(four, gp[i], gd[i], gp[j], gd[j]);
            s[4 + i][4 + j] += product(six, go[i], ge[i], go[j], ge[j]);
        }
    }
    cholesky(s, x);
    const double x0 = x[0] + x[2] + x[4], x1 = x[1] + x[3] + x[5];
    const double l0b = gb[0] * x0 + gb[1] * x1, l0t = gt[0] * x0 + gt[1] * x1;
    const double l4 = gp[0] * x[2] + gp[1] * x[3], l5 = gd[0] * x[2] + gd[1] * x[3];
    const double l6 = go[0] * x[4] + go[1] * x[5], l7 = ge[0] * x[4] + ge[1] * x[5];
    for (int i = 0; i < 7; ++i) rate[i] = y[7 + i];
    rate[7] = a0 - (one.a * l0b + one.b * l0t), rate[8] = a1 - (one.b * l0b + one.c * l0t);
    rate[9] = a2 - three * (gg[0] * x[0] + gg[1] * x[1]);
    rate[10] = a3 - (four.a * l4 + four.b * l5), rate[11] = a4 - (four.b * l4 + four.c * l5);
    rate[12] = a5 - (six.a * l6 + six.b * l7), rate[13] = a6 - (six.b * l6 + six.c * l7);
}

}  // namespace verner_peer
