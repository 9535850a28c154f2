// SPDX-License-Identifier: MIT
#pragma once

/// The impact of several contacts at once, of which some have friction in a plane: friction_modes.hpp with cones.
///
///     M (x⁺ − x⁻) = p + Aᵀ Λ + Σ gᵀ π + Σ Wᵀ τ,   A x⁺ + b = 0
///
/// Each contact is open (π = 0 and ξ ≥ 0), sticks (ξ = 0, η = 0, |τ| ≤ μₛ π) or slides (ξ = 0, τ = −μ π η/|η|),
/// where π ≥ 0, ξ = g x⁺ + c and η = W x⁺ + d has two components, or one (Moreau 1988; Jean, The Non-Smooth
/// Contact Dynamics Method, Comput. Methods Appl. Mech. Engrg. 177 (1999) 235).
///
/// The modes and directions are found by projecting the impulse of one contact after the other onto its cone, and
/// the equations of these modes are then solved by Newton's method. Where more impulses hold the contacts than are
/// determined, those nearest to the projected ones are taken; the rates are the same for all. With other impulses
/// to begin with the same velocities of the contacts must be found: if not, the result is ambiguous, and there is
/// none. Impulses are counted in units of the largest mass, so that the verdict is the same for every unit of
/// mass.

#include <Eigen/Dense>
#include <string>
#include <vector>

namespace alembert {

struct ContactCone {
    Eigen::RowVectorXd normal;       ///< g
    double offset = 0;               ///< c
    Eigen::MatrixXd tangent;         ///< W: no row for a contact without friction, one, or two in a plane
    Eigen::VectorXd tangent_offset;  ///< d
    double coefficient = 0, resting = 0;
};

struct ConeChoice {
    std::string failure;     ///< if not empty, the reason why there is no result; the other members are then empty
    Eigen::VectorXd after;   ///< x⁺
    Eigen::VectorXd normal;  ///< π of each contact
    std::vector<Eigen::VectorXd> tangential;  ///< τ of each
    Eigen::VectorXd bilateral;                ///< Λ
    explicit operator bool() const { return failure.empty(); }
};

/// Why an impact of several contacts has no result, in whichever way it is looked for.
inline constexpr const char* no_choice_is_consistent =
    "no choice of sticking and sliding is consistent in their impact together";
inline constexpr const char* several_choices_are_consistent =
    "several choices of sticking and sliding are consistent in their impact together, and the motion after it "
    "depends on the order in which they strike";

/// M: n×n, definite on the rates that the bilateral rows leave free; `momentum` is M x⁻ + p.
ConeChoice choose_in_cones(const Eigen::MatrixXd& M, const Eigen::VectorXd& momentum, const Eigen::MatrixXd& A,
                           const Eigen::VectorXd& b, const std::vector<ContactCone>& contacts);

}  // namespace alembert
