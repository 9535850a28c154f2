// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene in which an input from outside is a function of time, for one run.
///
///     with_input(scene, "u", "2*sin(t)");     // an expression, read as the scene's own would be
///     with_input(scene, "u", "measured.csv"); // a table: a time and a value in each line (scene/point_table.hpp)
///
/// Between the rows of a table an input is linear, and outside of them it keeps the first or the last value. Its
/// slope jumps at the rows, which are switches of the run.

#include <string>

#include "scene/scene.hpp"

namespace alembert {

/// Throws ModelError for a name that is no input from outside, for an expression that holds other names than
/// parameters, inputs and t, and for a table that cannot be read. What contradicts the input's unit is among the
/// scene's warnings.
Scene with_input(Scene scene, const std::string& name, const std::string& how);

}  // namespace alembert
