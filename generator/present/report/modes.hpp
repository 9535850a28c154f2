// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "present/report/json.hpp"
#include "stability/linear/modes.hpp"

namespace alembert {

/// A list of eigenvalue and vector, by state.
Json as_json(const std::vector<LinearMode>& modes, const std::vector<std::string>& states);
/// Size and phase of each state in each mode.
std::string as_text(const std::vector<LinearMode>& modes, const std::vector<std::string>& states);

}  // namespace alembert
