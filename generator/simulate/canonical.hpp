// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The functions that the method rattle needs: M, p = ∂L/∂q' and F = ∂L/∂q + Q of a scene, as the outputs of a
/// separate file.
///
///     need_canonical(derived, name(method));                 // refuses, with the reason
///     const Program form = canonical_form(derived);
///     rhs.canonical = make_canonical(module, load(compile(emit(form).text, …).object), values);

#include <optional>
#include <string>
#include <string_view>

#include "analysis/derive/derived.hpp"

namespace alembert {

/// Nothing if the state is (q, q') and all constraints are holonomic; otherwise the reason why the method does not
/// apply.
std::optional<std::string> not_canonical(const Derived& derived);

/// Throws ModelError with that reason and what to do.
void need_canonical(const Derived& derived, std::string_view method);

/// L contains the constraints of quaternions; see lib/alembert/ode/hamiltonian_system.hpp.
Program canonical_form(const Derived& derived);

}  // namespace alembert
