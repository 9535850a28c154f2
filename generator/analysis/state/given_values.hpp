// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene with other values than its own: those that a command line or a caller gives for one run.
///
///     with_values(scene, {{"l", "2"}, {"theta", "pi/2"}, {"theta'", "1"}, {"t", "5"}});   // l; state; start
///
/// A value that is given counts as the scene's own: it is no guess, and what the scene gives by others follows.

#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

/// Values as typed, in SI units, so that decimals are exact: constraints that follow from each other with 0.2
/// and 1.8 still do. Throws ModelError for a value that is no number, and as `start_of` does: for a name that the
/// scene does not have, or that follows from others, and for a value that is not finite.
Scene with_values(Scene scene, const std::vector<std::pair<std::string, std::string>>& at);

/// The same of numbers.
Scene with_numbers(Scene scene, const std::vector<std::pair<std::string, double>>& at);

/// Notes behind the scene's text what is given for this run: by the text an interrupted sweep knows its scene
/// again.
void note_given(Scene& scene, const std::string& given);

}  // namespace alembert
