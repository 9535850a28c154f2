// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A motion as an SVG picture: small charts over time, one above the other, each for quantities of the same kind
/// and unit.
///
///     write_file("motion.svg", motion_plot(simulate(scene, {.duration = 5}), {"theta1", "energy"}), {});
///
/// Each line is named at its end. Times of events and impacts are marked in all charts; while a contact is closed
/// the background is grey. A quantity that changes by less than a millionth of itself is drawn as its difference
/// from the start.

#include <string>
#include <vector>

#include "simulate/simulate.hpp"

namespace alembert {

/// `columns` are the names of the table's columns to draw (check_columns); if empty, all except the reactions of
/// joints.
std::string motion_plot(const Run& run, const std::vector<std::string>& columns);

/// The units of all columns of the table, in their order; empty where a unit is not known.
std::vector<std::string> column_units(const Run& run);

}  // namespace alembert
