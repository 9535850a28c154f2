// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Constraints that follow from the others: found by the rank of A at states that obey them all.
///
///     const std::vector<int> extra = redundant_constraints(mechanism);

#include <vector>

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// Positions (in Mechanism::constraints) of those whose row of A is a combination of the rows that are kept before
/// it: holonomic ones first, then those that are independent at the initial state, each in the order of the scene.
/// Looked at are eight states of the constraint variety around the initial one, sampled with a fixed seed, and the
/// initial one itself if its rank is not lower. A sampled answer, in floating point: a row counts as dependent if
/// less than 1e-9 of it is left beside the others. Nothing where the initial state cannot be assembled.
std::vector<int> redundant_constraints(const Mechanism& mechanism);

/// Rolling rows along N may depend on each other, or on other constraints, with factors that change with the pose:
/// of a gear on an arm that turns, the row along x is sin φ of the whole. Whichever row is left out then, the
/// other one vanishes at some poses. Such rollings get their rows along the axes that their contact is given in
/// (Mechanism::Rolling::along); the others are left as they are.
Mechanism with_regular_rows(Mechanism mechanism);

/// With the rows of this rolling (position in Mechanism::rollings) along the axes of its contact.
Mechanism along_axes(Mechanism mechanism, int rolling);

/// The constraints, none of them redundant, whose rows row k is made of at any of these states.
std::vector<int> follows_from(const Mechanism& mechanism, int k, const std::vector<int>& redundant,
                              const std::vector<State<double>>& states);

/// The mechanism without these; their multipliers are no unknowns of its equations.
Mechanism without_constraints(Mechanism mechanism, const std::vector<int>& positions);

/// Of constraints whose rows follow from the others: does what they ask of the rates follow too? Throws ModelError
/// where it does not, as for x' = y*z' beside x' = y*z' + z: together they ask for z = 0, which is a constraint of
/// its own.
void check_implied(const Mechanism& mechanism, const std::vector<int>& redundant);

}  // namespace alembert
