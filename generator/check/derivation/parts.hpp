// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Letters for parts of a quantity: T of one body, V of gravity alone, the generalized force of one load.
///
///     part_named({.base = "T", .raised = "particle M1"}, letters, system)      // ½ m₁ v₁²
///     part_named({.base = "V", .index = "g"}, letters, system)                 // of gravity on all bodies

#include <optional>

#include "check/derivation/letters.hpp"
#include "check/derivation/system.hpp"

namespace alembert {

/// Nothing for a letter that is none of these.
std::optional<GiNaC::ex> part_named(const Letter& letter, const Letters& letters, const DerivedSystem& system);

}  // namespace alembert
