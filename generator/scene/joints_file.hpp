// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A file of [[joint]]s alone, in the language of scenes: the joints that close the loops of a robot description.
///
///     const Scene loops = read_joints("loops.toml");
///     value_of(loops.joints[0].parent.point.component[0])        // a number, from 0.1 or "pi/4"

#include "scene/scene.hpp"

namespace alembert {

/// Throws SceneError for a file that cannot be read, or that has other tables. The names of bodies are not
/// checked.
Scene read_joints(const std::string& file);

/// The value of an expression in numbers and pi; nothing if it has other names in it.
std::optional<double> value_of(const Expression& e);

}  // namespace alembert
