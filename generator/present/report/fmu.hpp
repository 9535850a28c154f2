// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "present/report/json.hpp"
#include "simulate/fmu/unit.hpp"

namespace alembert {

/// `path` is that of the written file.
Json as_json(const FunctionalUnit& unit, const std::string& path);
std::string as_text(const FunctionalUnit& unit, const std::string& path);

}  // namespace alembert
