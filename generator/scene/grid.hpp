// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The points of a sweep.
///
///     const Grid grid{{{"theta1", 0, 3, 4}, {"l1", 1, 2, 2}}};     // 8 points, the last name the fastest
///     grid.point(3);                                               // {1, 2}
///
/// `count` evenly spaced values from `from` to `to`, both included; a single value is `from`. A grid may have a
/// list of points in place of these, as from a file or random (simulate/samples.hpp).

#include <functional>
#include <span>
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
    std::vector<double> listed = {};  ///< if not empty, the points, one value for each axis, point after point
    /// If not empty, it sets where a point lies in the range of each axis, from 0 to 1 (simulate/samples.hpp);
    /// there are as many points as the first axis counts. It is called by one thread at a time, the quickest in
    /// the order of the points.
    std::function<void(std::size_t k, std::span<double> fractions)> samples = {};

    std::size_t size() const;
    std::vector<double> point(std::size_t k) const;
    std::vector<std::string> names() const;
    bool is_listed() const { return !listed.empty() || samples; }  ///< whether it is no grid
};

/// The most motions of a sweep.
inline constexpr std::size_t most_points = 1'000'000'000'000'000;

/// Throws std::invalid_argument for a grid without names or points, with a name twice, with a number that is not
/// finite, and with a list that is not as long as its counts say.
void check_grid(const Grid& grid);

}  // namespace alembert
