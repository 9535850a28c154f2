// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A sweep as an SVG picture: lines over one varied quantity, or a coloured map with its scale over two.
///
///     write_file("map.svg", sweep_plot(sweep(scene, grid), {"theta1"}), {});
///
/// Motions that failed leave a gap in a line, and a grey cell in a map. If a map has more values than can be seen,
/// only every second, third … is drawn, and the picture says so.

#include <string>
#include <vector>

#include "simulate/sweep.hpp"

namespace alembert {

/// `shown` are names of end_columns; if empty, all coordinates. Throws ModelError if more than two quantities vary
/// (need_pictured).
std::string sweep_plot(const Sweep& sweep, const std::vector<std::string>& shown);

/// Throws ModelError if a grid varies more quantities than a picture can show.
void need_pictured(const Grid& grid);

}  // namespace alembert
