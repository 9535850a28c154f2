// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a formalism shows on its way, and its equations where they are not second-order ones in q alone.
///
///     show_own_steps(derivation, mechanism, equations);    // fills `sections`; replaces `equations` for hamilton, routhian

#include "formalism/derivation.hpp"

namespace alembert {

/// Leaves out what is beyond the readable size.
void show_own_steps(Derivation& shown, const Mechanism& mechanism, const Equations& equations);

}  // namespace alembert
