// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What Kane's and d'Alembert's equations share: forces on points instead of V, inertia about the mass centre, and
/// the refusal of scenes whose energies are given without the bodies that have them.

#include "formalism/equations.hpp"
#include "formalism/obstacle.hpp"

namespace alembert {

/// A force and the place that it acts on, both along N; or a generalized force along an expression.
struct PlacedForce {
    Origin origin;
    GiNaC::ex place, force;  ///< one component
};

/// Gravity on each mass and springs, as forces: between points a pair of opposite ones, k (d − d₀) along the line;
/// `along` an expression −k (d − d₀) on it. In place of the gradient of V.
std::vector<PlacedForce> conservative_forces(const Mechanism& mechanism);

/// −∂V/∂q of [energy] potential, which no force is known of.
std::vector<GiNaC::ex> potential_without_forces(const Mechanism& mechanism);

/// Q_i of the loads, by virtual displacements ∂r/∂q of what they act on; by ∂ω/∂q' where only a turning is known
/// (torques).
std::vector<GiNaC::ex> work_of_loads(const Mechanism& mechanism, bool dissipative);

/// Elements xx yy zz xy yz zx about the mass centre: Steiner's theorem where the scene gives them about another
/// point.
std::array<GiNaC::ex, 6> central_inertia(const MassElement& body, Intermediates& z);

/// Does all kinetic energy belong to particles and bodies?
bool masses_are_known(const Mechanism& mechanism);

/// Why a formalism does not apply to a scene without coordinates. `who`: "Kane's equations".
std::optional<std::string> no_coordinates(const Mechanism& mechanism, const std::string& who);

/// The same, and for [energy] kinetic or lagrangian, of one that starts from the velocities of particles and
/// bodies.
std::optional<std::string> masses_unknown(const Mechanism& mechanism, const std::string& who);

/// `values` with symbols replaced, through the definitions of intermediate symbols.
std::vector<GiNaC::ex> substitute(Intermediates& z, const std::vector<GiNaC::ex>& values, const GiNaC::exmap& by);

/// `e` as a textbook writes it where that is short, itself otherwise: what is divided by it, and what is
/// differentiated, stays short too.
GiNaC::ex short_form(const GiNaC::ex& e, const Mechanism& mechanism);

/// Symbols and an n×n matrix of zeros; no forces, no constraints.
Equations equations_without_terms(const std::string& formalism, const Mechanism& mechanism);

/// A, γ and λ of the scene's constraints.
void attach_constraints(const Mechanism& mechanism, Equations& equations);

}  // namespace alembert
