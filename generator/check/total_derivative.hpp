// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Two Lagrangians that differ by the time derivative of a function of coordinates and time have the same
/// equations of motion. They differ by such a derivative, and by none other, if the equations of their difference
/// are void: d/dt ∂Δ/∂q' − ∂Δ/∂q = 0 for all q, q', q'', t (Zhang & Qin, §1.5; Gelfand & Fomin, Calculus of
/// Variations, §36).
///
///     euler_operator(delta, mechanism)        // zero, or on constraints A q' + b = 0 a combination of the rows
///     of A source_of_derivative(delta, mechanism)  // F with Δ = F', if it is easily found: m*c*x

#include <optional>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

/// d/dt ∂Δ/∂q' − ∂Δ/∂q, one for each coordinate.
std::vector<GiNaC::ex> euler_operator(const GiNaC::ex& delta, const Mechanism& mechanism);

/// Nothing where Δ is not of first degree in the rates, is long, or holds terms beyond products of powers, sines
/// and cosines, or inputs. The result is proved: its time derivative is Δ.
std::optional<GiNaC::ex> source_of_derivative(const GiNaC::ex& delta, const Mechanism& mechanism);

}  // namespace alembert
