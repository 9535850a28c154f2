// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Vectors of a scene while its kinematics is written down.
///
///     VectorWriter write(mechanism);
///     const Vector3 omega = …;
///     write(omega);                    // formulas where they are short; no values yet
///     write(write.rate(omega));

#include "analysis/derive/unit_quaternions.hpp"
#include "model/formalism/steps.hpp"
#include "model/geometry.hpp"
#include "simulate/kinematics/kinematics.hpp"

namespace alembert {

class VectorWriter {
public:
    explicit VectorWriter(const Mechanism& mechanism) : m_(mechanism), steps_(mechanism), unit_(mechanism) {}

    KinematicVector operator()(const Vector3& v);
    /// The same for the derivative of `before` by time. A component that was too long to be shown before is not
    /// sought for it.
    KinematicVector derivative(const Vector3& v, const KinematicVector& before);
    std::optional<Phrase> formula(const GiNaC::ex& e);

    /// The time derivative of each component.
    Vector3 rate(const Vector3& v) const;
    /// With 1 in place of the e·e of every quaternion, which is 1 for all time: so its derivatives are 0.
    Vector3 unit(const Vector3& v) const;
    /// Components along axes that are given along N.
    Vector3 along(const std::array<Vector3, 3>& axes, const Vector3& v) const;
    /// Components along N of a vector that is given along these axes.
    Vector3 along_N(const std::array<Vector3, 3>& axes, const Vector3& v) const;

    Vector3 sum(const Vector3& a, const Vector3& b) const { return add(a, b, *m_.z); }
    Vector3 times(const GiNaC::ex& factor, const Vector3& v) const { return scale(factor, v, *m_.z); }
    Vector3 product(const Vector3& a, const Vector3& b) const { return cross(a, b, *m_.z); }

private:
    const Mechanism& m_;
    StepWriter steps_;
    UnitQuaternions unit_;
    int long_ones_ = 0;  ///< formulas sought in vain
};

}  // namespace alembert
