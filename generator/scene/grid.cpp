// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "alembert/base/argument.hpp"
#include "base/language/say.hpp"

namespace alembert {

std::size_t Grid::size() const {
    if (is_listed()) return axes.front().count;
    std::size_t points = 1;
    for (const Axis& axis : axes) points *= axis.count;
    return points;
}

std::vector<double> Grid::point(std::size_t k) const {
    std::vector<double> values(axes.size());
    if (samples) {
        samples(k, values);
        for (std::size_t i = 0; i < axes.size(); ++i)
            values[i] = axes[i].from + (axes[i].to - axes[i].from) * values[i];
        return values;
    }
    if (is_listed()) {
        std::copy_n(listed.begin() + static_cast<std::ptrdiff_t>(k * axes.size()), axes.size(), values.begin());
        return values;
    }
    for (std::size_t i = axes.size(); i-- > 0;) {
        const Axis& axis = axes[i];
        const std::size_t step = k % axis.count, last = axis.count - 1;
        values[i] = step == 0      ? axis.from
                    : step == last ? axis.to
                                   : axis.from + (axis.to - axis.from) * static_cast<double>(step) /
                                                     static_cast<double>(last);
        k /= axis.count;
    }
    return values;
}

std::vector<std::string> Grid::names() const {
    std::vector<std::string> result;
    for (const Axis& axis : axes) result.push_back(axis.name);
    return result;
}

void check_grid(const Grid& grid) {
    const auto need = [](bool good, const std::string& message) {
        if (!good) throw std::invalid_argument(message);
    };
    need(!grid.axes.empty(),
         say("there is nothing to vary; expected a coordinate, a rate, a parameter or t, with values for it"));
    std::size_t points = 1;
    for (auto axis = grid.axes.begin(); axis != grid.axes.end(); ++axis) {
        need(std::none_of(grid.axes.begin(), axis, [&](const Axis& other) { return other.name == axis->name; }),
             say("'{}' is varied twice", axis->name));
        argument::need_whole_positive(fmt::format("count of {}", axis->name), static_cast<double>(axis->count));
        argument::need_finite(axis->name, axis->from);
        argument::need_finite(axis->name, axis->to);
        need(!grid.is_listed() || axis->count == grid.axes.front().count,
             say("{} has {} values, {} has {}; expected as many of each", axis->name, axis->count,
                 grid.axes.front().name, grid.axes.front().count));
        need(axis->count <= most_points / points,
             say("more than {} motions; take fewer values, or several sweeps", most_points));
        if (!grid.is_listed()) points *= axis->count;
    }
    if (grid.samples || grid.listed.empty()) return;
    need(grid.listed.size() == grid.axes.size() * grid.axes.front().count,
         say("{} numbers are no {} points of {} values each", grid.listed.size(), grid.axes.front().count,
             grid.axes.size()));
    for (std::size_t k = 0; k < grid.listed.size(); ++k)
        if (!std::isfinite(grid.listed[k]))
            argument::need_finite(grid.axes[k % grid.axes.size()].name, grid.listed[k]);
}

}  // namespace alembert
