// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Expressions as reasons and conditions show them.

#include <string>

#include "model/mechanism.hpp"

namespace alembert {

/// Empty if it is too long.
std::string in_print(const GiNaC::ex& e, const Mechanism& mechanism);

/// "r > 0": on what sheet of roots a verdict holds.
std::string inequality(const GiNaC::ex& positive, const Mechanism& mechanism);

}  // namespace alembert
