// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds constraints that follow from the others, by the rank of A at states that obey all constraints.
///
///     const std::vector<int> extra = redundant_constraints(mechanism);

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "alembert/base/tolerances.hpp"
#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// What the rows that are kept before each row, in this order, leave of it (Gram-Schmidt, twice); `keeps` is asked
/// with each rest.
std::vector<double> rests_of_rows(const Eigen::MatrixXd& A, const std::vector<int>& order,
                                  const std::function<bool(int k, double rest)>& keeps);

/// The positions (in Mechanism::constraints) of constraints whose row of A is a combination of the rows that are
/// kept before it. Holonomic constraints come first, then those that are independent at the initial state, each in
/// the order of the scene. The rank is taken at eight states on the branch of the initial state (branch.hpp),
/// sampled with a fixed seed, and at the initial state itself if its rank is not lower. The answer is based on
/// samples and floating point: a row counts as dependent if less than `least` of it is not a combination of the
/// others. Empty if the initial state cannot be assembled.
std::vector<int> redundant_constraints(const Mechanism& mechanism, double least = tolerance::dependent_row);

/// Rolling rows along N may depend on each other, or on other constraints, with factors that change with the pose:
/// for a gear on a turning arm, the row along x is sin φ times the whole condition. Whichever row is left out, the
/// other one vanishes at some poses. Such rolling conditions get their rows along the axes in which their contact
/// is given (Mechanism::Rolling::along); the others are not changed.
Mechanism with_regular_rows(Mechanism mechanism);

/// The mechanism with the rows of this rolling condition (position in Mechanism::rollings) along the axes of its
/// contact.
Mechanism along_axes(Mechanism mechanism, int rolling);

/// The non-redundant constraints of whose rows row k is a combination at any of these states.
std::vector<int> follows_from(const Mechanism& mechanism, int k, const std::vector<int>& redundant,
                              const std::vector<State<double>>& states);

/// Whether the factors with which the row of constraint k depends on those that are not redundant change with the
/// pose. `places` obey the constraints.
bool factors_change(const Mechanism& mechanism, int k, const std::vector<int>& redundant,
                    const std::vector<State<double>>& places);

/// The mechanism without these constraints; their multipliers are no unknowns of its equations.
Mechanism without_constraints(Mechanism mechanism, const std::vector<int>& positions);

/// Checks constraints whose rows follow from the others: do the rates that they require follow too, wherever all
/// positions hold? Throws ModelError if not, as for x' = y*z' together with x' = y*z' + z: both require z = 0,
/// which is a further constraint.
void check_implied(const Mechanism& mechanism, const std::vector<int>& redundant);

}  // namespace alembert
