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

/// Adds an input for each motor, its control, and the force that follows from it.
void SceneWriter::actuators() {
    std::vector<std::string> without_mass;
    for (const Robot::Actuator& motor : *robot_.actuators) {
        const bool pulls = motor.tendon >= 0;
        const auto of = static_cast<std::size_t>(pulls ? motor.tendon : motor.joint);
        const std::string& along = pulls ? lengths_[of] : values_of_[of];
        if (along.empty()) {
            without_mass.push_back(motor.name);
            continue;
        }
        const std::string input = values_.given("drive_" + motor.name);
        inputs_ += fmt::format("{} = 0\n", scene_key(input));
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
        result_.drives.push_back(input);
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
