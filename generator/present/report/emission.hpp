// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "present/report/json.hpp"
#include "simulate/emission.hpp"

namespace alembert {

/// `paths` are the paths of the written files.
Json as_json(const Emission& emission, const std::vector<std::string>& paths);
std::string as_text(const Emission& emission, const std::vector<std::string>& paths);

}  // namespace alembert
