// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What Kane's and d'Alembert's equations share: forces on points instead of V, inertia about the mass centre, and
/// the obstacle of scenes whose energies are given without the bodies that have them.

#include "model/formalism/equations.hpp"
#include "model/formalism/obstacle.hpp"

namespace alembert {

/// A force and the position of the point on which it acts, both along N; or a generalized force along an
/// expression.
struct PlacedForce {
    Origin origin;
    GiNaC::ex place, force;  ///< if along an expression, one component
};

/// The forces of all parts of V, which replace its gradient: gravity on each mass, what springs exert, and
/// −∂V/∂q_i along each coordinate of a part whose forces are not known, [energy] potential. A spring between two
/// points gives two opposite forces k (d − d₀) along the line; a spring `along` an expression gives −k (d − d₀)
/// along it. Where k or d₀ changes with the coordinates, −½ (d − d₀)² acts along k, and k (d − d₀) along d₀.
std::vector<PlacedForce> conservative_forces(const Mechanism& mechanism);

/// Q_i of the loads by the virtual displacements ∂r/∂q of the points on which they act; for torques, where only an
/// angular velocity is known, by ∂ω/∂q'.
std::vector<GiNaC::ex> work_of_loads(const Mechanism& mechanism, bool dissipative);

/// The elements xx yy zz xy yz zx of the inertia about the mass centre, by Steiner's theorem if the scene gives
/// them about another point.
std::array<GiNaC::ex, 6> central_inertia(const MassElement& body, Intermediates& z);

/// The rate of the momentum of a body, m a + m' v, from m a, where its mass changes; m a where it does not.
Vector3 with_mass_rate(const MassElement& body, const Vector3& inertia, const Vector3& velocity, Intermediates& z);

/// Σ m' v·∂v/∂q' of masses that change, by coordinate: what d/dt ∂T/∂q' and the force of what leaves have in
/// common. Empty if no mass changes.
std::vector<GiNaC::ex> carried_momentum(const Mechanism& m);

/// Does all kinetic energy belong to particles and bodies?
bool masses_are_known(const Mechanism& mechanism);

/// Why a formalism does not apply to a scene without coordinates. `who` is its name, such as "Kane's equations".
std::optional<std::string> no_coordinates(const Mechanism& mechanism, const std::string& who);

/// The same for a formalism that starts from the velocities of particles and bodies, which also does not apply if
/// the scene has [energy] kinetic or lagrangian.
std::optional<std::string> masses_unknown(const Mechanism& mechanism, const std::string& who);

/// `values` with symbols replaced, through the definitions of intermediate symbols.
std::vector<GiNaC::ex> substitute(Intermediates& z, const std::vector<GiNaC::ex>& values, const GiNaC::exmap& by);

/// `e` as a textbook writes it if that is short, otherwise `e` itself. Quotients by the result and its derivatives
/// are then short too.
GiNaC::ex short_form(const GiNaC::ex& e, const Mechanism& mechanism);

/// Equations with symbols and an n×n matrix of zeros, without forces and constraints.
Equations equations_without_terms(const std::string& formalism, const Mechanism& mechanism);

/// A, γ and λ of the scene's constraints.
void attach_constraints(const Mechanism& mechanism, Equations& equations);

}  // namespace alembert
