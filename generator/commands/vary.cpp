// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/vary.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/verb.hpp"
#include "scene/units.hpp"

namespace alembert {

namespace {

bool read(std::string_view text, long& value) {
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    return failure == std::errc() && end == text.data() + text.size();
}

/// `missing`: the count where none is given; nothing: it must be.
Axis axis_of(const std::string& option, const std::string& item, std::optional<std::size_t> missing,
             const Scene& scene) {
    const auto wrong = [&](const std::string& what) {
        return ModelError(missing
                              ? say("{0} {1}: {2}; expected NAME=FROM:TO, as in {0} k=0:20", option, item, what)
                              : say("{0} {1}: {2}; expected NAME=FROM:TO:COUNT, as in {0} "
                                    "theta1=0:3:1000",
                                    option, item, what));
    };
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos || equals == 0) throw wrong(say("there is no NAME="));
    const std::string_view range = std::string_view(item).substr(equals + 1);
    const std::size_t first = range.find(':'),
                      second = first == range.npos ? range.npos : range.find(':', first + 1);
    const bool is_counted = second != range.npos;
    if (first == range.npos || (!is_counted && !missing)) throw wrong(say("'{}' is no range", range));
    Axis axis{.name = in_words_of(scene, item.substr(0, equals))};
    const std::string_view from = range.substr(0, first), to = range.substr(first + 1, second - first - 1),
                           count = is_counted ? range.substr(second + 1) : std::string_view();
    for (const auto& [text, value] : {std::pair{from, &axis.from}, std::pair{to, &axis.to}}) {
        const std::string number = in_si(scene, axis.name, std::string(text));
        try {
            *value = number_of(number);
        } catch (const ModelError&) {
            throw wrong(say("'{}' is no finite number", text));
        }
        if (!std::isfinite(*value)) throw wrong(say("'{}' is no finite number", text));
    }
    if (!is_counted) {
        axis.count = *missing;
        return axis;
    }
    long number = 0;
    if (!read(count, number)) throw wrong(say("the count '{}' is no whole number", count));
    if (number < 1) throw wrong(say("a count of {} leaves nothing to do", number));
    axis.count = static_cast<std::size_t>(number);
    return axis;
}

}  // namespace

Axis interval_of(const std::string& option, const std::string& item, const Scene& scene) {
    const Axis axis = axis_of(option, item, 0, scene);
    if (axis.count != 0) throw ModelError(say("{} {}: the range has no count here; leave it out", option, item));
    return axis;
}

Axis range_of(const std::string& option, const std::string& item, std::size_t count, const Scene& scene) {
    const Axis axis = axis_of(option, item, count, scene);
    if (axis.count > 2000) throw ModelError(say("{} {}: expected at most 2000 values", option, item));
    return axis;
}

std::vector<Axis> ranges_of(const std::vector<std::string>& vary, const Scene& scene) {
    std::vector<Axis> axes;
    for (const std::string& item : vary) {
        const Axis axis = axis_of("--vary", item, 0, scene);
        if (axis.count != 0)
            throw ModelError(say("--vary {}: with --samples a range has no count; leave it out", item));
        for (const Axis& other : axes)
            if (other.name == axis.name) throw ModelError(say("--vary {}: '{}' is varied twice", item, axis.name));
        axes.push_back(axis);
    }
    if (axes.empty()) throw ModelError(say("--samples needs ranges; expected --vary NAME=FROM:TO"));
    return axes;
}

Grid grid_of(const std::vector<std::string>& vary, const Scene& scene) {
    if (vary.empty())
        throw ModelError(
            say("there is nothing to vary; expected --vary NAME=FROM:TO:COUNT, as in --vary theta1=0:3:1000"));
    Grid grid;
    std::size_t points = 1;
    for (const std::string& item : vary) {
        const Axis axis = axis_of("--vary", item, {}, scene);
        for (const Axis& other : grid.axes)
            if (other.name == axis.name) throw ModelError(say("--vary {}: '{}' is varied twice", item, axis.name));
        if (axis.count > most_points / points)
            throw ModelError(
                say("--vary {}: more than {} motions; take fewer values, or several sweeps", item, most_points));
        points *= axis.count;
        grid.axes.push_back(axis);
    }
    return grid;
}

}  // namespace alembert
