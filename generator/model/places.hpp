// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The frames and points of a scene. Each is computed when it is first asked for, so that the order of declaration
/// does not matter.
///
///     places.position("P")          // from O, along N
///     places.orientation("B")       // of a frame, or of a body's frame by the body's name
///
/// Throws std::out_of_range for a name that the scene does not have (the reader has checked them all).

#include <map>

#include "model/translate.hpp"

namespace alembert {

/// The position in Mechanism::q of the coordinate of that name.
std::size_t coordinate_index(const std::string& name, const Mechanism& mechanism);

/// A frame's unit axes along N, and its angular velocity along itself.
struct Attitude {
    std::array<Vector3, 3> axes{Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}};
    Vector3 w_NF_F{0, 0, 0};
};

class Places {
public:
    Places(const Scene& scene, const Mechanism& mechanism, Translator& translator)
        : scene_(scene), m_(mechanism), translator_(translator) {}

    const Orientation& orientation(const std::string& frame);
    Vector3 position(const std::string& point);
    Vector3 velocity(const std::string& point);

    /// Components as written.
    Vector3 vector(const Vector& v);
    /// Components along N of a vector written along `axes`.
    Vector3 along(const Vector& v, const Name& axes);
    /// The direction of a rotation's axis.
    Vector3 unit_axis(const Rotation& rotation);
    Orientation turned(const Orientation& o, const Vector3& axis, const GiNaC::ex& angle);
    Orientation turned(const Orientation& o, const std::array<GiNaC::ex, 4>& quaternion);
    /// The frame along which a person would look at a point, particle or body: that of its offset, or of the body
    /// itself.
    std::string frame_of(const std::string& point) const;
    /// The position of the mass centre; of N, the origin.
    Vector3 position_of_body(const std::string& body) { return position(centre_of(body)); }
    /// The name of the mass centre among the points; of N, of a particle and of a point their own.
    std::string centre_of(const std::string& body) const;

    GiNaC::ex value(const Expression& e) { return m_.z->name(translator_.scalar(e)); }
    GiNaC::ex value(const Name& name);
    GiNaC::ex rate(const GiNaC::ex& value) { return m_.time_derivative({value})[0]; }
    /// The value of an expression at the scene's parameters.
    double number(const GiNaC::ex& e) const;
    /// The values at the scene's parameters and its initial state.
    std::vector<double> numbers_at_start(const std::vector<GiNaC::ex>& values) const;
    Intermediates& z() { return *m_.z; }

    /// The frames and points that have been asked for so far, as steps; `point` finds one by its name.
    const Skeleton& skeleton() const { return skeleton_; }
    int point(const std::string& name) { return position(name), name == "O" ? 0 : points_.at(name); }
    int step(int from, int frame, const Vector3& offset);
    /// Of the frame that a step of the skeleton leads to.
    const Attitude& attitude(int frame) const { return attitudes_[static_cast<std::size_t>(frame)]; }

private:
    /// What its position or orientation is counted from; empty for none.
    std::string base_of_point(const std::string& point) const;
    std::string base_of_frame(const std::string& frame) const;
    Orientation turn(const Frame& frame);
    void turn_step(Skeleton::Turn turn, Orientation& to);
    const Joint* joint_of(const std::string& body) const;
    const Position* find(const std::string& point) const;

    const Scene& scene_;
    const Mechanism& m_;
    Translator& translator_;
    std::map<std::string, Orientation> orientations_;
    std::map<std::string, Vector3> positions_, velocities_;
    std::map<std::string, int> points_;
    Skeleton skeleton_;
    std::vector<Attitude> attitudes_{Attitude{}};  // of its frames
};

}  // namespace alembert
