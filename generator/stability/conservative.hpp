// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Loads that are a gradient as part of the potential: x'' = −x³ given as a force is conservative.

#include "model/mechanism.hpp"

namespace alembert {

/// The same mechanism, with V − ∫Q·dq for V where the generalized forces Q of all loads outside V, dampers left
/// out, are polynomials in the coordinates alone with ∂Q_i/∂q_j = ∂Q_j/∂q_i. Itself elsewhere.
Mechanism with_potential_of_loads(const Mechanism& mechanism);

}  // namespace alembert
