// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "present/report/json.hpp"
#include "simulate/inverse.hpp"

namespace alembert {

Json as_json(const InverseLoads& needed);
std::string as_text(const InverseLoads& needed);

}  // namespace alembert
