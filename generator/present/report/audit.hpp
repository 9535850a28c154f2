// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "analysis/audit/audit.hpp"
#include "present/report/json.hpp"

namespace alembert {

Json as_json(const Audited& audited);
std::string as_text(const Audited& audited);

}  // namespace alembert
