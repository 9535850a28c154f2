// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/grid.hpp"

#include <algorithm>

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

}  // namespace alembert
