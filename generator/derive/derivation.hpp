// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// From equations to a derivation that a reader can follow.
///
///     const Derivation shown = derivation_of(mechanism, equations);
///     text(shown.equations[0].lhs);

#include "formalism/derivation.hpp"

namespace alembert {

/// λ ∂f/∂q of each constraint (λ a for nonholonomic ones), as far as readable.
void show_reactions(Derivation& shown, const Mechanism& mechanism);

Derivation derivation_of(const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
