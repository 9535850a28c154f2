// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/body_points.hpp"

namespace alembert {

const Body* body_at(const Scene& scene, const std::string& point) {
    for (const Body& body : scene.bodies)
        if (body.point().text == point) return &body;
    return nullptr;
}

std::string centre_of(const Scene& scene, const std::string& body) {
    if (body == "N") return "O";
    for (const Body& one : scene.bodies)
        if (one.name.text == body) return one.point().text;
    return body;
}

std::vector<std::string> points_of(const Scene& scene) {
    std::vector<std::string> names;
    for (const Point& p : scene.points) names.push_back(p.name.text);
    for (const Particle& p : scene.particles) names.push_back(p.name.text);
    for (const Body& b : scene.bodies) names.push_back(b.point().text);
    return names;
}

}  // namespace alembert
