// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Functions for results as JSON that all reports share.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace alembert {

using Json = nlohmann::ordered_json;

/// null if there is no value.
template <typename T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

/// {name: value}; as many values as names.
template <typename Names, typename Values>
Json by_name(const Names& names, const Values& values) {
    Json object = Json::object();
    std::size_t i = 0;
    for (const auto& name : names) object[name] = values[i++];
    return object;
}

}  // namespace alembert
