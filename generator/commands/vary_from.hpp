// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// --vary-from FILE.csv: the points of a sweep from a table.
///
///     theta1,l1            the names in the first line,
///     0.1,2.0              then a point in each line; numbers, or expressions such as pi/2

#include "scene/grid.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// Throws ModelError for a file that cannot be read; SceneError with the table's name and the line for what is no
/// table of finite numbers, for a name that stands there twice, and for more than 10⁸ points, which are kept in
/// memory.
Grid grid_from_file(const std::string& path, const Scene& scene);

}  // namespace alembert
