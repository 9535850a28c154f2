// SPDX-License-Identifier: MIT
#pragma once

/// Principal axes of a body, for rivals that want diagonal inertias.

#include <Eigen/Dense>

#include "rivals.hpp"

namespace alembert::bench {

inline Eigen::Vector3d eigen(const Vector& v) {
    return {v[0], v[1], v[2]};
}

inline Eigen::Matrix3d rotation_of(const TreeBody& body) {
    Eigen::Matrix3d R;
    for (int i = 0; i < 3; ++i) R.row(i) = eigen(body.R[static_cast<std::size_t>(i)]).transpose();
    return R;
}

inline Eigen::Matrix3d inertia_of(const TreeBody& body) {
    const auto& [xx, xy, xz, yy, yz, zz] = body.inertia;
    Eigen::Matrix3d I;
    I << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return I;
}

struct Principal {
    Eigen::Vector3d moments;
    Eigen::Matrix3d axes;  ///< columns, along the body's frame; a rotation
};

inline Principal principal_of(const TreeBody& body) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia_of(body));
    Principal result{solver.eigenvalues(), solver.eigenvectors()};
    if (result.axes.determinant() < 0) result.axes.col(0) *= -1;
    return result;
}

}  // namespace alembert::bench
