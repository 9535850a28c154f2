// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "report/ink.hpp"
#include "report/json.hpp"
#include "run/simulate.hpp"

namespace alembert {

Json as_json(const Run& run);
std::string as_text(const Run& run, const Ink& ink = {});

/// The rows, with 17 significant digits.
std::string as_csv(const MotionTable& table);

}  // namespace alembert
