// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/origin.hpp"

#include <fmt/format.h>

#include "base/language/say.hpp"

namespace alembert {

namespace {

/// With a place for the number, {0}, and for the name, {1}.
const char* pattern(const Origin& origin) {
    using Kind = Origin::Kind;
    switch (origin.kind) {
        case Kind::particle:
            return to_say("particle {1}");
        case Kind::body:
            return to_say("body {1}");
        case Kind::rotation:
            return to_say("rotation of body {1}");
        case Kind::gravity:
            return origin.on_body ? to_say("gravity on body {1}") : to_say("gravity on particle {1}");
        case Kind::spring:
            return to_say("spring {0}");
        case Kind::damper:
            return to_say("damper {0}");
        case Kind::force:
            return to_say("force {0} at {1}");
        case Kind::torque:
            return to_say("torque {0} on {1}");
        case Kind::impulse:
            return to_say("impulse {0} at {1}");
        case Kind::generalized_force:
            return to_say("force on {1}");
        case Kind::generalized_impulse:
            return to_say("impulse on {1}");
        case Kind::given_kinetic:
            return "[energy] kinetic";
        case Kind::given_potential:
            return "[energy] potential";
        case Kind::given_lagrangian:
            return "[energy] lagrangian";
        case Kind::rayleigh:
            return "[dissipation]";
        case Kind::friction:
            return to_say("friction {1}");
        case Kind::armature:
            return to_say("armature of {1}");
    }
    return "";
}

}  // namespace

std::string label(const Origin& origin) {
    const int number = origin.index + 1;
    return fmt::vformat(pattern(origin), fmt::make_format_args(number, origin.name));
}

std::string shown_label(const Origin& origin) {
    const int number = origin.index + 1;
    return translated_with(pattern(origin), fmt::make_format_args(number, origin.name));
}

Origin gravity_on(const Origin& mass) {
    return {Origin::Kind::gravity, mass.index, mass.name, mass.kind == Origin::Kind::body};
}

}  // namespace alembert
