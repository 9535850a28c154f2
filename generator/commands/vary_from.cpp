// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/vary_from.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/vary.hpp"
#include "commands/verb.hpp"
#include "scene/point_table.hpp"
#include "scene/text.hpp"
#include "scene/units.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_listed = 100'000'000;

}  // namespace

Grid grid_from_file(const std::string& path, const Scene& scene) {
    std::ifstream file(path);
    if (!file) throw ModelError(say("--vary-from {}: it cannot be read: {}", path, std::strerror(errno)));
    Grid grid;
    std::size_t number = 0, points = 0;
    const auto wrong = [&](const std::string& what) {
        const std::string place = number == 0 ? path : fmt::format("{}:{}", path, number);
        return SceneError(
            say("{}: {}; expected names with commas between in the first line, and a number for each of "
                "them in each other line",
                place, what),
            {});
    };
    for (std::string line; std::getline(file, line);) {
        ++number;
        const std::vector<std::string> fields = fields_in_line(line, false);
        if (fields.empty()) continue;
        if (grid.axes.empty()) {
            for (const std::string& name : fields) {
                if (name.empty()) throw wrong(say("a name is missing"));
                for (const Axis& other : grid.axes)
                    if (other.name == name) throw wrong(say("{} stands there twice", in_quotes(name)));
                grid.axes.push_back({.name = name});
            }
            continue;
        }
        if (fields.size() != grid.axes.size())
            throw wrong(say("there are {} values for {} names", fields.size(), grid.axes.size()));
        if (++points > most_listed) throw wrong(say("there are more than {} points", most_listed));
        for (std::size_t k = 0; k < fields.size(); ++k) {
            double value = NAN;
            try {
                value = number_of(in_si(scene, grid.axes[k].name, fields[k]));
            } catch (const ModelError&) {
            }
            if (!std::isfinite(value)) throw wrong(say("'{}' is no finite number", fields[k]));
            Axis& axis = grid.axes[k];
            axis.from = points == 1 ? value : std::min(axis.from, value);
            axis.to = points == 1 ? value : std::max(axis.to, value);
            grid.listed.push_back(value);
        }
    }
    if (number == 0) throw wrong(say("the table is empty"));
    if (points == 0) throw wrong(say("there are no points"));
    for (Axis& axis : grid.axes) axis.count = points;
    return grid;
}

}  // namespace alembert
