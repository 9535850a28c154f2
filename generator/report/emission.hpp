// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "report/json.hpp"
#include "run/emission.hpp"

namespace alembert {

/// `path`: where the file was written.
Json as_json(const Emission& emission, const std::string& path);
std::string as_text(const Emission& emission, const std::string& path);

}  // namespace alembert
