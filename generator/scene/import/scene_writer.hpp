// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A robot while it becomes the text of a scene. Only robot_scene.cpp, robot_joints.cpp, robot_loads.cpp and
/// robot_tendons.cpp use this.

#include <map>
#include <set>

#include "scene/import/robot_scene.hpp"
#include "scene/import/scene_words.hpp"
#include "scene/import/welded.hpp"

namespace alembert {

class SceneWriter {
public:
    SceneWriter(const Robot& robot, const RobotSceneOptions& options);
    /// Once.
    RobotScene write();

private:
    /// A body, with its names in the scene.
    struct Group : WeldedBody {
        std::string name = "N";
        std::string frame = "N";
        std::string centre_name =
            "O";  ///< of its mass centre; that of the body where its link has its origin there
    };
    /// A place in a body, relative to its mass centre, and the turns that lead to it.
    struct Stand {
        const Group* parent;
        Real3 point;
        std::vector<std::string> rotate;
    };

    const Robot::Link& link(int i) const { return robot_.links[static_cast<std::size_t>(i)]; }
    const Seat& seat(int i) const { return seats_[static_cast<std::size_t>(i)]; }
    std::size_t index(const Robot::Joint& joint) const {
        return static_cast<std::size_t>(&joint - robot_.joints.data());
    }

    // robot_scene.cpp: names and bodies
    void name_all();
    void head();
    void body(const Group& g, const std::string& placing = "");
    void mounted(const Group& group);
    void drop_the_rest();
    void map_names();
    void drop(const std::string& what, std::vector<std::string> of, Robot::Effect effect = Robot::Effect::none);
    static std::vector<std::string> turns_of(const Seat& at);
    static void add_turns(std::vector<std::string>& list, const Real3& rpy);
    Stand stand(int link, const RobotPose& at) const;

    // robot_joints.cpp
    std::string coordinate(const Robot::Joint* of, const std::string& name, const std::string& unit,
                           const std::string& about = "", double initial = 0, double rate = 0);
    void choose_starts();
    void start_at_keyframe();
    RobotPose start_of(const Robot::Joint& joint) const;  ///< of one that turns in space
    /// The rates of the coordinates of joint `of` in the keyframe; zeros without one.
    std::vector<double> rates_of(const Robot::Joint* of, const RobotPose& start) const;
    std::vector<std::string> turning(const Robot::Joint* of, const std::string& name, const RobotPose& start);
    void joint_table(const std::string& name, const std::string& type, const Stand& parent, const Stand& child,
                     const std::string& rest);
    void free_joint(const Robot::Joint* joint, const std::string& own, const std::string& name, const Group& child,
                    const Stand& parent, const RobotPose& start);
    void mover(const Robot::Joint& joint, const Group& child);
    void hinge(const Robot::Joint& joint, const Group& child, const Stand& at);
    void several(const Robot::Joint& joint, const Group& child, Stand at);
    void follower(const Robot::Joint& joint, Group& child);
    void loop(const Robot::Loop& loop);

    // robot_loads.cpp
    void damper(const Robot::Joint& joint, const std::string& along);
    void spring(const Robot::Joint& joint, const std::string& along);
    void friction(const Robot::Joint& joint, const std::string& q);
    void stops(const Robot::Joint& joint, const std::string& q);
    void drive(const Robot::Joint& joint, const std::string& q, bool slides);
    void actuators();
    std::string control_of(const Robot::Actuator& motor, double value);
    bool push_with(const Robot::Actuator& motor, double control);
    void coupling(const Robot::Coupling& coupling);

    // robot_tendons.cpp: what acts on several coordinates
    void held(const Group& group);
    void in_space(const Robot::Joint& joint, const Group& child, const std::vector<std::string>& shifts);
    void tendon(const Robot::Tendon& tendon, std::string& length);
    void tendon_stops(const Robot::Tendon& tendon, const std::string& length);
    std::string length_of(const Robot::Tendon& tendon);
    std::string point_of(int link, const Real3& inside, const std::string& wanted);
    void energies();

    const Robot& robot_;
    RobotSceneOptions options_;
    std::vector<Group> groups_;
    std::vector<Seat> seats_;
    SceneNames places_, values_, joints_taken_;
    std::vector<std::string> joint_names_, values_of_;  // for each joint of the robot
    std::vector<std::string> link_names_;               // of links that are fixed to others
    std::vector<double> starts_;                        // of those with one coordinate
    const Robot::Keyframe* keyframe_ = nullptr;         // in which the scene starts
    std::set<int> guessed_;                             // joints whose start may move
    bool all_guessed_ = false;
    std::vector<std::string> lengths_;  // of each tendon in coordinates; empty if it moves no mass
    std::string joints_, dampers_, springs_, frictions_, stops_, inputs_, conditions_, points_;
    std::string kinetic_, dissipation_;                        // sums
    std::vector<std::pair<std::string, std::string>> forces_;  // coordinate, sum of forces
    std::set<std::string> with_friction_, with_stops_;         // joints
    RobotScene result_;
};

}  // namespace alembert
