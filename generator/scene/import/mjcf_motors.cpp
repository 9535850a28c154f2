// SPDX-License-Identifier: GPL-2.0-or-later
// The motors of an MJCF file (documentation of MuJoCo: "Computation, Actuation model"; "XML reference, actuator").
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/language/say.hpp"
#include "scene/import/mjcf_reader.hpp"
#include "scene/text.hpp"

namespace alembert {

using Type = Robot::Type;

namespace {

/// The attributes of which a motor's law is made, of kinds that are known, and what defaults of other kinds have.
constexpr const char* of_laws[] = {"kp",       "kv",       "dampratio", "gainprm",  "biasprm",
                                   "gaintype", "biastype", "dyntype",   "timeconst"};
constexpr const char* of_other_laws[] = {"gear",  "gain",  "area", "diameter", "bias", "tausmooth", "range",
                                         "force", "scale", "lmin", "lmax",     "vmax", "fpmax",     "fvmax"};

}  // namespace

bool MjcfReader::Law::is_affine() const {
    if (dynamics != "none" || gain_type != "fixed" || !std::isfinite(gain[0])) return false;
    if (bias_type == "none") return true;
    return bias_type == "affine" &&
           std::all_of(bias.begin(), bias.end(), [](double x) { return std::isfinite(x); });
}

/// What the motor acts on; or what is told of one that cannot be had.
std::optional<std::string> MjcfReader::take_motor_of(const XmlElement& e, Robot::Actuator& motor) {
    const bool in_parent = !file_.text(e, "joint") && file_.text(e, "jointinparent");
    const auto on_joint = file_.text(e, in_parent ? "jointinparent" : "joint");
    std::vector<double> gear = values_->numbers(e, "gear", 0, "general").value_or(std::vector<double>{1});
    gear.resize(6);
    motor.gear = gear[0];
    const Real3 first(gear[0], gear[1], gear[2]), second(gear[3], gear[4], gear[5]);
    if (on_joint) {
        motor.joint = joint_named(e, *on_joint);
        const Robot::Joint& joint = robot_.joints[static_cast<std::size_t>(motor.joint)];
        if (joint.type == Type::floating)
            motor.wrench = {.link = joint.child,
                            .torque_axes = in_parent ? -1 : joint.child,
                            .force = first,
                            .torque = second};
        else if (joint.type == Type::spherical)
            motor.wrench = {.link = joint.child,
                            .torque_axes = in_parent ? joint.parent : joint.child,
                            .against = joint.parent,
                            .torque = first};
        return std::nullopt;
    }
    if (const auto site = file_.text(e, "site")) {
        if (file_.text(e, "refsite")) return say("<{}> between two sites", e.Name());
        const int link = site_named(e, *site).link;
        motor.wrench = {.link = link, .force_axes = link, .torque_axes = link, .force = first, .torque = second};
        return std::nullopt;
    }
    const auto on_tendon = file_.text(e, "tendon");
    if (!on_tendon) return fmt::format("<{}>", e.Name());
    const auto found = tendons_.find(*on_tendon);
    if (found == tendons_.end())
        file_.refuse(e,
                     say("{} names the tendon {}, which is none of this model", shown(e), in_quotes(*on_tendon)));
    motor.tendon = found->second;
    if (motor.tendon < 0 || !robot_.tendons[static_cast<std::size_t>(motor.tendon)].stretches.empty())
        return say("<{}> on a tendon through sites", e.Name());
    return std::nullopt;
}

void MjcfReader::read_actuator(const XmlElement& e) {
    const std::string name = name_of(e, fmt::format("motor{}", ++motors_));
    const Law law = law_of(e);
    const auto leave_out = [&](const std::string& what) {
        file_.ignore(e);
        file_.drop(what, name, !law.is_known || law.bias_type != "none" ? Effect::motion : Effect::driven);
    };
    Robot::Actuator motor{.name = name, .joint = -1};
    if (!law.is_known) return leave_out(fmt::format("<{}>", e.Name()));
    if (const auto what = take_motor_of(e, motor)) return leave_out(*what);
    file_.children(*e.Parent()->ToElement(), e.Name());
    if (!law.is_affine()) return leave_out(say("<{}> with states, or of a law that is not affine", e.Name()));
    motor.gain = law.gain[0];
    if (law.bias_type == "affine") {
        motor.constant = law.bias[0];
        motor.along = law.bias[1];
        motor.rate = law.bias[2];
    }
    if (motor.wrench && (motor.along != 0 || motor.rate != 0))
        return leave_out(say("<{}> that measures, at a site or on a ball or free joint", e.Name()));
    set_damping_ratio(e, motor);
    std::set<std::string> known(std::begin(of_laws), std::end(of_laws));
    known.insert(std::begin(of_other_laws), std::end(of_other_laws));
    tell_defaults(e, name, "general", known);
    for (const char* own : of_laws) file_.ignore(e, own);
    if (!motor.wrench) {
        const double reference = motor.joint >= 0
                                     ? references_[robot_.joints[static_cast<std::size_t>(motor.joint)].name]
                                     : robot_.tendons[static_cast<std::size_t>(motor.tendon)].at_reference;
        motor.constant += motor.along * motor.gear * reference;
    }
    motor_numbers_.push_back(motors_ - 1);
    robot_.actuators->push_back(std::move(motor));
}

/// A servo whose damping is positive has a damping ratio ζ there: d = 2 ζ √(k m), where m is the sum of the
/// diagonal elements of the mass matrix in the reference pose, each divided by the square of its joint's share of
/// the length.
void MjcfReader::set_damping_ratio(const XmlElement& e, Robot::Actuator& motor) {
    if (motor.rate <= 0 || motor.gain != -motor.along || motor.gain <= 0) return;
    if (!reference_) reference_ = reference_mass(robot_);
    std::vector<Robot::Tendon::Term> terms{{motor.joint, 1}};
    if (motor.tendon >= 0) terms = robot_.tendons[static_cast<std::size_t>(motor.tendon)].terms;
    double mass = 0;
    for (const Robot::Tendon::Term& term : terms) {
        const int row = reference_->first[static_cast<std::size_t>(term.joint)];
        const double share = motor.gear * term.coefficient;
        if (share != 0) mass += reference_->M.coeff(row, row) / (share * share);
    }
    motor.rate *= -2 * std::sqrt(motor.gain * mass);
    file_.remark(
        e,
        say("the damping ratio of motor {} is {:.6g} as a damping, with the inertia of MuJoCo 3; MuJoCo 4 takes "
            "the reciprocal of the mobility",
            in_quotes(motor.name), -motor.rate),
        "version");
}

/// All kinds of motors are one element of MuJoCo, with one default in each class: each <general>, <position> … on
/// the way writes into it, in the order of the file, and what it does not name stays as the one before has left
/// it.
MjcfReader::Law MjcfReader::law_of(const XmlElement& e) {
    Law law;
    for (const XmlElement* before : values_->defaults_of(e, "general")) change_law(*before, law);
    change_law(e, law);
    return law;
}

void MjcfReader::change_law(const XmlElement& e, Law& law) {
    const std::string tag = e.Name();
    const auto take = [&](const char* key, std::vector<double>& into) {
        const auto given = file_.numbers(e, key);
        for (std::size_t k = 0; given && k < std::min(given->size(), into.size()); ++k) into[k] = (*given)[k];
    };
    const auto word = [&](const char* key, std::string& into) { into = file_.text(e, key).value_or(into); };
    if (tag == "general") {
        word("dyntype", law.dynamics);
        word("gaintype", law.gain_type);
        word("biastype", law.bias_type);
        take("gainprm", law.gain);
        take("biasprm", law.bias);
        law.is_known = true;
    } else if (tag == "motor") {
        law = {.bias = law.bias};
    } else if (tag == "position") {
        law.gain = {file_.number(e, "kp").value_or(law.gain[0])};
        law.bias[1] = -law.gain[0];
        if (const auto kv = file_.number(e, "kv")) law.bias[2] = -*kv;
        if (const auto ratio = file_.number(e, "dampratio")) law.bias[2] = *ratio;
        if (const auto time = file_.number(e, "timeconst")) law.dynamics = *time == 0 ? "none" : "filterexact";
        law.gain_type = "fixed";
        law.bias_type = "affine";
        law.is_known = true;
    } else if (tag == "velocity") {
        law.gain = {file_.number(e, "kv").value_or(law.gain[0])};
        law.bias = {0, 0, -law.gain[0]};
        law.dynamics = "none";
        law.gain_type = "fixed";
        law.bias_type = "affine";
        law.is_known = true;
    } else {
        // What is not said after it stays as this kind leaves it, which is not known here.
        const std::string of_this = fmt::format("of <{}>", tag);
        law = {.gain = {NAN},
               .bias = {NAN, NAN, NAN},
               .dynamics = of_this,
               .gain_type = of_this,
               .bias_type = of_this,
               .is_known = false};
    }
}

}  // namespace alembert
