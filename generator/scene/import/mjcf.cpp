// SPDX-License-Identifier: GPL-2.0-or-later
// MJCF, the format of MuJoCo (its documentation: "Modeling", "XML reference"). A body's joints stand inside it,
// with their points and axes in the body's frame. A body with k joints becomes k links, all along the axes of the
// body, the origin of each at its joint: the last one is the body, the others have no mass.
#include <fmt/format.h>

#include <cstring>
#include <map>

#include "base/language/say.hpp"
#include "scene/import/mjcf_reader.hpp"
#include "scene/import/mjcf_rules.hpp"
#include "scene/import/possible_inertia.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

using Type = Robot::Type;

}  // namespace

Robot::Effect MjcfReader::effect_of(const std::string& element, const std::string& attribute) {
    static const std::set<std::string> elements{"asset",    "camera",    "contact",   "custom", "extension",
                                                "keyframe", "light",     "replicate", "sensor", "size",
                                                "skin",     "statistic", "visual"};
    static const std::set<std::string> attributes{"actlimited",
                                                  "actrange",
                                                  "actuatorfrclimited",
                                                  "actuatorgravcomp",
                                                  "childclass",
                                                  "class",
                                                  "ctrllimited",
                                                  "dclass",
                                                  "dynprm",
                                                  "forcelimited",
                                                  "group",
                                                  "lengthrange",
                                                  "limited",
                                                  "margin",
                                                  "material",
                                                  "mocap",
                                                  "name",
                                                  "rgba",
                                                  "sleep",
                                                  "solimp",
                                                  "solimplimit",
                                                  "solimpfriction",
                                                  "solref",
                                                  "solreflimit",
                                                  "solreffriction",
                                                  "user",
                                                  "width"};
    static const std::set<std::string> of_controls{"ctrlrange", "inheritrange"};
    if (attribute.empty()) return elements.contains(element) ? Effect::none : Effect::motion;
    return attributes.contains(attribute)    ? Effect::none
           : of_controls.contains(attribute) ? Effect::driven
                                             : Effect::motion;
}

MjcfReader::MjcfReader(const std::string& text, const std::string& file, const OtherFiles& others)
    : file_(text, file), named_(file, others) {
    if (std::strcmp(file_.root().Name(), "mujoco") != 0)
        file_.refuse(file_.root(), say("the outermost element is {}; expected <mujoco>", shown(file_.root())));
    include_parts(file_, named_);
    write_out_rules(file_, named_);
    values_.emplace(file_);
    values_->bytes_of = [this](const std::string& name) {
        return named_.bytes(name, [](const std::string& why) { throw MeshMistake(why); });
    };
}

Robot MjcfReader::read() {
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
    file_.children(root, "deformable");  // of which a <skin> moves with the bodies
    scale_masses();
    const auto each = [&](const char* section, auto read_one) {
        for (const XmlElement* e : file_.children(root, section))
            for (const XmlElement* one : file_.children(*e)) read_one(*one);
    };
    each("tendon", [&](const XmlElement& e) { read_tendon(e); });
    set_spring_dampers();
    finish_tendons();
    each("actuator", [&](const XmlElement& e) { read_actuator(e); });
    each("equality", [&](const XmlElement& e) { read_equality(e); });
    each("keyframe", [&](const XmlElement& e) { read_key(e); });
    switch_off();
    robot_.dropped = file_.left_out(
        [](const XmlElement& e, const std::string& attribute) { return effect_of(e.Name(), attribute); });
    robot_.remarks = file_.remarks();
    return std::move(robot_);
}

void MjcfReader::read_option(const XmlElement& e) {
    if (const auto g = file_.numbers(e, "gravity", 3)) robot_.gravity = {(*g)[0], (*g)[1], (*g)[2]};
    for (const XmlElement* flag : file_.children(e, "flag"))
        for (const tinyxml2::XMLAttribute* a = flag->FirstAttribute(); a != nullptr; a = a->Next())
            if (std::strcmp(a->Value(), "disable") == 0) disabled_.insert(a->Name());
    if (is_off("gravity")) robot_.gravity.setZero();
    for (const char* medium : {"density", "viscosity"})
        if (file_.number(e, medium).value_or(0) != 0)
            file_.drop(fmt::format("<option {}=…>", medium), "", Effect::motion);
    if (e.Attribute("actuatorgroupdisable") != nullptr)
        file_.drop("<option actuatorgroupdisable=…>", "", Effect::driven);
    file_.ignore(e);
}

std::string MjcfReader::name_of(const XmlElement& e, const std::string& otherwise) {
    const std::string name = file_.text(e, "name").value_or("");
    return name.empty() ? otherwise : name;
}

int MjcfReader::add_link(const std::string& name, const XmlElement& e) {
    robot_.links.push_back({.name = name, .place = XmlFile::place_of(e)});
    return static_cast<int>(robot_.links.size()) - 1;
}

/// Adds a joint between two links, `at` in the parent.
Robot::Joint& MjcfReader::connect(const XmlElement& e, const std::string& name, Type type, int parent, int child,
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

/// Bodies and sites inside a body, or inside a <frame> that stands at `offset` in it; bodies in the order of the
/// file.
void MjcfReader::read_inside(const XmlElement& e, const std::string& body, const RobotPlace& offset) {
    for (const char* tag : {"composite", "flexcomp"})
        if (const XmlElement* const found = e.FirstChildElement(tag))
            file_.refuse(*found, say("<{}> makes bodies by a rule; expected them written out, as MuJoCo saves a "
                                     "compiled model (mj_saveLastXML)",
                                     tag));
    for (const XmlElement* site : file_.children(e, "site")) read_site(*site, body, offset);
    for (const XmlElement* child : file_.children(e)) {
        const std::string tag = child->Name();
        if (tag == "body" || tag == "frame") file_.children(e, child->Name());
        if (tag == "body") read_body(*child, body, offset);
        if (tag != "frame") continue;
        for (const char* no_motion : {"childclass", "name", "attached-angle", "attached-eulerseq"})
            file_.ignore(*child, no_motion);
        read_inside(*child, body, composed(offset, values_->place(*child)));
    }
    if (body == "world")
        for (const XmlElement* geom : file_.children(e, "geom")) file_.ignore(*geom);
}

void MjcfReader::read_site(const XmlElement& e, const std::string& body, const RobotPlace& offset) {
    const std::string name = name_of(e, "");
    RobotPlace at = composed(offset, values_->place(e));
    file_.ignore(e);
    if (name.empty()) return;
    const Body& own = places_.at(body);
    at.shift -= own.origin;
    if (body == "world") {
        sites_[name] = {0, at};
        return;
    }
    const int link = add_link(name, e);
    connect(e, name, Type::fixed, own.link, link, at.pose());
    sites_[name] = {link, {}};
}

void MjcfReader::gather(const XmlElement& e, const RobotPlace& offset, std::vector<MjcfPart>& parts) {
    for (const XmlElement* child : file_.children(e)) {
        const std::string tag = child->Name();
        if (tag == "frame") gather(*child, composed(offset, values_->place(*child)), parts);
        if (tag != "joint" && tag != "freejoint" && tag != "geom" && tag != "inertial") continue;
        file_.children(e, child->Name());
        parts.push_back({child, offset});
    }
}

void MjcfReader::read_body(const XmlElement& e, const std::string& parent_name, const RobotPlace& offset) {
    const std::string name = name_of(e, fmt::format("body{}", places_.size()));
    if (places_.contains(name)) file_.refuse(e, say("a second body is called {}", in_quotes(name)));
    file_.ignore(e, "childclass");
    const Body parent = places_.at(parent_name);
    const RobotPlace own = composed(offset, values_->place(e));
    const RobotPlace global = composed(parent.place, own);
    std::vector<MjcfPart> parts, joints;
    gather(e, {}, parts);
    for (const MjcfPart& part : parts)
        if (std::strcmp(part.element->Name(), "joint") == 0 || std::strcmp(part.element->Name(), "freejoint") == 0)
            joints.push_back(part);
    Body body{parent.link, global, Real3::Zero()};
    if (joints.empty()) {
        body.link = add_link(name, e);
        connect(e, name, Type::fixed, parent.link, body.link, {own.shift - parent.origin, own.pose().rpy});
    }
    for (std::size_t k = 0; k < joints.size(); ++k) {
        const auto& [element, frame] = joints[k];
        const bool is_first = k == 0, is_last = k + 1 == joints.size();
        const std::string joint_name =
            name_of(*element, name + (joints.size() == 1 ? "_joint" : fmt::format("_joint{}", k + 1)));
        const int link = add_link(is_last ? name : fmt::format("{}_{}", name, joint_name), e);
        const Real3 point = frame.shift + frame.R * values_->three(*element, "pos", Real3::Zero());
        const RobotPose at = is_first ? RobotPose{own.shift - parent.origin + own.R * point, own.pose().rpy}
                                      : RobotPose{point - body.origin, Real3::Zero()};
        Robot::Joint& joint = connect(*element, joint_name, Type::revolute, body.link, link, at);
        read_joint(*element, joint, frame);
        if (joint.type == Type::floating)
            read_floating(*element, joint, global, parent_name == "world" && joints.size() == 1);
        body.link = link;
        body.origin = joint.type == Type::floating ? Real3::Zero() : point;
    }
    read_mass(e, parts, name, body);
    robot_.links[static_cast<std::size_t>(body.link)].held = file_.number(e, "gravcomp").value_or(0);
    places_[name] = body;
    read_inside(e, name, {});
}

void MjcfReader::read_floating(const XmlElement& e, Robot::Joint& joint, const RobotPlace& global,
                               bool may_float) {
    if (!may_float)
        file_.refuse(
            e, say("the free joint of {} is not the only joint of a body in <worldbody>", in_quotes(joint.name)));
    joint.at = {};
    joint.start = global.pose();
}

void MjcfReader::read_joint(const XmlElement& e, Robot::Joint& joint, const RobotPlace& frame) {
    const std::string type =
        std::strcmp(e.Name(), "freejoint") == 0 ? "free" : values_->text(e, "type").value_or("hinge");
    const std::map<std::string, Type> types{{"hinge", Type::revolute},
                                            {"slide", Type::prismatic},
                                            {"ball", Type::spherical},
                                            {"free", Type::floating}};
    if (!types.contains(type))
        file_.refuse(e, say("joint {} is of type {}; expected hinge, slide, ball or free", in_quotes(joint.name),
                            in_quotes(type)));
    joint.type = types.at(type);
    file_.ignore(e, "align");
    if (type != "free")
        tell_defaults(e, joint.name, nullptr,
                      {"type", "pos", "axis", "springdamper", "stiffness", "damping", "armature", "frictionloss",
                       "range", "ref", "springref"});
    const bool one = joint.type == Type::revolute || joint.type == Type::prismatic;
    const auto of_one = [&](const char* key) {
        const double result = first_number(e, key, joint.name);
        if (one || result == 0) return result;
        file_.drop(fmt::format("<joint {}=…> of ball and free joints", key), joint.name, Effect::motion);
        return 0.;
    };
    joint.damping = first_number(e, "damping", joint.name);
    joint.armature = values_->number(e, "armature").value_or(0);
    joint.friction = of_one("frictionloss");
    joint.stiffness = of_one("stiffness");
    for (const double x : {joint.damping, joint.armature, joint.friction, joint.stiffness})
        if (x < 0)
            file_.refuse(e, say("joint {} has a negative damping, armature, frictionloss or stiffness",
                                in_quotes(joint.name)));
    if (const auto both = values_->numbers(e, "springdamper", 2); both && (*both)[0] > 0 && (*both)[1] > 0)
        spring_dampers_[robot_.joints.size() - 1] = {(*both)[0], (*both)[1]};
    if (!one) {
        for (const char* unused : {"axis", "ref", "springref", "actuatorfrcrange"}) file_.ignore(e, unused);
        if (joint.type == Type::floating) file_.ignore(e, "range");
        return;
    }
    joint.axis = frame.R * values_->three(e, "axis", Real3::UnitZ());
    if (joint.axis.norm() == 0)
        file_.refuse(e, say("the axis of joint {} is zero; expected a direction", in_quotes(joint.name)));
    const auto of_joint = [&](double x) { return joint.type == Type::revolute ? values_->angle(e, x) : x; };
    const double reference = of_joint(values_->number(e, "ref").value_or(0));
    references_[joint.name] = reference;
    if (reference != 0)
        file_.remark(
            e, say("{} counts from the reference pose, where MuJoCo's coordinate is {}", joint.name, reference));
    joint.rest = of_joint(values_->number(e, "springref").value_or(0)) - reference;
    const auto range = values_->numbers(e, "range", 2);
    if (range && values_->flag(e, "limited").value_or(values_->autolimits))
        joint.limits = {of_joint((*range)[0]) - reference, of_joint((*range)[1]) - reference};
}

void MjcfReader::read_mass(const XmlElement& e, const std::vector<MjcfPart>& parts, const std::string& name,
                           const Body& body) {
    using From = MjcfValues::FromShapes;
    std::vector<MjcfPart> geoms;
    std::optional<MjcfPart> inertial;
    for (const MjcfPart& part : parts) {
        const std::string tag = part.element->Name();
        if (tag == "geom") geoms.push_back(part);
        if (tag != "inertial") continue;
        if (inertial) file_.refuse(*part.element, say("a second <inertial> inside {}; expected one", shown(e)));
        inertial = part;
    }
    MjcfInertia mass;
    if (values_->from_shapes == From::always || (values_->from_shapes == From::where_missing && !inertial)) {
        mass = values_->by_shapes(geoms, name);
    } else if (inertial) {
        mass = values_->given(*inertial->element);
        mass.centre = inertial->frame.shift + inertial->frame.R * mass.centre;
        mass.inertia = inertial->frame.R * mass.inertia * inertial->frame.R.transpose();
    }
    if (inertial) file_.ignore(*inertial->element);
    for (const MjcfPart& geom : geoms) {
        file_.ignore(*geom.element);
        file_.drop(say("contact and looks of <geom>"), name);
    }
    values_->bound(mass);
    if (inertial)
        if (const auto why = impossible_inertia(name, mass.inertia, mass.mass))
            file_.remark(*inertial->element, *why);
    Robot::Link& link = robot_.links[static_cast<std::size_t>(body.link)];
    link.mass = mass.mass;
    link.centre = mass.centre - body.origin;
    link.inertia = mass.inertia;
}

void MjcfReader::scale_masses() {
    double whole = 0;
    for (const Robot::Link& link : robot_.links) whole += link.mass;
    if (values_->total_mass <= 0 || whole == 0) return;
    for (Robot::Link& link : robot_.links) {
        link.mass *= values_->total_mass / whole;
        link.inertia *= values_->total_mass / whole;
    }
}

Robot parse_mjcf(const std::string& text, const std::string& file, const OtherFiles& others) {
    return MjcfReader(text, file, others).read();
}

}  // namespace alembert
