// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "report/json.hpp"
#include "run/sweep.hpp"

namespace alembert {

/// Everything except the rows.
Json as_json(const Sweep& sweep);
/// One row for each member.
Json rows_as_json(const Sweep& sweep);
std::string as_csv(const Sweep& sweep);
/// A summary in a few lines.
std::string as_text(const Sweep& sweep);

}  // namespace alembert
