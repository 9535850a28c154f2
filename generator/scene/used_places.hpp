// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Frames and points that a scene does not use are used where an option names them.
///
///     are_used(scene, {"tip", "P@A"});          // of --frame
///     all_places_are_used(scene);               // of a verb that shows all of them

#include <algorithm>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

namespace used_places {

template <typename Among>
void forget(Scene& scene, const Among& among) {
    std::erase_if(scene.warnings, [&](const Diagnostic& one) { return one.kind == "unused" && among(one.name); });
}

}  // namespace used_places

/// P@F is a point and a frame.
inline void are_used(Scene& scene, const std::vector<std::string>& places) {
    for (const std::string& place : places) {
        const std::size_t at = place.find('@');
        used_places::forget(scene, [&](const std::string& name) {
            return name == place.substr(0, at) || (at != std::string::npos && name == place.substr(at + 1));
        });
    }
}

inline void all_places_are_used(Scene& scene) {
    const auto holds = [](const auto& list, const std::string& name) {
        return std::any_of(list.begin(), list.end(), [&](const auto& one) { return one.name.text == name; });
    };
    used_places::forget(
        scene, [&](const std::string& name) { return holds(scene.frames, name) || holds(scene.points, name); });
}

}  // namespace alembert
