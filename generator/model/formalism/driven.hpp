// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Coordinates that constraints drive at a constant rate, whatever the others do: φ' = Ω where φ = Ω·t, and ψ' =
/// Ω/2 where a gear ties ψ to φ besides. While everything else rests, they go on.
///
///     const GiNaC::exmap rates = driven_rates(mechanism);         // φ' → Ω
///     rest_conditions(mechanism, counted_from(equations, rates))  // with the forces of inertia of the rotation
///
/// Rates that are counted from these have zeros at rest: q' becomes q' + c.

#include "model/formalism/equations.hpp"

namespace alembert {

/// The rates that are not zero, in parameters.
GiNaC::exmap driven_rates(const Mechanism& mechanism);

/// The constraints with rates counted from these; energies and loads stay as they are.
Mechanism counted_from(Mechanism mechanism, const GiNaC::exmap& rates);

/// The right-hand sides of the equations in rates counted from these.
Equations counted_from(Equations equations, const GiNaC::exmap& rates);

/// The expression in rates counted from these.
GiNaC::ex counted_from(const GiNaC::ex& e, const Mechanism& mechanism, const GiNaC::exmap& rates);

}  // namespace alembert
