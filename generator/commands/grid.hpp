// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The points of a sweep: what `--vary NAME=FROM:TO:COUNT …` means.
///
///     const Grid grid = grid_of({"theta1=0:3:4", "l1=1:2:2"});     // 8 points, the last name the fastest
///     grid.point(3);                                               // {1, 2}
///
/// COUNT values from FROM to TO, both included, evenly; one value is FROM.

#include <string>
#include <vector>

namespace alembert {

struct Axis {
    std::string name;
    double from = 0, to = 0;
    std::size_t count = 1;
};

struct Grid {
    std::vector<Axis> axes;

    std::size_t size() const;
    std::vector<double> point(std::size_t k) const;
    std::vector<std::string> names() const;
};

/// Throws ModelError: nothing to vary, what is not NAME=FROM:TO:COUNT with finite numbers and a count from 1, a name given
/// twice, more than a million points.
Grid grid_of(const std::vector<std::string>& vary);

}  // namespace alembert
