// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/robot.hpp"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "base/language/say.hpp"
#include "scene/import/elements.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr int deepest = 100;  // the deepest nesting of elements

/// The messages that urdfdom prints instead of throwing.
class Complaints : public console_bridge::OutputHandler {
public:
    Complaints() { console_bridge::useOutputHandler(this); }
    ~Complaints() override { console_bridge::restorePreviousOutputHandler(); }
    void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
        if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) said.push_back(text);
    }
    std::vector<std::string> said;
};

class Reader {
public:
    Reader(const std::string& text, const std::string& file) : text_(text), elements_(file) {}

    Robot read() {
        check_depth();
        document_.Parse(text_.c_str(), nullptr, TIXML_ENCODING_UTF8);
        if (document_.Error())
            refuse({document_.ErrorRow(), document_.ErrorCol()},
                   say("this is no XML: {}; expected a robot description, <robot name=…>", document_.ErrorDesc()));
        const TiXmlElement* root = document_.RootElement();
        if (root == nullptr || root->ValueStr() != "robot")
            refuse(root != nullptr ? place_of(*root) : Place{},
                   say("the outermost element is {}; expected <robot>",
                       root != nullptr ? shown(*root) : say("missing")));
        refuse_macros(*root);
        for (const TiXmlElement* e = root->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
            const std::string& tag = e->ValueStr();
            if (tag == "link")
                add_link(*e);
            else if (tag == "joint")
                read_joint(*e);
            else if (tag != "transmission")
                drop(fmt::format("<{}>", tag), named(*e), effect_of(*e));
        }
        check_by_urdfdom(*root);
        robot_.name = model_->getName();
        if (model_->links_.size() > robot_.links.size()) {  // the link `world`, which was added for urdfdom
            link_of_["world"] = static_cast<int>(robot_.links.size());
            robot_.links.push_back({.name = "world", .place = {}});
        }
        auto numbers = joints_read_.begin();
        for (const TiXmlElement* e = root->FirstChildElement("joint"); e != nullptr;
             e = e->NextSiblingElement("joint"))
            add_joint(*e, std::move(*numbers++));
        for (const TiXmlElement* e = root->FirstChildElement("joint"); e != nullptr;
             e = e->NextSiblingElement("joint"))
            add_mimic(*e);
        check_tree();
        for (Robot::Joint& joint : robot_.joints) resolve(joint);
        for (const TiXmlElement* e = root->FirstChildElement("transmission"); e != nullptr;
             e = e->NextSiblingElement("transmission"))
            read_transmission(*e);
        robot_.remarks = elements_.remarks();
        return std::move(robot_);
    }

private:
    [[noreturn]] void refuse(const Place& place, const std::string& why) const { elements_.refuse(place, why); }
    static Place place_of(const TiXmlElement& e) { return Elements::place_of(e); }
    /// The name in the form that urdfdom gets (checkable), with one blank between words.
    static std::string named(const TiXmlElement& e) {
        for (const char* key : {"name", "reference"})
            if (const char* value = e.Attribute(key)) {
                std::istringstream words(value);
                std::string name;
                for (std::string word; words >> word;) name += (name.empty() ? "" : " ") + word;
                return name;
            }
        return "";
    }
    /// Refuses a description about which urdfdom complains, at the link or joint that it names.
    void check_by_urdfdom(const TiXmlElement& root) {
        TiXmlPrinter printer;
        checkable(document_, elements_).Accept(&printer);
        Complaints complaints;
        model_ = urdf::parseURDF(printer.Str());
        if (model_ && complaints.said.empty()) return;
        const std::string said = complaints.said.empty() ? say("no reason given") : complaints.said.front();
        Place place{};
        for (const TiXmlElement* e = root.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
            if (const std::string name = named(*e); place.line == 0 && !name.empty() &&
                                                    (said.find("[" + name + "]") != std::string::npos ||
                                                     said.find("'" + name + "'") != std::string::npos))
                place = place_of(*e);
        refuse(place, say("urdfdom refuses it: {}", escaped(said, 300)));
    }
    void drop_unknown(const TiXmlElement& e, const std::string& of) {
        const Effect effect = e.ValueStr() == "limit" ? Effect::driven : Effect::motion;
        for (const std::string& what : elements_.unknown_attributes(e)) drop(what, of, effect);
        for (const TiXmlElement* child = e.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement())
            drop_unknown(*child, of);
    }
    using Effect = Robot::Effect;
    /// The effect of an element that is not read. Of what Gazebo adds, it is that of a damping or of a link that
    /// does not fall; looks, contacts and the programs that it starts leave the motion as it is.
    static Effect effect_of(const TiXmlElement& e) {
        static const std::set<std::string> known{"visual",       "collision", "material",
                                                 "transmission", "sensor",    "safety_controller",
                                                 "calibration",  "frame",     "drake:collision_filter_group",
                                                 "verbose",      "contact",   "self_collision_checking"};
        if (e.ValueStr() != "gazebo") return known.contains(e.ValueStr()) ? Effect::none : Effect::motion;
        for (const char* moves : {"dampingFactor", "turnGravityOff", "springStiffness", "static", "kinematic"})
            if (e.FirstChildElement(moves) != nullptr) return Effect::motion;
        return Effect::none;
    }
    void drop(const std::string& what, const std::string& of, Effect effect = Effect::none) {
        auto found = std::find_if(robot_.dropped.begin(), robot_.dropped.end(),
                                  [&](const Robot::Dropped& d) { return d.what == what && d.effect == effect; });
        if (found == robot_.dropped.end()) found = robot_.dropped.insert(found, {what, {}, effect});
        if (!of.empty() && (found->of.empty() || found->of.back() != of)) found->of.push_back(of);
    }

    /// The depth is limited, because TinyXML works recursively.
    void check_depth() const {
        int depth = 0;
        for (std::size_t i = text_.find('<'); i != std::string::npos; i = text_.find('<', i + 1)) {
            const auto skip_to = [&](const char* end) { i = std::min(text_.find(end, i), text_.size() - 1); };
            if (text_.compare(i, 4, "<!--") == 0) {
                skip_to("-->");
            } else if (text_.compare(i, 9, "<![CDATA[") == 0) {
                skip_to("]]>");
            } else if (i + 1 < text_.size() && text_[i + 1] == '/') {
                --depth;
            } else if (i + 1 < text_.size() &&
                       (std::isalpha(static_cast<unsigned char>(text_[i + 1])) != 0 || text_[i + 1] == '_')) {
                const std::size_t end = text_.find('>', i);
                if (end == std::string::npos || text_[end - 1] != '/') ++depth;
            }
            if (depth > deepest)
                refuse({}, say("more than {} elements stand inside each other; a robot description has five or so",
                               deepest));
        }
    }

    void refuse_macros(const TiXmlElement& e) const {
        if (e.ValueStr().starts_with("xacro:"))
            refuse(place_of(e), say("{} is a macro of xacro; expected plain URDF: expand it first, as in "
                                    "xacro robot.urdf.xacro > robot.urdf",
                                    shown(e)));
        for (const TiXmlElement* child = e.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement())
            refuse_macros(*child);
    }

    void add_link(const TiXmlElement& e) {
        Robot::Link link;
        link.name = named(e);
        link.place = place_of(e);
        for (const TiXmlElement* child = e.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement())
            if (child->ValueStr() != "inertial")
                drop(fmt::format("<{}>", child->ValueStr()), link.name, effect_of(*child));
        if (const TiXmlElement* const inertial = elements_.only(e, "inertial")) {
            elements_.read_inertial(*inertial, link);
            drop_unknown(*inertial, link.name);
        }
        link_of_[link.name] = static_cast<int>(robot_.links.size());
        robot_.links.push_back(std::move(link));
    }

    /// Reads the numbers of a joint; type, parent and child come from urdfdom.
    void read_joint(const TiXmlElement& e) {
        Robot::Joint joint{.name = named(e),
                           .place = place_of(e),
                           .type = Robot::Type::fixed,
                           .parent = -1,
                           .child = -1,
                           .at = elements_.pose(elements_.only(e, "origin")),
                           .axis = Real3::UnitX()};
        if (const TiXmlElement* const axis = elements_.only(e, "axis"))
            joint.axis = elements_.three(*axis, "xyz", Real3::Zero());
        if (const TiXmlElement* const dynamics = elements_.only(e, "dynamics")) {
            joint.damping = elements_.number(*dynamics, "damping").value_or(0);
            if (joint.damping < 0)
                refuse(joint.place, say("the damping of joint {} is {}; expected zero or more",
                                        in_quotes(joint.name), joint.damping));
            joint.friction = elements_.number(*dynamics, "friction").value_or(0);
        }
        if (const TiXmlElement* const limit = elements_.only(e, "limit"))
            if (limit->Attribute("lower") != nullptr || limit->Attribute("upper") != nullptr)
                joint.limits = {elements_.number(*limit, "lower").value_or(0),
                                elements_.number(*limit, "upper").value_or(0)};
        if (const TiXmlElement* const mimic = elements_.only(e, "mimic"))
            joint.mimic = Robot::Mimic{-1, elements_.number(*mimic, "multiplier").value_or(1),
                                       elements_.number(*mimic, "offset").value_or(0)};
        for (const char* tag : {"parent", "child"}) elements_.only(e, tag);
        drop_unknown(e, joint.name);
        joints_read_.push_back(std::move(joint));
    }

    void add_joint(const TiXmlElement& e, Robot::Joint joint) {
        const urdf::JointConstSharedPtr known = model_->getJoint(joint.name);
        using Known = urdf::Joint;
        const std::map<int, Robot::Type> types{
            {Known::REVOLUTE, Robot::Type::revolute},   {Known::CONTINUOUS, Robot::Type::continuous},
            {Known::PRISMATIC, Robot::Type::prismatic}, {Known::FLOATING, Robot::Type::floating},
            {Known::PLANAR, Robot::Type::planar},       {Known::FIXED, Robot::Type::fixed}};
        joint.type = types.at(known->type);
        joint.parent = link_of_.at(known->parent_link_name);
        joint.child = link_of_.at(known->child_link_name);
        const bool is_hinge = joint.type == Robot::Type::revolute || joint.type == Robot::Type::prismatic;
        if (joint.type == Robot::Type::fixed || joint.type == Robot::Type::floating)
            joint.axis = Real3::UnitX();
        else if (joint.axis.norm() == 0)
            refuse(joint.place, say("the axis of joint {} is zero; expected a direction", in_quotes(joint.name)));
        if (joint.damping != 0 && (joint.type == Robot::Type::floating || joint.type == Robot::Type::planar ||
                                   joint.type == Robot::Type::fixed))
            drop(say("damping of a floating, planar or fixed joint"), joint.name,
                 joint.type == Robot::Type::fixed ? Effect::none : Effect::motion);
        if (!is_hinge && joint.limits) {
            drop("<limit lower=… upper=…>", joint.name,
                 joint.type == Robot::Type::planar ? Effect::motion : Effect::none);
            joint.limits.reset();
        }
        if (const TiXmlElement* const limit = e.FirstChildElement("limit"))
            for (const char* key : {"effort", "velocity"})
                if (limit->Attribute(key) != nullptr)
                    drop(fmt::format("<limit {}=…>", key), joint.name, Effect::driven);
        for (const TiXmlElement* child = e.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement()) {
            const std::string& tag = child->ValueStr();
            const std::array kept{"parent", "child", "origin", "axis", "mimic", "dynamics", "limit"};
            if (std::find(kept.begin(), kept.end(), tag) == kept.end())
                drop(fmt::format("<{}>", tag), joint.name, effect_of(*child));
        }
        int& above = robot_.links[static_cast<std::size_t>(joint.child)].joint;
        if (above >= 0)
            refuse(joint.place,
                   say("joint {} holds link {}, which joint {} holds already; a robot "
                       "description is a tree, loops are closed by joints in a file of their own (--loops)",
                       in_quotes(joint.name), in_quotes(known->child_link_name),
                       in_quotes(robot_.joints[static_cast<std::size_t>(above)].name)));
        above = static_cast<int>(robot_.joints.size());
        joint_of_[joint.name] = above;
        robot_.joints.push_back(std::move(joint));
    }

    void add_mimic(const TiXmlElement& e) {
        Robot::Joint& joint = robot_.joints[static_cast<std::size_t>(joint_of_.at(named(e)))];
        const auto mimic = model_->getJoint(joint.name)->mimic;
        if (!mimic || joint.type == Robot::Type::fixed) return joint.mimic.reset();
        const auto found = joint_of_.find(mimic->joint_name);
        if (found == joint_of_.end())
            refuse(joint.place, say("joint {} mimics {}, which is no joint of this robot", in_quotes(joint.name),
                                    in_quotes(mimic->joint_name)));
        for (const Robot::Joint* both :
             {static_cast<const Robot::Joint*>(&joint),
              static_cast<const Robot::Joint*>(&robot_.joints[static_cast<std::size_t>(found->second)])})
            if (both->type == Robot::Type::planar || both->type == Robot::Type::floating)
                refuse(joint.place,
                       say("joint {} mimics {}: joint {} has more than one coordinate; expected revolute, "
                           "continuous or prismatic joints",
                           in_quotes(joint.name), in_quotes(mimic->joint_name), in_quotes(both->name)));
        joint.mimic->joint = found->second;
    }

    /// A joint that mimics a follower follows the leader of that one; a joint that mimics a fixed joint does not
    /// move.
    void resolve(Robot::Joint& joint) {
        for (std::size_t steps = 0; joint.mimic; ++steps) {
            const Robot::Joint& leader = robot_.joints[static_cast<std::size_t>(joint.mimic->joint)];
            if (!leader.mimic) return;
            if (steps > robot_.joints.size())
                refuse(joint.place, say("joint {} mimics itself in a circle", in_quotes(joint.name)));
            joint.mimic = Robot::Mimic{leader.mimic->joint, joint.mimic->factor * leader.mimic->factor,
                                       joint.mimic->factor * leader.mimic->offset + joint.mimic->offset};
        }
    }

    /// Reads the rotor behind a gear: n² J of <mechanicalReduction> or Drake's gear_ratio and rotor_inertia. A
    /// ratio alone does not change the motion.
    void read_transmission(const TiXmlElement& e) {
        const auto value = [&](const TiXmlElement& of, std::initializer_list<const char*> tags) {
            std::optional<double> result;
            for (const char* tag : tags)
                if (const TiXmlElement* const child = of.FirstChildElement(tag))
                    result = child->Attribute("value") != nullptr ? elements_.number(*child, "value")
                                                                  : elements_.number_inside(*child);
            return result;
        };
        std::vector<int> joints;
        double ratio = value(e, {"mechanicalReduction"}).value_or(1);
        std::optional<double> rotor;
        for (const TiXmlElement* child = e.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement()) {
            if (child->ValueStr() != "joint" && child->ValueStr() != "actuator") continue;
            if (const auto found = joint_of_.find(named(*child));
                child->ValueStr() == "joint" && found != joint_of_.end())
                joints.push_back(found->second);
            ratio = value(*child, {"mechanicalReduction", "drake:gear_ratio", "gear_ratio"}).value_or(ratio);
            if (const auto inertia = value(*child, {"drake:rotor_inertia", "rotor_inertia", "rotorInertia"}))
                rotor = inertia;
        }
        if (!rotor || joints.size() != 1)
            return drop("<transmission>", named(e), rotor ? Effect::motion : Effect::none);
        if (*rotor < 0)
            refuse(place_of(e), say("the rotor inertia of transmission {} is {}; expected zero or more",
                                    in_quotes(named(e)), *rotor));
        robot_.joints[static_cast<std::size_t>(joints[0])].armature += ratio * ratio * *rotor;
    }

    void check_tree() {
        robot_.root = link_of_.at(model_->getRoot()->name);
        for (const Robot::Link& link : robot_.links) {
            const Robot::Link* at = &link;
            for (std::size_t steps = 0; at->joint >= 0; ++steps) {
                if (steps > robot_.links.size())
                    refuse(link.place,
                           say("link {} hangs on itself in a circle of joints; expected a tree from one root",
                               in_quotes(link.name)));
                at = &robot_.links[static_cast<std::size_t>(
                    robot_.joints[static_cast<std::size_t>(at->joint)].parent)];
            }
        }
    }

    const std::string& text_;
    Elements elements_;
    TiXmlDocument document_;
    urdf::ModelInterfaceSharedPtr model_;
    Robot robot_;
    std::vector<Robot::Joint> joints_read_;
    std::map<std::string, int> link_of_, joint_of_;
};

}  // namespace

Robot parse_urdf(const std::string& text, const std::string& file) {
    return Reader(text, file).read();
}

}  // namespace alembert
