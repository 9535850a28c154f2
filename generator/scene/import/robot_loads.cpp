// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/language/say.hpp"
#include "scene/import/scene_writer.hpp"
#include "scene/text.hpp"

namespace alembert {

void SceneWriter::damper(const Robot::Joint& joint, const std::string& along) {
    if (joint.damping != 0)
        dampers_ +=
            fmt::format("\n[[damper]]\nalong = \"{}\"\ndamping = {}\n", along, scene_number(joint.damping));
}

void SceneWriter::spring(const Robot::Joint& joint, const std::string& along) {
    if (joint.stiffness == 0) return;
    springs_ +=
        fmt::format("\n[[spring]]\nalong = \"{}\"\nstiffness = {}\n{}", along, scene_number(joint.stiffness),
                    joint.rest == 0 ? "" : fmt::format("length = {}\n", scene_number(joint.rest)));
}

/// Adds a torque or force of constant size against the motion along q.
void SceneWriter::friction(const Robot::Joint& joint, const std::string& q) {
    if (!options_.friction || joint.friction == 0) return;
    if (joint.friction < 0)
        throw ModelError(say("the friction of joint {} is {}; expected zero or more", in_quotes(joint.name),
                             scene_number(joint.friction)));
    with_friction_.insert(joint.name);
    frictions_ += fmt::format("\n[[friction]]\nname = \"{}\"\ncoefficient = {}\nslip = \"{}'\"\nnormal = 1\n",
                              values_.given(joint.name + "_friction"), scene_number(joint.friction), q);
}

/// Adds a contact at each end of the range of q, without rebound.
void SceneWriter::stops(const Robot::Joint& joint, const std::string& q) {
    if (!options_.stops) return;
    with_stops_.insert(joint.name);
    const auto [low, high] = *joint.limits;
    const auto stop = [&](const char* end, const std::string& gap) {
        stops_ += fmt::format("\n[[unilateral]]\nname = \"{}\"\ngap = \"{}\"\n",
                              values_.given(fmt::format("{}_{}", joint.name, end)), gap);
    };
    stop("low", fmt::format("{} {} {}", q, low < 0 ? '+' : '-', scene_number(std::abs(low))));
    stop("high", fmt::format("{} - {}", scene_number(high), q));
}

/// Adds an input along the joint's coordinate, which is zero until it is given a value.
void SceneWriter::drive(const Robot::Joint& joint, const std::string& q, bool slides) {
    const std::string name = values_.given("drive_" + joint.name);
    inputs_ += fmt::format("{} = {{ value = 0, unit = \"{}\" }}\n", scene_key(name), slides ? "N" : "N*m");
    forces_.emplace_back(q, name);
    result_.drives.push_back(name);
}

/// Adds the input of a motor, and returns its name.
std::string SceneWriter::control_of(const Robot::Actuator& motor, double value) {
    const std::string input = values_.given("drive_" + motor.name);
    inputs_ += fmt::format("{} = {}\n", scene_key(input), scene_number(std::isnan(value) ? 0 : value));
    result_.drives.push_back(input);
    return input;
}

/// Adds the force and the torque of a motor on a body; false if it moves no mass.
bool SceneWriter::push_with(const Robot::Actuator& motor, double control) {
    const Robot::Actuator::Wrench& w = *motor.wrench;
    const auto group_of = [&](int link) -> const Group& {
        return groups_[static_cast<std::size_t>(seat(link).group)];
    };
    const Group& on = group_of(w.link);
    if (on.ground || !on.kept) return false;
    const std::string input = control_of(motor, control);
    const auto name_of = [&](int link) {
        const std::string& own = link_names_[static_cast<std::size_t>(link)];
        return own.empty() ? group_of(link).frame : own;
    };
    const auto along = [&](const Real3& v, int axes) {
        std::array<std::string, 3> sum;
        for (int k = 0; k < 3; ++k) {
            std::string& one = sum[static_cast<std::size_t>(k)];
            add_term(one, v[k] * motor.gain, input);
            add_term(one, v[k] * motor.constant, "");
            one = one.empty() ? "0" : scene_text(one);
        }
        return fmt::format("vector = [{}]\n{}", fmt::join(sum, ", "),
                           axes < 0 ? "" : fmt::format("axes = \"{}\"\n", name_of(axes)));
    };
    if (!w.force.isZero(0))
        points_ += fmt::format("\n# {}\n[[force]]\nat = \"{}\"\n{}", escaped(motor.name, 200),
                               point_of(w.link, Real3::Zero(), motor.name), along(w.force, w.force_axes));
    const bool bears = w.against >= 0 && !group_of(w.against).ground && group_of(w.against).kept;
    if (!w.torque.isZero(0))
        points_ += fmt::format("\n# {}\n[[torque]]\non = \"{}\"\n{}{}", escaped(motor.name, 200), on.frame,
                               along(w.torque, w.torque_axes),
                               bears ? fmt::format("reaction = \"{}\"\n", group_of(w.against).frame) : "");
    return true;
}

/// Adds an input for each motor, its control, and the force that follows from it.
void SceneWriter::actuators() {
    std::vector<std::string> without_mass;
    const auto& all = *robot_.actuators;
    for (const Robot::Actuator& motor : all) {
        const double control =
            keyframe_ == nullptr ? 0 : keyframe_->control[static_cast<std::size_t>(&motor - all.data())];
        if (motor.wrench) {
            if (!push_with(motor, control)) without_mass.push_back(motor.name);
            continue;
        }
        const bool pulls = motor.tendon >= 0;
        const auto of = static_cast<std::size_t>(pulls ? motor.tendon : motor.joint);
        const std::string& along = pulls ? lengths_[of] : values_of_[of];
        if (along.empty()) {
            without_mass.push_back(motor.name);
            continue;
        }
        const std::string input = control_of(motor, control);
        const double g = motor.gear;
        const auto push = [&](const std::string& q, double factor) {
            auto force = std::find_if(forces_.begin(), forces_.end(), [&](const auto& f) { return f.first == q; });
            if (force == forces_.end()) force = forces_.insert(force, {q, ""});
            const std::string length = pulls ? fmt::format("({})", along) : along;
            add_term(force->second, factor * g * motor.gain, input);
            add_term(force->second, factor * g * motor.constant, "");
            add_term(force->second, factor * g * g * motor.along, length);
            add_term(force->second, factor * g * g * motor.rate, length + "'");
            if (force->second.empty()) force->second = "0";
        };
        if (!pulls) push(along, 1);
        if (pulls)
            for (const Robot::Tendon::Term& term : robot_.tendons[of].terms)
                push(values_of_[static_cast<std::size_t>(term.joint)], term.coefficient);
    }
    drop(say("motors of joints that move no mass"), without_mass);
}

/// Adds the condition that one coordinate is a polynomial in another, or constant; or one length of a tendon, from
/// its value at the reference pose.
void SceneWriter::coupling(const Robot::Coupling& coupling) {
    const auto value = [&](int of) {
        if (of < 0) return std::string();
        const auto i = static_cast<std::size_t>(of);
        if (!coupling.of_tendons || lengths_[i].empty()) return coupling.of_tendons ? lengths_[i] : values_of_[i];
        std::string difference = lengths_[i];
        add_term(difference, -robot_.tendons[i].start, "");
        return fmt::format("({})", difference);
    };
    const std::string q = value(coupling.joint), other = value(coupling.other);
    if (q.empty() || (coupling.other >= 0 && other.empty()))
        return drop(say("couplings of joints that move no mass"), {coupling.name});
    std::string zero = q;
    for (std::size_t k = 0; k < coupling.polynomial.size(); ++k)
        add_term(zero, -coupling.polynomial[k], k == 0 ? "" : k == 1 ? other : fmt::format("{}^{}", other, k));
    const std::string name = values_.given(coupling.name);
    conditions_ += fmt::format("\n[[constraint]]\nname = \"{}\"\nholonomic = \"{}\"\n", name, zero);
    result_.couplings.push_back(name);
}

}  // namespace alembert
