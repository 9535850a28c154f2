// SPDX-License-Identifier: GPL-2.0-or-later
// MJCF, the format of MuJoCo (its documentation: "Modeling", "XML reference"). A body's joints stand inside it,
// with their points and axes in the body's frame. A body with k joints becomes k links, all along the axes of the
// body, the origin of each at its joint: the last one is the body, the others have no mass.
#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <map>

#include "language/say.hpp"
#include "scene/text.hpp"
#include "scene/text_file.hpp"
#include "urdf/mjcf_values.hpp"

namespace alembert {

namespace {

using Type = Robot::Type;

class MjcfReader {
public:
    MjcfReader(const std::string& text, const std::string& file)
        : file_(text, file), folder_(std::filesystem::path(file).parent_path()) {
        if (std::strcmp(file_.root().Name(), "mujoco") != 0)
            file_.refuse(file_.root(), say("the outermost element is {}; expected <mujoco>", shown(file_.root())));
        file_.include([&](const std::string& name) { return text_of_file((folder_ / name).string()); });
        values_.emplace(file_);
    }

    Robot read() {
        const XmlElement& root = file_.root();
        robot_.name = file_.text(root, "model").value_or("robot");
        robot_.has_world = true;
        robot_.actuators.emplace();
        robot_.links.push_back({.name = "world", .place = {}});
        places_["world"] = {0, {}, Real3::Zero()};
        for (const XmlElement* e : file_.children(root, "option")) read_option(*e);
        for (const XmlElement* world : file_.children(root, "worldbody")) {
            file_.ignore(*world, "childclass");
            read_inside(*world, "world", {});
        }
        for (const XmlElement* e : file_.children(root, "actuator"))
            for (const XmlElement* motor : file_.children(*e)) read_actuator(*motor);
        for (const XmlElement* e : file_.children(root, "equality"))
            for (const XmlElement* equality : file_.children(*e)) read_equality(*equality);
        scale_masses();
        robot_.dropped = file_.left_out();
        robot_.remarks = file_.remarks();
        return std::move(robot_);
    }

private:
    /// A body: its last link, and its place in the reference pose. `origin` is that of the link, in the body.
    struct Body {
        int link;
        RobotPlace place;
        Real3 origin;
    };

    void read_option(const XmlElement& e) {
        if (const auto g = file_.numbers(e, "gravity", 3)) robot_.gravity = {(*g)[0], (*g)[1], (*g)[2]};
        for (const XmlElement* flag : file_.children(e, "flag"))
            if (file_.text(*flag, "gravity") == "disable") robot_.gravity.setZero();
        for (const char* medium : {"density", "viscosity", "wind"})
            if (e.Attribute(medium) != nullptr) file_.drop(fmt::format("<option {}=…>", medium), "");
        file_.ignore(e);
    }

    std::string name_of(const XmlElement& e, const std::string& otherwise) {
        const std::string name = file_.text(e, "name").value_or("");
        return name.empty() ? otherwise : name;
    }
    int add_link(const std::string& name, const XmlElement& e) {
        robot_.links.push_back({.name = name, .place = XmlFile::place_of(e)});
        return static_cast<int>(robot_.links.size()) - 1;
    }
    /// Adds a joint between two links, `at` in the parent.
    Robot::Joint& connect(const XmlElement& e, const std::string& name, Type type, int parent, int child,
                          const RobotPose& at) {
        robot_.links[static_cast<std::size_t>(child)].joint = static_cast<int>(robot_.joints.size());
        robot_.joints.push_back({.name = name,
                                 .place = XmlFile::place_of(e),
                                 .type = type,
                                 .parent = parent,
                                 .child = child,
                                 .at = at,
                                 .axis = Real3::UnitX()});
        return robot_.joints.back();
    }

    /// Bodies and sites inside a body, or inside a <frame> that stands at `offset` in it.
    void read_inside(const XmlElement& e, const std::string& body, const RobotPlace& offset) {
        for (const XmlElement* frame : file_.children(e, "frame")) {
            file_.ignore(*frame, "childclass");
            read_inside(*frame, body, composed(offset, values_->place(*frame)));
        }
        for (const char* tag : {"replicate", "composite", "flexcomp", "attach"})
            if (const XmlElement* const found = e.FirstChildElement(tag))
                file_.refuse(*found,
                             say("<{}> makes bodies by a rule; expected them written out, as MuJoCo saves a "
                                 "compiled model (mj_saveLastXML)",
                                 tag));
        for (const XmlElement* site : file_.children(e, "site")) {
            const std::string name = name_of(*site, "");
            if (!name.empty() && body != "world") {
                const RobotPlace at = composed(offset, values_->place(*site));
                const Body& own = places_.at(body);
                connect(*site, name, Type::fixed, own.link, add_link(name, *site),
                        RobotPose{at.shift - own.origin, at.pose().rpy});
            }
            file_.ignore(*site);
        }
        for (const XmlElement* child : file_.children(e, "body")) read_body(*child, body, offset);
        if (body == "world")
            for (const XmlElement* geom : file_.children(e, "geom")) file_.ignore(*geom);
    }

    void read_body(const XmlElement& e, const std::string& parent_name, const RobotPlace& offset) {
        const std::string name = name_of(e, fmt::format("body{}", places_.size()));
        if (places_.contains(name)) file_.refuse(e, say("a second body is called {}", in_quotes(name)));
        file_.ignore(e, "childclass");
        const Body parent = places_.at(parent_name);
        const RobotPlace own = composed(offset, values_->place(e));
        const RobotPlace global = composed(parent.place, own);
        std::vector<const XmlElement*> joints;
        for (const XmlElement* child : file_.children(e))
            if (std::strcmp(child->Name(), "joint") == 0 || std::strcmp(child->Name(), "freejoint") == 0)
                joints.push_back(child);
        Body body{parent.link, global, Real3::Zero()};
        if (joints.empty()) {
            body.link = add_link(name, e);
            connect(e, name, Type::fixed, parent.link, body.link, {own.shift - parent.origin, own.pose().rpy});
        }
        for (std::size_t k = 0; k < joints.size(); ++k) {
            file_.children(e, joints[k]->Name());
            const bool is_first = k == 0, is_last = k + 1 == joints.size();
            const std::string joint_name =
                name_of(*joints[k], name + (joints.size() == 1 ? "_joint" : fmt::format("_joint{}", k + 1)));
            const int link = add_link(is_last ? name : fmt::format("{}_{}", name, joint_name), e);
            const Real3 point = values_->three(*joints[k], "pos", Real3::Zero());
            const RobotPose at = is_first ? RobotPose{own.shift - parent.origin + own.R * point, own.pose().rpy}
                                          : RobotPose{point - body.origin, Real3::Zero()};
            read_joint(*joints[k], connect(*joints[k], joint_name, Type::revolute, body.link, link, at), global,
                       parent_name == "world" && joints.size() == 1);
            body.link = link;
            body.origin = robot_.joints.back().type == Type::floating ? Real3::Zero() : point;
        }
        read_mass(e, name, body);
        places_[name] = body;
        read_inside(e, name, {});
    }

    void read_joint(const XmlElement& e, Robot::Joint& joint, const RobotPlace& global, bool may_float) {
        const std::string type =
            std::strcmp(e.Name(), "freejoint") == 0 ? "free" : values_->text(e, "type").value_or("hinge");
        const std::map<std::string, Type> types{{"hinge", Type::revolute},
                                                {"slide", Type::prismatic},
                                                {"ball", Type::spherical},
                                                {"free", Type::floating}};
        if (!types.contains(type))
            file_.refuse(e, say("joint {} is of type {}; expected hinge, slide, ball or free",
                                in_quotes(joint.name), in_quotes(type)));
        joint.type = types.at(type);
        for (const char* no_motion : {"group", "user", "margin", "solreflimit", "solimplimit", "solreffriction",
                                      "solimpfriction", "align"})
            file_.ignore(e, no_motion);
        if (joint.type == Type::floating) {
            if (!may_float)
                file_.refuse(e, say("the free joint of {} is not the only joint of a body in <worldbody>",
                                    in_quotes(joint.name)));
            joint.at = {};
            joint.start = global.pose();
        }
        const bool one = joint.type == Type::revolute || joint.type == Type::prismatic;
        const auto value = [&](const char* key) {
            const double result = values_->number(e, key).value_or(0);
            if (one || result == 0) return result;
            file_.drop(fmt::format("<joint {}=…> of ball and free joints", key), joint.name);
            return 0.;
        };
        joint.damping = value("damping");
        joint.armature = value("armature");
        joint.friction = value("frictionloss");
        joint.stiffness = value("stiffness");
        for (const double x : {joint.damping, joint.armature, joint.friction, joint.stiffness})
            if (x < 0)
                file_.refuse(e, say("joint {} has a negative damping, armature, frictionloss or stiffness",
                                    in_quotes(joint.name)));
        if (!one) return;
        joint.axis = values_->three(e, "axis", Real3::UnitZ());
        if (joint.axis.norm() == 0)
            file_.refuse(e, say("the axis of joint {} is zero; expected a direction", in_quotes(joint.name)));
        const auto of_joint = [&](double x) { return joint.type == Type::revolute ? values_->angle(x) : x; };
        const double reference = of_joint(values_->number(e, "ref").value_or(0));
        references_[joint.name] = reference;
        if (reference != 0)
            file_.remark(e, say("{} counts from the reference pose, where MuJoCo's coordinate is {}", joint.name,
                                reference));
        joint.rest = of_joint(values_->number(e, "springref").value_or(0)) - reference;
        const auto range = values_->numbers(e, "range", 2);
        if (range && values_->flag(e, "limited").value_or(values_->autolimits))
            joint.limits = {of_joint((*range)[0]) - reference, of_joint((*range)[1]) - reference};
    }

    void read_mass(const XmlElement& e, const std::string& name, const Body& body) {
        using From = MjcfValues::FromShapes;
        const XmlElement* const inertial = file_.only(e, "inertial");
        const std::vector<const XmlElement*> geoms = file_.children(e, "geom");
        MjcfInertia mass;
        if (values_->from_shapes == From::always || (values_->from_shapes == From::where_missing && !inertial))
            mass = values_->by_shapes(geoms, name);
        else if (inertial != nullptr)
            mass = values_->given(*inertial);
        if (inertial != nullptr) file_.ignore(*inertial);
        for (const XmlElement* geom : geoms) {
            file_.ignore(*geom);
            file_.drop(say("contact and looks of <geom>"), name);
        }
        values_->bound(mass);
        Robot::Link& link = robot_.links[static_cast<std::size_t>(body.link)];
        link.mass = mass.mass;
        link.centre = mass.centre - body.origin;
        link.inertia = mass.inertia;
    }

    void scale_masses() {
        double whole = 0;
        for (const Robot::Link& link : robot_.links) whole += link.mass;
        if (values_->total_mass <= 0 || whole == 0) return;
        for (Robot::Link& link : robot_.links) {
            link.mass *= values_->total_mass / whole;
            link.inertia *= values_->total_mass / whole;
        }
    }

    int joint_named(const XmlElement& e, const std::string& name) const {
        for (std::size_t k = 0; k < robot_.joints.size(); ++k)
            if (robot_.joints[k].name == name && robot_.joints[k].type != Type::fixed) return static_cast<int>(k);
        file_.refuse(e, say("{} names the joint {}, which is none of this model", shown(e), in_quotes(name)));
    }

    /// force = gain u + constant + along·length + rate·velocity, with length = gear·(q + reference)
    void read_actuator(const XmlElement& e) {
        const std::string tag = e.Name(), name = name_of(e, fmt::format("motor{}", robot_.actuators->size() + 1));
        const auto number = [&](const char* key, double otherwise) {
            return values_->number(e, key, "general").value_or(otherwise);
        };
        const auto word = [&](const char* key, const char* otherwise) {
            return values_->text(e, key, "general").value_or(otherwise);
        };
        const bool is_general = tag == "general";
        const auto on = file_.text(e, "joint") ? file_.text(e, "joint") : file_.text(e, "jointinparent");
        const bool is_known = is_general || tag == "motor" || tag == "position" || tag == "velocity";
        if (!is_known || !on) {
            file_.ignore(e);
            return file_.drop(fmt::format("<{}>", tag), name);
        }
        file_.children(*e.Parent()->ToElement(), e.Name());
        for (const char* no_motion : {"class", "group", "user"}) file_.ignore(e, no_motion);
        const int joint = joint_named(e, *on);
        const Robot::Joint& moved = robot_.joints[static_cast<std::size_t>(joint)];
        const bool turns_in_space = moved.type == Type::spherical || moved.type == Type::floating;
        if (turns_in_space || word("dyntype", "none") != "none" || number("timeconst", 0) != 0 ||
            word("gaintype", "fixed") != "fixed" ||
            (is_general && word("biastype", "none") != "none" && word("biastype", "none") != "affine"))
            return file_.drop(say("<{}> with states, or on a ball or free joint", tag), name);
        Robot::Actuator motor{.name = name, .joint = joint};
        if (const auto gear = values_->numbers(e, "gear", 0, "general")) motor.gear = (*gear)[0];
        if (tag == "position") {
            motor.gain = number("kp", 1);
            motor.along = -motor.gain;
            motor.rate = -number("kv", 0);
        } else if (tag == "velocity") {
            motor.gain = number("kv", 1);
            motor.rate = -motor.gain;
        } else if (is_general) {
            if (const auto gain = values_->numbers(e, "gainprm")) motor.gain = (*gain)[0];
            const auto bias = values_->numbers(e, "biasprm");
            if (bias && word("biastype", "none") == "affine") {
                motor.constant = (*bias)[0];
                motor.along = bias->size() > 1 ? (*bias)[1] : 0;
                motor.rate = bias->size() > 2 ? (*bias)[2] : 0;
            }
        }
        motor.constant += motor.along * motor.gear * references_[moved.name];
        robot_.actuators->push_back(std::move(motor));
    }

    const Body& body_named(const XmlElement& e, const char* key) {
        const std::string name = file_.text(e, key).value_or("world");
        const auto found = places_.find(name);
        if (found == places_.end())
            file_.refuse(e, say("{} names the body {}, which is none of this model", shown(e), in_quotes(name)));
        return found->second;
    }

    void read_equality(const XmlElement& e) {
        const std::string tag = e.Name();
        const std::string name =
            name_of(e, fmt::format("{}{}", tag, robot_.loops.size() + robot_.couplings.size() + 1));
        const bool on_bodies = (tag == "connect" || tag == "weld") && e.Attribute("body1") != nullptr;
        if ((!on_bodies && tag != "joint") || values_->flag(e, "active") == false) {
            file_.ignore(e);
            return file_.drop(fmt::format("<{}> of <equality>", tag), name);
        }
        file_.children(*e.Parent()->ToElement(), e.Name());
        for (const char* soft : {"class", "solref", "solimp", "torquescale"}) file_.ignore(e, soft);
        if (tag == "joint") return read_coupling(e, name);
        const Body &one = body_named(e, "body1"), &two = body_named(e, "body2");
        const RobotPlace to_two = composed(inverted(two.place), one.place);
        const Real3 anchor = values_->three(e, "anchor", Real3::Zero());
        if (tag == "connect") {
            robot_.loops.push_back({.name = name,
                                    .type = Type::spherical,
                                    .parent = one.link,
                                    .child = two.link,
                                    .at_parent = {anchor - one.origin, Real3::Zero()},
                                    .at_child = {to_two.shift + to_two.R * anchor - two.origin, Real3::Zero()}});
            return;
        }
        RobotPlace relative = inverted(to_two);
        if (const auto pose = file_.numbers(e, "relpose", 7)) {
            const Eigen::Quaterniond q((*pose)[3], (*pose)[4], (*pose)[5], (*pose)[6]);
            if (q.norm() != 0)
                relative = {{(*pose)[0], (*pose)[1], (*pose)[2]}, q.normalized().toRotationMatrix()};
        }
        robot_.loops.push_back({.name = name,
                                .type = Type::fixed,
                                .parent = one.link,
                                .child = two.link,
                                .at_parent = {relative.shift - one.origin, relative.pose().rpy},
                                .at_child = {-two.origin, Real3::Zero()}});
    }

    void read_coupling(const XmlElement& e, const std::string& name) {
        Robot::Coupling coupling{.name = name, .joint = joint_named(e, file_.needed_text(e, "joint1"))};
        if (const auto other = file_.text(e, "joint2")) coupling.other = joint_named(e, *other);
        const std::vector<double> polynomial =
            values_->numbers(e, "polycoef").value_or(std::vector<double>{0, 1, 0, 0, 0});
        for (std::size_t k = 0; k < std::min<std::size_t>(5, polynomial.size()); ++k)
            if (k == 0 || coupling.other >= 0) coupling.polynomial[k] = polynomial[k];
        robot_.couplings.push_back(coupling);
    }

    XmlFile file_;
    std::filesystem::path folder_;
    std::optional<MjcfValues> values_;
    Robot robot_;
    std::map<std::string, Body> places_;
    std::map<std::string, double> references_;  // by joint: the coordinate of MuJoCo in the reference pose
};

}  // namespace

Robot parse_mjcf(const std::string& text, const std::string& file) {
    return MjcfReader(text, file).read();
}

}  // namespace alembert
