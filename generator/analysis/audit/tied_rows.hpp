// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds constraints of which no choice may be left out once and for all. Two wheels on one axle have four rows of
/// rank 3, and each of the four is needed at some heading; a row of a wheel that follows from another one at every
/// pose, with factors that stay finite, is needed nowhere.
///
///     mechanism = with_tied_rows(without_constraints(std::move(mechanism), redundant));

#include "model/mechanism.hpp"

namespace alembert {

/// The mechanism with `tie` set for the rows of Mechanism::constraints and Mechanism::redundant that depend on
/// each other so that the rows in `constraints` lose rank at a pose where all of them together do not. Such poses
/// are found by the search of singular_poses.hpp, which need not find all, and count where a walk from the initial
/// state gets to them. Large groups are left as they are (sixteen rows of rank five are not): what ties them would
/// take too many operations.
Mechanism with_tied_rows(Mechanism mechanism);

}  // namespace alembert
