// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A file of MuJoCo while it becomes a robot. mjcf.cpp reads the tree of bodies, mjcf_actions.cpp and
/// mjcf_motors.cpp what acts on it and what ties it together; only these use this.

#include <map>
#include <set>

#include "scene/import/mjcf_values.hpp"
#include "scene/import/other_files.hpp"
#include "scene/import/robot_pose.hpp"

namespace alembert {

class MjcfReader {
public:
    MjcfReader(const std::string& text, const std::string& file, const OtherFiles& others);
    /// Once.
    Robot read();

private:
    /// A body: its last link, and its place in the reference pose. `origin` is that of the link, in the body.
    struct Body {
        int link;
        RobotPlace place;
        Real3 origin;
    };
    /// A place in a link.
    struct Site {
        int link;
        RobotPlace place;
    };
    using Effect = Robot::Effect;

    // mjcf.cpp: the tree
    /// The effect of what nobody asked for: of an element, or of its attribute.
    static Effect effect_of(const std::string& element, const std::string& attribute);
    void read_option(const XmlElement& e);
    void read_inside(const XmlElement& e, const std::string& body, const RobotPlace& offset);
    void read_site(const XmlElement& e, const std::string& body, const RobotPlace& offset);
    void read_body(const XmlElement& e, const std::string& parent_name, const RobotPlace& offset);
    void read_joint(const XmlElement& e, Robot::Joint& joint, const RobotPlace& frame);
    void read_floating(const XmlElement& e, Robot::Joint& joint, const RobotPlace& global, bool may_float);
    void read_mass(const XmlElement& e, const std::vector<MjcfPart>& parts, const std::string& name,
                   const Body& body);
    void scale_masses();
    std::string name_of(const XmlElement& e, const std::string& otherwise);
    int add_link(const std::string& name, const XmlElement& e);
    Robot::Joint& connect(const XmlElement& e, const std::string& name, Robot::Type type, int parent, int child,
                          const RobotPose& at);
    /// The joints, shapes and inertias of a body, also those inside <frame>s.
    void gather(const XmlElement& e, const RobotPlace& offset, std::vector<MjcfPart>& parts);

    // mjcf_actions.cpp: springs, tendons, equalities, states; mjcf_motors.cpp: motors
    bool is_off(const char* what) const { return disabled_.contains(what); }
    /// Equalities, limits and dry friction, which MuJoCo counts as constraints.
    bool is_off_constraint(const char* what) const { return is_off(what) || is_off("constraint"); }
    void switch_off();
    void tell_defaults(const XmlElement& e, const std::string& of, const char* or_as,
                       const std::set<std::string>& known);
    double first_number(const XmlElement& e, const char* key, const std::string& of, const char* or_as = nullptr);
    int joint_named(const XmlElement& e, const std::string& name) const;
    const Site& site_named(const XmlElement& e, const std::string& name) const;
    const Body& body_named(const XmlElement& e, const char* key);
    void read_tendon(const XmlElement& e);
    void read_fixed(const XmlElement& e, Robot::Tendon& tendon);
    bool read_path(const XmlElement& e, Robot::Tendon& tendon);
    void finish_tendons();
    void read_actuator(const XmlElement& e);
    /// The law of a motor: force = gain·u + bias[0] + bias[1]·length + bias[2]·velocity.
    struct Law {
        std::vector<double> gain{1}, bias{0, 0, 0};
        std::string dynamics = "none", gain_type = "fixed", bias_type = "none";
        bool is_known = true;
        /// Whether it is a constant gain and a bias that is affine in length and rate, in numbers that are known.
        bool is_affine() const;
    };
    Law law_of(const XmlElement& e);
    void change_law(const XmlElement& e, Law& law);
    std::optional<std::string> take_motor_of(const XmlElement& e, Robot::Actuator& motor);
    void set_damping_ratio(const XmlElement& e, Robot::Actuator& motor);
    void read_key(const XmlElement& e);
    void read_equality(const XmlElement& e);
    void read_loop(const XmlElement& e, const std::string& name);
    void read_coupling(const XmlElement& e, const std::string& name);
    void set_spring_dampers();

    XmlFile file_;
    NamedFiles named_;
    std::optional<MjcfValues> values_;
    Robot robot_;
    std::map<std::string, Body> places_;
    std::map<std::string, Site> sites_;
    std::map<std::string, double> references_;  // by joint: the coordinate of MuJoCo in the reference pose
    std::map<std::string, int> tendons_;        // in the robot, or −1 for one that cannot be had
    std::vector<std::size_t> rests_;            // tendons that are slack in the pose of the springs
    std::map<std::size_t, std::array<double, 2>> spring_dampers_;  // by joint: time constant, damping ratio
    std::optional<ReferenceMass> reference_;
    int motors_ = 0;                  // of the file
    std::vector<int> motor_numbers_;  // of those that are had
    std::set<std::string> disabled_;  // by <flag>
};

}  // namespace alembert
