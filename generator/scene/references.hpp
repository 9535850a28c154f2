// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What refers to what: the graph of definitions, parameters, inputs, frames and points, without circles.

#include <vector>

#include "scene/names.hpp"

namespace alembert {

struct References {
    /// Definitions and speeds (kind, index), each after those it refers to; those in circles are missing.
    std::vector<std::pair<Declared::Kind, std::size_t>> definitions;
};

/// Tells circles (each once), and chains so long that they could not be followed.
References follow(const Scene& scene, std::vector<Diagnostic>& diagnostics);

}  // namespace alembert
