// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A ball joint turned by a quaternion e, as three turning joints of a tree (joint_tree.hpp).
///
/// The rates of these three are the components of ω, relative to the parent and along the axes that turn:
///     ω = J e',   J = 2 G/(e·e),   G e = 0,   G Gᵀ = (e·e) E
/// They turn about x, then y, then z, each at the angle 0; R(e) is a rotation before the first. At e'' = 0,
/// because of J' e' = −2 (e·e'/e·e) ω, their rates change by
///     w'₀ = −2 (e·e'/e·e) ω − (ω_y ω_z, −ω_x ω_z, ω_x ω_y),
/// where the last term cancels what three joints in a row add because the first ones turn the axes of the others.
/// Accelerations a that a recursion adds to w'₀, together with e·e = 1 differentiated twice, give
///     e'' = ½ Gᵀ a − (e'·e'/e·e) e.
/// Generalized forces Q of e give the torque ½ G Q. Their component along e is borne by the multiplier of e·e = 1,
/// whose row is 2 e:
///     λ = −(e·Q)/(2 e·e)
/// All this holds for every e and e', also where e·e is not 1, because R and ω are divided by e·e
/// (model/geometry.cpp). Therefore e'' is that of Lagrange's equations with a multiplier in every state, and all
/// methods of integration solve the same differential equation.

#include <array>
#include <optional>

#include "model/mechanism.hpp"

namespace alembert {

struct BallJoint {
    int first = 0;                            ///< the first of its three joints
    std::array<int, 4> coordinate{}, sign{};  ///< e_i = sign·q; the vector part may have the sign −1
    std::array<GiNaC::ex, 4> e{};
    GiNaC::ex inverse = 0, spin = 0;  ///< 1/(e·e), e'·e'/(e·e)
    std::array<Vector3, 3> R{};       ///< rows
    Vector3 rate{}, bias{};           ///< of the three joints: ω, w'₀
};

/// Nothing if an element of `e` is not a coordinate, or a coordinate with the sign −1.
std::optional<BallJoint> ball_joint(const Mechanism& mechanism, const std::array<GiNaC::ex, 4>& e);

/// G: the vector part of e* e' is G e'.
template <typename S>
std::array<std::array<S, 4>, 3> rows_of_turn(const std::array<S, 4>& e) {
    return {std::array<S, 4>{-e[1], e[0], e[3], -e[2]}, std::array<S, 4>{-e[2], -e[3], e[0], e[1]},
            std::array<S, 4>{-e[3], e[2], -e[1], e[0]}};
}

}  // namespace alembert
