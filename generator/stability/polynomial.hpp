// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Stability of a scene's [polynomial], and conditions in the parameters.

#include "stability/stability.hpp"

namespace alembert {

Stability stability_of_polynomial(const Scene& scene, const StabilityOptions& options);

/// Adds conditions in the parameters for a mechanism without constraints and with up to four coordinates; none for
/// others.
void add_conditions(Stability& result, const Local& local, const ExactOverrides& exact_at);

}  // namespace alembert
