// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "present/report/ink.hpp"
#include "present/report/json.hpp"
#include "proof/proof.hpp"

namespace alembert {

/// In SI units.
Json as_json(const Proof& proof);
/// In the units of the scene: the middle of each interval with a bound of what is left.
std::string as_text(const Proof& proof);

}  // namespace alembert
