// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "analysis/rigid/identify.hpp"
#include "present/report/json.hpp"

namespace alembert {

Json as_json(const Identification& found);
std::string as_text(const Identification& found);

}  // namespace alembert
