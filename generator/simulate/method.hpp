// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Chooses the method that integrates a scene, and gives the reason.
///
///     const MethodChoice choice = method_for(request, derived, program, start);
///     choice.why;      // "the tolerance is 1e-09; if the system turns out stiff, radau goes on"
///
/// `auto` looks at the structure (is the energy separable? has the motion a power series?), the length of the run
/// in steps, the tolerance, and what steps cost:
///
/// | asked for | chosen |
/// | --- | --- |
/// | a regularized run | verner98; kahanli8 or gauss with a step |
/// | a step, energy separable, 10 000 steps or more | kahanli8: its energy does not drift |
/// | a step | rk4 |
/// | 1e-5 or below, with a power series that is not too long and predicted to be faster | taylor |
/// | likewise, at any tolerance, if the equations are linear with constant coefficients | taylor |
/// | accelerations of positions alone, free, energy conserved, no events | rkn86 above 3e-5, rkn1210 |
/// | any other above 3e-5 | dop853 |
/// | any other with constraints of position, such as linkages | dop853 to 1e-8, verner98 below |
/// | any other, norms of quaternions and rolling among them | verner98 |
///
/// With constraints, dop853 goes on where the steps of taylor become very short, as at flat poses of linkages.
/// Runs that begin with dop853 or verner98 below 3e-4 go over to taylor where the lengths of their steps show that
/// it is faster (taylor_switch.hpp). What this predicts is multiplied by what steps were measured to take on this
/// processor (step_times.hpp), and runs of more than some ten milliseconds try methods first (method_trial.hpp),
/// unless RunOptions::tuning is false. Where the series has to be compiled, which takes longer than most runs, it
/// is taken below 1e-10 alone; with constraints of position that and verner98 below 1e-12. Methods that choose
/// their steps watch for stiffness while they run (stiffness_watch.hpp), change to radau, and come back.

#include "alembert/ode/integrate.hpp"
#include "alembert/ode/method_trial.hpp"
#include "analysis/derive/derived.hpp"
#include "simulate/options.hpp"

namespace alembert {

struct MethodChoice {
    Method method = Method::dop853;
    std::optional<Method> when_stiff = {};
    std::optional<Method> when_stuck = {};
    std::optional<Method> when_cheaper = {};
    /// Methods that a long run tries before it begins (method_trial.hpp).
    std::vector<Method> rivals = {};
    Slowness slowness = {};     ///< of this processor, as the choice has assumed
    std::string why = {};       ///< empty if the method was given
    std::string sundials = {};  ///< a method of SUNDIALS that replaces `method` (sundials_methods.hpp)
};

/// The requested method; nothing if it is `auto`. Throws ModelError for an unknown name, and for a method that the
/// scene does not allow.
std::optional<Method> given_method(const RunOptions& request, const Derived& derived);

/// The requested method, or the one that suits the scene. `program` is the program that will run.
MethodChoice method_for(const RunOptions& request, const Derived& derived, const Program& program,
                        const Start& start);

/// The choice after a trial has found the fastest method.
MethodChoice after_trial(MethodChoice choice, const MethodTrial& trial);

/// Whether the motion has a power series that is short enough to be compiled.
bool has_short_series(const Program& program, const Derived& derived);

/// At this tolerance verner98 becomes faster than dop853 (tests/bench/regret.sh).
inline constexpr double loosest_of_verner98 = 3e-5;
/// What is taken at a tolerance where there is no series, or none that is faster: dop853 or, from `loosest` down,
/// verner98.
Method without_series(double tolerance, double loosest = loosest_of_verner98);

/// What is taken instead for a free system whose accelerations depend on positions alone.
Method of_positions(double tolerance);

/// The predicted time of one right-hand side, ns (cost_model.hpp).
double effort_of(const Program& program);

/// The longest allowed step in s; 0 means no bound.
double longest_step(const RunOptions& wishes, const Start& start);

/// The settings of the scene, overridden by those of `wishes`. Throws ModelError for a longest step with a method
/// that has a fixed step.
Options options_of(const RunOptions& wishes, const MethodChoice& choice, const Start& start);

}  // namespace alembert
