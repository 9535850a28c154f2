// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "fmu/unit.hpp"
#include "report/json.hpp"

namespace alembert {

/// `path` is that of the written file.
Json as_json(const FunctionalUnit& unit, const std::string& path);
std::string as_text(const FunctionalUnit& unit, const std::string& path);

}  // namespace alembert
