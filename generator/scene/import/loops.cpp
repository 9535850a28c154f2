// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/loops.hpp"

#include "base/language/say.hpp"
#include "scene/import/scene_words.hpp"
#include "scene/joint_moves.hpp"
#include "scene/joints_file.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

class LoopReader {
public:
    LoopReader(Robot& robot, const std::string& file) : robot_(robot), scene_(read_joints(file)) {}

    void read() {
        for (const Joint& joint : scene_.joints) {
            Robot::Loop loop{.name = joint.name.text, .type = type_of(joint), .parent = -1, .child = -1};
            loop.parent = link(joint.parent);
            loop.child = link(joint.child);
            loop.at_parent = pose(joint.parent);
            loop.at_child = pose(joint.child);
            if (moves_of(joint.type).has_axis()) loop.axis = axis(joint.axis);
            loop.second = Real3::UnitY();
            if (joint.type == Joint::Type::universal) loop.axis = Real3::UnitX();
            if (joint.pitch) loop.pitch = number(joint.pitch);
            robot_.loops.push_back(std::move(loop));
        }
        if (!mistakes_.empty()) fail(scene_, mistakes_);
    }

private:
    Robot::Type type_of(const Joint& joint) {
        using enum Robot::Type;
        const std::string& word = moves_of(joint.type).name;
        for (const Robot::Type type :
             {fixed, revolute, prismatic, universal, spherical, planar, screw, cylindrical})
            if (joint_word(type) == word) return type;
        mistakes_.push_back({joint.name.place, say("a {} joint closes no loop", word)});
        return floating;
    }

    int link(const Joint::Side& side) {
        for (std::size_t i = 0; i < robot_.links.size(); ++i)
            if (robot_.links[i].name == side.body.text) return static_cast<int>(i);
        if (side.body.text == "N") return robot_.root;
        std::vector<std::string> names;
        for (const Robot::Link& one : robot_.links) names.push_back(one.name);
        const std::string meant = nearest(side.body.text, names);
        mistakes_.push_back({side.body.place, say("the robot has no link {}{}", in_quotes(side.body.text),
                                                  meant.empty() ? "" : say("; did you mean '{}'?", meant))});
        return 0;
    }

    double number(const Expression& e) {
        const std::optional<double> value = value_of(e);
        if (!value) mistakes_.push_back({e.place(), say("{} is no number; expected one, or one with pi", e.text)});
        return value.value_or(0);
    }
    Real3 vector(const Vector& v) {
        return {number(v.component[0]), number(v.component[1]), number(v.component[2])};
    }
    Real3 axis(const Rotation& r) {
        if (r.letter != 0) return Real3::Unit(r.letter - 'x');
        const Real3 a = vector(r.axis);
        if (a.norm() == 0) mistakes_.push_back({r.axis.place, say("an axis is zero; expected a direction")});
        return a;
    }
    RobotPose pose(const Joint::Side& side) {
        RobotPlace at{vector(side.point), Real33::Identity()};
        for (const Rotation& r : side.rotate) {
            Real3 rpy = Real3::Zero();
            if (r.letter != 0) {
                rpy[r.letter - 'x'] = number(r.angle);
                at.R = at.R * RobotPose{Real3::Zero(), rpy}.rotation();
            } else {
                at.R = at.R * Eigen::AngleAxisd(number(r.angle), axis(r).normalized()).toRotationMatrix();
            }
        }
        return at.pose();
    }

    Robot& robot_;
    Scene scene_;
    std::vector<Diagnostic> mistakes_;
};

}  // namespace

void close_loops(Robot& robot, const std::string& file) {
    LoopReader(robot, file).read();
}

}  // namespace alembert
