// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Rows of joints that close loops and follow from the others but for a rest that rounded numbers leave. The axes
/// of a planar linkage are parallel; where an export has turned one frame by 1e-9 rad, three rows that would hold
/// identically are independent, and the linkage is rigid in exact arithmetic.
///
///     mechanism = without_nearly_redundant(std::move(mechanism));
///     mechanism.redundant[0].nearly;        // 1.4e-9
///
/// Rows are looked at where the others hold, at the initial state and at states on its branch (branch.hpp), with a
/// tolerance, tolerance::nearly_dependent_row.

#include <functional>

#include "model/mechanism.hpp"

namespace alembert {

/// The size of which a rest of row k is a part: of a row of a joint, the largest `row` among the joint's rows that
/// shift, or turn (1 at least), as it does, so that a linkage is measured by its own levers beside whatever else
/// the scene holds; where rows that shift have no lever, the largest of the terms of their positions; of any other
/// row its own.
double scale_of_row(const std::vector<Mechanism::Constraint>& constraints, int k,
                    const std::function<double(int)>& row, const std::function<double(int)>& terms);

/// The mechanism with such rows in `redundant`, with their `nearly`. Rows that follow exactly stay: these are for
/// redundancy.hpp. The same mechanism if no state near the initial one closes the loops.
Mechanism without_nearly_redundant(Mechanism mechanism);

/// What is told of the rows of one joint, for each joint that has some.
std::vector<Diagnostic> warnings_of_nearly_redundant(const Mechanism& mechanism);

}  // namespace alembert
