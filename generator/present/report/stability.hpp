// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A verdict of stability as text and as JSON.

#include "present/report/json.hpp"
#include "stability/stability.hpp"

namespace alembert {

Json as_json(const Stability& stability);
std::string as_text(const Stability& stability, bool with_modes = false);

}  // namespace alembert
