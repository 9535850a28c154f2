// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Checks what verlet and kahanli8 require: q' = u, and M and u' = M⁻¹f do not contain rates (and M no
/// coordinates). Terms that would cancel count as present.
///
///     if (needs_separable(method)) need_separable(derived, name(method));

#include <optional>
#include <string>
#include <string_view>

#include "analysis/derive/derived.hpp"

namespace alembert {

/// Nothing if the system has this form; otherwise the reason why not.
std::optional<std::string> inseparable(const Derived& derived);

/// Throws ModelError with the reason and what to do.
void need_separable(const Derived& derived, std::string_view method);

}  // namespace alembert
