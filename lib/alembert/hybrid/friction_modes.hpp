// SPDX-License-Identifier: MIT
#pragma once

/// Several contacts with dry friction at once, at the level of rates (an impact) or of accelerations.
///
///     M (x⁺ − x⁻) = p + Aᵀ Λ + Σ gᵀ π + Σ wᵀ τ,   A x⁺ + b = 0
///
/// Each contact is open (π = 0 and ξ ≥ 0), sticks (ξ = 0, η = 0, |τ| ≤ μₛ π) or slides (ξ = 0, τ = −μ π s with
/// s η ≥ 0), where π ≥ 0, ξ = g x⁺ + c and η = w x⁺ + d (Moreau, Unilateral Contact and Dry Friction in Finite
/// Freedom Dynamics, 1988; Pfeiffer & Glocker, Multibody Dynamics with Unilateral Contacts, 1996, ch. 8). All
/// choices of modes are tried. With M definite, small μ and μₛ = μ the rates of all consistent ones are the same.
/// What rests slides only where μₛ does not hold it: with μₛ > μ a choice in which a contact slides does not count
/// beside a consistent one in which this contact sticks, and with it all those with μₛ > μ that stick in the
/// first.
///
/// Where the forces of a choice are not unique, it is not solved. Nothing is lost: the forces that it allows are a
/// polyhedron without lines, and at a corner so many contacts are at their bounds, π = 0 or |τ| = μₛ π, that a
/// choice in which these are open, slide or stick with τ = ±μₛ π has the same rates and unique forces.

#include <Eigen/Dense>
#include <string>
#include <vector>

namespace alembert {

struct FrictionRows {
    Eigen::RowVectorXd normal;   ///< g
    double offset = 0;           ///< c
    Eigen::RowVectorXd tangent;  ///< w; empty for a contact without friction
    double tangent_offset = 0;   ///< d
    double coefficient = 0, resting = 0;
    int side = 0;  ///< s, if the contact slides in any case; else 0
};

struct FrictionMode {
    Eigen::VectorXd after;               ///< x⁺
    Eigen::VectorXd normal, tangential;  ///< π and τ of each contact
    Eigen::VectorXd bilateral;           ///< Λ
    std::vector<bool> closed;            ///< which contacts are closed
    std::vector<int> moves;              ///< the sign of η of closed contacts, 0 of the others
};

/// The consistent choices whose rates differ, the first of those whose rates are the same. M: n×n; `momentum` is
/// M x⁻ + p; A: m×n. At most `most_contacts_with_friction`. `is_complete` tells whether there are no others: it is
/// false if the forces of a choice are not unique, or if there are too many contacts.
struct FrictionModes {
    std::vector<FrictionMode> different;
    bool is_complete = false;
};
FrictionModes consistent_friction_modes(const Eigen::MatrixXd& M, const Eigen::VectorXd& momentum,
                                        const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                        const std::vector<FrictionRows>& contacts);

inline constexpr std::size_t most_contacts_with_friction = 5;  // for which 4⁵ choices are tried, or 6⁵

}  // namespace alembert
