// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The graph of references between definitions, parameters, inputs, frames and points. It must have no circles.

#include <vector>

#include "scene/names.hpp"

namespace alembert {

struct References {
    /// Definitions and speeds (kind, index), each after those to which it refers; those in circles are missing.
    std::vector<std::pair<Declared::Kind, std::size_t>> definitions;
};

/// Reports circles (each once), and chains that are too long to be followed.
References follow(const Scene& scene, std::vector<Diagnostic>& diagnostics);

}  // namespace alembert
