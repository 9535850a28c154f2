// SPDX-License-Identifier: MIT
#pragma once

/// The memory of a run that comes in pieces, because contacts close, signs change or a method gives way to
/// another: what each piece has to know of those before it.
///
///     const Options rest = rest_of(options, t, work);        // wishes for what is left from t on
///     Trajectory next = integrate(system, state, rest, events, {.grid = grid_of(options, piece)});
///
/// The driver of all such runs is hybrid/automaton.hpp.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "alembert/ode/events.hpp"
#include "alembert/ode/options.hpp"

namespace alembert {

/// Called with each accepted step before the next one; returns whether the run ends with it.
using OnStepView = std::function<bool(const StepView&)>;

/// What a piece knows of the other method of the run.
struct MethodSwitching {
    std::optional<Method> back = {};  ///< the explicit method to which a run that was found stiff may come back
    double effort_per_time = 0;       ///< of the explicit method; 0: not known
    long patience = 0;                ///< steps before which no stiffness is looked for
    bool may_leave_series =
        false;  ///< whether a series was taken because it was cheaper: until its steps are short
};

struct RunPiece {
    std::optional<double> grid = {};  ///< rows fall on grid + k·sample; if missing, on start + k·sample
    std::vector<double> late = {};    ///< of a disturbed run: is added with the first step; empty: nothing
    MethodSwitching switching = {};
    OnStepView on_step_view = {};  ///< may be empty
};

/// The time from which the rows of the run are counted.
inline double grid_of(const Options& options, const RunPiece& piece) {
    return piece.grid.value_or(options.start);
}

/// The wishes for the rest of a run from t on, of which so many evaluations are done. Rows stay as dense.
Options rest_of(const Options& given, double t, long work);

/// Why a run ends whose budget is used up. `changes` tells what it has been spent on, as in ", with 3 impacts".
std::string budget_is_used_up(long budget, double t, const std::string& changes = {});

}  // namespace alembert
