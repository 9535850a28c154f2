// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Decides whether a claim about rest is a combination of the static equations and the constraints.
///
///     const auto found = static_combination(claims, law, residual);
///     found && *found <= -60          // log₂ of the chance that the combination found does not exist
///
/// The residual r, times its denominators and at most two parameters that are not zero in the scene, is compared
/// with Σ c_ij g_j E_i: E_i are the equations of motion and the constraints with q' = q'' = 0, g_j products of at
/// most two of the parameters, coordinates, sines, cosines and roots that occur, c_ij numbers. r lies in the span
/// of the g_j E_i if it does at more random states than there are c_ij. No state of rest is needed, so equations
/// of rest that cannot be solved one after the other (analysis/exact/motions.hpp) are no obstacle. The c_ij are
/// not functions of the parameters, because such functions might have poles just where rest is possible, as 1/(m1
/// − m2) for two weights on a rope.

#include <optional>

#include "check/claims.hpp"

namespace alembert {

/// Nothing if no such combination was found, or if some equation of rest contains only parameters.
std::optional<double> static_combination(const Claims& claims, const Equations& law, const GiNaC::ex& residual);

}  // namespace alembert
