// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Makes loads that are a gradient a part of the potential: x'' = −x³ given as a force is conservative.

#include "model/mechanism.hpp"

namespace alembert {

/// The mechanism with V − ∫Q·dq in place of V, if the generalized forces Q of all loads outside V, except dampers,
/// are polynomials in the coordinates only with ∂Q_i/∂q_j = ∂Q_j/∂q_i. Otherwise the mechanism itself.
Mechanism with_potential_of_loads(const Mechanism& mechanism);

}  // namespace alembert
