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

#include "present/report/plot_panels.hpp"
#include "simulate/simulate.hpp"

namespace alembert {

/// `columns` are the names of the table's columns to draw (check_columns); if empty, all except the reactions of
/// joints.
std::string motion_plot(const Run& run, const std::vector<std::string>& columns);

/// The named columns of the table, or all except the reactions of joints, with their points.
std::vector<PlottedLine> lines_of(const Run& run, const std::vector<std::string>& names);

/// The same as lines of text: a chart of dots (Braille's letters) for each quantity, one above the other, at most
/// `columns` letters wide. Where no names are given it shows coordinates alone, at most four.
std::string braille_plot(const Run& run, const std::vector<std::string>& names, int columns);

/// The units of all columns of the table, in their order; empty where a unit is not known.
std::vector<std::string> column_units(const Run& run);

}  // namespace alembert
