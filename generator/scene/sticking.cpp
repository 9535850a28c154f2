// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/sticking.hpp"

#include <algorithm>

namespace alembert {

namespace {

bool contains(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

std::vector<std::string> sticking_forces(const FrictionRule& f) {
    const std::string force = "friction_" + f.name.text;
    return f.across ? std::vector{force + "_1", force + "_2"} : std::vector{force};
}

std::vector<std::string> taken_forces(const FrictionRule& friction, const NameSpaces& names) {
    std::vector<std::string> forces = sticking_forces(friction);
    std::erase_if(forces, [&](const std::string& force) { return !NameSpaces::find(names.values, force); });
    return forces;
}

Scene with_sticking(Scene scene, const std::vector<std::string>& frictions) {
    for (const FrictionRule& f : scene.frictions) {
        if (!contains(frictions, f.name.text)) continue;
        const std::vector<std::string> forces = sticking_forces(f);
        const std::vector<Expression> sliding_velocities =
            f.across ? std::vector{f.sliding_velocity, f.across} : std::vector{f.sliding_velocity};
        for (std::size_t i = 0; i < sliding_velocities.size(); ++i) {
            std::vector<Diagnostic> none;
            ConstraintRule held{.name = {forces[i], f.name.place},
                                .holonomic = false,
                                .equation = parse_equality("0 = 0", {}, none),
                                .multiplier = Name{forces[i], f.name.place}};
            held.equation.lhs = sliding_velocities[i];
            scene.constraints.push_back(std::move(held));
        }
    }
    std::erase_if(scene.frictions, [&](const FrictionRule& f) { return contains(frictions, f.name.text); });
    for (Coordinate& q : scene.coordinates) q.rate_is_guess = true;
    for (Speed& u : scene.speeds)
        scene.definitions.push_back({.name = std::move(u.name), .value = std::move(u.form)});
    scene.speeds.clear();
    return scene;
}

std::vector<std::string> sticking_in(const Claim& claim, const Scene& scene) {
    std::vector<std::string> result;
    for (const FrictionRule& f : scene.frictions)
        if (claim.sticking.empty() || contains(claim.sticking, f.name.text)) result.push_back(f.name.text);
    return result;
}

}  // namespace alembert
