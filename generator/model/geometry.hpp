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
/// Is it zero as it is written?
inline bool is_zero(const Vector3& v) {
    return v[0].is_zero() && v[1].is_zero() && v[2].is_zero();
}
Vector3 cross(const Vector3& a, const Vector3& b, Intermediates& z);
/// √(a·a)
GiNaC::ex norm(const Vector3& a, Intermediates& z);

/// A frame as the successive simple rotations that lead to it from N. Rotations that follow each other about the
/// same axis are one, by the sum of their angles: a planar chain has one sine and cosine for each link.
class Orientation {
public:
    /// N itself.
    Orientation();

    /// The frame reached from this one by turning by `angle` about the unit vector `axis` (components in this
    /// frame, which are those in the new one too); `rate` is the angle's time derivative.
    Orientation turned(const Vector3& axis, const GiNaC::ex& angle, const GiNaC::ex& rate, Intermediates& z) const;

    /// The frame reached from this one by the turn of a quaternion, scalar first: components of `rate` are its
    /// derivative's. Both are those of e/|e|, whatever e's length: the turn is one, and the angular velocity its
    /// own, beside e·e = 1 too.
    Orientation turned(const std::array<GiNaC::ex, 4>& e, const std::array<GiNaC::ex, 4>& rate,
                       Intermediates& z) const;

    /// R_NB · v_B
    Vector3 to_inertial(const Vector3& v_B, Intermediates& z) const;
    /// Column k of R_NB: the frame's unit axis in N.
    Vector3 axis(int k) const;
    /// w_NB_B
    const Vector3& angular_velocity() const { return steps_.back().w_NB_B; }

    int frame = 0;  ///< which one of Skeleton::frames this is

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
