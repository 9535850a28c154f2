// SPDX-License-Identifier: GPL-2.0-or-later
#include "urdf/robot.hpp"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "alembert/inertia.hpp"
#include "scene/text.hpp"
#include "scene/text_file.hpp"

namespace alembert {

namespace {

constexpr int deepest = 100;  // elements inside each other

/// What urdfdom says instead of throwing.
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
    Reader(const std::string& text, const std::string& file) : text_(text), file_(file) {}

    Robot read() {
        check_depth();
        document_.Parse(text_.c_str(), nullptr, TIXML_ENCODING_UTF8);
        if (document_.Error())
            refuse({document_.ErrorRow(), document_.ErrorCol()},
                   fmt::format("this is no XML: {}; expected a robot description, <robot name=…>",
                               document_.ErrorDesc()));
        const TiXmlElement* root = document_.RootElement();
        if (root == nullptr || root->ValueStr() != "robot")
            refuse(root != nullptr ? place_of(*root) : Place{},
                   fmt::format("the outermost element is {}; expected <robot>",
                               root != nullptr ? shown(*root) : "missing"));
        refuse_macros(*root);
        Complaints complaints;
        model_ = urdf::parseURDF(text_);
        if (!model_)
            refuse({}, fmt::format("urdfdom refuses it: {}", complaints.said.empty()
                                                                 ? "no reason given"
                                                                 : escaped(complaints.said.front(), 300)));
        robot_.name = model_->getName();
        for (const TiXmlElement* e = root->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
            const std::string& tag = e->ValueStr();
            if (tag == "link")
                add_link(*e);
            else if (tag != "joint")
                drop(fmt::format("<{}>", tag), named(*e));
        }
        for (const TiXmlElement* e = root->FirstChildElement("joint"); e != nullptr;
             e = e->NextSiblingElement("joint"))
            add_joint(*e);
        for (const TiXmlElement* e = root->FirstChildElement("joint"); e != nullptr;
             e = e->NextSiblingElement("joint"))
            add_mimic(*e);
        check_tree();
        for (Robot::Joint& joint : robot_.joints) resolve(joint);
        return std::move(robot_);
    }

private:
    [[noreturn]] void refuse(const Place& place, const std::string& why) const {
        const std::string where = place.line > 0 ? fmt::format(":{}:{}", place.line, place.column) : "";
        throw SceneError(fmt::format("{}{}: {}", file_, where, why), {{place, why}});
    }
    static Place place_of(const TiXmlElement& e) { return {e.Row(), e.Column()}; }
    static std::string shown(const TiXmlElement& e) { return "<" + escaped(e.ValueStr()) + ">"; }
    static std::string named(const TiXmlElement& e) {
        for (const char* key : {"name", "reference"})
            if (const char* value = e.Attribute(key)) return value;
        return "";
    }
    void drop(const std::string& what, const std::string& of) {
        auto found = std::find_if(robot_.dropped.begin(), robot_.dropped.end(),
                                  [&](const Robot::Dropped& d) { return d.what == what; });
        if (found == robot_.dropped.end()) found = robot_.dropped.insert(found, {what, {}});
        if (!of.empty() && (found->of.empty() || found->of.back() != of)) found->of.push_back(of);
    }

    /// TinyXML goes down by recursion.
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
                refuse({}, fmt::format(
                               "more than {} elements stand inside each other; a robot description has five or so",
                               deepest));
        }
    }

    void refuse_macros(const TiXmlElement& e) const {
        if (e.ValueStr().starts_with("xacro:"))
            refuse(place_of(e), fmt::format("{} is a macro of xacro; expected plain URDF: expand it first, as in "
                                            "xacro robot.urdf.xacro > robot.urdf",
                                            shown(e)));
        for (const TiXmlElement* child = e.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement())
            refuse_macros(*child);
    }

    double finite(double value, const TiXmlElement& e, const char* what) const {
        if (!std::isfinite(value))
            refuse(place_of(e), fmt::format("{} of {} is not finite", what, in_quotes(named(e))));
        return value;
    }
    Real3 finite(const urdf::Vector3& v, const TiXmlElement& e, const char* what) const {
        return {finite(v.x, e, what), finite(v.y, e, what), finite(v.z, e, what)};
    }

    /// Angles as they are written: urdfdom keeps a quaternion.
    RobotPose pose(const urdf::Pose& known, const TiXmlElement* inside, const TiXmlElement& owner) const {
        RobotPose result{.shift = finite(known.position, owner, "the origin")};
        const TiXmlElement* origin = inside != nullptr ? inside->FirstChildElement("origin") : nullptr;
        if (const char* angles = origin != nullptr ? origin->Attribute("rpy") : nullptr) {
            urdf::Vector3 rpy;
            try {
                rpy.init(angles);
            } catch (const urdf::ParseError&) {
                refuse(place_of(*origin),
                       fmt::format("rpy=\"{}\"; expected three numbers, roll, pitch and yaw", escaped(angles)));
            }
            result.rpy = finite(rpy, owner, "the origin's rpy");
        }
        return result;
    }

    void add_link(const TiXmlElement& e) {
        Robot::Link link;
        link.name = named(e);
        link.place = place_of(e);
        for (const TiXmlElement* child = e.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement())
            if (child->ValueStr() != "inertial") drop(fmt::format("<{}>", child->ValueStr()), link.name);
        if (const auto inertial = model_->getLink(link.name)->inertial) {
            const RobotPose at = pose(inertial->origin, e.FirstChildElement("inertial"), e);
            link.mass = finite(inertial->mass, e, "the mass");
            if (link.mass < 0)
                refuse(link.place, fmt::format("the mass of link {} is {}; expected zero or more",
                                               in_quotes(link.name), link.mass));
            link.centre = at.shift;
            const Real33 own =
                inertia_matrix<double>({finite(inertial->ixx, e, "ixx"), finite(inertial->iyy, e, "iyy"),
                                        finite(inertial->izz, e, "izz"), finite(inertial->ixy, e, "ixy"),
                                        finite(inertial->iyz, e, "iyz"), finite(inertial->ixz, e, "ixz")});
            link.inertia = turned<double>(own, at.rotation());
            if (const PrincipalAxes<> principal = principal_axes<double>(own); has_negative_moment(principal))
                refuse(link.place, fmt::format("the principal moments of inertia of link {}, {:.6g}, {:.6g} and "
                                               "{:.6g}, are not all zero or more",
                                               in_quotes(link.name), principal.moments[0], principal.moments[1],
                                               principal.moments[2]));
        }
        link_of_[link.name] = static_cast<int>(robot_.links.size());
        robot_.links.push_back(std::move(link));
    }

    void add_joint(const TiXmlElement& e) {
        const urdf::JointConstSharedPtr known = model_->getJoint(named(e));
        using Known = urdf::Joint;
        const std::map<int, Robot::Type> types{
            {Known::REVOLUTE, Robot::Type::revolute},   {Known::CONTINUOUS, Robot::Type::continuous},
            {Known::PRISMATIC, Robot::Type::prismatic}, {Known::FLOATING, Robot::Type::floating},
            {Known::PLANAR, Robot::Type::planar},       {Known::FIXED, Robot::Type::fixed}};
        Robot::Joint joint{.name = known->name,
                           .place = place_of(e),
                           .type = types.at(known->type),
                           .parent = link_of_.at(known->parent_link_name),
                           .child = link_of_.at(known->child_link_name),
                           .at = pose(known->parent_to_joint_origin_transform, &e, e),
                           .axis = finite(known->axis, e, "the axis")};
        if (joint.type == Robot::Type::fixed || joint.type == Robot::Type::floating)
            joint.axis = Real3::UnitX();
        else if (joint.axis.norm() == 0)
            refuse(joint.place,
                   fmt::format("the axis of joint {} is zero; expected a direction", in_quotes(joint.name)));
        if (known->dynamics) {
            joint.damping = finite(known->dynamics->damping, e, "the damping");
            if (joint.damping < 0)
                refuse(joint.place, fmt::format("the damping of joint {} is {}; expected zero or more",
                                                in_quotes(joint.name), joint.damping));
            if (known->dynamics->friction != 0) drop("Coulomb friction, <dynamics friction=…>", joint.name);
            if (joint.damping != 0 && (joint.type == Robot::Type::floating || joint.type == Robot::Type::planar ||
                                       joint.type == Robot::Type::fixed))
                drop("damping of a floating, planar or fixed joint", joint.name);
        }
        if (known->limits && (joint.type == Robot::Type::revolute || joint.type == Robot::Type::prismatic))
            joint.limits = {known->limits->lower, known->limits->upper};
        for (const TiXmlElement* child = e.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement()) {
            const std::string& tag = child->ValueStr();
            const std::array kept{"parent", "child", "origin", "axis", "mimic", "dynamics"};
            if (std::find(kept.begin(), kept.end(), tag) == kept.end()) drop(fmt::format("<{}>", tag), joint.name);
        }
        int& above = robot_.links[static_cast<std::size_t>(joint.child)].joint;
        if (above >= 0)
            refuse(joint.place, fmt::format("joint {} holds link {}, which joint {} holds already; a robot "
                                            "description is a tree, loops are added to the scene as joints",
                                            in_quotes(joint.name), in_quotes(known->child_link_name),
                                            in_quotes(robot_.joints[static_cast<std::size_t>(above)].name)));
        above = static_cast<int>(robot_.joints.size());
        joint_of_[joint.name] = above;
        robot_.joints.push_back(std::move(joint));
    }

    void add_mimic(const TiXmlElement& e) {
        Robot::Joint& joint = robot_.joints[static_cast<std::size_t>(joint_of_.at(named(e)))];
        const auto mimic = model_->getJoint(joint.name)->mimic;
        if (!mimic || joint.type == Robot::Type::fixed) return;
        const auto found = joint_of_.find(mimic->joint_name);
        if (found == joint_of_.end())
            refuse(joint.place, fmt::format("joint {} mimics {}, which is no joint of this robot",
                                            in_quotes(joint.name), in_quotes(mimic->joint_name)));
        for (const Robot::Joint* both :
             {static_cast<const Robot::Joint*>(&joint),
              static_cast<const Robot::Joint*>(&robot_.joints[static_cast<std::size_t>(found->second)])})
            if (both->type == Robot::Type::planar || both->type == Robot::Type::floating)
                refuse(joint.place,
                       fmt::format("joint {} mimics {}: joint {} has more than one coordinate; expected revolute, "
                                   "continuous or prismatic joints",
                                   in_quotes(joint.name), in_quotes(mimic->joint_name), in_quotes(both->name)));
        joint.mimic = Robot::Mimic{found->second, finite(mimic->multiplier, e, "the multiplier of <mimic>"),
                                   finite(mimic->offset, e, "the offset of <mimic>")};
    }

    /// Who mimics a follower follows its leader; who mimics a fixed joint stands still.
    void resolve(Robot::Joint& joint) {
        for (std::size_t steps = 0; joint.mimic; ++steps) {
            const Robot::Joint& leader = robot_.joints[static_cast<std::size_t>(joint.mimic->joint)];
            if (!leader.mimic) return;
            if (steps > robot_.joints.size())
                refuse(joint.place, fmt::format("joint {} mimics itself in a circle", in_quotes(joint.name)));
            joint.mimic = Robot::Mimic{leader.mimic->joint, joint.mimic->factor * leader.mimic->factor,
                                       joint.mimic->factor * leader.mimic->offset + joint.mimic->offset};
        }
    }

    void check_tree() {
        robot_.root = link_of_.at(model_->getRoot()->name);
        for (const Robot::Link& link : robot_.links) {
            const Robot::Link* at = &link;
            for (std::size_t steps = 0; at->joint >= 0; ++steps) {
                if (steps > robot_.links.size())
                    refuse(
                        link.place,
                        fmt::format("link {} hangs on itself in a circle of joints; expected a tree from one root",
                                    in_quotes(link.name)));
                at = &robot_.links[static_cast<std::size_t>(
                    robot_.joints[static_cast<std::size_t>(at->joint)].parent)];
            }
        }
    }

    const std::string& text_;
    std::string file_;
    TiXmlDocument document_;
    urdf::ModelInterfaceSharedPtr model_;
    Robot robot_;
    std::map<std::string, int> link_of_, joint_of_;
};

}  // namespace

std::optional<int> twelfths_of_pi(double angle) {
    const double k = std::round(angle * 12 / M_PI);
    if (std::abs(k) > 1200 || std::abs(angle - k * M_PI / 12) > 4e-16 * std::abs(angle)) return {};
    return static_cast<int>(k);
}

Real33 RobotPose::rotation() const {
    const auto about = [](int axis, double angle) {
        double c = std::cos(angle), s = std::sin(angle);
        if (const std::optional<int> k = twelfths_of_pi(angle); k && *k % 6 == 0) {
            constexpr std::array<double, 4> cosine{1, 0, -1, 0};
            c = cosine[static_cast<std::size_t>((*k / 6) & 3)];
            s = cosine[static_cast<std::size_t>((*k / 6 + 3) & 3)];
        }
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        Real33 R = Real33::Identity();
        R(i, i) = R(j, j) = c;
        R(j, i) = s;
        R(i, j) = -s;
        return R;
    };
    return about(2, rpy[2]) * about(1, rpy[1]) * about(0, rpy[0]);
}

Robot parse_robot(const std::string& text, const std::string& file) {
    return Reader(text, file).read();
}
Robot read_robot(const std::string& file) {
    return parse_robot(text_of_file(file), file);
}

}  // namespace alembert
