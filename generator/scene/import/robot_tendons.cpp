// SPDX-License-Identifier: GPL-2.0-or-later
// What acts on several coordinates at once. A spring of stiffness k that is slack between the lengths a and b has
// the potential ½ k d² with d = max(L − b, min(L − a, 0)). Damping d and armature J of a joint in space belong to
// each component of the angular velocity ω of the child in the parent: R = ½ d ω², T = ½ J ω².
#include <fmt/format.h>

#include <cmath>

#include "base/language/say.hpp"
#include "scene/import/scene_writer.hpp"
#include "scene/text.hpp"

namespace alembert {

/// The force that bears a part of the weight of a body's links, at the mass centre of these parts.
void SceneWriter::held(const Group& group) {
    if (group.ground || !group.kept || robot_.gravity.isZero(0)) return;
    double mass = 0;
    Real3 centre = Real3::Zero();
    bool all = true;
    for (const int i : group.links) {
        const double part = link(i).held * link(i).mass;
        mass += part;
        centre += part * (seat(i).shift + seat(i).R * link(i).centre);
        all &= link(i).held == link(group.top).held || link(i).mass == 0;
    }
    Real3 moment = centre - mass * group.centre;  // of the parts about the mass centre of the body
    if (!(mass * robot_.gravity).allFinite() || !moment.allFinite())
        throw ModelError(say("the weight of {} is not finite", in_quotes(link(group.top).name)));
    if (mass == 0 && moment.isZero(0)) return;
    std::string at = group.centre_name;
    if (mass == 0) {
        drop(say("gravity compensation whose forces are a couple"), {link(group.top).name}, Robot::Effect::motion);
        return;
    }
    if (!all) {
        at = places_.given(group.name + "_held");
        points_ += fmt::format("\n[[point]]\nname = \"{}\"\nfrom = \"{}\"\noffset = {}\naxes = \"{}\"\n", at,
                               group.centre_name, scene_vector(moment / mass), group.frame);
    }
    points_ += fmt::format("\n# gravity compensation\n[[force]]\nat = \"{}\"\nvector = {}\n", at,
                           scene_vector(-mass * robot_.gravity));
}

/// Damping and armature of a spherical or floating joint.
void SceneWriter::in_space(const Robot::Joint& joint, const Group& child, const std::vector<std::string>& shifts) {
    if (joint.damping == 0 && joint.armature == 0) return;
    const Group& parent = groups_[static_cast<std::size_t>(seat(joint.parent).group)];
    const std::string turn = parent.ground ? fmt::format("omega({})", child.frame)
                                           : fmt::format("omega({}) - omega({})", child.frame, parent.frame);
    std::string squares = fmt::format("dot({0}, {0})", turn);
    for (const std::string& shift : shifts) squares += fmt::format(" + {}'^2", shift);
    if (!shifts.empty()) squares = fmt::format("({})", squares);
    add_term(dissipation_, joint.damping / 2, squares);
    add_term(kinetic_, joint.armature / 2, squares);
}

/// The name of a point that is given in a link, a new one if there is none.
std::string SceneWriter::point_of(int of, const Real3& inside, const std::string& wanted) {
    const Seat& own = seat(of);
    const Group& group = groups_[static_cast<std::size_t>(own.group)];
    if (inside.isZero(0) && !link_names_[static_cast<std::size_t>(of)].empty())
        return link_names_[static_cast<std::size_t>(of)];
    if (inside.isZero(0) && !group.ground && of == group.top) return group.name;
    Real3 offset = own.shift + own.R * inside;
    if (!group.ground) offset -= group.centre;
    const std::string& from = group.centre_name;
    if (offset.isZero(0)) return from;
    const std::string name = places_.given(wanted);
    points_ += fmt::format("\n[[point]]\nname = \"{}\"\nfrom = \"{}\"\noffset = {}\naxes = \"{}\"\n", name, from,
                           scene_vector(offset), group.frame);
    return name;
}

/// The length in coordinates; empty if a part of it moves no mass.
std::string SceneWriter::length_of(const Robot::Tendon& tendon) {
    std::string length;
    for (const Robot::Tendon::Term& term : tendon.terms) {
        const std::string& q = values_of_[static_cast<std::size_t>(term.joint)];
        if (q.empty()) return "";
        add_term(length, term.coefficient, q);
    }
    double constant = 0;
    int count = 0;
    for (const Robot::Tendon::Stretch& s : tendon.stretches) {
        const Seat &from = seat(s.from), &to = seat(s.to);
        if (from.group == to.group) {
            constant += s.factor * (from.shift + from.R * s.from_at - to.shift - to.R * s.to_at).norm();
            continue;
        }
        for (const Seat* end : {&from, &to})
            if (const Group& group = groups_[static_cast<std::size_t>(end->group)]; !group.ground && !group.kept)
                return "";
        const auto point = [&](int of, const Real3& inside) {
            return point_of(of, inside, fmt::format("{}_{}", tendon.name, ++count));
        };
        const std::string a = point(s.from, s.from_at), b = point(s.to, s.to_at);
        add_term(length, s.factor, fmt::format("norm(pos({}, {}))", a, b));
    }
    if (!length.empty()) add_term(length, constant, "");
    return length;
}

void SceneWriter::tendon(const Robot::Tendon& tendon, std::string& length) {
    length = length_of(tendon);
    if (length.empty()) return drop(say("tendons that move no mass"), {tendon.name}, Robot::Effect::motion);
    if (tendon.stiffness != 0) {
        const auto [low, high] = tendon.rest;
        const auto beyond = [&](double end) {
            std::string difference = length;
            add_term(difference, -end, "");
            return difference;
        };
        const bool never_short = low <= 0 && tendon.terms.empty();  // a distance is not negative
        const std::string stretched = low == high ? length
                                      : never_short
                                          ? fmt::format("max({}, 0)", beyond(high))
                                          : fmt::format("max({}, min({}, 0))", beyond(high), beyond(low));
        springs_ += fmt::format("\n# {}\n[[spring]]\nalong = \"{}\"\nstiffness = {}\n{}",
                                escaped(tendon.name, 200), stretched, scene_number(tendon.stiffness),
                                low == high && low != 0 ? fmt::format("length = {}\n", scene_number(low)) : "");
    }
    if (tendon.damping != 0)
        dampers_ += fmt::format("\n# {}\n[[damper]]\nalong = \"{}\"\ndamping = {}\n", escaped(tendon.name, 200),
                                length, scene_number(tendon.damping));
    add_term(kinetic_, tendon.armature / 2, fmt::format("(({})')^2", length));
    if (options_.friction && tendon.friction != 0) {
        with_friction_.insert(tendon.name);
        frictions_ +=
            fmt::format("\n[[friction]]\nname = \"{}\"\ncoefficient = {}\nslip = \"({})'\"\nnormal = 1\n",
                        values_.given(tendon.name + "_friction"), scene_number(tendon.friction), length);
    }
    if (options_.stops && tendon.limits) tendon_stops(tendon, length);
}

/// Contacts at the ends of the range of a tendon, unless one does not hold in the pose of the file.
void SceneWriter::tendon_stops(const Robot::Tendon& tendon, const std::string& length) {
    const auto [low, high] = *tendon.limits;
    if (tendon.start < low || tendon.start > high) return;
    with_stops_.insert(tendon.name);
    std::string above = length, below = scene_number(high);
    add_term(above, -low, "");
    add_term(below, -1, fmt::format("({})", length));
    const bool never_short = low <= 0 && tendon.terms.empty();  // a distance is not negative
    for (const auto& [end, gap] : {std::pair("low", above), std::pair("high", below)})
        if (end != std::string("low") || !never_short)
            stops_ += fmt::format("\n[[unilateral]]\nname = \"{}\"\ngap = \"{}\"\n",
                                  values_.given(fmt::format("{}_{}", tendon.name, end)), gap);
}

void SceneWriter::energies() {
    if (!kinetic_.empty()) result_.text += fmt::format("\n[energy]\nkinetic = \"{}\"\n", kinetic_);
    if (!dissipation_.empty()) result_.text += fmt::format("\n[dissipation]\nrayleigh = \"{}\"\n", dissipation_);
}

}  // namespace alembert
