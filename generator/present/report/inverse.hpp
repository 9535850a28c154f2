// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "report/json.hpp"
#include "run/inverse.hpp"

namespace alembert {

Json as_json(const InverseLoads& needed);
std::string as_text(const InverseLoads& needed);

}  // namespace alembert
