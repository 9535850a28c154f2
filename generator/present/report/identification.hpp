// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "report/json.hpp"
#include "rigid/identify.hpp"

namespace alembert {

Json as_json(const Identification& found);
std::string as_text(const Identification& found);

}  // namespace alembert
