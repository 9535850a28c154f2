// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What refers to what: the graph of definitions, parameters, inputs, frames and points, without circles.

#include <vector>

#include "scene/names.hpp"

namespace alembert {

struct References {
    std::vector<std::size_t>
        definitions;  ///< indices, each after those it refers to; those in circles are missing
};

/// Tells circles (each once), and chains so long that they could not be followed.
References follow(const Scene& scene, std::vector<Diagnostic>& diagnostics);

}  // namespace alembert
