// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The origin of a part of the mechanism in the scene. Code uses `kind` and `index`; `label` is for people only.
///
///     if (part.origin.kind != Origin::Kind::gravity) …
///     fmt::print("V of {}", label(part.origin));       // "V of gravity on particle M1"

#include <string>

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
    };
    Kind kind = Kind::body;
    /// Position in the scene's table of that kind; for gravity, in the table of the mass on which it acts.
    int index = 0;
    std::string name = {};  ///< of the particle, body, point, frame or coordinate; empty if the kind has none
    bool on_body = false;   ///< for gravity: whether the mass is a body
};

/// "body A", "rotation of body A", "spring 1", "force 2 at P", "[energy] kinetic".
std::string label(const Origin& origin);

/// The same in the language of the reader; `label` is for emitted code, which is English.
std::string shown_label(const Origin& origin);

/// Gravity on a particle or body.
Origin gravity_on(const Origin& mass);

}  // namespace alembert
