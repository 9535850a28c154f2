// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Numbers that a user types on the command line. As in a scene, they may be expressions of numbers and pi.
///
///     constant_value("-pi/2")        // −π/2, exactly
///     constant_value("2*atan(1/3)")  // as counterexamples have it

#include <ginac/ginac.h>

#include <string>

namespace alembert {

/// The exact value; it has no symbols. Throws ModelError with the reason: not an expression, a name other than pi,
/// a prime, a division by zero, a value that is not a finite real number.
GiNaC::ex constant_value(const std::string& text);

/// The same as the nearest number of double precision.
double constant_number(const std::string& text);

}  // namespace alembert
