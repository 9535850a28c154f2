// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Routh's procedure: cyclic coordinates are found and removed, their momenta are constants.
///
///     const Reduction r = reduction(mechanism).value();   // r.cyclic = {1}: theta; r.R in the others and p_theta
///     const Equations equations = routhian(mechanism);

#include "formalism/obstacle.hpp"
#include "formalism/steps.hpp"

namespace alembert {

/// Coordinates with ∂L/∂q = 0 and no generalized force, by index.
std::vector<int> cyclic_coordinates(const Mechanism& mechanism);

struct Reduction {
    std::vector<int> cyclic, remaining;
    std::vector<GiNaC::symbol> p;    ///< of the cyclic coordinates, constants
    std::vector<GiNaC::ex> momenta;  ///< what they are in q, q'
    std::vector<GiNaC::ex> rates;    ///< of the cyclic coordinates, in p and the others
    GiNaC::ex R;
    GiNaC::matrix M;             ///< ∂²R/∂q'², of the remaining
    std::vector<GiNaC::ex> own;  ///< the rest of d/dt ∂R/∂q' − ∂R/∂q, to the right; with p
};

/// An obstacle is a scene in which no coordinate is cyclic, and those of `canonical`.
Possible<Reduction> reduction(const Mechanism& mechanism);
std::optional<std::string> obstacle_to_routhian(const Mechanism& mechanism);

/// All coordinates' equations, the momenta eliminated: comparable with the other formalisms.
/// Throws ModelError with the obstacle where there is one.
Equations routhian(const Mechanism& mechanism);
/// R, and the equations of the coordinates that are left.
OwnSteps steps_of_routhian(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
