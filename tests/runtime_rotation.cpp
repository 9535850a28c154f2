// SPDX-License-Identifier: MIT
// Rotations as values: sequences of angles against single turns, axis and angle, quaternions and matrices against
// each other, and every rate against the derivative of what it is the rate of, by complex numbers: f'(t) = Im f(t
// + ih)/h without rounding.
#include <doctest/doctest.h>

#include <algorithm>
#include <complex>
#include <random>

#include "alembert/base/rotation.hpp"

namespace runtime_rotation {

using namespace alembert;

namespace {

using C = std::complex<double>;
constexpr double h = 1e-40;

const char* const sequences[] = {"xyx", "xzx", "yxy", "yzy", "zxz", "zyz",
                                 "xyz", "xzy", "yxz", "yzx", "zxy", "zyx"};

std::array<double, 3> angles(std::mt19937_64& random, std::string_view sequence) {
    std::uniform_real_distribution<double> turn(-3, 3), middle(0.1, 1.4);
    const bool proper = sequence[0] == sequence[2];
    return {turn(random), proper ? 2 * middle(random) : middle(random) - 0.7, turn(random)};
}

Vector3r<> vector(std::mt19937_64& random) {
    std::uniform_real_distribution<double> one(-1, 1);
    return {one(random), one(random), one(random)};
}

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return (a - b).cwiseAbs().maxCoeff();
}

constexpr double rounding = 1e-13;  // of some dozen operations on numbers of order one

}  // namespace

TEST_CASE(
    "rotation: each of the twelve sequences is its three turns, gives its angles back, and turns about the other "
    "axes in reverse") {
    std::mt19937_64 random(20040110);
    for (const char* sequence : sequences) {
        CAPTURE(sequence);
        const std::array<double, 3> a = angles(random, sequence);
        Eigen::Matrix3d body = Eigen::Matrix3d::Identity(), space = body;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Matrix3d turn =
                Eigen::AngleAxisd(a[k], Eigen::Vector3d::Unit(sequence[k] - 'x')).toRotationMatrix();
            body = body * turn;
            space = turn * space;
        }
        for (const Axes axes : {Axes::body, Axes::space}) {
            const Matrix3<> R = rotation_by_angles(sequence, a, axes);
            CHECK(distance(R, axes == Axes::body ? body : space) < rounding);
            const Angles<> back = angles_of(R, sequence, axes);
            CHECK_FALSE(back.locked);
            CHECK(distance(rotation_by_angles(sequence, back.value, axes), R) < rounding);
            for (int k = 0; k < 3; ++k) CHECK(back.value[k] == doctest::Approx(a[k]).epsilon(1e-12));
        }
    }
    CHECK_THROWS_AS(rotation_by_angles("xxz", {1.0, 2.0, 3.0}), std::invalid_argument);
    CHECK_THROWS_AS(rotation_by_angles("xyw", {1.0, 2.0, 3.0}), std::invalid_argument);
}

TEST_CASE(
    "rotation: in gimbal lock the angles say so and still give the rotation, and the rates matrix is singular") {
    for (const char* sequence : sequences)
        for (const Axes axes : {Axes::body, Axes::space})
            for (const int side : {0, 1}) {
                CAPTURE(sequence);
                const bool proper = sequence[0] == sequence[2];
                const std::array<double, 3> a{0.7, proper ? side * M_PI : (side - 0.5) * M_PI, 0.4};
                const Matrix3<> R = rotation_by_angles(sequence, a, axes);
                const Angles<> back = angles_of(R, sequence, axes);
                CHECK(back.locked);
                CHECK(distance(rotation_by_angles(sequence, back.value, axes), R) < rounding);
                CHECK(std::abs(rates_matrix(sequence, a, axes, Axes::body).determinant()) < rounding);
            }
}

TEST_CASE(
    "rotation: angular velocities are those of the rotation's own derivative, for angles and for quaternions") {
    std::mt19937_64 random(20040110);
    const auto along_body = [](const Matrix3<C>& moved) {  // R^T R' is the skew matrix of ω
        return unskew<double>(Matrix3<>(moved.real().transpose() * (moved.imag() / h)));
    };
    for (const char* sequence : sequences)
        for (const Axes axes : {Axes::body, Axes::space}) {
            CAPTURE(sequence);
            const std::array<double, 3> a = angles(random, sequence);
            const Vector3r<> v = vector(random);
            const std::array<double, 3> rates{v[0], v[1], v[2]};
            std::array<C, 3> moved;
            for (int k = 0; k < 3; ++k) moved[k] = C(a[k], h * rates[k]);
            const Matrix3<C> R = rotation_by_angles<C>(sequence, moved, axes);
            CHECK(distance(angular_velocity(sequence, a, rates, axes), along_body(R)) < rounding);
            CHECK(distance(angular_velocity(sequence, a, rates, axes, Axes::space), R.real() * along_body(R)) <
                  rounding);
        }
    const Quaternion<> e = normalized<double>({0.3, -0.5, 0.2, 0.7});
    const Vector3r<> w = vector(random);
    const Quaternion<> rate = quaternion_rate<double>(e, w);
    Quaternion<C> moved;
    double along = 0;
    for (int k = 0; k < 4; ++k) {
        moved[k] = C(e[k], h * rate[k]);
        along += e[k] * rate[k];
    }
    CHECK(std::abs(along) < rounding);  // e' keeps e·e
    CHECK(distance(along_body(rotation_by<C>(moved)), w) < rounding);
    CHECK(distance(angular_velocity<double>(e, rate), w) < rounding);
    const Quaternion<> longer{2 * e[0], 2 * e[1], 2 * e[2], 2 * e[3]},
        faster{2 * rate[0], 2 * rate[1], 2 * rate[2], 2 * rate[3]};
    CHECK(distance(rotation_by<double>(longer), rotation_by<double>(e)) < rounding);
    CHECK(distance(angular_velocity<double>(longer, faster), w) < rounding);
}

TEST_CASE("rotation: axis and angle, quaternion and direction cosines are one rotation, up to the half turn") {
    std::mt19937_64 random(20040110);
    for (const double angle : {0.0, 1e-9, 0.3, 2.0, M_PI - 1e-9, M_PI}) {
        CAPTURE(angle);
        const Vector3r<> axis = vector(random).normalized();
        const Matrix3<> R = rotation_about<double>(axis, angle);
        CHECK(distance(R, Eigen::AngleAxisd(angle, axis).toRotationMatrix()) < rounding);
        CHECK(distance(R * axis, axis) < rounding);  // Euler's theorem: the axis stays
        CHECK(R.trace() == doctest::Approx(1 + 2 * std::cos(angle)));
        const Turn<> turn = turn_of<double>(R);
        CHECK(turn.angle == doctest::Approx(angle).epsilon(1e-12));
        CHECK(distance(rotation_about<double>(turn.axis, turn.angle), R) < rounding);
        const Quaternion<> e = quaternion_of<double>(R), own = quaternion_about<double>(axis, angle);
        CHECK(std::abs(norm_defect(e)) < rounding);
        CHECK(distance(rotation_by<double>(e), R) < rounding);
        CHECK(distance(rotation_by<double>(own), R) < rounding);
    }
    const Quaternion<> e = quaternion_about<double>(vector(random).normalized(), 1.2),
                       f = quaternion_about<double>(vector(random).normalized(), 2.1);
    CHECK(distance(rotation_by<double>(product<double>(e, f)), rotation_by<double>(e) * rotation_by<double>(f)) <
          rounding);
    CHECK(distance(rotation_by<double>(conjugate<double>(e)), rotation_by<double>(e).transpose()) < rounding);
}

// B turns in A by angles a(t) = a + b t + c t²/2, C in B likewise; first derivatives by complex t, second by the
// derivative of ω.
TEST_CASE(
    "rotation: velocities and accelerations of composed rotations and of moving points are the derivatives of "
    "places") {
    std::mt19937_64 random(20040110);
    const Vector3r<> a = vector(random), b = vector(random), c = vector(random), p = vector(random),
                     q = vector(random), s = vector(random);
    const auto at = [](const Vector3r<>& x, const Vector3r<>& y, const Vector3r<>& z, C t) {
        std::array<C, 3> result;
        for (int k = 0; k < 3; ++k) result[k] = x[k] + y[k] * t + z[k] * t * t / 2.0;
        return result;
    };
    const auto rate = [](const Vector3r<>& y, const Vector3r<>& z, C t) {
        return std::array<C, 3>{y[0] + z[0] * t, y[1] + z[1] * t, y[2] + z[2] * t};
    };
    const C t(0.4, h);
    const Matrix3<C> AB = rotation_by_angles<C>("zxz", at(a, b, c, t)),
                     BC = rotation_by_angles<C>("xyz", at(p, q, s, t));
    const Vector3r<C> w_AB = angular_velocity<C>("zxz", at(a, b, c, t), rate(b, c, t), Axes::body, Axes::space),
                      w_BC = angular_velocity<C>("xyz", at(p, q, s, t), rate(q, s, t), Axes::body, Axes::space);
    const Vector3r<> w = w_AB.real(), alpha = w_AB.imag() / h, own = w_BC.real(), own_rate = w_BC.imag() / h;
    const Matrix3<> R = AB.real();

    const Matrix3<C> AC = AB * BC;
    const Vector3r<> w_AC = unskew<double>(Matrix3<>((AC.imag() / h) * AC.real().transpose()));
    CHECK(distance(composed_velocity<double>(w, R, own), w_AC) < rounding);
    const Vector3r<C> whole = composed_velocity<C>(w_AB, AB, w_BC);
    CHECK(distance(composed_acceleration<double>(w, alpha, R, own, own_rate), whole.imag() / h) < rounding);

    // A point at r(t) = p + q t + s t²/2 in B, whose origin is at a + b t + c t²/2.
    const auto r = at(p, q, s, t), r_rate = rate(q, s, t), o = at(a, b, c, t), o_rate = rate(b, c, t);
    const auto column = [](const std::array<C, 3>& v) { return Vector3r<C>(v[0], v[1], v[2]); };
    const Vector3r<C> place = column(o) + AB * column(r);
    const FrameMotion<C> frame{column(o_rate), Vector3r<C>(C(c[0]), C(c[1]), C(c[2])), w_AB,
                               Vector3r<C>(C(alpha[0]), C(alpha[1]), C(alpha[2]))};
    const Vector3r<C> arm = AB * column(r), relative = AB * column(r_rate);
    const Vector3r<C> v = point_velocity<C>(frame, arm, relative);
    CHECK(distance(v.real(), place.imag() / h) < rounding);
    const Vector3r<C> jerk = AB * Vector3r<C>(C(s[0]), C(s[1]), C(s[2]));
    CHECK(distance(point_acceleration<C>(frame, arm, relative, jerk).real(), v.imag() / h) < rounding);
    const Vector3r<> seen_in_B = R * Vector3r<>(column(r_rate).real());
    CHECK(distance(absolute_derivative<double>(seen_in_B, w, arm.real()), arm.imag() / h) < rounding);
}

}  // namespace runtime_rotation
