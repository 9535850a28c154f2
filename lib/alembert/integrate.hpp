// SPDX-License-Identifier: MIT
#pragma once

/// A motion from a system and its state at the start.
///
///     const Rhs rhs = make_rhs(load(compile(text, "pendulum", {}).object));
///     const Trajectory motion = integrate(rhs, {0.5, 0.0}, {.duration = 10, .tolerance = 1e-12});
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
/// | taylor | by tolerance, at most 32 | adaptive, or fixed | its order | to about hλ = -1.3 - 0.37 order |
/// | verlet | 2 | fixed; q' = v, v' = a(q, t) only | cubic Hermite | oscillators with hω < 2 |
/// | kahanli8 | 8 | fixed; likewise | a shorter step, order 8 | oscillators, a bounded hω |
/// | gauss | 6 | fixed | a shorter step, order 6 | everywhere left of 0; damps nothing |
/// | rattle | 2 | fixed; holonomic constraints (rattle.hpp) | a shorter step, order 2 | oscillators with hω < 2 |
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
/// Tolerance: the estimated local error of each component is at most tolerance · max(1, |y|), with the tolerance
/// as given; below 4.4e-16, where an estimate is rounding alone and a shorter step no better, as 4.4e-16 (taylor:
/// at any size). In a step that a row or an event falls in, dense output adds its own error, for dop853 somewhat
/// more than the tolerance; the last row of a run that completes is the end of a step.
///
/// What fails while it runs is in Trajectory::failure, with the rows until then. std::invalid_argument is thrown
/// for options that make no sense: each message says which. Nothing is allocated per step.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "alembert/events.hpp"
#include "alembert/methods.hpp"
#include "alembert/quick_times.hpp"
#include "alembert/rhs.hpp"
#include "alembert/trajectory.hpp"

namespace alembert {

/// Called with the start, then with the end of each accepted step (or the event that cuts it short).
using OnStep = std::function<void(double t, std::span<const double> state, std::span<const double> rate)>;

struct Options;
/// Somebody else's integrator for one system. It is given options that have been checked, `by` left out, and gives
/// rows, statistics (with its name) and failures as `integrate` does.
using Integrator =
    std::function<Trajectory(const Rhs& rhs, const std::vector<double>& initial, const Options& options)>;

struct Options {
    Method method = Method::dop853;
    double start = 0;
    double duration = 0;      ///< from the start; 0 gives one row
    double tolerance = 1e-9;  ///< adaptive methods
    double step = 0;  ///< of methods with a fixed step, and of taylor where given; first step of the others, 0:
                      ///< found automatically
    double longest_step = 0;  ///< adaptive methods; 0: no bound
    std::vector<QuickTime> quick_times =
        {};                           ///< adaptive methods: when steps have to be shorter (quick_times.hpp)
    double sample = 0;                ///< time between rows; 0: duration/200
    std::optional<double> grid = {};  ///< rows fall on grid + k·sample; missing: on start + k·sample
    long budget = 10'000'000;  ///< evaluations of the right-hand side; no step is begun that could exceed it
    /// Where the steps of an explicit method are found to be held down by stiffness (stiffness.hpp), the run goes
    /// on with this one.
    std::optional<Method> when_stiff = {};
    std::function<Rhs()> rhs_when_stiff =
        {};               ///< the same system, with its Jacobian; asked for then; empty: the same Rhs
    OnStep on_step = {};  ///< may be empty
    /// Moves the end of each step, after its error was found small enough, to where it belongs; may be empty.
    std::function<void(double t, double* state)> project = {};
    Integrator by = {};  ///< in the place of `method`, for a run without events; may be empty
};

/// What `integrate` begins with.
void check_options(const Rhs& rhs, const std::vector<double>& initial, const Options& options);

Trajectory integrate(const Rhs& rhs, const std::vector<double>& initial, const Options& options,
                     const Events& events = {});

}  // namespace alembert
