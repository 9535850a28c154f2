// SPDX-License-Identifier: MIT
#pragma once

/// A system as it is integrated: its right-hand side, and what it can do for a method that asks.
///
///     const Rhs rhs = make_rhs(module, values);
///     const System system{.rhs = rhs, .project = projection.after_steps()};
///     const Trajectory motion = integrate(system, start, options);
///
/// A right-hand side alone is a system too: `integrate(rhs, start, options)`. Which abilities there are, and who
/// asks for them:
///
/// | ability | asked for by | without it |
/// | --- | --- | --- |
/// | rhs.jacobian, with_jacobian | implicit methods | differences (newton_iteration.hpp) |
/// | rhs.series, with_series | taylor | taylor refuses; a run does not go over to it |
/// | rhs.canonical | rattle, rattle8 | they refuse |
/// | rhs.energies | a run in a time of its own (time_transformation.hpp) | it refuses |
/// | rhs.effort | the search for stiffness, cost_model.hpp | steps have no predicted cost |
/// | project | every step | the constraints drift |
/// | quick_times | methods that choose their steps | a step may pass over a pulse |
/// | quick_places | the same methods | a step may pass over a narrow hill |
///
/// An ability that is dear to make is a function (`with_…`) and is made when it is first asked for.

#include <functional>
#include <vector>

#include "alembert/ode/events.hpp"
#include "alembert/ode/input_time_scale.hpp"
#include "alembert/ode/method.hpp"
#include "alembert/ode/options.hpp"
#include "alembert/ode/quick_places.hpp"
#include "alembert/ode/rhs.hpp"
#include "alembert/ode/run_piece.hpp"
#include "alembert/ode/trajectory.hpp"

namespace alembert {

struct System;

/// An integrator of another library for one system. It gets options that have been checked, and returns rows,
/// events, statistics (with its name) and failures like `integrate`.
using Integrator = std::function<Trajectory(const System& system, const std::vector<double>& initial,
                                            const Options& options, const Events& events, const RunPiece& piece)>;

/// Called with the method before each piece of a run that it takes.
using OnMethod = std::function<void(Method)>;

/// A state moved onto the constraints. A step is moved after its error was found small enough.
using Project = std::function<void(double t, double* state)>;

struct System {
    Rhs rhs = {};
    /// The same right-hand side with its Jacobian, for a run that was found stiff; if empty, `rhs` is used.
    std::function<Rhs()> with_jacobian = {};
    /// The same with its power series, if it has one, for a run that may go over to taylor; if empty, `rhs` is
    /// used.
    std::function<Rhs()> with_series = {};
    double effort_of_series = 0;  ///< the predicted time of that call, ns
    Project project = {};         ///< may be empty
    /// The times at which steps have to be shorter (input_time_scale.hpp).
    std::vector<InputTimeScale> quick_times = {};
    QuickPlaces quick_places = {};  ///< functions of the state that change fast somewhere (quick_places.hpp)
    OnMethod on_method = {};        ///< may be empty
    Integrator by = {};             ///< integrates it in place of all methods; may be empty
};

}  // namespace alembert
