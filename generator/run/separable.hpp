// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What verlet and kahanli8 take for granted: q' = u, and M and u' = M⁻¹f in which no rate (and, for M, no
/// coordinate) occurs. What occurs only to cancel counts as there.
///
///     if (needs_separable(method)) need_separable(derived, name(method));

#include <optional>
#include <string>
#include <string_view>

#include "derive/derived.hpp"

namespace alembert {

/// Nothing where the system is of that kind, else the reason why not.
std::optional<std::string> inseparable(const Derived& derived);

/// Throws ModelError with the reason and what to do.
void need_separable(const Derived& derived, std::string_view method);

}  // namespace alembert
