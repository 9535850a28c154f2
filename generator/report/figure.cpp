// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/figure.hpp"

#include <fmt/format.h>

#include <map>

#include "lower/lower.hpp"
#include "report/figure_shapes.hpp"
#include "state/assemble.hpp"

namespace alembert {

std::string description_of(const Drawing& drawing) {
    using Kind = FigureElement::Kind;
    std::map<std::string, int> count;
    const auto word = [](Kind kind) -> const char* {
        switch (kind) {
            case Kind::disc:
            case Kind::block:
                return "mass";
            case Kind::rod:
                return "rod without mass";
            case Kind::bar:
            case Kind::plate:
            case Kind::box:
                return "body";
            case Kind::ring:
                return "disc or wheel";
            case Kind::ball:
                return "ball";
            case Kind::support:
                return "hinge on the ground";
            case Kind::pin:
                return "hinge";
            case Kind::spring:
            case Kind::coil:
                return "spring";
            case Kind::damper:
                return "damper";
            case Kind::force:
                return "force";
            default:
                return nullptr;
        }
    };
    for (const FigureElement& e : drawing.elements)
        if (const char* const name = word(e.kind)) ++count[name];
    std::string text;
    for (const auto& [name, number] : count)
        text += fmt::format("{}{} x {}", text.empty() ? "" : ", ", number, name);
    return text.empty() ? "The figure of the scene." : "The figure shows: " + text + ".";
}

std::string figure_of(const Scene& scene) {
    const Mechanism mechanism = build(scene);
    const Drawing drawing = draw(scene, mechanism);
    if (!drawing.obstacle.empty()) throw ModelError(drawing.obstacle);
    Start start = start_of(mechanism);
    assemble(start, mechanism, lower_constraints(mechanism), {}, false);
    Pose pose = pose_at(drawing, start.state());
    // A force that is zero at the start is shown at the point where it will act.
    for (const FigureElement& e : drawing.elements)
        for (int k = 1; k <= 8 && e.kind == FigureElement::Kind::force && pose[e.points[1]].isZero(1e-12); ++k) {
            State<double> later = start.state();
            later.t += k * start.duration / 37;
            pose[e.points[1]] = pose_at(drawing, later)[e.points[1]];
        }
    return as_svg(shapes_of(drawing, {pose}, {start.q}), pose, start.q,
                  scene.title.empty() ? mechanism.name : scene.title, description_of(drawing), false);
}

}  // namespace alembert
