// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Accelerations among the values of `--at`: "theta1''=2".

#include <optional>
#include <vector>

#include "program/lower/start.hpp"

namespace alembert {

/// By coordinate; nothing where none is given. Throws ModelError for a name that is none, and
/// std::invalid_argument for a value that is not finite.
std::vector<std::optional<double>> given_accelerations(const Overrides& at, const Mechanism& mechanism);

/// All other values: what `start_of` and `prepared` take.
Overrides without_accelerations(Overrides at);

}  // namespace alembert
