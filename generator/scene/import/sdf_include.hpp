// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Replaces each <include> of an SDF file by the <model> that it names (sdformat.org, "Composition"), with the
/// name, the pose and the `static` that the <include> gives. Only sdf.cpp uses this.
///
///     XmlFile world(text, "world.sdf");
///     include_models(world, "world.sdf", {.packages = {"models"}});

#include "scene/import/xml.hpp"

namespace alembert {

/// `name` is the path of `file`. Throws SceneError at the <include> for a model that is not found or not allowed.
void include_models(XmlFile& file, const std::string& name, const OtherFiles& others);

}  // namespace alembert
