// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Numbers in code.

#include <string>

#include "codegen/emit/statement.hpp"
#include "program/program.hpp"

namespace alembert {

/// The shortest decimal that gives the same double when it is read.
std::string shortest(double value);

/// The literal of a number with these digits: Real(3); in JavaScript 3, or (-3); in Rust R::of(3.0).
std::string literal(const std::string& digits, CodeLanguage language);

/// A rational as a double or a quotient of two, with as few characters as possible.
std::string number_text(const Rational& value, CodeLanguage language = CodeLanguage::cpp);

/// A rational, exact for every Real of up to 34 digits: a double, a quotient of two, or a sum of three.
std::string exact_text(const Rational& value);

}  // namespace alembert
