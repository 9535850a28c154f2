// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How the energy of a mechanism changes in all of its motions, where that can be proved: forces that depend on
/// the coordinates and have a potential belong to it, and the power of the others has one sign.
///
///     // quadratic drag, c > 0: P = −c |v|³
///     energy_rate(mechanism, problem, start.parameters) == EnergyRate::falls
///
/// About a strict minimum of the potential the energy is Lyapunov's function: the motion is stable if it never
/// grows (Lagrange and Dirichlet), and unstable if it grows in every motion, which then leaves all levels near the
/// minimum.

#include "stability/linear/steady.hpp"

namespace alembert {

enum class EnergyRate {
    open,      ///< nothing was proved
    constant,  ///< only a potential acts
    falls,     ///< it never grows
    grows      ///< of one coordinate: it grows whenever that moves
};

/// At these values of the independent parameters, whose signs decide. Constraints that the rates alone obey,
/// inputs and impulses leave it open.
EnergyRate energy_rate(const Mechanism& mechanism, const SteadyProblem& problem,
                       const std::vector<double>& parameters);

}  // namespace alembert
