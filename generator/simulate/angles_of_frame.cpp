// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/angles_of_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/joint_moves.hpp"

namespace alembert {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Quaternion = Eigen::Quaterniond;

const char* const names_of_quaternion[] = {"chart_e0", "chart_e1", "chart_e2", "chart_e3"};

/// The position of a coordinate; −1 if it has a prescribed motion, or is none.
int position_of(const Scene& scene, const std::string& name) {
    for (std::size_t i = 0; i < scene.coordinates.size(); ++i)
        if (scene.coordinates[i].name.text == name) return static_cast<int>(i);
    return -1;
}

/// The coordinate that an expression is; −1 if it is anything else.
int coordinate_of(const Scene& scene, const Expression& e) {
    return e.tree && e.tree->kind == Tree::Kind::name && e.tree->primes == 0 ? position_of(scene, e.tree->text)
                                                                             : -1;
}

bool names_any(const TreePtr& tree, const std::vector<std::string>& names) {
    if (!tree) return false;
    if (tree->kind == Tree::Kind::name && std::find(names.begin(), names.end(), tree->text) != names.end())
        return true;
    return std::any_of(tree->args.begin(), tree->args.end(),
                       [&](const TreePtr& arg) { return names_any(arg, names); });
}

/// `angle` and whole turns, as near to `near` as possible.
double turned_towards(double angle, double near) {
    constexpr double turn = 2 * std::numbers::pi;
    return angle + turn * std::round((near - angle) / turn);
}

/// The two triples of angles of a rotation, each with the whole turns that bring it nearest to `near`. In the
/// first the sine of the middle angle is not negative (its cosine, where the three axes differ).
std::array<Vector3d, 2> both_triples(const AnglesOfFrame& of, const Quaternion& e, const Vector3d& near) {
    const Matrix3d R = e.normalized().toRotationMatrix();
    const auto [i, j, k] = of.axes;
    const double sign = (j - i + 3) % 3 == 1 ? 1 : -1;
    std::array<Vector3d, 2> both;
    if (of.is_proper()) {
        const int l = 3 - i - j;
        both[0] = {std::atan2(R(j, i), -sign * R(l, i)), std::atan2(std::hypot(R(j, i), R(l, i)), R(i, i)),
                   std::atan2(R(i, j), sign * R(i, l))};
        both[1] = {both[0][0] + std::numbers::pi, -both[0][1], both[0][2] + std::numbers::pi};
    } else {
        both[0] = {std::atan2(-sign * R(j, k), R(k, k)), std::atan2(sign * R(i, k), std::hypot(R(i, i), R(i, j))),
                   std::atan2(-sign * R(i, j), R(i, i))};
        both[1] = {both[0][0] + std::numbers::pi, std::numbers::pi - both[0][1], both[0][2] + std::numbers::pi};
    }
    for (Vector3d& angles : both)
        for (int n = 0; n < 3; ++n) angles[n] = turned_towards(angles[n], near[n]);
    return both;
}

}  // namespace

double AnglesOfFrame::evenness(const double* q) const {
    const double b = q[angles[1]];
    return std::abs(is_proper() ? std::sin(b) : std::cos(b));
}

std::vector<AnglesOfFrame> angles_in(const Scene& scene) {
    std::vector<AnglesOfFrame> found;
    const auto add = [&](const AnglesOfFrame& one) {
        const auto& [a, b, c] = one.axes;
        const auto& [p, q, r] = one.angles;
        if (a != b && b != c && p != q && q != r && p != r && p >= 0 && q >= 0 && r >= 0) found.push_back(one);
    };
    for (std::size_t k = 0; k < scene.frames.size(); ++k) {
        const std::vector<Rotation>& rotations = scene.frames[k].rotations;
        const auto has_letter = [](const Rotation& r) { return r.letter != 0; };
        if (rotations.size() != 3 || !std::all_of(rotations.begin(), rotations.end(), has_letter)) continue;
        AnglesOfFrame one{.place = k, .is_joint = false, .axes = {}, .angles = {}};
        for (std::size_t i = 0; i < 3; ++i) {
            one.axes[i] = rotations[i].letter - 'x';
            one.angles[i] = coordinate_of(scene, rotations[i].angle);
        }
        add(one);
    }
    for (std::size_t k = 0; k < scene.joints.size(); ++k) {
        const Joint& joint = scene.joints[k];
        if (joint.angles.empty() || joint.closes_loop) continue;
        AnglesOfFrame one{.place = k, .is_joint = true, .axes = {}, .angles = {}};
        for (std::size_t i = 0; i < 3; ++i) {
            one.axes[i] = joint.angles[i] - 'x';
            one.angles[i] =
                position_of(scene, joint.coordinates[moves_of(joint.type).before_turn_in_space() + i].text);
        }
        add(one);
    }
    return found;
}

bool named_elsewhere(const Scene& scene, const AnglesOfFrame& angles) {
    std::vector<std::string> names;
    for (const int k : angles.angles) names.push_back(scene.coordinates[static_cast<std::size_t>(k)].name.text);
    bool found = false;
    const auto look = [&](const Expression& e) { found = found || names_any(e.tree, names); };
    const auto look_at = [&](const Vector& v) { std::for_each(v.component.begin(), v.component.end(), look); };
    for (const Definition& d : scene.definitions) look(d.value);
    for (std::size_t k = 0; k < scene.frames.size(); ++k)
        for (const Rotation& r : scene.frames[k].rotations)
            if (angles.is_joint || k != angles.place) look(r.angle);
    for (const Point& p : scene.points) look_at(p.position.offset);
    for (const Particle& p : scene.particles) look_at(p.position.offset);
    for (const Body& b : scene.bodies) look_at(b.position.offset);
    for (const Force& f : scene.forces) look_at(f.vector);
    for (const Torque& t : scene.torques) look_at(t.vector);
    for (const auto* links : {&scene.springs, &scene.dampers})
        for (const Link& link : *links)
            for (const Expression* e : {&link.along, &link.constant, &link.length}) look(*e);
    for (const Expression* e : {&scene.kinetic, &scene.potential, &scene.lagrangian, &scene.rayleigh}) look(*e);
    for (const GeneralizedForce& f : scene.generalized_forces) {
        look(f.value);
        found = found || std::find(names.begin(), names.end(), f.coordinate.text) != names.end();
    }
    for (const ConstraintRule& c : scene.constraints)
        for (const Expression* e : {&c.equation.lhs, &c.equation.rhs}) look(*e);
    for (const Armature& a : scene.armatures)
        found = found || std::find(names.begin(), names.end(), a.coordinate.text) != names.end();
    return found;
}

Scene with_quaternion(const Scene& given, const AnglesOfFrame& angles) {
    Scene scene = given;
    scene.on_warning = {};
    scene.outputs.clear();
    scene.claims.clear();
    scene.impulses.clear();
    scene.generalized_impulses.clear();
    scene.coordinates.clear();
    for (std::size_t i = 0; i < given.coordinates.size(); ++i)
        if (std::find(angles.angles.begin(), angles.angles.end(), static_cast<int>(i)) == angles.angles.end())
            scene.coordinates.push_back(given.coordinates[i]);
    const Name name = angles.name(given);
    std::vector<Name> quaternion;
    std::vector<Diagnostic> none;
    for (int k = 0; k < 4; ++k) {
        Coordinate e;
        e.name = {names_of_quaternion[k], name.place};
        e.initial = parse_expression(k == 0 ? "1" : "0", {}, none);
        e.rate = parse_expression("0", {}, none);
        quaternion.push_back(e.name);
        scene.coordinates.push_back(std::move(e));
    }
    if (angles.is_joint) {
        Joint& joint = scene.joints[angles.place];
        const auto first =
            joint.coordinates.begin() + static_cast<std::ptrdiff_t>(moves_of(joint.type).before_turn_in_space());
        joint.coordinates.insert(joint.coordinates.erase(first, first + 3), quaternion.begin(), quaternion.end());
        joint.angles.clear();
    } else {
        scene.frames[angles.place].rotations.clear();
        scene.frames[angles.place].quaternion = quaternion;
    }
    return scene;
}

TurnedFrame::TurnedFrame(const std::array<int, 3>& axes, const Vector3d& angle) {
    e = Quaternion::Identity();
    for (int k = 0; k < 3; ++k) {
        const Vector3d axis = Vector3d::Unit(axes[static_cast<std::size_t>(k)]);
        rates.col(k) = e * axis;
        e = e * Quaternion(Eigen::AngleAxisd(angle[k], axis));
    }
}

Eigen::Vector2d AnglesOfFrame::from_lock(const Quaternion& e) const {
    const Matrix3d R = e.normalized().toRotationMatrix();
    const auto [i, j, k] = axes;
    return is_proper() ? Eigen::Vector2d(R(j, i), R(3 - i - j, i)) : Eigen::Vector2d(R(j, k), R(k, k));
}

Vector3d angles_near(const AnglesOfFrame& of, const Quaternion& e, const Vector3d& near) {
    const auto [first, second] = both_triples(of, e, near);
    return (first - near).norm() <= (second - near).norm() ? first : second;
}

Vector3d angles_on_side(const AnglesOfFrame& of, const Quaternion& e, const Vector3d& near) {
    const auto [first, second] = both_triples(of, e, near);
    const double side = of.is_proper() ? std::sin(near[1]) : std::cos(near[1]);
    return side >= 0 ? first : second;
}

Vector3d angles_in_lock(const AnglesOfFrame& of, const Quaternion& e, const Vector3d& near) {
    const Vector3d first = Vector3d::Unit(of.axes[0]), second = Vector3d::Unit(of.axes[1]),
                   third = Vector3d::Unit(of.axes[2]);
    const Quaternion left = Quaternion(Eigen::AngleAxisd(-near[0], first)) * e.normalized();
    const Vector3d turned = left * third;  // by the second angle alone
    const double b = std::atan2(second.dot(third.cross(turned)), third.dot(turned));
    const Vector3d last = Quaternion(Eigen::AngleAxisd(-b, second)) * left * second;
    const double c = std::atan2(third.dot(second.cross(last)), second.dot(last));
    return {near[0], turned_towards(b, near[1]), turned_towards(c, near[2])};
}

}  // namespace alembert
