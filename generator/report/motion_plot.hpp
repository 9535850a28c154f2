// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A motion as an SVG picture: one small chart above the other for quantities of one kind and unit, over the time.
///
///     write_file("motion.svg", motion_plot(simulate(scene, {.duration = 5}), {"theta1", "energy"}), {});
///
/// Each line is named at its end. Times of events and impacts are marked in all charts; while a contact is closed
/// the ground is grey. A quantity that changes by less than a millionth of itself is drawn as its difference to
/// the start.

#include <string>
#include <vector>

#include "run/simulate.hpp"

namespace alembert {

/// `columns`: what is drawn, names of columns of the table (check_columns); empty: all but the reactions of
/// joints.
std::string motion_plot(const Run& run, const std::vector<std::string>& columns);

}  // namespace alembert
