// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds irregular constraints, which only touch: wherever they all hold, their rows depend on each other, and
/// what they hold beyond their rank they hold by their second derivatives.
///
///     const std::vector<IrregularConstraints> irregular = irregular_constraints(mechanism);
///         // |AB| = 1, |BC| = 2 and |AC| = 3 keep B on the line AC, but no row holds B across it
///     mechanism = with_regular_constraints(std::move(mechanism));
///         // C − 3 B + 2 A = 0 is added, of which the three distances follow from one
///
/// With λᵀA = 0, a motion along v (A v = 0) changes Σ λ_i f_i by ½ vᵀQv with Q = Σ λ_i ∂²f_i/∂q². Where Q takes
/// both signs, motions go on in several directions: a pose at which branches meet, as of a linkage that lies flat.
/// Where Q has one sign, all motions that the constraints allow obey Q v = 0, which no row says: a load along such
/// a direction has no finite reactions.
///
/// Source: R. Connelly & W. Whiteley, Second-order rigidity and prestress stability for tensegrity frameworks,
/// SIAM J. Discrete Math. 9 (1996) 453-491 (Q is the stress matrix of distances).

#include <Eigen/Core>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

struct IrregularConstraints {
    std::vector<int> constraints;  ///< positions in Mechanism::constraints, ascending
    Eigen::VectorXd lambda;        ///< λ of each at the initial state
};

/// Judged at the initial state and at states around it that obey all constraints, which a search finds to the root
/// of its precision only: rows count as dependent here if less than 1e-3 of one is not explained by the others, at
/// all these states.
std::vector<IrregularConstraints> irregular_constraints(const Mechanism& mechanism);

/// Adds, before all others, constraints that hold exactly where the irregular ones do and have regular rows
/// (sum_of_squares.hpp), each with Mechanism::Constraint::squared_in. Those for which none are
/// proved stay as they are.
Mechanism with_regular_constraints(Mechanism mechanism);

/// Throws ModelError if there are some.
void refuse_irregular_constraints(const Mechanism& mechanism);

}  // namespace alembert
