// SPDX-License-Identifier: MIT
#pragma once

/// The inertia of a rigid body as values (Zhang & Qin, chapter 3; Goldstein, Classical Mechanics (1980), chapter
/// 5).
///
///     const Matrix3<> I_C = inertia_matrix({.xx = 1, .yy = 2, .zz = 2.5, .xy = -0.1});
///     const Matrix3<> I_P = moved_from_centre(I_C, m, d);          // Steiner
///     const Matrix3<> I_A = turned(I_C, R_AB);                     // along the axes of A
///     const PrincipalAxes<> own = principal_axes(I_C);             // moments A ≤ B ≤ C and their axes
///
/// Elements are those of the tensor: xy = −∫ x y dm. Any consistent units may be used.

#include "alembert/base/rotation.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace alembert {

template <typename Real = double>
struct InertiaElements {
    Real xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
};

template <typename Real>
Matrix3<Real> inertia_matrix(const InertiaElements<Real>& I) {
    Matrix3<Real> m;
    m << I.xx, I.xy, I.zx, I.xy, I.yy, I.yz, I.zx, I.yz, I.zz;
    return m;
}

/// Theorem of Steiner and Huygens, from the mass centre to a point P of the body, with d the vector from P to the
/// mass centre (or its negative): I_P = I_C + m (d·d E − d dᵀ).
template <typename Real>
Matrix3<Real> moved_from_centre(const Matrix3<Real>& I_C, const Real& mass, const Vector3r<Real>& d) {
    return I_C + mass * (d.dot(d) * Matrix3<Real>::Identity() - d * d.transpose());
}

/// The inverse: I_C = I_P − m (d·d E − d dᵀ). To move between two other points, move to the mass centre first.
template <typename Real>
Matrix3<Real> moved_to_centre(const Matrix3<Real>& I_P, const Real& mass, const Vector3r<Real>& d) {
    return moved_from_centre<Real>(I_P, -mass, d);
}

/// I along the axes of A from I along those of B, about the same point: R I Rᵀ.
template <typename Real>
Matrix3<Real> turned(const Matrix3<Real>& I_B, const Matrix3<Real>& R_AB) {
    return R_AB * I_B * R_AB.transpose();
}

template <typename Real = double>
struct PrincipalAxes {
    Vector3r<Real> moments;  ///< ascending
    Matrix3<Real> R;         ///< its columns are the axes, right-handed: I = R diag(moments) Rᵀ
};

template <typename Real>
PrincipalAxes<Real> principal_axes(const Matrix3<Real>& I) {
    const Eigen::SelfAdjointEigenSolver<Matrix3<Real>> solver(I);
    PrincipalAxes<Real> result{solver.eigenvalues(), solver.eigenvectors()};
    if (result.R.determinant() < 0) result.R.col(2) = -result.R.col(2);
    return result;
}

/// A difference of moments below this part of the largest one counts as rounding.
inline constexpr double rounded_moment = 1e-9;

/// Two tests for moments that no distribution of mass has: one of them is negative, or the largest exceeds the sum
/// of the others, although C = ∫ (x² + y²) dm ≤ A + B. If the moments are differences of larger ones (about
/// another point), `scale` is the size of those.
template <typename Real>
bool has_negative_moment(const PrincipalAxes<Real>& I, const Real& scale = 0) {
    return I.moments[0] < -Real(rounded_moment) * std::max<Real>(scale, I.moments.cwiseAbs().maxCoeff());
}
template <typename Real>
bool breaks_triangle_inequality(const PrincipalAxes<Real>& I, const Real& scale = 0) {
    return I.moments[2] - I.moments[0] - I.moments[1] > Real(rounded_moment) * std::max<Real>(scale, I.moments[2]);
}

}  // namespace alembert
