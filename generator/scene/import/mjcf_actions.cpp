// SPDX-License-Identifier: GPL-2.0-or-later
// What acts on the bodies of an MJCF file, and what ties them together (documentation of MuJoCo: "Computation",
// "XML reference"). MuJoCo's coordinates q are those of the scene plus `ref`; lengths of tendons likewise.
#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "base/language/say.hpp"
#include "scene/import/mjcf_reader.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

using Type = Robot::Type;

/// The transformation of a vector of seven numbers, position and quaternion; nothing if the quaternion is zero.
std::optional<RobotPlace> place_of_seven(const std::vector<double>& v) {
    const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
    if (q.norm() == 0) return std::nullopt;
    return RobotPlace{{v[0], v[1], v[2]}, q.normalized().toRotationMatrix()};
}

}  // namespace

/// The first of up to three coefficients of a polynomial; the others are left out.
double MjcfReader::first_number(const XmlElement& e, const char* key, const std::string& of, const char* or_as) {
    const auto list = values_->numbers(e, key, 0, or_as);
    if (!list) return 0;
    for (std::size_t k = 1; k < list->size(); ++k)
        if ((*list)[k] != 0)
            file_.drop(fmt::format("<{} {}=…> of higher degree", e.Name(), key), of, Effect::motion);
    return list->front();
}

/// Lists what the defaults of an element have beside what is `known` and what it says itself.
void MjcfReader::tell_defaults(const XmlElement& e, const std::string& of, const char* or_as,
                               const std::set<std::string>& known) {
    for (const std::string& attribute : values_->default_attributes(e, or_as)) {
        if (known.contains(attribute) || e.Attribute(attribute.c_str()) != nullptr) continue;
        const Effect effect = effect_of(e.Name(), attribute);
        if (effect != Effect::none) file_.drop(fmt::format("<{} {}=…>", e.Name(), attribute), of, effect);
    }
}

int MjcfReader::joint_named(const XmlElement& e, const std::string& name) const {
    for (std::size_t k = 0; k < robot_.joints.size(); ++k)
        if (robot_.joints[k].name == name && robot_.joints[k].type != Type::fixed) return static_cast<int>(k);
    file_.refuse(e, say("{} names the joint {}, which is none of this model", shown(e), in_quotes(name)));
}

const MjcfReader::Site& MjcfReader::site_named(const XmlElement& e, const std::string& name) const {
    const auto found = sites_.find(name);
    if (found == sites_.end())
        file_.refuse(e, say("{} names the site {}, which is none of this model", shown(e), in_quotes(name)));
    return found->second;
}

const MjcfReader::Body& MjcfReader::body_named(const XmlElement& e, const char* key) {
    const std::string name = file_.text(e, key).value_or("world");
    const auto found = places_.find(name);
    if (found == places_.end())
        file_.refuse(e, say("{} names the body {}, which is none of this model", shown(e), in_quotes(name)));
    return found->second;
}

void MjcfReader::read_tendon(const XmlElement& e) {
    const std::string tag = e.Name();
    if (tag != "fixed" && tag != "spatial") return;
    file_.children(*e.Parent()->ToElement(), e.Name());
    Robot::Tendon tendon{.name = name_of(e, fmt::format("tendon{}", tendons_.size() + 1))};
    const auto number = [&](const char* key) { return first_number(e, key, tendon.name, "tendon"); };
    tendon.stiffness = number("stiffness");
    tendon.damping = number("damping");
    tendon.friction = number("frictionloss");
    tendon.armature = number("armature");
    for (const double x : {tendon.stiffness, tendon.damping, tendon.friction, tendon.armature})
        if (x < 0)
            file_.refuse(e, say("tendon {} has a negative stiffness, damping, frictionloss or armature",
                                in_quotes(tendon.name)));
    const auto range = values_->numbers(e, "range", 2, "tendon");
    const auto limited = values_->text(e, "limited", "tendon").value_or("auto");
    if (range && (limited == "auto" ? values_->autolimits : file_.truth(e, limited)))
        tendon.limits = {(*range)[0], (*range)[1]};
    tell_defaults(e, tendon.name, "tendon",
                  {"stiffness", "damping", "frictionloss", "armature", "range", "limited", "springlength"});
    const auto rest = values_->numbers(e, "springlength", 0, "tendon").value_or(std::vector<double>{-1});
    tendon.rest = {rest.front(), rest.back()};
    if (tag == "fixed") {
        read_fixed(e, tendon);
    } else if (!read_path(e, tendon)) {
        const bool acts = tendon.stiffness + tendon.damping + tendon.friction + tendon.armature > 0 || range;
        file_.drop(say("tendons that wrap around <geom>s"), tendon.name, acts ? Effect::motion : Effect::driven);
        tendons_[tendon.name] = -1;
        return;
    }
    tendons_[tendon.name] = static_cast<int>(robot_.tendons.size());
    if (tendon.rest == std::array{-1., -1.}) rests_.push_back(robot_.tendons.size());
    robot_.tendons.push_back(std::move(tendon));
}

void MjcfReader::read_fixed(const XmlElement& e, Robot::Tendon& tendon) {
    for (const XmlElement* one : file_.children(e, "joint")) {
        const std::string name = file_.needed_text(*one, "joint");
        const int joint = joint_named(*one, name);
        const Type type = robot_.joints[static_cast<std::size_t>(joint)].type;
        if (type != Type::revolute && type != Type::prismatic)
            file_.refuse(*one,
                         say("{} names the joint {}, which is no hinge or slide", shown(*one), in_quotes(name)));
        const double coefficient = file_.number(*one, "coef").value_or(0);
        tendon.terms.push_back({joint, coefficient});
        tendon.at_reference += coefficient * references_[name];
    }
}

/// Reads straight stretches between sites; false if the tendon wraps around something.
bool MjcfReader::read_path(const XmlElement& e, Robot::Tendon& tendon) {
    double divisor = 1;
    const Site* last = nullptr;
    bool is_straight = true;
    for (const XmlElement* one : file_.children(e)) {
        const std::string tag = one->Name();
        file_.children(e, one->Name());
        if (tag == "pulley") {
            divisor = file_.number(*one, "divisor").value_or(1);
            if (divisor <= 0)
                file_.refuse(*one, say("the divisor of a pulley is {}; expected more than 0", divisor));
            last = nullptr;
        } else if (tag == "site") {
            const Site& site = site_named(*one, file_.needed_text(*one, "site"));
            if (last != nullptr)
                tendon.stretches.push_back(
                    {last->link, site.link, last->place.shift, site.place.shift, 1 / divisor});
            last = &site;
        } else {
            file_.ignore(*one);
            is_straight = false;
        }
    }
    return is_straight;
}

/// Lengths of rest of tendons that are slack where all springs of joints are; limits from those of the file.
void MjcfReader::finish_tendons() {
    if (robot_.tendons.empty()) return;
    std::vector<double> q;
    for (const Robot::Joint& joint : robot_.joints) q.push_back(joint.rest);
    const std::vector<double> zero(q.size());
    const std::vector<RobotPlace> places = link_places(robot_, q), reference = link_places(robot_, zero);
    for (Robot::Tendon& tendon : robot_.tendons) {
        tendon.start = tendon_length(tendon, reference, zero);
        for (double& x : tendon.rest) x -= tendon.at_reference;
        if (tendon.limits)
            for (double& x : *tendon.limits) x -= tendon.at_reference;
    }
    for (const std::size_t k : rests_) robot_.tendons[k].rest.fill(tendon_length(robot_.tendons[k], places, q));
}

/// Stiffness and damping from a time constant T and a damping ratio ζ: k = I/(T ζ)², d = 2 I/T, with I the
/// reciprocal of the mean of the joint's diagonal elements of M⁻¹ in the reference pose.
void MjcfReader::set_spring_dampers() {
    if (spring_dampers_.empty()) return;
    ReferenceMass mass = reference_mass(robot_);
    const auto row_of = [&](const Robot::Tendon::Term& term) {
        return mass.first[static_cast<std::size_t>(term.joint)];
    };
    for (const Robot::Tendon& tendon : robot_.tendons)
        for (const Robot::Tendon::Term& a : tendon.terms)
            for (const Robot::Tendon::Term& b : tendon.terms)
                if (tendon.armature != 0)
                    mass.M.coeffRef(row_of(a), row_of(b)) += tendon.armature * a.coefficient * b.coefficient;
    const std::vector<double> all = mass.mobilities();
    for (const auto& [k, wanted] : spring_dampers_) {
        Robot::Joint& joint = robot_.joints[k];
        const int count = ReferenceMass::speeds(joint.type);
        double mobility = 0;
        for (int i = 0; i < count; ++i) mobility += all[static_cast<std::size_t>(mass.first[k] + i)] / count;
        if (!(mobility > 0))
            throw SceneError(
                say("springdamper of joint {}: the masses that it moves are zero", in_quotes(joint.name)),
                {{joint.place, joint.name}});
        joint.damping = 2 / (mobility * wanted[0]);
        const double stiffness = 1 / (mobility * std::pow(wanted[0] * wanted[1], 2));
        if (joint.type == Type::revolute || joint.type == Type::prismatic)
            joint.stiffness = stiffness;
        else
            file_.drop("<joint springdamper=…> of ball and free joints", joint.name, Effect::motion);
    }
}

/// What <flag> switches off.
void MjcfReader::switch_off() {
    const bool all = is_off("passive");
    const bool springs = all || is_off("spring"), dampers = all || is_off("damper");
    const auto quiet = [&](auto& one) {
        if (springs) one.stiffness = 0;
        if (dampers) one.damping = 0;
        if (is_off_constraint("frictionloss")) one.friction = 0;
        if (is_off_constraint("limit")) one.limits.reset();
    };
    for (Robot::Joint& joint : robot_.joints) quiet(joint);
    for (Robot::Tendon& tendon : robot_.tendons) quiet(tendon);
    if (is_off_constraint("equality")) {
        robot_.loops.clear();
        robot_.couplings.clear();
    }
    if (is_off("actuation")) robot_.actuators->clear();
    if (springs && dampers)
        for (Robot::Link& link : robot_.links) link.held = 0;
}

/// A state of <keyframe>: qpos has the joints in the order of the tree, a free one with a place and a quaternion.
void MjcfReader::read_key(const XmlElement& e) {
    file_.children(*e.Parent()->ToElement(), e.Name());
    Robot::Keyframe key{.name = name_of(e, fmt::format("key{}", robot_.keyframes.size()))};
    const auto list = [&](const char* attribute, std::size_t size) {
        std::vector<double> given = file_.numbers(e, attribute).value_or(std::vector<double>(size, NAN));
        if (given.size() != size)
            file_.refuse(e, say("{} of {} has {} numbers; expected {}", attribute, shown(e), given.size(), size));
        return given;
    };
    std::size_t positions = 0, rates = 0;
    for (const Robot::Joint& joint : robot_.joints) {
        const bool floats = joint.type == Type::floating, turns = joint.type == Type::spherical;
        positions += joint.type == Type::fixed ? 0 : floats ? 7 : turns ? 4 : 1;
        rates += joint.type == Type::fixed ? 0 : floats ? 6 : turns ? 3 : 1;
    }
    const std::vector<double> q = list("qpos", positions), u = list("qvel", rates);
    auto at = q.begin(), rate = u.begin();
    for (const Robot::Joint& joint : robot_.joints) {
        const bool floats = joint.type == Type::floating, turns = joint.type == Type::spherical;
        const std::ptrdiff_t wide = joint.type == Type::fixed ? 0
                                    : floats                  ? 7
                                    : turns                   ? 4
                                                              : 1,
                             fast = wide > 1 ? wide - 1 : wide;
        key.position.emplace_back(at, at + wide);
        key.rate.emplace_back(rate, rate + fast);
        at += wide;
        rate += fast;
        if (wide == 1) key.position.back()[0] -= references_[joint.name];
    }
    std::vector<double> all = list("ctrl", static_cast<std::size_t>(motors_));
    for (const int k : motor_numbers_) key.control.push_back(all[static_cast<std::size_t>(k)]);
    for (const char* unused : {"time", "act", "mpos", "mquat"}) file_.ignore(e, unused);
    robot_.keyframes.push_back(std::move(key));
}

void MjcfReader::read_equality(const XmlElement& e) {
    const std::string tag = e.Name();
    const std::string name =
        name_of(e, fmt::format("{}{}", tag, robot_.loops.size() + robot_.couplings.size() + 1));
    const bool is_known = tag == "connect" || tag == "weld" || tag == "joint" || tag == "tendon";
    const bool is_active = values_->flag(e, "active", "equality") != false;
    if (!is_known || !is_active) {
        file_.ignore(e);
        const bool matters = is_active && !is_off_constraint("equality");
        return file_.drop(fmt::format("<{}> of <equality>", tag), name, matters ? Effect::motion : Effect::none);
    }
    file_.children(*e.Parent()->ToElement(), e.Name());
    return tag == "joint" || tag == "tendon" ? read_coupling(e, name) : read_loop(e, name);
}

void MjcfReader::read_loop(const XmlElement& e, const std::string& name) {
    // A weld whose torques count nothing holds a point alone.
    const bool is_weld = std::strcmp(e.Name(), "weld") == 0;
    const bool may_turn = file_.number(e, "torquescale").value_or(1) == 0;
    const Type type = is_weld && !may_turn ? Type::fixed : Type::spherical;
    if (const auto site = file_.text(e, "site1")) {
        const Site &one = site_named(e, *site), &two = site_named(e, file_.needed_text(e, "site2"));
        robot_.loops.push_back({.name = name,
                                .type = type,
                                .parent = one.link,
                                .child = two.link,
                                .at_parent = one.place.pose(),
                                .at_child = two.place.pose()});
        return;
    }
    const Body &one = body_named(e, "body1"), &two = body_named(e, "body2");
    const RobotPlace to_two = composed(inverted(two.place), one.place);
    const Real3 anchor = values_->three(e, "anchor", Real3::Zero());
    if (!is_weld) {
        robot_.loops.push_back({.name = name,
                                .type = type,
                                .parent = one.link,
                                .child = two.link,
                                .at_parent = {anchor - one.origin, Real3::Zero()},
                                .at_child = {to_two.shift + to_two.R * anchor - two.origin, Real3::Zero()}});
        return;
    }
    // With `relpose`, its position is the welded point in the first body, and `anchor` is that in the second one.
    RobotPlace relative = inverted(to_two);
    Real3 in_two = Real3::Zero();
    if (const auto pose = file_.numbers(e, "relpose", 7))
        if (const auto given = place_of_seven(*pose)) {
            relative = *given;
            in_two = anchor;
        }
    robot_.loops.push_back({.name = name,
                            .type = type,
                            .parent = one.link,
                            .child = two.link,
                            .at_parent = {relative.shift - one.origin, relative.pose().rpy},
                            .at_child = {in_two - two.origin, Real3::Zero()}});
}

void MjcfReader::read_coupling(const XmlElement& e, const std::string& name) {
    const bool of_tendons = std::strcmp(e.Name(), "tendon") == 0;
    const auto named = [&](const std::string& of) {
        if (!of_tendons) return joint_named(e, of);
        const auto found = tendons_.find(of);
        if (found == tendons_.end())
            file_.refuse(e, say("{} names the tendon {}, which is none of this model", shown(e), in_quotes(of)));
        return found->second;
    };
    const char* const keys[] = {of_tendons ? "tendon1" : "joint1", of_tendons ? "tendon2" : "joint2"};
    Robot::Coupling coupling{
        .name = name, .joint = named(file_.needed_text(e, keys[0])), .of_tendons = of_tendons};
    const auto other = file_.text(e, keys[1]);
    if (other) coupling.other = named(*other);
    if (coupling.joint < 0 || (other && coupling.other < 0))
        return file_.drop(say("couplings of tendons that wrap around <geom>s"), name, Effect::motion);
    const std::vector<double> polynomial =
        values_->numbers(e, "polycoef").value_or(std::vector<double>{0, 1, 0, 0, 0});
    for (std::size_t k = 0; k < std::min<std::size_t>(5, polynomial.size()); ++k)
        if (k == 0 || coupling.other >= 0) coupling.polynomial[k] = polynomial[k];
    robot_.couplings.push_back(coupling);
}

}  // namespace alembert
