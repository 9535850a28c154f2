// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Motions in numbers with 34 digits, by two methods that have only the right-hand side in common.
///
///     const QuadMotion first = extrapolate(rhs, state, 0, 10, {.tolerance = 1e-28});
///     const QuadMotion second = collocate(rhs, rough, state, first.mesh, {});
///     agreement(first.state, second.state);        // 1e-22: so many digits are beyond doubt
///
/// `extrapolate`: Gragg's modified midpoint rule with 2, 4, … 2K substeps, extrapolated to h² = 0 (Bulirsch &
/// Stoer; Hairer, Nørsett, Wanner I, §II.9), order 2K with K from the tolerance. The step follows from the
/// difference of the last two columns, compared with tolerance · max(1, |y|). `collocate`: Gauss's nodes, 14 of
/// them, order 28 (Hairer & Wanner II, §IV.5), solved to `tolerance` on the first one's mesh: first by iteration
/// in doubles, then by corrections of the residual in 34 digits, which are computed in doubles; each correction
/// gains seven digits at the cost of one round. A step on which the iteration does not contract is halved.
///
/// Neither throws; `finished` is false if the evaluations were used up or a step became zero.

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
    /// The ends of the steps of another run, ascending: no step of `extrapolate` is longer than two of these. May
    /// be empty.
    std::vector<double> mesh = {};
};

QuadMotion extrapolate(const QuadRhs& rhs, std::vector<Quad> state, Quad start, Quad end,
                       const QuadOptions& options);
QuadMotion collocate(const QuadRhs& rhs, const RoughRhs& rough, std::vector<Quad> state,
                     const std::vector<Quad>& mesh, const QuadOptions& options);

/// The largest |a − b| / max(1, |b|).
double agreement(const std::vector<Quad>& a, const std::vector<Quad>& b);

}  // namespace alembert
