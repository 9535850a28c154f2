// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What can be known of a scene without algebra: every name declared once and known where it is used, nothing
/// defined by itself, every quantity made only of what it may depend on, vectors and scalars where they belong.

#include <vector>

#include "scene/scene.hpp"

namespace alembert {

std::vector<Diagnostic> check_scene(const Scene& scene);

/// The same of the claims alone, of a scene that has been read.
std::vector<Diagnostic> check_claims(const Scene& scene);

}  // namespace alembert
