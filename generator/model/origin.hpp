// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The origin of a part of the mechanism in the scene. Code uses `kind` and `index`; `label` is for people only.
///
///     if (part.origin.kind != Origin::Kind::gravity) …
///     fmt::print("V of {}", label(part.origin));       // "V of gravity on particle M1"

#include <array>
#include <string>
#include <vector>

#include "base/language/say.hpp"

namespace alembert {

struct Origin {
    enum class Kind {
        particle,
        body,
        rotation,  ///< the share of a body's rotation in T
        gravity,
        spring,
        damper,
        force,
        torque,
        impulse,
        generalized_force,  ///< along a coordinate
        generalized_impulse,
        given_kinetic,  ///< [energy] kinetic
        given_potential,
        given_lagrangian,
        rayleigh,  ///< [dissipation]
        friction,  ///< dry friction
        armature,  ///< the rotor of a joint
        thrust,    ///< of what leaves a particle
    };
    Kind kind = Kind::body;
    /// Position in the scene's table of that kind; for gravity, in the table of the mass on which it acts.
    int index = 0;
    std::string name = {};  ///< of the particle, body, point, frame or coordinate; empty if the kind has none
    bool on_body = false;   ///< for gravity: whether the mass is a body
};

/// What people read of a kind, and the names by which a claim may call a part of it. Each with a place for the
/// number, {0}, and for the name, {1}.
struct OriginWords {
    Origin::Kind kind;
    const char* text;
    std::array<const char*, 3> names;
};

inline constexpr OriginWords origin_words[] = {
    {Origin::Kind::particle, to_say("particle {1}"), {"{1}"}},
    {Origin::Kind::body, to_say("body {1}"), {"{1}", "translation_{1}"}},
    {Origin::Kind::rotation, to_say("rotation of body {1}"), {"{1}", "rotation_{1}"}},
    {Origin::Kind::gravity, to_say("gravity on particle {1}"), {"{1}", "gravity_{1}", "gravity"}},
    {Origin::Kind::spring, to_say("spring {0}"), {"spring_{0}", "springs"}},
    {Origin::Kind::damper, to_say("damper {0}"), {"damper_{0}", "dampers"}},
    {Origin::Kind::force, to_say("force {0} at {1}"), {"{1}", "force_{0}"}},
    {Origin::Kind::torque, to_say("torque {0} on {1}"), {"{1}", "torque_{0}"}},
    {Origin::Kind::impulse, to_say("impulse {0} at {1}"), {"{1}", "impulse_{0}"}},
    {Origin::Kind::generalized_force, to_say("force on {1}"), {"{1}", "force_{1}"}},
    {Origin::Kind::generalized_impulse, to_say("impulse on {1}"), {"{1}", "force_{1}"}},
    {Origin::Kind::given_kinetic, "[energy] kinetic", {"energy"}},
    {Origin::Kind::given_potential, "[energy] potential", {"energy"}},
    {Origin::Kind::given_lagrangian, "[energy] lagrangian", {"energy"}},
    {Origin::Kind::rayleigh, "[dissipation]", {"dissipation"}},
    {Origin::Kind::friction, to_say("friction {1}"), {"{1}", "friction_{1}"}},
    {Origin::Kind::armature, to_say("armature of {1}"), {"{1}", "armature_{1}"}},
    {Origin::Kind::thrust, to_say("what leaves {1}"), {"{1}", "thrust_{1}"}},
};

/// "body A", "rotation of body A", "spring 1", "force 2 at P", "[energy] kinetic".
std::string label(const Origin& origin);

/// The same in each language in which people may write it.
std::vector<std::string> labels(const Origin& origin);

/// The same in the language of the reader; `label` is for emitted code, which is English.
std::string shown_label(const Origin& origin);

/// {"P", "force_2"}: the names by which a claim may call it.
std::vector<std::string> names_of(const Origin& origin);

/// Gravity on a particle or body.
Origin gravity_on(const Origin& mass);

}  // namespace alembert
