// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Initial values that contradict the scene, told where equations are only shown. What computes from them refuses
/// them (analysis/state/assemble.hpp, analysis/contact/contacts.hpp).

#include <vector>

#include "model/mechanism.hpp"
#include "program/lower/start.hpp"

namespace alembert {

/// Warnings, each with the place of a constraint that the initial values break and no guess can mend, or of a gap
/// that is negative. `mechanism` is without redundant constraints.
std::vector<Diagnostic> warnings_of_start(const Mechanism& mechanism, const Overrides& at);

}  // namespace alembert
