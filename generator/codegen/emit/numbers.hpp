// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Numbers as C++.

#include <string>

#include "program/program.hpp"

namespace alembert {

/// The shortest decimal that gives the same double when it is read.
std::string shortest(double value);

/// A rational as a double or a quotient of two, with as few characters as possible.
std::string number_text(const Rational& value);

/// A rational, exact for every Real of up to 34 digits: a double, a quotient of two, or a sum of three.
std::string exact_text(const Rational& value);

}  // namespace alembert
