// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/mjcf_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "base/language/say.hpp"
#include "scene/import/mjcf_rules.hpp"
#include "scene/text.hpp"

namespace alembert {

MjcfValues::MjcfValues(XmlFile& file) : file_(file) {
    for (const XmlElement* e : file_.children(file_.root(), "compiler")) read_compiler(*e);
    for (const XmlElement* e : file_.children(file_.root(), "default")) read_class(*e, "");
}

void MjcfValues::read_compiler(const XmlElement& e) {
    if (const auto unit = file_.text(e, "angle")) {
        if (*unit != "degree" && *unit != "radian")
            file_.refuse(e, say("angle {} of <compiler>; expected degree or radian", in_quotes(*unit)));
        in_degrees_ = *unit == "degree";
    }
    if (const auto coordinates = file_.text(e, "coordinate"); coordinates && *coordinates != "local")
        file_.refuse(e,
                     say("coordinate {} of <compiler> is of the past; expected local", in_quotes(*coordinates)));
    if (const auto sequence = file_.text(e, "eulerseq")) {
        if (sequence->size() != 3 || sequence->find_first_not_of("xyzXYZ") != std::string::npos)
            file_.refuse(e, say("eulerseq {} of <compiler>; expected three of x, y, z", in_quotes(*sequence)));
        euler_ = *sequence;
    }
    if (const auto from = file_.text(e, "inertiafromgeom"); from && *from != "auto")
        from_shapes = file_.truth(e, *from) ? FromShapes::always : FromShapes::never;
    if (const auto range = file_.numbers(e, "inertiagrouprange", 2)) groups_ = {(*range)[0], (*range)[1]};
    autolimits = file_.flag(e, "autolimits").value_or(autolimits);
    least_mass_ = file_.number(e, "boundmass").value_or(least_mass_);
    least_moment_ = file_.number(e, "boundinertia").value_or(least_moment_);
    balance_ = file_.flag(e, "balanceinertia").value_or(balance_);
    total_mass = file_.number(e, "settotalmass").value_or(total_mass);
    strips_path_ = file_.flag(e, "strippath").value_or(strips_path_);
    for (const char* key : {"assetdir", "meshdir"})
        if (const auto folder = file_.text(e, key)) mesh_folder_ = folder->empty() ? "" : *folder + "/";
    file_.ignore(e);
}

void MjcfValues::read_class(const XmlElement& e, const std::string& parent) {
    const std::string name = file_.text(e, "class").value_or("main");
    for (std::string above = parent; !above.empty(); above = classes_.at(above).parent)
        if (above == name) file_.refuse(e, say("the class {} stands inside itself", in_quotes(name)));
    const auto known = classes_.try_emplace(name, Class{parent, {}}).first;
    known->second.elements.insert(known->second.elements.begin(), &e);
    for (const XmlElement* child : file_.children(e)) {
        if (std::strcmp(child->Name(), "default") == 0) {
            read_class(*child, name);
            continue;
        }
        file_.ignore(*child);
    }
    file_.ignore(e);
}

const MjcfValues::Class& MjcfValues::class_of(const XmlElement& e) {
    std::string name = file_.text(e, "class").value_or("");
    for (const tinyxml2::XMLNode* at = e.Parent(); name.empty() && at != nullptr; at = at->Parent())
        if (const XmlElement* const above = at->ToElement()) name = file_.text(*above, "childclass").value_or("");
    if (name.empty()) name = "main";
    const auto found = classes_.find(name);
    if (found == classes_.end() && name != "main")
        file_.refuse(e, say("the class {} of {} has no <default>", in_quotes(name), shown(e)));
    return found == classes_.end() ? classes_["main"] : found->second;
}

void MjcfValues::each_default(const XmlElement& e, const char* or_as,
                              const std::function<bool(const XmlElement&)>& give) {
    static const std::set<std::string> motors{"general", "motor",    "position", "velocity", "intvelocity",
                                              "damper",  "cylinder", "muscle",   "adhesion", "plugin"};
    const bool is_motor = or_as != nullptr && std::strcmp(or_as, "general") == 0;
    const auto counts = [&](const std::string& tag) {
        return tag == e.Name() || (is_motor ? motors.contains(tag) : or_as != nullptr && tag == or_as);
    };
    for (const Class* c = &class_of(e);; c = &classes_.at(c->parent)) {
        for (const XmlElement* all : c->elements)
            for (const XmlElement* d = all->LastChildElement(); d != nullptr; d = d->PreviousSiblingElement())
                if (counts(d->Name()) && give(*d)) return;
        if (c->parent.empty()) return;
    }
}

std::optional<std::string> MjcfValues::text(const XmlElement& e, const char* attribute, const char* or_as) {
    std::optional<std::string> result = file_.text(e, attribute);
    if (result) return result;
    each_default(e, or_as, [&](const XmlElement& d) {
        result = file_.text(d, attribute);
        return result.has_value();
    });
    return result;
}

std::set<std::string> MjcfValues::default_attributes(const XmlElement& e, const char* or_as) {
    std::set<std::string> result;
    each_default(e, or_as, [&](const XmlElement& d) {
        for (const tinyxml2::XMLAttribute* a = d.FirstAttribute(); a != nullptr; a = a->Next())
            result.insert(a->Name());
        return false;
    });
    return result;
}

std::vector<const XmlElement*> MjcfValues::defaults_of(const XmlElement& e, const char* or_as) {
    std::vector<const XmlElement*> result;
    each_default(e, or_as, [&](const XmlElement& d) {
        result.insert(result.begin(), &d);
        return false;
    });
    return result;
}

std::optional<std::vector<double>> MjcfValues::numbers(const XmlElement& e, const char* attribute,
                                                       std::size_t count, const char* or_as) {
    const std::optional<std::string> value = text(e, attribute, or_as);
    if (!value) return std::nullopt;
    return file_.numbers_of(e, fmt::format("{}=\"{}\"", attribute, escaped(*value, 60)), *value, count);
}

std::optional<double> MjcfValues::number(const XmlElement& e, const char* attribute, const char* or_as) {
    const auto list = numbers(e, attribute, 1, or_as);
    return list ? std::optional(list->front()) : std::nullopt;
}

std::optional<bool> MjcfValues::flag(const XmlElement& e, const char* attribute, const char* or_as) {
    const std::optional<std::string> value = text(e, attribute, or_as);
    if (!value || *value == "auto") return std::nullopt;
    return file_.truth(e, *value);
}

Real3 MjcfValues::three(const XmlElement& e, const char* attribute, const Real3& missing) {
    const auto list = numbers(e, attribute, 3);
    return list ? Real3((*list)[0], (*list)[1], (*list)[2]) : missing;
}

double MjcfValues::angle(const XmlElement& e, double written) const {
    const char* const unit = of_attached_model(e, "angle");
    const bool in_degrees = unit != nullptr ? std::strcmp(unit, "degree") == 0 : in_degrees_;
    return in_degrees ? written * M_PI / 180 : written;
}

Real33 MjcfValues::rotation(const XmlElement& e) {
    const auto direction = [&](const Real3& v) -> Real3 {
        if (v.norm() == 0) file_.refuse(e, say("a direction of {} is zero; expected another", shown(e)));
        return v.normalized();
    };
    if (const auto q = numbers(e, "quat", 4)) {
        const Eigen::Quaterniond e4((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
        if (e4.norm() == 0)
            file_.refuse(e, say("quat of {} is zero; expected a quaternion of length 1", shown(e)));
        return e4.normalized().toRotationMatrix();
    }
    if (const auto a = numbers(e, "axisangle", 4))
        return Eigen::AngleAxisd(angle(e, (*a)[3]), direction({(*a)[0], (*a)[1], (*a)[2]})).toRotationMatrix();
    if (const auto angles = numbers(e, "euler", 3)) {
        Real33 R = Real33::Identity();
        const char* const sequence = of_attached_model(e, "eulerseq");
        for (std::size_t k = 0; k < 3; ++k) {
            const char letter = sequence != nullptr && std::strlen(sequence) == 3 ? sequence[k] : euler_[k];
            const bool moves = letter >= 'a';  // about axes that turn with the body, or that do not
            Real3 rpy = Real3::Zero();
            rpy[moves ? letter - 'x' : letter - 'X'] = angle(e, (*angles)[k]);
            const Real33 turn = RobotPose{Real3::Zero(), rpy}.rotation();
            R = moves ? Real33(R * turn) : Real33(turn * R);
        }
        return R;
    }
    if (const auto v = numbers(e, "xyaxes", 6)) {
        const Real3 x = direction({(*v)[0], (*v)[1], (*v)[2]});
        const Real3 second{(*v)[3], (*v)[4], (*v)[5]};
        const Real3 y = direction(second - second.dot(x) * x);
        Real33 R;
        R << x, y, x.cross(y);
        return R;
    }
    if (const auto v = numbers(e, "zaxis", 3))
        return Eigen::Quaterniond::FromTwoVectors(Real3::UnitZ(), direction({(*v)[0], (*v)[1], (*v)[2]}))
            .toRotationMatrix();
    return Real33::Identity();
}

}  // namespace alembert
