// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/origin.hpp"

#include <fmt/format.h>

namespace alembert {

std::string label(const Origin& origin) {
    using Kind = Origin::Kind;
    const int number = origin.index + 1;
    switch (origin.kind) {
        case Kind::particle:
            return "particle " + origin.name;
        case Kind::body:
            return "body " + origin.name;
        case Kind::rotation:
            return "rotation of body " + origin.name;
        case Kind::gravity:
            return "gravity on " + origin.name;
        case Kind::spring:
            return fmt::format("spring {}", number);
        case Kind::damper:
            return fmt::format("damper {}", number);
        case Kind::force:
            return fmt::format("force {} at {}", number, origin.name);
        case Kind::torque:
            return fmt::format("torque {} on {}", number, origin.name);
        case Kind::impulse:
            return fmt::format("impulse {} at {}", number, origin.name);
        case Kind::generalized_force:
            return "force on " + origin.name;
        case Kind::generalized_impulse:
            return "impulse on " + origin.name;
        case Kind::given_kinetic:
            return "[energy] kinetic";
        case Kind::given_potential:
            return "[energy] potential";
        case Kind::given_lagrangian:
            return "[energy] lagrangian";
        case Kind::rayleigh:
            return "[dissipation]";
        case Kind::friction:
            return "friction " + origin.name;
    }
    return {};
}

Origin gravity_on(const Origin& mass) {
    return {Origin::Kind::gravity, mass.index, label(mass)};
}

}  // namespace alembert
