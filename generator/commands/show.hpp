// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Prints results and warnings to standard output and standard error (streams.hpp).

#include <string>
#include <vector>

#include "present/report/json.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// Prints one JSON object, with the warnings of the scenes that were read, or text for people.
void show(const Json& result);
/// The text that this prints.
std::string shown(const Json& result);
void show(const std::string& text);

/// Prints text with formulas; on a terminal its lines are wrapped to the width (wrap.hpp).
void show_formulas(const std::string& text);

/// The same, shortened to two screens unless the whole is asked for (fold.hpp).
void show_page(const std::string& text, bool full);

/// Reads a scene. Its warnings, and those of everything computed from it, are printed to standard error as soon as
/// they are found; with --strict the first is a mistake of the scene. Throws like read_scene.
Scene scene_of(const std::string& file);

/// Whether --strict was given.
bool& are_warnings_errors();

/// Prints each warning to standard error.
void warn(const std::vector<std::string>& warnings);

}  // namespace alembert
