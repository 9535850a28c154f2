// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Where a part of the mechanism comes from. Code asks for `kind` and `index`; `label` is for people alone.
///
///     if (part.origin.kind != Origin::Kind::gravity) …
///     fmt::print("V of {}", label(part.origin));       // "V of gravity on particle M1"

#include <string>

namespace alembert {

struct Origin {
    enum class Kind {
        particle,
        body,
        rotation,  ///< of a body: its share of T
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
        friction,  ///< dry
    };
    Kind kind = Kind::body;
    int index = 0;  ///< position in the scene's table of that kind; of gravity in the table of what it acts on
    std::string name = {};  ///< of the particle, body, point, frame or coordinate; empty where the kind has none
};

/// "body A", "rotation of body A", "spring 1", "force 2 at P", "[energy] kinetic".
std::string label(const Origin& origin);

/// Gravity on a particle or body.
Origin gravity_on(const Origin& mass);

}  // namespace alembert
