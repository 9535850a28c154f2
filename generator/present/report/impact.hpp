// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "analysis/contact/impact.hpp"
#include "present/report/json.hpp"

namespace alembert {

Json as_json(const Struck& struck);
std::string as_text(const Struck& struck);

}  // namespace alembert
