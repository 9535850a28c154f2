// SPDX-License-Identifier: GPL-2.0-or-later
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "scene/import/robot.hpp"

#include "alembert/base/inertia.hpp"

namespace alembert {

std::optional<int> twelfths_of_pi(double angle) {
    const double k = std::round(angle * 12 / M_PI);
    if (std::abs(k) > 1200 || std::abs(angle - k * M_PI / 12) > 4e-16 * std::abs(angle)) return {};
    return static_cast<int>(k);
}

Real33 RobotPose::rotation() const {
    const auto about = [](int axis, double angle) {
        double c = std::cos(angle), s = std::sin(angle);
        if (const std::optional<int> k = twelfths_of_pi(angle); k && *k % 6 == 0) {
            constexpr std::array<double, 4> cosine{1, 0, -1, 0};
            c = cosine[static_cast<std::size_t>((*k / 6) & 3)];
            s = cosine[static_cast<std::size_t>((*k / 6 + 3) & 3)];
        }
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        Real33 R = Real33::Identity();
        R(i, i) = R(j, j) = c;
        R(j, i) = s;
        R(i, j) = -s;
        return R;
    };
    return about(2, rpy[2]) * about(1, rpy[1]) * about(0, rpy[0]);
}

Real3 roll_pitch_yaw(const Real33& R) {
    const double across = std::hypot(R(0, 0), R(1, 0));
    if (across < 1e-12) return {0, R(2, 0) < 0 ? M_PI / 2 : -M_PI / 2, std::atan2(-R(0, 1), R(1, 1))};
    Real3 angles{std::atan2(R(2, 1), R(2, 2)), std::atan2(-R(2, 0), across), std::atan2(R(1, 0), R(0, 0))};
    if (across < 0.1) {  // near gimbal lock, where quotients of small elements would lose digits
        const Eigen::Quaterniond e(R);
        const double difference = std::atan2(e.z() - e.x(), e.w() + e.y()),
                     sum = std::atan2(e.z() + e.x(), e.w() - e.y()),
                     tilt = std::atan2(std::hypot(e.w() + e.y(), e.z() - e.x()),
                                       std::hypot(e.w() - e.y(), e.z() + e.x()));
        angles = {sum - difference, 2 * tilt - M_PI / 2, sum + difference};
    }
    for (double& angle : angles)
        if (const double k = std::round(angle * 2 / M_PI); std::abs(angle - k * M_PI / 2) < 1e-15)
            angle = k * M_PI / 2;
    return angles;
}

RobotPlace composed(const RobotPlace& outer, const RobotPlace& inner) {
    return {outer.shift + outer.R * inner.shift, outer.R * inner.R};
}

RobotPlace inverted(const RobotPlace& place) {
    return {-(place.R.transpose() * place.shift), place.R.transpose()};
}

namespace {

/// The multiple of π/2 that an angle with few digits stands for.
std::optional<double> right_angle_meant(double angle) {
    const double right = std::round(angle / M_PI_2) * M_PI_2;
    if (right == 0 || twelfths_of_pi(angle)) return std::nullopt;
    const std::string text = fmt::format("{}", angle);
    const std::size_t point = text.find('.');
    if (point == std::string::npos || text.find('e') != std::string::npos) return std::nullopt;
    const int decimals = static_cast<int>(text.size() - point) - 1;
    const double scale = std::pow(10, decimals), written = std::abs(angle) * scale,
                 exact = std::abs(right) * scale;
    if (decimals < 2 || decimals > 14) return std::nullopt;
    if (std::round(written) != std::round(exact) && std::round(written) != std::floor(exact)) return std::nullopt;
    return right;
}

}  // namespace

int rounded_right_angles(Robot& robot, bool mend) {
    int count = 0;
    for (Robot::Joint& joint : robot.joints)
        for (double& angle : joint.at.rpy)
            if (const std::optional<double> right = right_angle_meant(angle)) {
                ++count;
                if (mend) angle = *right;
            }
    for (Robot::Link& link : robot.links) {
        if (!mend || !link.own_axes) continue;
        for (double& angle : link.own_axes->rpy) angle = right_angle_meant(angle).value_or(angle);
        link.inertia =
            turned<double>(link.own_axes->inertia, RobotPose{Real3::Zero(), link.own_axes->rpy}.rotation());
    }
    return count;
}

}  // namespace alembert
