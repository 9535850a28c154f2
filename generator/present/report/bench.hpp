// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "present/report/json.hpp"
#include "simulate/bench.hpp"

namespace alembert {

Json as_json(const Bench& bench);
std::string as_text(const Bench& bench);
std::string as_csv(const Bench& bench);
/// The diagram of time against error (work_precision.hpp).
std::string as_svg(const Bench& bench);

}  // namespace alembert
