// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene with other values than its own: those that a command line or a caller gives for one run.
///
///     with_values(scene, {{"l", "2"}, {"theta", "pi/2"}, {"theta'", "1"}, {"t", "5"}});   // parameters, the
///     start with_input(scene, "u", "2*sin(t)");        // an input from outside is this function now
///     with_input(scene, "u", "measured.csv");    // or this table: a time and a value in each line
///
/// A value that is given counts as the scene's own: it is no guess, and what the scene gives by others follows.
/// Between the rows of a table an input is linear, and outside of them it keeps the first or the last value. Its
/// slope jumps at the rows, which are switches of the run.

#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

/// Values as typed, in SI units, so that decimals are exact: constraints that follow from each other with 0.2
/// and 1.8 still do. Throws ModelError for a value that is no number, and as `start_of` does: for a name that the
/// scene does not have, or that follows from others, and for a value that is not finite.
Scene with_values(Scene scene, const std::vector<std::pair<std::string, std::string>>& at);

/// Throws ModelError for a name that is no input from outside, for an expression that holds other names than
/// parameters, inputs and t, and for a table with a line that is no two numbers, or whose times do not grow.
Scene with_input(Scene scene, const std::string& name, const std::string& how);

}  // namespace alembert
