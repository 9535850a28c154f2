// SPDX-License-Identifier: MIT
#pragma once

/// Kinematics of rotation and of relative motion, as values (Zhang & Qin, chapter 2; Goldstein, Classical
/// Mechanics (1980), chapter 4).
///
///     // Euler's angles, about the body's axes
///     const Matrix3<> R_NB = rotation_by_angles("zxz", {phi, theta, psi});
///     // along B
///     const Vector3r<> w = angular_velocity("zxz", {phi, theta, psi}, {phi_dot, theta_dot, psi_dot});
///     // Euler's theorem: axis and angle
///     const Turn<> turn = turn_of(R_NB);
///     // (e0, e1, e2, e3), scalar first
///     const Quaternion<> e = quaternion_of(R_NB);
///
/// R_AB takes components along B to components along A; its columns are B's unit axes in A, its elements the
/// direction cosines. w_AB_B is the angular velocity of B in A along B. Angles are in radians, lengths and times
/// in any consistent units. All functions are templates over the scalar, so that dual or complex numbers give
/// derivatives; those that compare sizes (turn_of, quaternion_of, angles_of) take real numbers.
/// std::invalid_argument is thrown for letters that are no sequence of axes.

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

namespace alembert {

template <typename Real = double>
using Matrix3 = Eigen::Matrix<Real, 3, 3>;
template <typename Real = double>
using Vector3r = Eigen::Matrix<Real, 3, 1>;
template <typename Real = double>
using Quaternion = std::array<Real, 4>;  ///< scalar first

/// The matrix ã with ã b = a × b.
template <typename Real>
Matrix3<Real> skew(const Vector3r<Real>& a) {
    Matrix3<Real> m;
    m << Real(0), -a[2], a[1], a[2], Real(0), -a[0], -a[1], a[0], Real(0);
    return m;
}

/// a × b, without the conjugation that Eigen's cross product has for complex numbers.
template <typename Real>
Vector3r<Real> cross_product(const Vector3r<Real>& a, const Vector3r<Real>& b) {
    return skew<Real>(a) * b;
}

/// The vector a whose ã is the skew part of m.
template <typename Real>
Vector3r<Real> unskew(const Matrix3<Real>& m) {
    return Vector3r<Real>(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)) / Real(2);
}

// Euler's theorem: every rotation is a turn about an axis.

template <typename Real = double>
struct Turn {
    Vector3r<Real> axis;  ///< a unit vector with the same components in both frames
    Real angle;           ///< 0 to π
};

/// Rodrigues: R = cos φ E + (1 − cos φ) a aᵀ + sin φ ã, a being a unit vector.
template <typename Real>
Matrix3<Real> rotation_about(const Vector3r<Real>& axis, const Real& angle) {
    using std::cos;
    using std::sin;
    const Real c = cos(angle), s = sin(angle);
    return c * Matrix3<Real>::Identity() + (Real(1) - c) * axis * axis.transpose() + s * skew<Real>(axis);
}

// Quaternions e = (cos φ/2, a sin φ/2), e·e = 1; e and −e are the same rotation.

/// R = ((e₀² − ε·ε) E + 2 ε εᵀ + 2 e₀ ε̃)/(e·e): normalized, whatever the length of e.
template <typename Real>
Matrix3<Real> rotation_by(const Quaternion<Real>& e) {
    const Vector3r<Real> v(e[1], e[2], e[3]);
    const Real vv = v[0] * v[0] + v[1] * v[1] + v[2] * v[2], square = e[0] * e[0] + vv;
    return ((e[0] * e[0] - vv) * Matrix3<Real>::Identity() + Real(2) * v * v.transpose() +
            Real(2) * e[0] * skew<Real>(v)) /
           square;
}

/// R(e ∘ f) = R(e) R(f).
template <typename Real>
Quaternion<Real> product(const Quaternion<Real>& e, const Quaternion<Real>& f) {
    return {e[0] * f[0] - e[1] * f[1] - e[2] * f[2] - e[3] * f[3],
            e[0] * f[1] + e[1] * f[0] + e[2] * f[3] - e[3] * f[2],
            e[0] * f[2] + e[2] * f[0] + e[3] * f[1] - e[1] * f[3],
            e[0] * f[3] + e[3] * f[0] + e[1] * f[2] - e[2] * f[1]};
}

/// The inverse rotation, for e·e = 1.
template <typename Real>
Quaternion<Real> conjugate(const Quaternion<Real>& e) {
    return {e[0], -e[1], -e[2], -e[3]};
}

/// e·e − 1, which the motion keeps at 0: the norm constraint.
template <typename Real>
Real norm_defect(const Quaternion<Real>& e) {
    return e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3] - Real(1);
}

template <typename Real>
Quaternion<Real> normalized(const Quaternion<Real>& e) {
    using std::sqrt;
    const Real length = sqrt(norm_defect(e) + Real(1));
    return {e[0] / length, e[1] / length, e[2] / length, e[3] / length};
}

template <typename Real>
Quaternion<Real> quaternion_about(const Vector3r<Real>& axis, const Real& angle) {
    using std::cos;
    using std::sin;
    const Real half = angle / Real(2), s = sin(half);
    return {cos(half), axis[0] * s, axis[1] * s, axis[2] * s};
}

/// The largest of the four is computed first, so that no digits are lost (Shepperd, J. Guidance and Control 1
/// (1978) 223); e₀ ≥ 0.
template <typename Real>
Quaternion<Real> quaternion_of(const Matrix3<Real>& R) {
    const Real trace = R.trace();
    int k = 0;  // 4 e_k² = 1 + 2 R_kk − tr R, and 1 + tr R for the scalar
    Real largest = trace;
    for (int i = 0; i < 3; ++i)
        if (R(i, i) > largest) {
            largest = R(i, i);
            k = i + 1;
        }
    const Vector3r<Real> w = unskew<Real>(R);  // 2 e₀ ε
    Quaternion<Real> e;
    if (k == 0) {
        e[0] = std::sqrt(Real(1) + trace) / Real(2);
        for (int i = 0; i < 3; ++i) e[i + 1] = w[i] / (Real(2) * e[0]);
    } else {
        const int i = k - 1;
        e[k] = std::sqrt(std::max(Real(0), Real(1) + Real(2) * R(i, i) - trace)) / Real(2);
        e[0] = w[i] / (Real(2) * e[k]);
        for (int j = 0; j < 3; ++j)
            if (j != i) e[j + 1] = (R(i, j) + R(j, i)) / (Real(4) * e[k]);
    }
    if (e[0] < 0)
        for (Real& component : e) component = -component;
    return e;
}

/// Axis and angle of R; if R is the identity, the axis is z.
template <typename Real>
Turn<Real> turn_of(const Matrix3<Real>& R) {
    const Quaternion<Real> e = quaternion_of<Real>(R);
    const Vector3r<Real> v(e[1], e[2], e[3]);
    const Real s = v.norm();
    if (s == Real(0)) return {Vector3r<Real>(0, 0, 1), Real(0)};
    return {v / s, Real(2) * std::atan2(s, e[0])};
}

/// ω_B = 2 vec(e* ∘ e')/(e·e): along the new axes.
template <typename Real>
Vector3r<Real> angular_velocity(const Quaternion<Real>& e, const Quaternion<Real>& rate) {
    const Quaternion<Real> w = product<Real>(conjugate<Real>(e), rate);
    return Vector3r<Real>(w[1], w[2], w[3]) * (Real(2) / (norm_defect(e) + Real(1)));
}

/// e' = ½ e ∘ (0, ω_B), with e·e' = 0.
template <typename Real>
Quaternion<Real> quaternion_rate(const Quaternion<Real>& e, const Vector3r<Real>& w_B) {
    Quaternion<Real> rate = product<Real>(e, {Real(0), w_B[0], w_B[1], w_B[2]});
    for (Real& component : rate) component = component / Real(2);
    return rate;
}

// Euler angles: three turns about axes x, y, z in a sequence such as "zxz" (Euler's) or "xyz" (Cardan's, Bryan's).
// If the turns are about the body's axes, each turn carries the axes of the next ones along, R = R₁ R₂ R₃; if they
// are about the space's axes, these stay fixed, R = R₃ R₂ R₁.

enum class Axes { body, space };

/// The axis of each letter as 0, 1 or 2. Throws if the sequence is none of the twelve.
inline std::array<int, 3> letters_of(std::string_view sequence) {
    const bool is_one = sequence.size() == 3 && sequence.find_first_not_of("xyz") == std::string_view::npos &&
                        sequence[0] != sequence[1] && sequence[1] != sequence[2];
    if (!is_one)
        throw std::invalid_argument(
            "'" + std::string(sequence) +
            "' is no sequence of axes; expected three of x, y, z, no two neighbours the same, as in zxz");
    return {sequence[0] - 'x', sequence[1] - 'x', sequence[2] - 'x'};
}

template <typename Real = double>
Matrix3<Real> rotation_by_angles(std::string_view sequence, const std::array<Real, 3>& angles,
                                 Axes axes = Axes::body) {
    const std::array<int, 3> k = letters_of(sequence);
    Matrix3<Real> R = Matrix3<Real>::Identity();
    for (int i = 0; i < 3; ++i) {
        const Matrix3<Real> turn = rotation_about<Real>(Vector3r<Real>::Unit(k[i]), angles[i]);
        R = axes == Axes::body ? Matrix3<Real>(R * turn) : Matrix3<Real>(turn * R);
    }
    return R;
}

template <typename Real = double>
struct Angles {
    std::array<Real, 3> value;  ///< the second from 0 to π ("zxz"), or from −π/2 to π/2 ("xyz")
    bool locked;  ///< gimbal lock: the first and the third turn are about the same line; the third angle is then
                  ///< set to 0
};

/// The angles of a rotation. Near gimbal lock (within 1e-8 of it) the first and the third angle are not determined
/// separately, and `locked` is true.
template <typename Real = double>
Angles<Real> angles_of(const Matrix3<Real>& R, std::string_view sequence, Axes axes = Axes::body) {
    if (axes == Axes::space) {  // about the space's axes in reverse order it is the same rotation
        const Angles<Real> reversed = angles_of<Real>(R, std::string(sequence.rbegin(), sequence.rend()));
        return {{reversed.value[2], reversed.value[1], reversed.value[0]}, reversed.locked};
    }
    const auto [i, j, last] = letters_of(sequence);
    const Real tiny = Real(1e-8);
    const int k = 3 - i - j;                                      // the third axis
    const Real sign = (j - i + 3) % 3 == 1 ? Real(1) : Real(-1);  // of e_i × e_j = ± e_k
    if (i == last) {  // R e_i = cos θ₂ e_i + sin θ₂ (sin θ₁ e_j − sign cos θ₁ e_k)
        const Real s = std::hypot(R(j, i), R(k, i)), middle = std::atan2(s, R(i, i));
        if (s < tiny) return {{std::atan2(sign * R(k, j), R(j, j)), middle, Real(0)}, true};
        return {{std::atan2(R(j, i), -sign * R(k, i)), middle, std::atan2(R(i, j), sign * R(i, k))}, false};
    }
    const Real c = std::hypot(R(i, i), R(i, j)), middle = std::atan2(sign * R(i, k), c);
    if (c < tiny) return {{std::atan2(sign * R(k, j), R(j, j)), middle, Real(0)}, true};
    return {{std::atan2(-sign * R(j, k), R(k, k)), middle, std::atan2(-sign * R(i, j), R(i, i))}, false};
}

/// The matrix B of ω = B (θ₁', θ₂', θ₃'): ω is along the body's axes or along the space's. The determinant of B, ±
/// sin θ₂ or ± cos θ₂, vanishes at gimbal lock.
template <typename Real = double>
Matrix3<Real> rates_matrix(std::string_view sequence, const std::array<Real, 3>& angles, Axes axes, Axes along) {
    const std::array<int, 3> k = letters_of(sequence);
    Matrix3<Real> B, before = Matrix3<Real>::Identity();  // the turns that carry the axis of the next one, along N
    const bool body = axes == Axes::body;
    for (int step = 0; step < 3; ++step) {
        const int i = body ? step : 2 - step;  // about the space's axes the last turn is the leftmost factor
        const Vector3r<Real> axis = Vector3r<Real>::Unit(k[i]);
        B.col(i) = before * axis;
        before = before * rotation_about<Real>(axis, angles[i]);
    }
    return along == Axes::space ? B : Matrix3<Real>(before.transpose() * B);
}

template <typename Real = double>
Vector3r<Real> angular_velocity(std::string_view sequence, const std::array<Real, 3>& angles,
                                const std::array<Real, 3>& rates, Axes axes = Axes::body,
                                Axes along = Axes::body) {
    return rates_matrix<Real>(sequence, angles, axes, along) * Vector3r<Real>(rates[0], rates[1], rates[2]);
}

// Composition: C moves relative to B, which moves relative to A. All vectors are along A, except those whose names
// end in _B.

/// ω_AC = ω_AB + R_AB ω_BC
template <typename Real>
Vector3r<Real> composed_velocity(const Vector3r<Real>& w_AB, const Matrix3<Real>& R_AB,
                                 const Vector3r<Real>& w_BC_B) {
    return w_AB + R_AB * w_BC_B;
}

/// α_AC = α_AB + R_AB α_BC + ω_AB × R_AB ω_BC, α_BC being the rate of ω_BC as seen in B.
template <typename Real>
Vector3r<Real> composed_acceleration(const Vector3r<Real>& w_AB, const Vector3r<Real>& alpha_AB,
                                     const Matrix3<Real>& R_AB, const Vector3r<Real>& w_BC_B,
                                     const Vector3r<Real>& alpha_BC_B) {
    return alpha_AB + R_AB * alpha_BC_B + cross_product<Real>(w_AB, R_AB * w_BC_B);
}

/// The absolute derivative of a vector from the relative one: (dv/dt)_A = (dv/dt)_B + ω_AB × v.
template <typename Real>
Vector3r<Real> absolute_derivative(const Vector3r<Real>& relative, const Vector3r<Real>& w_AB,
                                   const Vector3r<Real>& v) {
    return relative + cross_product<Real>(w_AB, v);
}

/// A point at r from O_B, moving in B: v = v_B + ω × r + v_r; a = a_B + α × r + ω × (ω × r) + 2 ω × v_r + a_r, the
/// last two being Coriolis's and the relative acceleration. All components are along the same frame.
template <typename Real = double>
struct FrameMotion {
    Vector3r<Real> velocity, acceleration;  ///< of the origin of B
    Vector3r<Real> w, alpha;
};
template <typename Real>
Vector3r<Real> point_velocity(const FrameMotion<Real>& frame, const Vector3r<Real>& r,
                              const Vector3r<Real>& relative) {
    return frame.velocity + cross_product<Real>(frame.w, r) + relative;
}
template <typename Real>
Vector3r<Real> point_acceleration(const FrameMotion<Real>& frame, const Vector3r<Real>& r,
                                  const Vector3r<Real>& relative_velocity,
                                  const Vector3r<Real>& relative_acceleration) {
    return frame.acceleration + cross_product<Real>(frame.alpha, r) +
           cross_product<Real>(frame.w, cross_product<Real>(frame.w, r)) +
           Real(2) * cross_product<Real>(frame.w, relative_velocity) + relative_acceleration;
}

}  // namespace alembert
