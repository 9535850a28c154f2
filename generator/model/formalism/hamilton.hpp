// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Hamilton's canonical equations.
///
///     const CanonicalEquations c = canonical(mechanism).value();      // c.H in q, p_<coordinate> and t
///     const Equations equations = hamilton(mechanism);
///
/// `hamilton` eliminates the momenta again by p = ∂L/∂q', so that its result can be compared with the other
/// formalisms.

#include "model/formalism/obstacle.hpp"
#include "model/formalism/steps.hpp"

namespace alembert {

struct CanonicalEquations {
    std::vector<GiNaC::symbol> p;    ///< p_<coordinate>
    std::vector<GiNaC::ex> momenta;  ///< ∂L/∂q' in q, q', t
    GiNaC::matrix M;                 ///< ∂p/∂q'
    GiNaC::ex H;
    std::vector<GiNaC::ex> qdot, pdot;  ///< ∂H/∂p, −∂H/∂q + Q in q, p, t
    std::vector<GiNaC::ex> force;       ///< −∂H/∂q alone
};

/// There is an obstacle if the scene has constraints, if L is not of second degree in the rates, or if its mass
/// matrix is singular.
Possible<CanonicalEquations> canonical(const Mechanism& mechanism);
std::optional<std::string> obstacle_to_hamilton(const Mechanism& mechanism);

/// Throws ModelError with the obstacle if there is one.
Equations hamilton(const Mechanism& mechanism);
/// The steps shown: H and the canonical equations.
OwnSteps steps_of_hamilton(const Mechanism& mechanism, const Equations& equations);

/// X with M X = right, by symbolic elimination for a symmetric M; there is an obstacle if a pivot is zero.
Possible<std::vector<GiNaC::ex>> solve_named(const GiNaC::matrix& M, const std::vector<GiNaC::ex>& right,
                                             const Mechanism& mechanism);

}  // namespace alembert
