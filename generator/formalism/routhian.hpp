// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Routh's procedure: cyclic coordinates are found and removed, their momenta are constants.
///
///     const Reduction r = reduction(mechanism);   // r.cyclic = {1}: theta; r.R in the others and p_theta
///     const Equations equations = routhian(mechanism);

#include "formalism/equations.hpp"

namespace alembert {

/// Coordinates with ∂L/∂q = 0 and no generalized force, by index.
std::vector<int> cyclic_coordinates(const Mechanism& mechanism);

struct Reduction {
    std::vector<int> cyclic, remaining;
    std::vector<GiNaC::symbol> p;       ///< of the cyclic coordinates, constants
    std::vector<GiNaC::ex> momenta;     ///< what they are in q, q'
    std::vector<GiNaC::ex> rates;       ///< of the cyclic coordinates, in p and the others
    GiNaC::ex R;
    GiNaC::matrix M;                    ///< ∂²R/∂q'², of the remaining
    std::vector<GiNaC::ex> own;         ///< the rest of d/dt ∂R/∂q' − ∂R/∂q, to the right; with p
};

/// Throws ModelError if no coordinate is cyclic, and as `canonical` does.
Reduction reduction(const Mechanism& mechanism);

/// All coordinates' equations, the momenta eliminated: comparable with the other formalisms.
Equations routhian(const Mechanism& mechanism);

}  // namespace alembert
