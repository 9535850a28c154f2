// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A mechanism in which quantities that somebody states, right or wrong, have taken the place of its own: what
/// follows from them is then judged as it follows, not as it is.
///
///     Formulas formulas(scene, mechanism);
///     const Mechanism own = with_own(mechanism, {.kinetic = formulas.value(T)});
///     check(scene, own)         // the claims hold of the motion that this T would have

#include <map>
#include <optional>
#include <string>

#include "model/mechanism.hpp"

namespace alembert {

/// In the symbols of the mechanism.
struct OwnQuantities {
    /// With L, the equations follow from L; T and V are then what the letters T and V mean, and no more.
    std::optional<GiNaC::ex> kinetic = {}, potential = {}, lagrangian = {};
    std::map<std::string, GiNaC::ex> forces = {};  ///< by coordinate; of the others the mechanism's own
    bool forces_are_whole = false;  ///< whether these hold the forces of V too, as in d/dt ∂T/∂q' − ∂T/∂q = Q
};

/// Lagrange's equations, with multipliers where there are constraints, apply to the result; the energies of single
/// bodies and springs are unknown in it where T or V was stated. Geometry, masses and constraints are those of the
/// mechanism. Throws std::out_of_range for a name that is no coordinate.
Mechanism with_own(const Mechanism& mechanism, const OwnQuantities& own);

}  // namespace alembert
