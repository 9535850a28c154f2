// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A C++ file with the Taylor coefficients of a motion, from straight-line code.
///
///     const Source source = emit_taylor(program);       // double_pendulum_taylor.cpp
///
/// The file has one function, `series`, a template over the number type (double, __float128), with the order as an argument;
/// the table at its end is lib/alembert/series.hpp. Shape in templates/taylor.cpp.mustache, mathematics in lower/recurrence.hpp.
/// Each Cauchy product is kept as running sums: as soon as two coefficients are known, their products are added to all later
/// orders that need them, eight at a time; on the way from one order to the next lie a few scalar operations only.
///
/// Throws ModelError for a program without accelerations (a singular system) and for functions without a power series.

#include "emit/emit.hpp"

namespace alembert {

/// `with_work`: the power of loads is integrated as one more component.
Source emit_taylor(const Program& program, bool with_work = false);

}  // namespace alembert
