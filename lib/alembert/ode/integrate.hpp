// SPDX-License-Identifier: MIT
#pragma once

/// Integrates the motion of a system from its state at the start.
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
/// Tolerance: the estimated local error of each component is at most tolerance · max(1, |y|), with the given
/// tolerance. A tolerance below 4.4e-16, at which an estimate is only rounding and a shorter step is no better,
/// counts as 4.4e-16 (not for taylor). In a step that contains a row or an event, dense output adds its own error,
/// for dop853 somewhat more than the tolerance; the last row of a run that completes is the end of a step.
///
/// If something fails during the run, Trajectory::failure says what, and the rows until then are kept.
/// std::invalid_argument is thrown for invalid options and for initial values that are not finite; each message
/// says which one is wrong (argument.hpp). Nothing is allocated per step.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "alembert/ode/events.hpp"
#include "alembert/ode/input_time_scales.hpp"
#include "alembert/ode/methods.hpp"
#include "alembert/ode/rhs.hpp"
#include "alembert/ode/trajectory.hpp"

namespace alembert {

/// Called with the start, then with the end of each accepted step (or with the event that ends the run in it).
using OnStep = std::function<void(double t, std::span<const double> state, std::span<const double> rate)>;

/// Called with the method before each piece of a run that it takes.
using OnMethod = std::function<void(Method)>;

/// Called with each accepted step before the next one; returns whether the run ends with it.
using OnStepView = std::function<bool(const StepView&)>;

/// The time in which steps are counted: t, or one of its own that makes steps short where the potential is deep,
/// in the form for any system or in that for constant masses and forces of positions (time_transformation.hpp).
enum class Regularization { none, rescaled, canonical };

/// Changes of a run that are a few times as large as its rounding (disturbance.hpp).
struct Disturbed {
    std::uint64_t seed = 0;         ///< 0: nothing is changed
    std::vector<double> late = {};  ///< is added with the first step; empty: nothing
};

struct Options;
/// An integrator of another library for one system. It gets options that have been checked, and returns rows,
/// events, statistics (with its name) and failures like `integrate`.
using Integrator = std::function<Trajectory(const Rhs& rhs, const std::vector<double>& initial,
                                            const Options& options, const Events& events)>;

/// What a piece of a run knows of the other method of the run. `integrate` sets it.
struct MethodSwitching {
    std::optional<Method> back = {};  ///< the explicit method to which a run that was found stiff may come back
    double effort_per_time = 0;       ///< of the explicit method; 0: not known
    long patience = 0;                ///< steps before which no stiffness is looked for
};

struct Options {
    Method method = Method::dop853;
    double start = 0;
    double duration = 0;      ///< counted from the start; 0 gives one row
    double tolerance = 1e-9;  ///< adaptive methods
    double step = 0;  ///< the step of methods with a fixed step, and of taylor if given; for the others the first
                      ///< step, found automatically if 0
    double longest_step = 0;  ///< for adaptive methods; 0 means no bound
    double first_share = 1;   ///< a first step that is found automatically is multiplied by this
    std::vector<QuickTime> quick_times =
        {};  ///< for adaptive methods: the times at which steps have to be shorter (input_time_scales.hpp)
    double sample = 0;                ///< time between rows; 0: duration/200
    std::optional<double> grid = {};  ///< rows fall on grid + k·sample; if missing, on start + k·sample
    /// The most evaluations of the right-hand side; no step is begun that could exceed it.
    long budget = 10'000'000;
    /// If stiffness is found to limit the steps of an explicit method (stiffness.hpp), the run goes on with this
    /// method. It comes back where the explicit one would be stable with the same steps, or where the steps of the
    /// other turn out to cost more (cost_model.hpp).
    std::optional<Method> when_stiff = {};
    std::function<Rhs()> rhs_when_stiff =
        {};  ///< gives the same system with its Jacobian at that time; if empty, the same Rhs is used
    /// Where no step is short enough, or where a power series needs steps of a twentieth of its longest though
    /// the motion is no faster, the run goes on with this method to its end. Where a linkage lies flat, pivots of
    /// its equations pass through zero: values beside that pose are still good, but the coefficients of a series
    /// lose all digits as it comes close.
    std::optional<Method> when_stuck = {};
    /// If the steps of an explicit method turn out to cost clearly more than those of a power series would
    /// (taylor_switch.hpp), the run goes on with this method, which must be taylor. It comes back where the steps
    /// of the series become very short, as above.
    std::optional<Method> when_cheaper = {};
    std::function<Rhs()> rhs_when_cheaper =
        {};  ///< gives the same system with its series, if it has one; if empty, the same Rhs is used
    double effort_of_series = 0;  ///< predicted time of that call, ns
    MethodSwitching turns = {};
    OnMethod on_method = {};  ///< may be empty
    OnStep on_step = {};      ///< may be empty
    /// Moves the end of each step onto the constraints after its error was found small enough; may be empty.
    std::function<void(double t, double* state)> project = {};
    Integrator by = {};            ///< takes the place of `method`; may be empty
    OnStepView on_step_view = {};  ///< may be empty
    Regularization regularization = Regularization::none;
    Disturbed disturbed = {};  ///< for estimates of what rounding does
};

/// The check of options with which `integrate` begins.
void check_options(const Rhs& rhs, const std::vector<double>& initial, const Options& options);

Trajectory integrate(const Rhs& rhs, const std::vector<double>& initial, const Options& options,
                     const Events& events = {});

}  // namespace alembert
