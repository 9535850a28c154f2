// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Vectors and orientations with named components. Notation after Drake: R_NB takes components along B to
/// components along N; w_NB_B is the angular velocity of B in N with components along B.

#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

Vector3 add(const Vector3& a, const Vector3& b, Intermediates& z);
Vector3 scale(const GiNaC::ex& factor, const Vector3& a, Intermediates& z);
GiNaC::ex dot(const Vector3& a, const Vector3& b, Intermediates& z);
/// Are all components literally zero?
inline bool is_zero(const Vector3& v) {
    return v[0].is_zero() && v[1].is_zero() && v[2].is_zero();
}
Vector3 cross(const Vector3& a, const Vector3& b, Intermediates& z);
/// √(a·a)
GiNaC::ex norm(const Vector3& a, Intermediates& z);

/// A frame as the successive simple rotations that lead to it from N. Successive rotations about the same axis are
/// combined into one by the sum of their angles, so that a planar chain has one sine and one cosine for each link.
class Orientation {
public:
    /// N itself.
    Orientation();

    /// The frame reached from this one by turning by `angle` about the unit vector `axis` (its components are the
    /// same in this frame and in the new one); `rate` is the angle's time derivative.
    Orientation turned(const Vector3& axis, const GiNaC::ex& angle, const GiNaC::ex& rate, Intermediates& z) const;

    /// The frame reached from this one by the turn of a quaternion, scalar first: `rate` is its derivative. The
    /// rotation and the angular velocity are those of e/|e| for any length of e, so that they are a rotation and
    /// its angular velocity even where e·e = 1 does not hold.
    Orientation turned(const std::array<GiNaC::ex, 4>& e, const std::array<GiNaC::ex, 4>& rate,
                       Intermediates& z) const;

    /// R_NB · v_B
    Vector3 to_inertial(const Vector3& v_B, Intermediates& z) const;
    /// Column k of R_NB: the frame's unit axis in N.
    Vector3 axis(int k) const;
    /// w_NB_B
    const Vector3& angular_velocity() const { return steps_.back().w_NB_B; }

    int frame = 0;  ///< the position in Skeleton::frames

private:
    struct Step {
        Vector3 axis;
        GiNaC::ex angle, rate;
        std::array<Vector3, 3> R_NB;  // rows
        Vector3 w_NB_B;
    };
    std::vector<Step> steps_;
};

}  // namespace alembert
