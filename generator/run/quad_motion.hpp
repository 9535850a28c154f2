// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Motions in numbers of 34 digits, by two methods that have nothing in common but the right-hand side.
///
///     const QuadMotion first = extrapolate(rhs, state, 0, 10, {.tolerance = 1e-28});
///     const QuadMotion second = collocate(rhs, rough, state, first.mesh, {});
///     agreement(first.state, second.state);        // 1e-22: so many digits are beyond doubt
///
/// `extrapolate`: Gragg's modified midpoint rule with 2, 4, … 2K substeps, extrapolated to h² = 0 (Bulirsch &
/// Stoer; Hairer, Nørsett, Wanner I, §II.9), order 2K, K from the tolerance; the step from the difference of the
/// last two columns, held against tolerance · max(1, |y|). `collocate`: Gauss's nodes, 14 of them, order 28
/// (Hairer & Wanner II, §IV.5), solved to `tolerance` on the first one's mesh: by iteration in doubles, then by
/// corrections that doubles find for what is left over in 34 digits, each of which brings seven digits for the
/// price of one round. A step on which the iteration does not contract is halved.
///
/// Neither throws: `finished` is false where evaluations ran out or a step vanished.

#include <functional>
#include <vector>

#include "program/quad.hpp"

namespace alembert {

using QuadRhs = std::function<void(Quad t, const Quad* state, Quad* rate)>;
using RoughRhs = std::function<void(double t, const double* state, double* rate)>;  ///< the same in doubles

struct QuadMotion {
    bool finished = false;
    std::vector<Quad> state;
    std::vector<Quad> mesh;  ///< the times of the steps, start and end included
    long evaluations = 0;
};

struct QuadOptions {
    double tolerance = 1e-28;
    long budget = 10'000'000;
};

QuadMotion extrapolate(const QuadRhs& rhs, std::vector<Quad> state, Quad start, Quad end,
                       const QuadOptions& options);
QuadMotion collocate(const QuadRhs& rhs, const RoughRhs& rough, std::vector<Quad> state,
                     const std::vector<Quad>& mesh, const QuadOptions& options);

/// The largest |a − b| / max(1, |b|).
double agreement(const std::vector<Quad>& a, const std::vector<Quad>& b);

}  // namespace alembert
