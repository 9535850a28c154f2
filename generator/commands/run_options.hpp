// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How a motion is to be integrated, for the commands that integrate one.

#include <string_view>

#include "alembert/integrate.hpp"
#include "commands/pipeline.hpp"

namespace alembert {

/// The scene's wishes, those of the command line first. Throws ModelError for a method that does not exist.
Options options_of(const Request& request, const Mechanism& mechanism, const Start& start);

/// What verlet and kahanli8 take for granted: q' = u, and M and u' = M⁻¹f in which no rate (and, for M, no coordinate)
/// occurs. What occurs only to cancel counts as there. Throws ModelError.
void need_separable(const Derived& derived, std::string_view method);

}  // namespace alembert
