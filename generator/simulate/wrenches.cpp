// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/wrenches.hpp"

#include <algorithm>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "program/lower/frame_functions.hpp"
#include "scene/body_points.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

template <typename List>
auto found(const List& list, const std::string& name) {
    return std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.name.text == name; });
}
template <typename List>
bool has(const List& list, const std::string& name) {
    return found(list, name) != list.end();
}

bool is_frame(const Scene& scene, const std::string& name) {
    return name == "N" || has(scene.frames, name) ||
           std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [&](const Body& b) { return b.joint && b.name.text == name; });
}

/// The frame that turns with the point.
std::string frame_of(const Scene& scene, const std::string& point) {
    if (const Body* const body = body_at(scene, point)) return body->joint ? body->name.text : body->frame.text;
    if (is_frame(scene, point)) return point;
    if (const auto own = found(scene.points, point); own != scene.points.end()) return own->position.axes.text;
    const auto particle = found(scene.particles, point);
    if (particle == scene.particles.end())
        throw ModelError(say("there is no point or body {} on which a wrench could act", in_quotes(point)));
    return particle->position.axes.text;
}

}  // namespace

void with_wrench(Scene& scene, const std::string& place, const std::string& prefix) {
    check_place(scene, place);
    const std::size_t at = place.find('@');
    const std::string point = place.substr(0, at);
    std::string frame = frame_of(scene, point);
    if (at != std::string::npos) frame = place.substr(at + 1);
    if (!is_frame(scene, frame)) throw ModelError(say("there is no frame {}", in_quotes(frame)));
    std::vector<Diagnostic> none;
    const auto vector = [&](const char* letter, const char* unit) {
        Vector v;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::string name = prefix + "_" + letter + "xyz"[k];
            if (has(scene.parameters, name) || has(scene.coordinates, name) || has(scene.inputs, name) ||
                has(scene.definitions, name) || has(scene.speeds, name))
                throw ModelError(say("the scene has the name {} already, which the wrench on {} needs",
                                     in_quotes(name), in_quotes(place)));
            scene.parameters.push_back({.name = {name, {}},
                                        .value = parse_expression("0", {}, none),
                                        .unit = unit,
                                        .about = "wrench on " + place});
            v.component[k] = parse_expression(name, {}, none);
        }
        return v;
    };
    Force force;
    force.at = {point, {}};
    force.vector = vector("f", "N");
    scene.forces.push_back(std::move(force));
    Torque torque;
    torque.on = {frame, {}};
    torque.vector = vector("m", "N*m");
    if (frame != "N") scene.torques.push_back(std::move(torque));
}

}  // namespace alembert
