// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Results and warnings on their way to standard output and standard error (streams.hpp).

#include <string>
#include <vector>

#include "report/json.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// Prints one JSON object, or text for a person.
void show(const Json& result);
void show(const std::string& text);

/// Text with formulas: on a terminal its lines are wrapped to the width (wrap.hpp).
void show_formulas(const std::string& text);

/// Reads a scene. Its warnings, and those of all that is made from it, go to standard error as soon as they are
/// found. Throws as read_scene.
Scene scene_of(const std::string& file);

/// Prints each warning to standard error.
void warn(const std::vector<std::string>& warnings);

}  // namespace alembert
