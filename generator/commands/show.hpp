// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Results and warnings on their way to standard output and standard error (streams.hpp).

#include <string>
#include <vector>

#include "report/json.hpp"

namespace alembert {

/// Prints one JSON object, or text for a person.
void show(const Json& result);
void show(const std::string& text);

/// Prints each warning to standard error.
void warn(const std::vector<std::string>& warnings);

}  // namespace alembert
