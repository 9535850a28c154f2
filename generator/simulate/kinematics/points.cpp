// SPDX-License-Identifier: GPL-2.0-or-later
// With ρ along a frame that turns with ω:  (dρ/dt)_N = ρ' + ω × ρ, and once more
// (d²ρ/dt²)_N = ρ'' + 2 ω × ρ' + α × ρ + ω × (ω × ρ)  (Zhang & Qin, chapter 2).
#include "simulate/kinematics/points.hpp"

#include <algorithm>

#include "scene/body_points.hpp"
#include "simulate/kinematics/frames.hpp"

namespace alembert {

PointWriter::PointWriter(const Scene& scene, Places& places, VectorWriter& write)
    : scene_(scene), places_(places), write_(write) {
    named_[0] = "N";
    for (const std::string& name : frames_and_bodies(scene)) named_.emplace(places.orientation(name).frame, name);
}

const Position* PointWriter::place_of(const std::string& name) const {
    const auto find = [&](const auto& list) -> const Position* {
        const auto found =
            std::find_if(list.begin(), list.end(), [&](const auto& item) { return item.name.text == name; });
        return found == list.end() ? nullptr : &found->position;
    };
    if (const Position* place = find(scene_.points)) return place;
    if (const Position* place = find(scene_.particles)) return place;
    const Body* const body = body_at(scene_, name);
    return body == nullptr || body->joint ? nullptr : &body->position;
}

const Joint* PointWriter::joint_of(const std::string& name) const {
    const Body* const body = body_at(scene_, name);
    return body != nullptr && body->joint ? &scene_.joints[*body->joint] : nullptr;
}

PointWriter::Moving PointWriter::along_N(const std::string& name) {
    const Vector3 r = write_.unit(places_.position(name)), v = write_.rate(r);
    return {r, v, write_.rate(v)};
}

PointWriter::Moving PointWriter::along(const std::string& name, const std::string& frame) {
    if (name == "O") return {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    const Orientation& orientation = places_.orientation(frame);
    const Position* place = place_of(name);
    if (place == nullptr || places_.frame_of(name) != frame) {
        const Moving m = along_N(name);
        std::array<Vector3, 3> axes;
        for (std::size_t k = 0; k < 3; ++k) axes[k] = write_.unit(orientation.axis(static_cast<int>(k)));
        return {write_.along(axes, m.r), write_.along(axes, m.v), write_.along(axes, m.a)};
    }
    const Moving base = along(place->from.text, frame);
    const Vector3 rho = places_.vector(place->offset), w = write_.unit(orientation.angular_velocity()),
                  rate = write_.rate(rho), turning = write_.product(w, rho);
    const Vector3 velocity = write_.sum(rate, turning);
    // (d/dt)_N of the whole, as seen in the frame: its derivative there and ω × it.
    const Vector3 acceleration = write_.sum(write_.rate(velocity), write_.product(w, velocity));
    return {write_.sum(base.r, rho), write_.sum(base.v, velocity), write_.sum(base.a, acceleration)};
}

PlaceStep PointWriter::step_of(int point) {
    const Skeleton::Step step = places_.skeleton().points[static_cast<std::size_t>(point)];
    const auto name = named_.find(step.frame);
    PlaceStep result{.frame = name == named_.end() ? "" : name->second};
    const Vector3 w = write_.unit(places_.attitude(step.frame).w_NF_F);
    result.turns = !is_zero(w);
    const Vector3 rho = step.offset, velocity = write_.rate(rho), turning = write_.product(w, rho);
    result.offset = write_(rho);
    result.relative_velocity = write_(velocity);
    result.turning_velocity = write_(turning);
    result.relative = write_(write_.rate(velocity));
    result.tangential = write_(write_.product(write_.rate(w), rho));
    result.centripetal = write_(write_.product(w, turning));
    result.coriolis = write_(write_.times(2, write_.product(w, velocity)));
    return result;
}

PointKinematics PointWriter::operator()(const std::string& name, bool steps) {
    PointKinematics p{.name = name};
    const Position* place = place_of(name);
    if (place != nullptr) {
        p.from = place->from.text;
    } else {
        const Joint& joint = *joint_of(name);
        const std::string& inner = (*joint.places_child ? joint.parent : joint.child).body.text;
        p.from = places_.centre_of(inner);
    }
    const Moving fixed = along_N(name);
    p.position.along_N = write_(fixed.r);
    p.velocity.along_N = write_.derivative(fixed.v, p.position.along_N);
    p.acceleration.along_N = write_.derivative(fixed.a, p.velocity.along_N);
    if (const std::string frame = places_.frame_of(name); frame != "N") {
        const Moving moving = along(name, frame);
        p.along = frame;
        p.position.own = write_(moving.r);
        p.velocity.own = write_(moving.v);
        p.acceleration.own = write_.derivative(moving.a, p.velocity.own);
    }
    if (!steps) return p;
    const int begin = places_.point(p.from);
    std::vector<int> chain;
    for (int i = places_.point(name); i != begin && i != 0;
         i = places_.skeleton().points[static_cast<std::size_t>(i)].from)
        chain.push_back(i);
    std::reverse(chain.begin(), chain.end());
    for (const int i : chain) p.places.push_back(step_of(i));
    return p;
}

}  // namespace alembert
