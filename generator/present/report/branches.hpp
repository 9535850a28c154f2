// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "present/report/json.hpp"
#include "stability/equilibrium/branches.hpp"

namespace alembert {

Json as_json(const Branches& found);
std::string as_text(const Branches& found);
/// A row for each point: branch, parameter, coordinates, stable, kind of a special point.
std::string as_csv(const Branches& found);
/// The bifurcation diagram: a panel for each coordinate over the parameter; solid where states are stable, dashed
/// where they are unstable, dotted where that is undecided.
std::string as_svg(const Branches& found);

}  // namespace alembert
