// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// cvode and ida of SUNDIALS as methods of `simulate`, if the program was built with them (plugins/backend.hpp).
///
///     if (is_sundials(name)) system.by = sundials_integrator(name, module, parameters);

#include <string>
#include <string_view>

#include "alembert/native/module.hpp"
#include "alembert/ode/integrate.hpp"
#include "analysis/derive/derived.hpp"

namespace alembert {

bool is_sundials(std::string_view method);

/// Throws ModelError for ida with constraints in generalized speeds.
void need_sundials(const Derived& derived, std::string_view method);

/// Throws CompileError if this build has no SUNDIALS. With `has_signs` some of the module's parameters are signs,
/// which the right-hand sides hold.
Integrator sundials_integrator(std::string_view method, const Module& module,
                               const std::vector<double>& parameters, bool has_signs);

}  // namespace alembert
