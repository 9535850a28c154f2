// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/figure.hpp"

#include <fmt/format.h>

#include <map>

#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "present/report/figure_shapes.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

std::string description_of(const Drawing& drawing) {
    using Kind = FigureElement::Kind;
    std::map<std::string, int> count;
    const auto word = [](Kind kind) -> const char* {
        switch (kind) {
            case Kind::disc:
            case Kind::block:
                return to_say("mass");
            case Kind::rod:
                return to_say("rod without mass");
            case Kind::bar:
            case Kind::plate:
            case Kind::solid:
                return to_say("body");
            case Kind::ring:
            case Kind::hoop:
            case Kind::pulley:
                return to_say("disc or wheel");
            case Kind::ball:
            case Kind::ellipsoid:
                return to_say("ball");
            case Kind::support:
                return to_say("hinge on the ground");
            case Kind::pin:
                return to_say("hinge");
            case Kind::spring:
            case Kind::coil:
                return to_say("spring");
            case Kind::damper:
                return to_say("damper");
            case Kind::force:
                return to_say("force");
            default:
                return nullptr;
        }
    };
    for (const FigureElement& e : drawing.elements)
        if (const char* const name = word(e.kind)) ++count[name];
    std::string text;
    for (const auto& [name, number] : count)
        text += (text.empty() ? "" : ", ") + say("{} x {}", number, translated(name));
    return text.empty() ? say("The figure of the scene.") : say("The figure shows: {}.", text);
}

std::string figure_of(const Scene& scene) {
    const Mechanism mechanism = build(scene);
    Drawing drawing = draw(scene, mechanism);
    if (!drawing.obstacle.empty()) throw ModelError(drawing.obstacle);
    Start start = start_of(mechanism);
    try {
        Start assembled = start;
        assemble(assembled, mechanism, lower_constraints(mechanism), {}, false);
        start = assembled;
    } catch (const ModelError&) {  // constraints with functions that the scene leaves open have no values
        if (mechanism.open_functions().empty()) throw;
    }
    Pose pose = pose_at(drawing, start.state());
    // A force that is zero at the start is shown at the point where it will act.
    for (const FigureElement& e : drawing.elements)
        for (int k = 1; k <= 8 && e.kind == FigureElement::Kind::force && pose[e.points[1]].isZero(1e-12); ++k) {
            State<double> later = start.state();
            later.t += k * start.duration / 37;
            pose[e.points[1]] = pose_at(drawing, later)[e.points[1]];
        }
    std::vector<Pose> poses{pose};
    stretch_grounds(drawing, poses);
    return as_svg(shapes_of(drawing, poses, {start.q}), poses[0], start.q,
                  scene.title.empty() ? mechanism.name : scene.title, description_of(drawing), false);
}

}  // namespace alembert
