// SPDX-License-Identifier: GPL-2.0-or-later
// Rotation by φ about a unit vector a (Rodrigues):  R = cos φ E + (1 − cos φ) a aᵀ + sin φ ã,
// composition R_NC = R_NB R_BC, addition of angular velocities ω_NC = R_BCᵀ ω_NB + φ' a
// (Zhang & Qin, chapter 2; Kane & Levinson, Dynamics (1985), chapter 2). By a quaternion e = (e₀, ε):
//   R = ((e₀² − ε·ε) E + 2 ε εᵀ + 2 e₀ ε̃)/(e·e),   ω = 2 (e₀ ε' − e₀' ε − ε × ε')/(e·e) along the new axes
// (Goldstein, Classical Mechanics (1980), §4-5; twice vec(e* e')). Because of the division by e·e they hold for
// every e, so that T and V do not change along e and all formalisms give the same multiplier of e·e = 1, which is
// 0.
#include "model/geometry.hpp"

#include "algebra/symbolic/functions.hpp"

namespace alembert {

using GiNaC::ex;

Vector3 add(const Vector3& a, const Vector3& b, Intermediates& z) {
    return {z.name(a[0] + b[0]), z.name(a[1] + b[1]), z.name(a[2] + b[2])};
}

Vector3 scale(const ex& factor, const Vector3& a, Intermediates& z) {
    return {z.name(factor * a[0]), z.name(factor * a[1]), z.name(factor * a[2])};
}

ex dot(const Vector3& a, const Vector3& b, Intermediates& z) {
    return z.name(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

Vector3 cross(const Vector3& a, const Vector3& b, Intermediates& z) {
    return {z.name(a[1] * b[2] - a[2] * b[1]), z.name(a[2] * b[0] - a[0] * b[2]),
            z.name(a[0] * b[1] - a[1] * b[0])};
}

ex norm(const Vector3& a, Intermediates& z) {
    return z.name(sqrt(dot(a, a, z)));
}

Orientation::Orientation()
    : steps_{Step{{0, 0, 0}, 0, 0, {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}}, {0, 0, 0}}} {}

Orientation Orientation::turned(const Vector3& axis, const ex& angle, const ex& rate, Intermediates& z) const {
    Orientation result = *this;
    ex whole = angle, whole_rate = rate;
    const Step& last = result.steps_.back();
    if (result.steps_.size() > 1 && last.axis[0].is_equal(axis[0]) && last.axis[1].is_equal(axis[1]) &&
        last.axis[2].is_equal(axis[2])) {
        whole = z.name(last.angle + angle);
        whole_rate = z.name(last.rate + rate);
        result.steps_.pop_back();
    }
    const Step& base = result.steps_.back();
    const ex c = z.name(exact_cosine(whole)), s = z.name(exact_sine(whole));
    std::array<Vector3, 3> R;  // R_BC
    const Vector3& a = axis;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const ex tilde = i == k ? ex(0) : ((k - i + 3) % 3 == 1 ? -a[3 - i - k] : a[3 - i - k]);
            R[i][k] = (i == k ? c : ex(0)) + (1 - c) * a[i] * a[k] + s * tilde;
            // For the axis itself, c + (1 − c)·1 is 1.
            R[i][k] = z.name(a[i].is_equal(1) && i == k ? ex(1) : R[i][k]);
        }
    Step step{axis, whole, whole_rate, {}, {}};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            ex sum = 0;
            for (int j = 0; j < 3; ++j) sum += base.R_NB[i][j] * R[j][k];
            step.R_NB[i][k] = z.name(sum);
        }
    for (int k = 0; k < 3; ++k) {
        ex sum = whole_rate * a[k];
        for (int j = 0; j < 3; ++j) sum += R[j][k] * base.w_NB_B[j];
        step.w_NB_B[k] = z.name(sum);
    }
    result.steps_.push_back(std::move(step));
    return result;
}

Orientation Orientation::turned(const std::array<ex, 4>& e, const std::array<ex, 4>& rate,
                                Intermediates& z) const {
    const auto sq = [&](int k) { return e[k] * e[k]; };
    const ex inverse = z.name(1 / z.name(sq(0) + sq(1) + sq(2) + sq(3)));
    std::array<Vector3, 3> R;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        R[i][i] = sq(0) + sq(i + 1) - sq(j + 1) - sq(k + 1);
        R[i][j] = 2 * (e[i + 1] * e[j + 1] - e[0] * e[k + 1]);
        R[j][i] = 2 * (e[i + 1] * e[j + 1] + e[0] * e[k + 1]);
    }
    const Step& base = steps_.back();
    Step step{{0, 0, 0}, 0, 0, {}, {}};
    for (Vector3& row : R)
        for (ex& entry : row) entry = z.name(z.name(entry) * inverse);
    for (int k = 0; k < 3; ++k) {
        const int i = k, j = (k + 1) % 3, l = (k + 2) % 3;
        const ex own = e[0] * rate[i + 1] - e[i + 1] * rate[0] + e[l + 1] * rate[j + 1] - e[j + 1] * rate[l + 1];
        ex sum = 2 * z.name(own) * inverse;
        for (int a = 0; a < 3; ++a) {
            sum += R[a][k] * base.w_NB_B[a];
            ex entry = 0;
            for (int b = 0; b < 3; ++b) entry += base.R_NB[a][b] * R[b][k];
            step.R_NB[a][k] = z.name(entry);
        }
        step.w_NB_B[k] = z.name(sum);
    }
    Orientation result = *this;
    result.steps_.push_back(std::move(step));
    return result;
}

Vector3 Orientation::to_inertial(const Vector3& v_B, Intermediates& z) const {
    const auto& R = steps_.back().R_NB;
    return {dot(R[0], v_B, z), dot(R[1], v_B, z), dot(R[2], v_B, z)};
}

Vector3 Orientation::axis(int k) const {
    const auto& R = steps_.back().R_NB;
    return {R[0][k], R[1][k], R[2][k]};
}

}  // namespace alembert
