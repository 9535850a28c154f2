// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A sweep as an SVG picture: over one varied quantity, lines; over two, a map in colours with its scale.
///
///     write_file("map.svg", sweep_plot(sweep(scene, grid), {"theta1"}), {});
///
/// Motions that failed leave a gap in a line, and a grey place in a map. Of more values than can be seen in a map
/// every second, third … is drawn, which the picture says.

#include <string>
#include <vector>

#include "run/sweep.hpp"

namespace alembert {

/// `shown`: names of end_columns; empty: all coordinates. Throws ModelError where more than two quantities vary
/// (need_pictured).
std::string sweep_plot(const Sweep& sweep, const std::vector<std::string>& shown);

/// Throws ModelError where a grid varies more quantities than a picture can show.
void need_pictured(const Grid& grid);

}  // namespace alembert
