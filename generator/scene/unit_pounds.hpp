// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Whether the pound in a unit is a mass or a force, by one rule for all spellings.
///
///     "ft-lb", "lb ft", "inch-pounds"      // a torque: the pound is a force
///     "lb", "lb/ft^3", "lb ft^2"           // a mass
///     "lb/in", "kg-cm", "lb s/in"          // read as a mass, and told: the force is lbf, or kgf
///
/// A pound or ounce beside a foot or inch, each to the first power in the numerator, is a torque in any order,
/// unless the unit is per square second or more: lb ft/s^2 is a force of pounds as masses.

#include <set>
#include <string>
#include <vector>

#include "scene/unit_words.hpp"

namespace alembert {

/// A word of a unit as it is written.
struct WrittenWord {
    std::string word;
    std::size_t begin = 0;  ///< in the text
    int power = 1;          ///< with that of its parentheses, negative below a fraction bar
    UnitMeaning meaning = {};
};

/// The words, by where they begin, that are forces: "lbf" for lb, "ozf" for oz.
std::set<std::size_t> pounds_of_force(const std::vector<WrittenWord>& words);

/// The mass that may be meant as a force, in a unit whose words of `forces` are forces already; null for none.
const WrittenWord* doubtful_mass(const std::vector<WrittenWord>& words, const std::set<std::size_t>& forces);

/// "lbf" for pound, "kgf" for kg.
std::string force_of_mass(const UnitMeaning& mass);

}  // namespace alembert
