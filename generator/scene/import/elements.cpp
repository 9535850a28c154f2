// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>

#include "alembert/base/inertia.hpp"
#include "base/language/say.hpp"
#include "scene/import/possible_inertia.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr double unit_enough = 1e-6;  // a quaternion written with seven digits

std::string squeezed(const std::string& text) {
    std::istringstream words(text);
    std::string result;
    for (std::string word; words >> word;) result += (result.empty() ? "" : " ") + word;
    return result;
}

void squeeze_attributes(TiXmlElement& e) {
    for (TiXmlAttribute* a = e.FirstAttribute(); a != nullptr; a = a->Next()) a->SetValue(squeezed(a->ValueStr()));
    for (TiXmlElement* child = e.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
        squeeze_attributes(*child);
}

void remove_children(TiXmlElement& e, const std::vector<std::string>& kept) {
    for (TiXmlNode* child = e.FirstChild(); child != nullptr;) {
        TiXmlNode* const next = child->NextSibling();
        if (child->ToElement() == nullptr || std::find(kept.begin(), kept.end(), child->ValueStr()) == kept.end())
            e.RemoveChild(child);
        child = next;
    }
}

bool is_limited(const TiXmlElement& joint) {
    const char* const type = joint.Attribute("type");
    return type != nullptr && (squeezed(type) == "revolute" || squeezed(type) == "prismatic");
}

/// urdfdom requires effort and velocity, which do not matter for the motion without a controller.
void complete_limits(TiXmlElement& joint) {
    TiXmlElement* limit = joint.FirstChildElement("limit");
    if (limit == nullptr) {
        if (!is_limited(joint)) return;
        limit = joint.LinkEndChild(new TiXmlElement("limit"))->ToElement();
    }
    for (const char* key : {"effort", "velocity"})
        if (limit->Attribute(key) == nullptr) limit->SetAttribute(key, "0");
}

}  // namespace

std::string shown(const TiXmlElement& e) {
    return "<" + escaped(e.ValueStr()) + ">";
}

void Elements::refuse(const Place& place, const std::string& why) const {
    const std::string where = place.line > 0 ? fmt::format(":{}:{}", place.line, place.column) : "";
    throw SceneError(fmt::format("{}{}: {}", file_, where, why), {{place, why}});
}

std::vector<double> Elements::numbers(const TiXmlElement& e, const char* attribute, std::size_t count) const {
    std::istringstream words(e.Attribute(attribute));
    std::vector<double> result;
    const auto wrong = [&](const std::string& what) {
        refuse(place_of(e), say("{}=\"{}\" of {}: {}; expected {}", attribute,
                                escaped(squeezed(e.Attribute(attribute)), 60), shown(e), what,
                                count == 1 ? std::string(say("one number, as in 1.5"))
                                           : say("{} numbers between blanks", count)));
    };
    for (std::string word; words >> word;) {
        const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
        double value = 0;
        const auto [end, failure] = std::from_chars(begin, word.data() + word.size(), value);
        if (failure == std::errc::result_out_of_range)
            wrong(say("{} is beyond the range of double precision", in_quotes(word)));
        if (failure != std::errc() || end != word.data() + word.size())
            wrong(say("{} is no number{}", in_quotes(word),
                      word.find(',') != std::string::npos ? say(", the decimal sign is a point") : ""));
        if (!std::isfinite(value)) wrong(say("{} is not finite", in_quotes(word)));
        result.push_back(value);
    }
    if (result.size() != count)
        wrong(result.size() == 1 ? say("this is one number") : say("these are {} numbers", result.size()));
    return result;
}

std::optional<double> Elements::number(const TiXmlElement& e, const char* attribute) const {
    if (e.Attribute(attribute) == nullptr) return std::nullopt;
    return numbers(e, attribute, 1)[0];
}

double Elements::needed_number(const TiXmlElement& e, const char* attribute) const {
    const std::optional<double> value = number(e, attribute);
    if (!value) refuse(place_of(e), say("{} has no {}=\"…\"; expected a number", shown(e), attribute));
    return *value;
}

std::optional<double> Elements::number_inside(const TiXmlElement& e) const {
    if (e.GetText() == nullptr) return std::nullopt;
    TiXmlElement copy(e);
    copy.SetAttribute("text", e.GetText());
    return numbers(copy, "text", 1)[0];
}

Real3 Elements::three(const TiXmlElement& e, const char* attribute, const Real3& missing) const {
    if (e.Attribute(attribute) == nullptr) return missing;
    const std::vector<double> v = numbers(e, attribute, 3);
    return {v[0], v[1], v[2]};
}

RobotPose Elements::pose(const TiXmlElement* origin) {
    RobotPose result;
    if (origin == nullptr) return result;
    result.shift = three(*origin, "xyz", Real3::Zero());
    result.rpy = three(*origin, "rpy", Real3::Zero());
    if (origin->Attribute("quat_xyzw") == nullptr) return result;
    if (origin->Attribute("rpy") != nullptr)
        refuse(place_of(*origin), "<origin> has rpy and quat_xyzw; expected one of them");
    const std::vector<double> e = numbers(*origin, "quat_xyzw", 4);
    const double length = std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3]);
    if (length == 0) refuse(place_of(*origin), say("quat_xyzw is zero; expected a quaternion of length 1"));
    if (std::abs(length - 1) > unit_enough)
        remark(place_of(*origin), say("quat_xyzw has the length {:.9g}; it is divided by it", length));
    result.rpy = roll_pitch_yaw(Eigen::Quaterniond(e[3], e[0], e[1], e[2]).normalized().toRotationMatrix());
    return result;
}

double Elements::needed_moment(const TiXmlElement& inertia, const char* attribute) const {
    if (inertia.Attribute(attribute) == nullptr)
        refuse(place_of(inertia),
               say("<inertia> has no {}; expected ixx, iyy and izz (products that are missing are 0)", attribute));
    return *number(inertia, attribute);
}

void Elements::read_inertial(const TiXmlElement& inertial, Robot::Link& link) {
    const RobotPose at = pose(only(inertial, "origin"));
    link.centre = at.shift;
    const TiXmlElement *mass = only(inertial, "mass"), *inertia = only(inertial, "inertia");
    if (mass == nullptr)
        refuse(place_of(inertial),
               say("<inertial> of link {} has no mass; expected <mass value=\"…\"/>", in_quotes(link.name)));
    link.mass = needed_number(*mass, "value");
    if (link.mass < 0)
        refuse(place_of(*mass),
               say("the mass of link {} is {}; expected zero or more", in_quotes(link.name), link.mass));
    if (inertia == nullptr) {
        remark(place_of(inertial), say("link {} has no <inertia>: its mass is a point", in_quotes(link.name)));
        return;
    }
    std::vector<std::string> missing;
    const auto product = [&](const char* name) {
        const std::optional<double> value = number(*inertia, name);
        if (!value) missing.emplace_back(name);
        return value.value_or(0);
    };
    const double ixx = needed_moment(*inertia, "ixx"), iyy = needed_moment(*inertia, "iyy"),
                 izz = needed_moment(*inertia, "izz"), ixy = product("ixy"), iyz = product("iyz"),
                 ixz = product("ixz");
    if (!missing.empty())
        remark(place_of(*inertia), say("the inertia of link {} has no {}, taken as 0", in_quotes(link.name),
                                       fmt::join(missing, ", ")));
    const Real33 own = inertia_matrix<double>({ixx, iyy, izz, ixy, iyz, ixz});
    link.inertia = turned<double>(own, at.rotation());
    if (!at.rpy.isZero(0)) link.own_axes = {at.rpy, own};
    if (const auto why = impossible_inertia(link.name, own, link.mass)) remark(place_of(*inertia), *why);
}

const TiXmlElement* Elements::only(const TiXmlElement& e, const char* tag) const {
    const TiXmlElement* const first = e.FirstChildElement(tag);
    if (first != nullptr)
        if (const TiXmlElement* const second = first->NextSiblingElement(tag))
            refuse(place_of(*second), say("a second <{}> inside {}, the first is on line {}; expected one", tag,
                                          shown(e), first->Row()));
    return first;
}

std::vector<std::string> Elements::unknown_attributes(const TiXmlElement& e) const {
    struct Known {
        const char* tag;
        std::vector<const char*> attributes;
    };
    static const std::array<Known, 11> table{{{"origin", {"xyz", "rpy", "quat_xyzw"}},
                                              {"mass", {"value"}},
                                              {"inertia", {"ixx", "iyy", "izz", "ixy", "iyz", "ixz"}},
                                              {"inertial", {}},
                                              {"axis", {"xyz"}},
                                              {"parent", {"link"}},
                                              {"child", {"link"}},
                                              {"limit", {"lower", "upper", "effort", "velocity"}},
                                              {"dynamics", {"damping", "friction"}},
                                              {"mimic", {"joint", "multiplier", "offset"}},
                                              {"joint", {"name", "type"}}}};
    const auto row =
        std::find_if(table.begin(), table.end(), [&](const Known& k) { return e.ValueStr() == k.tag; });
    std::vector<std::string> result;
    if (row == table.end()) return result;
    for (const TiXmlAttribute* a = e.FirstAttribute(); a != nullptr; a = a->Next())
        if (std::none_of(row->attributes.begin(), row->attributes.end(),
                         [&](const char* known) { return std::strcmp(known, a->Name()) == 0; }))
            result.push_back(fmt::format("<{} {}=…>", row->tag, a->Name()));
    return result;
}

TiXmlDocument checkable(const TiXmlDocument& document, Elements& elements) {
    TiXmlDocument result(document);
    TiXmlElement& robot = *result.RootElement();
    if (const char* name = robot.Attribute("name"); name == nullptr || squeezed(name).empty()) {
        robot.SetAttribute("name", "robot");
        elements.remark(Elements::place_of(*document.RootElement()),
                        say("<robot> has no name; it is called robot"));
    }
    remove_children(robot, {"link", "joint"});
    squeeze_attributes(robot);
    bool has_world = false, hangs_from_world = false;
    for (TiXmlElement* e = robot.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
        if (e->ValueStr() == "link") {
            remove_children(*e, {});
            has_world |= e->Attribute("name") != nullptr && std::strcmp(e->Attribute("name"), "world") == 0;
            continue;
        }
        remove_children(*e, {"parent", "child", "axis", "mimic", "dynamics", "limit"});
        complete_limits(*e);
        const TiXmlElement* const parent = e->FirstChildElement("parent");
        const char* const link = parent != nullptr ? parent->Attribute("link") : nullptr;
        hangs_from_world |= link != nullptr && std::strcmp(link, "world") == 0;
    }
    if (hangs_from_world && !has_world) {
        robot.LinkEndChild(new TiXmlElement("link"))->ToElement()->SetAttribute("name", "world");
        elements.remark(Elements::place_of(*document.RootElement()),
                        say("the link 'world', from which joints hang, is not described; it is the ground"));
    }
    return result;
}

}  // namespace alembert
