// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/vary.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "alembert/error.hpp"
#include "commands/verb.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_points = 1'000'000;

bool read(std::string_view text, long& value) {
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    return failure == std::errc() && end == text.data() + text.size();
}

Axis axis_of(const std::string& item) {
    const auto wrong = [&](const std::string& what) {
        return ModelError(
            fmt::format("--vary {}: {}; expected NAME=FROM:TO:COUNT, as in --vary theta1=0:3:1000", item, what));
    };
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos || equals == 0) throw wrong("there is no NAME=");
    const std::string_view range = std::string_view(item).substr(equals + 1);
    const std::size_t first = range.find(':'),
                      second = first == range.npos ? range.npos : range.find(':', first + 1);
    if (second == range.npos) throw wrong(fmt::format("'{}' is no range", range));
    Axis axis{.name = item.substr(0, equals)};
    const std::string_view from = range.substr(0, first), to = range.substr(first + 1, second - first - 1),
                           count = range.substr(second + 1);
    for (const auto& [text, value] : {std::pair{from, &axis.from}, std::pair{to, &axis.to}}) {
        try {
            *value = number_of(std::string(text));
        } catch (const ModelError&) {
            throw wrong(fmt::format("'{}' is no finite number", text));
        }
        if (!std::isfinite(*value)) throw wrong(fmt::format("'{}' is no finite number", text));
    }
    long number = 0;
    if (!read(count, number)) throw wrong(fmt::format("the count '{}' is no whole number", count));
    if (number < 1) throw wrong(fmt::format("a count of {} leaves nothing to do", number));
    axis.count = static_cast<std::size_t>(number);
    return axis;
}

}  // namespace

Grid grid_of(const std::vector<std::string>& vary) {
    if (vary.empty())
        throw ModelError(
            "there is nothing to vary; expected --vary NAME=FROM:TO:COUNT, as in --vary theta1=0:3:1000");
    Grid grid;
    std::size_t points = 1;
    for (const std::string& item : vary) {
        const Axis axis = axis_of(item);
        for (const Axis& other : grid.axes)
            if (other.name == axis.name)
                throw ModelError(fmt::format("--vary {}: '{}' is varied twice", item, axis.name));
        if (axis.count > most_points / points)
            throw ModelError(fmt::format("--vary {}: more than {} motions; take fewer values, or several sweeps",
                                         item, most_points));
        points *= axis.count;
        grid.axes.push_back(axis);
    }
    return grid;
}

}  // namespace alembert
