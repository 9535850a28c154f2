// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Tables of the scene language that this version does not treat yet: their keys are checked, then they are
/// refused.

#include <string>
#include <vector>

#include "scene/value.hpp"

namespace alembert {

std::vector<std::string> later_sections();

/// False where `entry` is none of them.
bool refuse_later(const Reading& reading, const Entry& entry);

}  // namespace alembert
