// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which coordinates the motion of the others depends on, and which are cyclic.
///
///     const Dependences depends = dependences(residuals, split, instant);
///     const std::vector<bool> essential = essential_coordinates(depends, split.u.size());
///
/// Found at random states near the given one, not from the text of the equations: a coordinate that cancels is
/// cyclic too, also where constraints have been eliminated.

#include "linear/tangent.hpp"

namespace alembert {

/// Rows: w', r'; columns: r, w, t. True where the derivative is not zero at one of a few states.
using Dependences = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>;

Dependences dependences(const Residuals& residuals, const Split& split, const Instant<long double>& at);

/// Of the independent coordinates, those that the rates of the `speeds` speeds hold, those that the rates of these
/// coordinates hold, and so on. The others are cyclic.
std::vector<bool> essential_coordinates(const Dependences& depends, Eigen::Index speeds);

}  // namespace alembert
