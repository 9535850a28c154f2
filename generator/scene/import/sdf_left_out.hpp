// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The effect on the motion of what an SDF file has and nobody asked for. Only sdf.cpp uses this.

#include "scene/import/xml.hpp"

namespace alembert {

/// Of an element, or of its attribute if that is not empty. Plugins of Gazebo that only watch, show or run the
/// simulation have none.
Robot::Effect effect_in_sdf(const XmlElement& e, const std::string& attribute);

}  // namespace alembert
