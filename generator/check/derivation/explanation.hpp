// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Whether a small change that makes a line right is why the line fails: whether one makes such a slip.
///
///     is_plausible({.kind = "sign", …}, claim, order)       // true
///     is_plausible({.kind = "unknown"}, claim, order)       // false: it may be meant otherwise
///
/// Almost every false equation can be mended by one term more or by one less. Such a term is what the author
/// forgot only if it is one term, of no higher order in time than what the line speaks of: an equation of rest
/// lacks no acceleration. A term too many is a slip if enough is left without it. On some two hundred
/// derivations of people most lines that another change mends were mistakes, a third of those that any term more
/// mends, and few of those that any term less mends or that no change does.

#include <functional>
#include <optional>
#include <string>

#include "check/derivation/system.hpp"

namespace alembert {

/// The highest derivative in an expression: 2 of accelerations and forces of constraints, 1 of rates, else 0;
/// nothing if it has no value.
using OrderOf = std::function<std::optional<int>(const std::string& expression)>;

bool is_plausible(const Slip& slip, const LineClaim& claim, const OrderOf& order);

/// The same of what is said of states of rest, where a factor of coordinates may make anything vanish.
bool is_plausible_at_rest(const Slip& slip, const LineClaim& claim, const OrderOf& order,
                          const std::vector<std::string>& coordinates);

}  // namespace alembert
