// SPDX-License-Identifier: GPL-2.0-or-later
// ω along the frame is known from turn to turn (model/geometry.cpp); α is its derivative in the frame itself,
// since (dω/dt)_N = (dω/dt)_F + ω × ω.
#include "simulate/kinematics/frames.hpp"

#include <algorithm>

namespace alembert {

namespace {

/// What a frame stands in: its parent, or the body on the inner side of the joint that places it.
std::string parent_of(const std::string& name, const Scene& scene) {
    for (const Frame& frame : scene.frames)
        if (frame.name.text == name) return frame.parent.text;
    for (const Body& body : scene.bodies)
        if (body.name.text == name && body.joint) {
            const Joint& joint = scene.joints[*body.joint];
            return (*joint.places_child ? joint.parent : joint.child).body.text;
        }
    return "N";
}

/// The turns that lead from one frame to another.
class TurnWriter {
public:
    TurnWriter(FrameKinematics& f, Places& places, VectorWriter& write)
        : f_(f), places_(places), write_(write), parent_(places.orientation(f.parent).frame) {}

    void write(bool steps) {
        std::vector<int> chain;
        for (int i = places_.orientation(f_.name).frame; i != parent_; i = places_.skeleton().frames[i].parent)
            chain.push_back(i);
        std::reverse(chain.begin(), chain.end());
        f_.is_simple = parent_ == 0 && chain.size() == 1 && !places_.skeleton().frames[chain[0]].by_quaternion;
        for (const int i : chain) add(i);
        const Vector3 w = write_.unit(places_.attitude(parent_).w_NF_F);
        if (steps && !is_zero(w))
            f_.carried = {{write_(w), write_(write_.rate(w)), write_(write_.product(w, omega_))}};
    }

private:
    void add(int frame) {
        // What the turn holds refers to a list that grows with new frames.
        const Skeleton::Turn turn = places_.skeleton().frames[frame];
        const Vector3 before = omega_;
        if (turn.by_quaternion) {
            is_plain_ = false;
            const Vector3 added = write_.sum(against_parent(frame), write_.times(-1, before));
            if (is_zero(added)) return;
            omega_ = write_.sum(before, added);
            f_.turns.push_back({.omega = write_(added), .alpha = write_(write_.rate(added))});
            return;
        }
        const Vector3 axis =
            is_plain_ ? reached_.to_inertial(turn.axis, places_.z()) : along_parent(frame, turn.axis);
        const GiNaC::ex rate = places_.rate(turn.angle);
        if (is_plain_) reached_ = reached_.turned(turn.axis, turn.angle, rate, places_.z());
        if (rate.is_zero()) return;
        const Vector3 added = write_.times(rate, axis);
        omega_ = write_.sum(before, added);
        f_.turns.push_back({.angle = write_.formula(turn.angle),
                            .axis = write_(axis),
                            .omega = write_(added),
                            .alpha = write_(write_.times(places_.rate(rate), axis)),
                            .turning = write_(write_.product(before, added))});
    }

    Vector3 along_parent(int frame, const Vector3& v) const {
        const Vector3 along_N = write_.along_N(places_.attitude(frame).axes, v);
        return write_.unit(write_.along(places_.attitude(parent_).axes, along_N));
    }

    /// ω against the parent, along it.
    Vector3 against_parent(int frame) const {
        const Vector3 all = along_parent(frame, places_.attitude(frame).w_NF_F);
        return write_.sum(all, write_.times(-1, write_.unit(places_.attitude(parent_).w_NF_F)));
    }

    FrameKinematics& f_;
    Places& places_;
    VectorWriter& write_;
    const int parent_;
    Orientation reached_;   // against the parent
    bool is_plain_ = true;  // it is known: no quaternion so far
    Vector3 omega_{0, 0, 0};
};

}  // namespace

std::vector<std::string> frames_and_bodies(const Scene& scene) {
    std::vector<std::string> names;
    for (const Frame& frame : scene.frames) names.push_back(frame.name.text);
    for (const Body& body : scene.bodies)
        if (std::find(names.begin(), names.end(), body.name.text) == names.end()) names.push_back(body.name.text);
    return names;
}

FrameKinematics frame_kinematics(const std::string& name, const Scene& scene, Places& places, VectorWriter& write,
                                 bool steps) {
    FrameKinematics f{.name = name};
    for (const Body& body : scene.bodies)
        if (body.name.text == name) {
            f.is_body = true;
            if (!body.joint) f.same_as = body.frame.text;
        }
    if (f.same_as == name) f.same_as.clear();
    const Orientation orientation = places.orientation(name);
    std::array<Vector3, 3> axes;
    for (std::size_t k = 0; k < 3; ++k) {
        axes[k] = write.unit(orientation.axis(static_cast<int>(k)));
        f.axes[k] = write(axes[k]);
    }
    const Vector3 w = write.unit(orientation.angular_velocity()), alpha = write.rate(w);
    f.omega = {write(write.along_N(axes, w)), write(w)};
    f.alpha = {write.derivative(write.along_N(axes, alpha), f.omega.along_N),
               write.derivative(alpha, f.omega.own)};
    f.parent = parent_of(f.same_as.empty() ? name : f.same_as, scene);
    TurnWriter(f, places, write).write(steps);
    return f;
}

}  // namespace alembert
