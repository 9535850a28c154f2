// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What rattle steps with, from a scene: M, p = ∂L/∂q' and F = ∂L/∂q + Q as the outputs of a file of their own.
///
///     need_canonical(derived, name(method));                 // refuses, with the reason
///     const Program form = canonical_form(derived);
///     rhs.canonical = make_canonical(module, load(compile(emit(form).text, …).object), values);

#include <optional>
#include <string>
#include <string_view>

#include "derive/derived.hpp"

namespace alembert {

/// Nothing where the state is (q, q') and all constraints are holonomic, else the reason why not.
std::optional<std::string> not_canonical(const Derived& derived);

/// Throws ModelError with that reason and what to do.
void need_canonical(const Derived& derived, std::string_view method);

/// Quaternions have their constraint in L: see lib/alembert/canonical.hpp.
Program canonical_form(const Derived& derived);

}  // namespace alembert
