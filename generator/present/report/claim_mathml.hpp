// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// An equation of the scene language typeset as it was written: nothing is moved or simplified.
///
///     typeset_equality(claim.equation, "m*g*sin(theta)")   // with that term marked as wrong

#include <string>

#include "scene/expression.hpp"

namespace alembert {

/// A block of HTML. `wrong` is a term as it stands in either side; empty, or not found there: nothing is marked.
std::string typeset_equality(const Equality& equation, const std::string& wrong);

}  // namespace alembert
