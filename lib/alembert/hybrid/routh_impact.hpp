// SPDX-License-Identifier: MIT
#pragma once

/// Rates after the impact of a single contact with dry friction.
///
///     const RouthImpact hit = strike_rough(M, u, bilateral, {.normal = g, .tangent = w, .coefficient = 0.3}, e);
///     hit.after;       // the rates
///
/// The normal impulse π grows from 0 and the rates with it (Routh, Dynamics of a System of Rigid Bodies,
/// Elementary Part, ch. 5):
///
///     M du/dπ = gᵀ + τ wᵀ + Aᵀ dΛ/dπ,   A du/dπ = 0
///
/// with τ = −μ sign v while the contact slides, v = w u + d; where v comes to zero, the contact sticks if some |τ|
/// ≤ μₛ keeps v = 0; otherwise it slides the other way. All rates are linear in π between these points. The
/// compression ends where gap' = 0, at π_c; the whole impulse is (1 + e) π_c (Poisson), with which no energy is
/// gained.
///
/// In a plane v has two components and τ = −μ v/|v|; the direction of v turns during the impact, unless the mass
/// is the same for all directions, and its motion is integrated (Keller, Impact with Friction, J. Appl. Mech. 53
/// (1986) 1).
///
/// With a restitution e_t of the sliding velocity, an impact that ends without sliding goes on: further impulses,
/// which leave gap' as it is, take v to −e_t times its value before, as far as |τ| ≤ μₛ π and the energy allow.
/// With e = e_t = 1 this is the superball (Garwin, Kinematics of an Ultraelastic Rough Ball, Am. J. Phys. 37
/// (1969) 88).

#include <Eigen/Dense>
#include <string>

namespace alembert {

struct RoughContact {
    Eigen::RowVectorXd normal, tangent;  ///< g and w: gap' = g u + normal_offset, v = w u + tangent_offset
    double normal_offset = 0, tangent_offset = 0;
    double coefficient = 0, resting = 0;  ///< μ and μₛ
    Eigen::RowVectorXd across = {};       ///< the row of the second component of v in a plane; empty otherwise
    double across_offset = 0;
    double grip = 0;  ///< e_t
};

struct RouthImpact {
    std::string failure;  ///< if not empty, the reason why there are no rates after the impact; the other members
                          ///< are then empty
    Eigen::VectorXd after;
    double impulse = 0;     ///< π at the end
    double tangential = 0;  ///< ∫ τ dπ
    double across = 0;      ///< its second component in a plane
    bool slides = false;    ///< whether the contact slides at the end
    double work = 0;        ///< the work of both impulses along the rates, without the offsets
    double loss = 0;        ///< T before − T after, seen from the moving floor; never negative
    explicit operator bool() const { return failure.empty(); }
};

/// M: n×n, definite on the rates that the bilateral rows leave free.
RouthImpact strike_rough(const Eigen::MatrixXd& mass, const Eigen::VectorXd& before,
                         const Eigen::MatrixXd& bilateral_rows, const RoughContact& contact, double restitution);

/// M⁻¹ rowᵀ with the bilateral rows at rest.
Eigen::VectorXd response_to(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& bilateral_rows,
                            const Eigen::VectorXd& row);

/// The same impact in a plane, without restitution of the sliding velocity.
RouthImpact strike_in_plane(const Eigen::MatrixXd& mass, const Eigen::VectorXd& before,
                            const Eigen::MatrixXd& bilateral_rows, const RoughContact& contact,
                            double restitution);

}  // namespace alembert
