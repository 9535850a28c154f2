// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Euler's dynamical equations as a book prints them:
///
///     I1*w1' - (I2-I3)*w2*w3 = M1
///     I2*w2' - (I3-I1)*w3*w1 = M2          // not: I2*w2' + (I1-I3)*w1*w3
///     I3*w3' - (I1-I2)*w1*w2 = M3
///
/// (Zhang & Qin, chapter 3; Goldstein, Classical Mechanics (1980), §5-5.) Only the form changes: in the equation
/// of each of three speeds, the product of the two others gets the cyclic order, and the difference of moments
/// before it gets a minus sign.

#include "algebra/notation/readable.hpp"

namespace alembert {

/// `rows[i]` is the speed to which `equations[i]` belongs. The equations are rewritten if at least two of three
/// speeds have such a term.
void write_as_euler(std::vector<ReadableEquation>& equations, const std::vector<Phrase>& rows);

}  // namespace alembert
