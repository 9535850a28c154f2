// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/tolerances.hpp"
#include "base/language/say.hpp"
#include "scene/import/scene_writer.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

/// The turns from the axes in which a joint is given to those in which the scene's joint of that type moves: z is
/// the normal of a plane, x and y are the axes of a universal joint.
std::vector<std::string> to_own_axes(Robot::Type type, const Real3& axis, const Real3& second) {
    const Real3 a = axis.normalized();
    if (type == Robot::Type::universal) {
        Real33 R;
        R << a, (second - second.dot(a) * a).normalized(), a.cross(second).normalized();
        std::vector<std::string> list;
        const Real3 rpy = roll_pitch_yaw(R);
        for (int k = 2; k >= 0; --k)
            if (rpy[k] != 0) list.push_back(fmt::format("[\"{}\", {}]", "xyz"[k], scene_angle(rpy[k])));
        return list;
    }
    if (type != Robot::Type::planar || a[2] == 1) return {};
    const double across = std::hypot(a[0], a[1]);
    return {across == 0
                ? "[\"x\", \"pi\"]"
                : fmt::format("[{}, {}]", scene_axis({-a[1], a[0], 0}), scene_angle(std::atan2(across, a[2])))};
}

bool has_axis(Robot::Type type) {
    return type == Robot::Type::revolute || type == Robot::Type::continuous || type == Robot::Type::prismatic ||
           type == Robot::Type::screw || type == Robot::Type::cylindrical;
}

std::string axis_lines(Robot::Type type, const Real3& axis, double pitch) {
    return (has_axis(type) ? fmt::format("axis = {}\n", scene_axis(axis)) : "") +
           (type == Robot::Type::screw ? fmt::format("pitch = {}\n", scene_number(pitch)) : "");
}

}  // namespace

std::string SceneWriter::coordinate(const Robot::Joint* of, const std::string& name, const std::string& unit,
                                    const std::string& about, double initial, double rate) {
    result_.coordinates.push_back(name);
    result_.coordinates_of[of == nullptr ? "floating_base" : of->name].push_back(name);
    const std::string rest = about.empty() ? "" : fmt::format(", about = \"{}\"", about);
    const bool guess = all_guessed_ || (of != nullptr && guessed_.contains(static_cast<int>(index(*of))));
    return fmt::format("{} = {{ {} = {}, {} = {}{}{} }}", scene_key(name), guess ? "guess" : "initial",
                       scene_number(initial), guess ? "rate_guess" : "rate", scene_number(rate),
                       unit.empty() ? "" : fmt::format(", unit = \"{}\"", unit), rest);
}

/// Where coordinates start: at 0, between stops, or where a coupling of joints has them. What a coupling moves is
/// a guess, and so is everything in a robot with closed loops, which are right only in the pose of the file.
void SceneWriter::choose_starts() {
    starts_.assign(robot_.joints.size(), 0);
    for (std::size_t k = 0; k < robot_.joints.size(); ++k) {
        const auto& limits = robot_.joints[k].limits;
        if (options_.stops && limits && (*limits)[0] <= (*limits)[1] && ((*limits)[0] > 0 || (*limits)[1] < 0))
            starts_[k] = ((*limits)[0] + (*limits)[1]) / 2;
    }
    for (std::size_t steps = 0; steps < robot_.couplings.size(); ++steps)
        for (const Robot::Coupling& c : robot_.couplings) {
            if (c.of_tendons) continue;
            const double x = c.other < 0 ? 0 : starts_[static_cast<std::size_t>(c.other)];
            double value = 0;
            for (std::size_t k = c.polynomial.size(); k-- > 0;) value = value * x + c.polynomial[k];
            if (value == starts_[static_cast<std::size_t>(c.joint)]) continue;
            starts_[static_cast<std::size_t>(c.joint)] = value;
            guessed_.insert(c.joint);
        }
    start_at_keyframe();
    all_guessed_ = (!guessed_.empty() && !robot_.loops.empty()) || options_.guesses ||
                   (keyframe_ != nullptr && !(robot_.loops.empty() && robot_.couplings.empty()));
}

void SceneWriter::start_at_keyframe() {
    std::vector<std::string> names;
    for (const Robot::Keyframe& key : robot_.keyframes) {
        names.push_back(key.name);
        if (key.name == options_.keyframe) keyframe_ = &key;
    }
    if (options_.keyframe.empty()) {
        if (!names.empty())
            result_.notes.push_back(
                say("the scene starts in the reference pose; --keyframe NAME starts in a state "
                    "that the file names: {}",
                    fmt::join(names, ", ")));
        return;
    }
    if (keyframe_ == nullptr)
        throw ModelError(names.empty() ? say("the robot names no state; --keyframe needs a <key> of <keyframe>")
                                       : say("the robot has no state {}; expected one of: {}",
                                             in_quotes(options_.keyframe), fmt::join(names, ", ")));
    for (std::size_t k = 0; k < robot_.joints.size(); ++k)
        if (const auto& q = keyframe_->position[k]; q.size() == 1 && !std::isnan(q[0])) starts_[k] = q[0];
}

RobotPose SceneWriter::start_of(const Robot::Joint& joint) const {
    if (keyframe_ == nullptr) return joint.start;
    const std::vector<double>& q = keyframe_->position[index(joint)];
    if (q.size() < 4 || std::isnan(q[0])) return joint.start;
    const std::size_t e = q.size() - 4;
    const Eigen::Quaterniond turn(q[e], q[e + 1], q[e + 2], q[e + 3]);
    RobotPlace place;  // MuJoCo reads a zero quaternion as no turn
    if (turn.norm() != 0) place.R = turn.normalized().toRotationMatrix();
    if (e > 0) place.shift = {q[0], q[1], q[2]};
    return place.pose();
}

std::vector<double> SceneWriter::rates_of(const Robot::Joint* of, const RobotPose& start) const {
    std::vector<double> u(6, 0);
    if (keyframe_ != nullptr && of != nullptr) u = keyframe_->rate[index(*of)];
    for (double& x : u)
        if (std::isnan(x)) x = 0;
    if (u.size() < 3) return u;
    const Real3 w(u[u.size() - 3], u[u.size() - 2], u[u.size() - 1]);  // along the child
    u.resize(u.size() - 3);
    if (options_.quaternion) {
        const Eigen::Quaterniond e(start.rotation()),
            rate = e * Eigen::Quaterniond(0, w[0] / 2, w[1] / 2, w[2] / 2);
        for (const double x : {rate.w(), rate.x(), rate.y(), rate.z()}) u.push_back(x + 0.0);
        return u;
    }
    const double roll = start.rpy[0], pitch = start.rpy[1];
    if (std::abs(std::cos(pitch)) < tolerance::gimbal_lock && !w.isZero(0))
        throw ModelError(
            say("state {} starts joint {} with a turning at a pitch of {:.6g} deg, where yaw and roll turn about "
                "the same line, and no rates of them give it; --quaternion turns it by a quaternion",
                in_quotes(keyframe_->name), in_quotes(of->name), pitch * 180 / M_PI));
    const double yaw_rate = (w[1] * std::sin(roll) + w[2] * std::cos(roll)) / std::cos(pitch);
    u.insert(u.end(),
             {yaw_rate, w[1] * std::cos(roll) - w[2] * std::sin(roll), w[0] + yaw_rate * std::sin(pitch)});
    return u;
}

/// The coordinates of a turn in space.
std::vector<std::string> SceneWriter::turning(const Robot::Joint* of, const std::string& name,
                                              const RobotPose& start) {
    std::vector<std::string> list;
    const std::vector<double> rates = rates_of(of, start);
    const std::size_t first = rates.size() - (options_.quaternion ? 4 : 3);
    if (options_.quaternion) {
        const Eigen::Quaterniond e(start.rotation());
        const double component[] = {e.w(), e.x(), e.y(), e.z()};
        for (int k = 0; k < 4; ++k)
            list.push_back(coordinate(of, values_.given(fmt::format("{}_e{}", name, k)), "", "",
                                      component[k] + 0.0, rates[first + static_cast<std::size_t>(k)]));
    } else {
        for (int k = 2; k >= 0; --k)
            list.push_back(
                coordinate(of, values_.given(fmt::format("{}_{}", name, std::array{"roll", "pitch", "yaw"}[k])),
                           "rad", "", start.rpy[k], rates[first + static_cast<std::size_t>(2 - k)]));
    }
    return list;
}

void SceneWriter::joint_table(const std::string& name, const std::string& type, const Stand& parent,
                              const Stand& child, const std::string& rest) {
    joints_ += fmt::format("\n[[joint]]\nname = \"{}\"\ntype = \"{}\"\nparent = \"{}\"\nchild = \"{}\"\n", name,
                           type, parent.parent->name, child.parent->name);
    if (!parent.point.isZero(0)) joints_ += fmt::format("parent_point = {}\n", scene_vector(parent.point));
    if (!child.point.isZero(0)) joints_ += fmt::format("child_point = {}\n", scene_vector(child.point));
    if (!parent.rotate.empty()) joints_ += fmt::format("parent_rotate = {}\n", scene_list(parent.rotate));
    if (!child.rotate.empty()) joints_ += fmt::format("child_rotate = {}\n", scene_list(child.rotate));
    joints_ += rest;
}

void SceneWriter::free_joint(const Robot::Joint* joint, const std::string& own, const std::string& name,
                             const Group& child, const Stand& parent, const RobotPose& start) {
    std::vector<std::string> list, shifts;
    const std::vector<double> rates = rates_of(joint, start);
    for (int k = 0; k < 3; ++k) {
        shifts.push_back(values_.given(fmt::format("{}_{}", name, "xyz"[k])));
        list.push_back(
            coordinate(joint, shifts.back(), "m", "", start.shift[k], rates[static_cast<std::size_t>(k)]));
    }
    for (std::string& one : turning(joint, name, start)) list.push_back(std::move(one));
    joint_table(own, "free", parent, {&child, -child.centre, {}},
                fmt::format("{}coordinates = {{ {} }}\n", options_.quaternion ? "" : "angles = \"zyx\"\n",
                            fmt::join(list, ", ")));
    if (joint != nullptr) in_space(*joint, child, shifts);
}

void SceneWriter::mover(const Robot::Joint& joint, const Group& child) {
    body(child);
    const Stand at = stand(joint.parent, joint.at);
    if (joint.type == Robot::Type::floating)
        free_joint(&joint, joint_names_[index(joint)], joint.name, child, at, start_of(joint));
    else if (has_axis(joint.type))
        hinge(joint, child, at);
    else
        several(joint, child, at);
}

/// A joint with one coordinate, and what acts along it.
void SceneWriter::hinge(const Robot::Joint& joint, const Group& child, const Stand& at) {
    const bool slides = joint.type == Robot::Type::prismatic;
    const std::string& q = values_of_[index(joint)];
    std::string about;
    if (joint.limits)
        about = fmt::format("limits {} to {}", scene_number((*joint.limits)[0]), scene_number((*joint.limits)[1]));
    const bool has_limits = joint.limits && (*joint.limits)[0] <= (*joint.limits)[1];
    const double initial = starts_[index(joint)];
    if (has_limits && ((*joint.limits)[0] > 0 || (*joint.limits)[1] < 0)) {
        result_.notes.push_back(options_.stops
                                    ? say("{} starts at {}, between its stops", q, scene_number(initial))
                                    : say("{} starts at 0, outside its limits", q));
    }
    joint_table(joint_names_[index(joint)], joint_word(joint.type), at, {&child, -child.centre, {}},
                fmt::format("{}coordinates = {{ {} }}\n{}", axis_lines(joint.type, joint.axis, joint.pitch),
                            coordinate(&joint, q, slides ? "m" : "rad", about, initial, rates_of(&joint, {})[0]),
                            joint.armature == 0 ? ""
                                                : fmt::format("armature = {{ {} = {} }}\n", scene_key(q),
                                                              scene_number(joint.armature))));
    damper(joint, q);
    spring(joint, q);
    friction(joint, q);
    if (has_limits) stops(joint, q);
    if (options_.stops && joint.limits && !has_limits)
        result_.notes.push_back(say("{} has no stops, because its lower limit is above the upper one", q));
    if (options_.drives && !robot_.actuators) drive(joint, q, slides);
}

/// A planar, universal or spherical joint.
void SceneWriter::several(const Robot::Joint& joint, const Group& child, Stand at) {
    std::vector<std::string> list;
    const auto one = [&](const std::string& name, const char* unit) {
        list.push_back(coordinate(&joint, values_.given(joint.name + name), unit));
    };
    if (joint.type == Robot::Type::spherical) {
        list = turning(&joint, joint.name, start_of(joint));
    } else if (joint.type == Robot::Type::universal) {
        for (const char* k : {"_1", "_2"}) one(k, "rad");
    } else {
        for (const char* k : {"_x", "_y"}) one(k, "m");
        one("_turn", "rad");
    }
    const std::vector<std::string> turns = to_own_axes(joint.type, joint.axis, joint.second);
    at.rotate.insert(at.rotate.end(), turns.begin(), turns.end());
    const bool angles = joint.type == Robot::Type::spherical && !options_.quaternion;
    joint_table(
        joint_names_[index(joint)], joint_word(joint.type), at, {&child, -child.centre, turns},
        fmt::format("{}coordinates = {{ {} }}\n", angles ? "angles = \"zyx\"\n" : "", fmt::join(list, ", ")));
    if (joint.type == Robot::Type::spherical) in_space(joint, child, {});
}

/// Adds a frame and a point in place of a joint, without a coordinate and without a constraint.
void SceneWriter::follower(const Robot::Joint& joint, Group& child) {
    Stand at = stand(joint.parent, joint.at);
    const Robot::Mimic& mimic = *joint.mimic;
    const std::string& leader = values_of_[static_cast<std::size_t>(mimic.joint)];
    const bool moves = !leader.empty() && mimic.factor != 0;  // a fixed leader stays at 0
    std::string position = scene_number(mimic.offset);
    if (moves) {
        position = mimic.factor == 1    ? leader
                   : mimic.factor == -1 ? "-" + leader
                                        : fmt::format("{}*{}", scene_number(mimic.factor), leader);
        if (mimic.offset != 0)
            position += fmt::format(" {} {}", mimic.offset < 0 ? '-' : '+', scene_number(std::abs(mimic.offset)));
    }
    const bool slides = joint.type == Robot::Type::prismatic;
    const std::string& parent = at.parent->frame;
    if (!slides) at.rotate.push_back(fmt::format("[{}, \"{}\"]", scene_axis(joint.axis), position));
    child.frame = places_.given(child.name + "_frame");
    const std::string& from = at.parent->centre_name;
    std::string pivot = places_.given(joint.name);
    result_.text += fmt::format("\n# {}\n[[frame]]\nname = \"{}\"\nparent = \"{}\"\n",
                                moves ? fmt::format("{} moves with {}", escaped(joint.name), leader)
                                      : fmt::format("{} stands still", escaped(joint.name)),
                                child.frame, parent);
    result_.text += fmt::format(
        "rotate = {}\n", scene_list(at.rotate.empty() ? std::vector<std::string>{"[\"z\", 0]"} : at.rotate));
    result_.text += fmt::format("\n[[point]]\nname = \"{}\"\nfrom = \"{}\"\noffset = {}\naxes = \"{}\"\n", pivot,
                                from, scene_vector(at.point), parent);
    if (slides) {
        const Real3 a = joint.axis.normalized();
        std::array<std::string, 3> shift;
        for (int k = 0; k < 3; ++k)
            shift[static_cast<std::size_t>(k)] =
                a[k] == 0   ? "0"
                : a[k] == 1 ? scene_text(position)
                            : scene_text(fmt::format("{}*({})", scene_number(a[k]), position));
        const std::string moved = places_.given(joint.name + "_shifted");
        result_.text += fmt::format("\n[[point]]\nname = \"{}\"\nfrom = \"{}\"\noffset = [{}]\naxes = \"{}\"\n",
                                    moved, pivot, fmt::join(shift, ", "), child.frame);
        pivot = moved;
    }
    body(child, fmt::format("frame = \"{}\"\nfrom = \"{}\"\nposition = {}\naxes = \"{}\"\n", child.frame, pivot,
                            scene_vector(child.centre), child.frame));
    if (moves) damper(joint, position);
}

void SceneWriter::loop(const Robot::Loop& loop) {
    const auto group = [&](int i) { return seat(i).group; };
    if (group(loop.parent) == group(loop.child)) return drop(say("joints between parts of one body"), {loop.name});
    Stand parent = stand(loop.parent, loop.at_parent), child = stand(loop.child, loop.at_child);
    const std::vector<std::string> turns = to_own_axes(loop.type, loop.axis, loop.second);
    for (Stand* side : {&parent, &child}) side->rotate.insert(side->rotate.end(), turns.begin(), turns.end());
    const std::string name = joints_taken_.given(loop.name);
    joint_table(name, joint_word(loop.type), parent, child, axis_lines(loop.type, loop.axis, loop.pitch));
    result_.loops.push_back(name);
}

}  // namespace alembert
