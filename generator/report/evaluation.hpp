// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "report/json.hpp"
#include "run/evaluate.hpp"

namespace alembert {

/// `reactions`: whether they were asked for; then their objects are there, empty or not.
Json as_json(const Evaluation& evaluation, bool reactions);
std::string as_text(const Evaluation& evaluation);

}  // namespace alembert
