// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Routh's procedure: cyclic coordinates are found and removed; their momenta are constants.
///
///     const Reduction r = reduction(mechanism).value();   // r.cyclic = {1}: theta; r.R in the others and p_theta
///     const Equations equations = routhian(mechanism);

#include "model/formalism/obstacle.hpp"
#include "model/formalism/steps.hpp"

namespace alembert {

/// The indices of coordinates with ∂L/∂q = 0 and no generalized force.
std::vector<int> cyclic_coordinates(const Mechanism& mechanism);

struct Reduction {
    std::vector<int> cyclic, remaining;
    std::vector<GiNaC::symbol> p;    ///< the momenta of the cyclic coordinates, which are constants
    std::vector<GiNaC::ex> momenta;  ///< the momenta as functions of q, q'
    std::vector<GiNaC::ex> rates;    ///< the rates of the cyclic coordinates as functions of p and the other rates
    GiNaC::ex R;
    GiNaC::matrix M;             ///< ∂²R/∂q'² for the remaining coordinates
    std::vector<GiNaC::ex> own;  ///< the other terms of d/dt ∂R/∂q' − ∂R/∂q, on the right-hand side; with p
};

/// There is an obstacle if no coordinate is cyclic or if `canonical` has one.
Possible<Reduction> reduction(const Mechanism& mechanism);
std::optional<std::string> obstacle_to_routhian(const Mechanism& mechanism);

/// The equations of all coordinates with the momenta eliminated, which can be compared with the other formalisms.
/// Throws ModelError with the obstacle if there is one.
Equations routhian(const Mechanism& mechanism);
/// The steps shown: R and the equations of the remaining coordinates.
OwnSteps steps_of_routhian(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
