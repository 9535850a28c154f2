// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/sdf_poses.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "scene/text.hpp"

namespace alembert {

void SdfPoses::add(const std::string& path, Entry entry) {
    const XmlElement& e = *entry.element;
    if (!entries_.emplace(path, std::move(entry)).second)
        file_.refuse(e, say("the name {} is taken already", in_quotes(path)));
    order_.push_back(path);
}

void SdfPoses::add_model(const XmlElement& model, const std::string& name, const std::string& around) {
    using Kind = Entry::Kind;
    const std::string scope = name + "::";
    add(name, {Kind::model, &model, around, around.empty() ? "world" : around.substr(0, around.size() - 2), ""});
    for (const XmlElement* e : file_.children(model, "link"))
        add(scope + file_.needed_text(*e, "name"), {Kind::link, e, scope, "__model__", ""});
    for (const XmlElement* e : file_.children(model, "frame")) {
        const std::string on = file_.text(*e, "attached_to").value_or("");
        const std::string attached = on.empty() ? "__model__" : on;
        add(scope + file_.needed_text(*e, "name"), {Kind::frame, e, scope, attached, attached});
    }
    for (const XmlElement* e : file_.children(model, "joint"))
        add(scope + file_.needed_text(*e, "name"),
            {Kind::joint, e, scope, file_.text_in(*e, "child").value_or(""), ""});
    for (const XmlElement* e : file_.children(model, "model"))
        add_model(*e, scope + file_.needed_text(*e, "name"), scope);
}

std::string SdfPoses::path(const XmlElement& e, const std::string& scope, const std::string& name) const {
    if (name == "world") return name;
    if (name == "__model__" && !scope.empty()) return scope.substr(0, scope.size() - 2);
    if (entries_.contains(scope + name)) return scope + name;
    file_.refuse(e, say("{} is no link, joint, frame or model here", in_quotes(name)));
}

RobotPlace SdfPoses::written(const XmlElement& pose) {
    const bool turns = file_.text(pose, "rotation_format").value_or("euler_rpy") == "quat_xyzw";
    const double unit = file_.flag(pose, "degrees").value_or(false) ? M_PI / 180 : 1;
    if (pose.GetText() == nullptr) return {};
    const std::vector<double> v = file_.numbers_in(pose, turns ? 7 : 6);
    RobotPlace result{{v[0], v[1], v[2]}, Real33::Identity()};
    if (turns) {
        const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
        if (q.norm() == 0) file_.refuse(pose, say("the quaternion of <pose> is zero; expected one of length 1"));
        result.R = q.normalized().toRotationMatrix();
    } else {
        result.R = RobotPose{Real3::Zero(), {unit * v[3], unit * v[4], unit * v[5]}}.rotation();
    }
    return result;
}

RobotPlace SdfPoses::place(const std::string& path) {
    if (const auto found = known_.find(path); found != known_.end()) return found->second;
    const Entry entry = entries_.at(path);
    if (std::find(open_.begin(), open_.end(), path) != open_.end())
        file_.refuse(*entry.element,
                     say("the pose of {} is given relative to itself in a circle", in_quotes(path)));
    open_.push_back(path);
    const XmlElement* const pose = file_.only(*entry.element, "pose");
    RobotPlace own;
    std::string to = entry.usual;
    if (pose != nullptr) {
        own = written(*pose);
        if (const auto other = file_.text(*pose, "relative_to"); other && !other->empty()) to = *other;
        if (const auto other = file_.text(*pose, "frame"); other && !other->empty()) to = *other;
    }
    RobotPlace base;
    if (entry.kind == Entry::Kind::model) {
        base = place(to == entry.usual ? to : this->path(*entry.element, entry.scope, to));
        if (const auto by = file_.text(*entry.element, "placement_frame")) {
            // The pose is that of one of its frames: the model stands where this one is then right.
            known_[path] = {};
            const RobotPlace inside = place(this->path(*entry.element, path + "::", *by));
            known_.erase(path);
            own = composed(own, inverted(inside));
        }
    } else {
        base = place(this->path(*entry.element, entry.scope, to));
    }
    open_.pop_back();
    return known_[path] = composed(base, own);
}

std::string SdfPoses::link(const std::string& path, int steps) const {
    const Entry& entry = entries_.at(path);
    if (entry.kind == Entry::Kind::link || entry.kind == Entry::Kind::world) return path;
    if (steps > static_cast<int>(entries_.size()))
        file_.refuse(*entry.element, say("the frame {} is attached to itself in a circle", in_quotes(path)));
    if (entry.kind == Entry::Kind::frame)
        return link(this->path(*entry.element, entry.scope, entry.attached), steps + 1);
    if (entry.kind == Entry::Kind::joint)
        return link(this->path(*entry.element, entry.scope, entry.usual), steps + 1);
    // A model stands for its canonical link: the one that it names, or its first.
    if (const char* const canonical = entry.element->Attribute("canonical_link"))
        return link(path + "::" + canonical, steps + 1);
    for (const std::string& one : order_)
        if (one.starts_with(path + "::") && entries_.at(one).kind == Entry::Kind::link) return one;
    file_.refuse(*entry.element, say("model {} has no link", in_quotes(path)));
}

}  // namespace alembert
