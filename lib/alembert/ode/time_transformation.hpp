// SPDX-License-Identifier: MIT
#pragma once

/// Integration in a time s of its own, in which near collisions are slow: a step of s is short in t where the
/// potential is deep.
///
///     Options options{.method = Method::kahanli8, .duration = 60, .step = 0.02,
///                     .regularization = Regularization::canonical};
///     const Trajectory motion = integrate(rhs, start, options);          // rhs.energies must be there
///
/// With U = −V > 0, B = U − T at the start (so that T + B = U in the exact motion), and the value U₀ of U at the
/// start, by which s runs like t at first:
///
///     rescaled    dy/ds = f g(U),          dt/ds = g(U),     g(x) = (U₀/x)^γ         for any system
///     canonical   dq/ds = v g(T + B),      dt/ds = g(T + B),      dv/ds = a g(U)     q' = v, M v' = −∂V/∂q
///
/// The second is the canonical system of Γ = G(T + B) − G(U) with G' = g, which is zero along the motion, for a
/// constant M. Its q and t change by v alone and its v by q alone, so that splitting methods stay explicit
/// (symplectic_composition.hpp); implicit symplectic methods stay symplectic too.
///
/// γ = 1, a logarithmic Γ, for verlet, which then follows two bodies that attract each other as 1/r on their exact
/// orbit, with an error in the time alone, and for methods that choose their steps. γ = 3/2 for the other methods
/// with fixed steps: a step is then the same part of the time in which two bodies at that distance would fall
/// together, and steps of high order resolve the nearest place of an orbit with 1 − e = 1e-4 as well as the rest.
///
/// Since B is a constant, an error ε of Γ in a deep place changes the energy by ε U far outside only: rounding in
/// the pericentre of that orbit does not change its period in the 12th digit, as it does in t.
///
/// Options keep their meanings, except that `step` is one of s. Rows, events and steps are told in t. A row
/// between two steps is a state on the step's dense output whose t is that of the row. The last step is repeated
/// with lengths from Newton's method until it ends at the end of the run.
///
/// It is one piece with another clock, and no mode of the automaton (hybrid/automaton.hpp): its right-hand side,
/// rows and end are different from those in t, and nothing comes after it.
///
/// Sources: S. Mikkola & K. Tanikawa, Celest. Mech. Dyn. Astron. 74 (1999) 287-295; M. Preto & S. Tremaine,
/// Astron. J. 118 (1999) 2532-2541; Hairer, Lubich, Wanner,
/// Geometric Numerical Integration, 2nd ed. 2006, §VIII.2.

#include "alembert/ode/integrate.hpp"

namespace alembert {

/// What `integrate` calls if Options::regularization is given. Throws std::invalid_argument if the right-hand side
/// has no energies or has quadratures, if V is not negative at the start, for the canonical form of a state that
/// is not (q, q'), and for methods that need more of a system than its right-hand side (taylor, rattle).
Trajectory integrate_regularized(const System& system, const std::vector<double>& initial, const Options& options,
                                 const Events& events, const RunPiece& piece);

}  // namespace alembert
