// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "present/report/json.hpp"
#include "stability/equilibrium/equilibria.hpp"

namespace alembert {

Json as_json(const Equilibria& found);
std::string as_text(const Equilibria& found);

/// The names of the coordinates and states that choose in a continuum.
std::vector<std::string> free_names(const Mechanism& mechanism, const SteadyFamily& family);

/// The values of coordinates, or of their rates, by name.
Json by_name_of(const Mechanism& mechanism, const std::vector<double>& values);

}  // namespace alembert
