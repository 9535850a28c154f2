// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "present/report/json.hpp"
#include "simulate/evaluate.hpp"

namespace alembert {

/// `reactions` tells whether these were requested; if so, their objects are present even if they are empty.
Json as_json(const Evaluation& evaluation, bool reactions);
std::string as_text(const Evaluation& evaluation);

}  // namespace alembert
