// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// --vary NAME=FROM:TO:COUNT, any number of times.
///
///     const Grid grid = grid_of({"theta1=0:3:4", "l1=1:2:2"}, scene);     // 8 points, the last name the fastest

#include "scene/grid.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// Throws ModelError if there is nothing to vary, if an item is not NAME=FROM:TO:COUNT with finite numbers and a
/// count of at least 1, if a name is given twice, or if there are more than 10¹⁵ points.
Grid grid_of(const std::vector<std::string>& vary, const Scene& scene);

/// The ranges NAME=FROM:TO of --vary with --samples. Throws ModelError likewise, and for a range with a count.
std::vector<Axis> ranges_of(const std::vector<std::string>& vary, const Scene& scene);

/// NAME=FROM:TO of an option. Throws ModelError likewise, and for a range with a count.
Axis interval_of(const std::string& option, const std::string& item, const Scene& scene);

/// NAME=FROM:TO or NAME=FROM:TO:COUNT of an option; `count` where there is none. Throws ModelError likewise.
Axis range_of(const std::string& option, const std::string& item, std::size_t count, const Scene& scene);

}  // namespace alembert
