// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The figure of a scene at its initial state.

#include <string>

#include "present/figure/drawing.hpp"

namespace alembert {

/// An SVG file in the style of a textbook. Throws ModelError for a scene that has no geometry.
std::string figure_of(const Scene& scene);

/// A description of a drawing in a sentence or two, for readers who cannot see it.
std::string description_of(const Drawing& drawing);

}  // namespace alembert
