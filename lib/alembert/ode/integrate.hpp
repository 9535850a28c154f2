// SPDX-License-Identifier: MIT
#pragma once

/// Integrates the motion of a system from its state at the start.
///
///     const Rhs rhs = make_rhs(load(compile(text, "pendulum", {}).object));
///     const Trajectory motion = integrate(rhs, {0.5, 0.0}, {.duration = 10, .tolerance = 1e-12});
///     const Trajectory kept = integrate(System{.rhs = rhs, .project = project}, {0.5, 0.0}, {.duration = 10});
///     const std::span<const double> end = motion.final_state();
///
/// | method | order | steps | dense output | stable for hλ (y' = λy) |
/// | --- | --- | --- | --- | --- |
/// | euler | 1 | fixed, `step` | cubic Hermite | in the disc around -1 of radius 1 |
/// | rk2 | 2 | fixed | cubic Hermite | -2 < hλ < 0; nowhere on the imaginary axis |
/// | rk4 | 4 | fixed | cubic Hermite | -2.79 < hλ < 0; on the imaginary axis to 2.83 |
/// | dopri5 | 5, estimate of order 4 | adaptive | order 4 | -3.31 < hλ < 0 |
/// | dop853 | 8, estimates of orders 5 and 3 | adaptive | order 7 | -6.1 < hλ < 0 |
/// | verner76 | 7, estimate of order 6 | adaptive | order 6 | -4.64 < hλ < 0 |
/// | verner98 | 9, estimate of order 8 | adaptive | order 8 | -4.48 < hλ < 0 |
/// | rkn86 | 8, estimate of order 6 | adaptive; q' = v, v' = a(q, t) only | order 7 | oscillators with hω < 3.3 |
/// | rkn1210 | 12, estimate of order 10 | adaptive; likewise | order 8 | oscillators with hω < 8.3 |
/// | taylor | by tolerance, at most 32 | adaptive, or fixed | its order | to about hλ = -1.3 - 0.37 order |
/// | verlet | 2 | fixed; q' = v, v' = a(q, t) only | cubic Hermite | oscillators with hω < 2 |
/// | kahanli8 | 8 | fixed; likewise | a shorter step, order 8 | oscillators, a bounded hω |
/// | gauss | 6 | fixed | a shorter step, order 6 | everywhere left of 0; damps nothing |
/// | rattle | 2 | fixed; holonomic constraints (rattle_step.hpp) | a shorter step, order 2 | oscillators with hω < 2 |
/// | rattle8 | 8 | fixed; likewise | a shorter step, order 8 | oscillators, a bounded hω |
/// | abm | 4 | adaptive | order 4 | -1.28 < hλ < 0 |
/// | bdf | 1 to 5 | adaptive, stiff | its order | sectors about hλ < 0 of 90°, 90°, 86°, 73°, 51° to either side |
/// | radau5 | 5, estimate of order 3 | adaptive, stiff | order 3 | everywhere left of 0; damps stiff parts |
/// | radau9 | 9, estimate of order 5 | adaptive, stiff | order 5 | likewise |
/// | radau13 | 13, estimate of order 7 | adaptive, stiff | order 7 | likewise |
/// | radau | 5, 9 or 13, as the steps suggest | adaptive, stiff | 3, 5 or 7 | likewise |
///
/// The order of taylor is ⌈1 − ½ ln tolerance⌉ or, where that is faster, more.
///
/// Tolerance: the estimated local error of each component is at most tolerance · max(1, |y|), with the given
/// tolerance. A tolerance below 4.4e-16, at which an estimate is only rounding and a shorter step is no better,
/// counts as 4.4e-16 (not for taylor). In a step that contains a row or an event, dense output adds its own error,
/// for dop853 somewhat more than the tolerance; the last row of a run that completes is the end of a step.
///
/// If something fails during the run, Trajectory::failure says what, and the rows until then are kept.
/// std::invalid_argument is thrown for invalid options and for initial values that are not finite; each message
/// says which one is wrong (argument.hpp). Nothing is allocated per step.

#include <vector>

#include "alembert/ode/events.hpp"
#include "alembert/ode/method.hpp"
#include "alembert/ode/options.hpp"
#include "alembert/ode/rhs.hpp"
#include "alembert/ode/run_piece.hpp"
#include "alembert/ode/system.hpp"
#include "alembert/ode/trajectory.hpp"

namespace alembert {

/// The check of options with which `integrate` begins.
void check_options(const Rhs& rhs, const std::vector<double>& initial, const Options& options);

/// `piece` is for runs that come in pieces (run_piece.hpp).
Trajectory integrate(const System& system, const std::vector<double>& initial, const Options& options,
                     const Events& events = {}, const RunPiece& piece = {});

/// A system that can no more than its right-hand side.
Trajectory integrate(const Rhs& rhs, const std::vector<double>& initial, const Options& options,
                     const Events& events = {});

}  // namespace alembert
