// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Three angles followed along a rotation that is known as a quaternion at some times (charts.hpp).
///
///     AnglesAlong along(angles, start, first, 1e-6);
///     along.go_to(next);
///     along.angles();  // those of `next` that continue the angles before
///
/// Each rotation has two triples of angles and whole turns of each. Beside gimbal lock the middle angle stays on
/// its side and the two others turn quickly; how far, the rotation between the times says: a polynomial of degree
/// 5 through values, rates and accelerations. In space the first angle is the direction, in a plane, of a vector
/// whose length is the distance from the lock, |sin b| or |cos b|. Where this vector comes nearer to 0 than
/// `through`, the motion counts as going through the lock, and the nearest angles follow, with the middle one
/// passing through it.

#include <Eigen/Geometry>

#include "simulate/angles_of_frame.hpp"

namespace alembert {

/// A quaternion and its derivatives by time.
struct Turning {
    double t;
    Eigen::Vector4d e, rate, acceleration;  ///< scalar part first
};

class AnglesAlong {
public:
    AnglesAlong(const AnglesOfFrame& of, const Eigen::Vector3d& angles, const Turning& first, double through)
        : of_(of), angles_(angles), last_(first), through_(through) {}

    /// Times must not decrease.
    void go_to(const Turning& next);
    const Eigen::Vector3d& angles() const { return angles_; }

private:
    AnglesOfFrame of_;
    Eigen::Vector3d angles_;
    Turning last_;
    double through_;
};

}  // namespace alembert
