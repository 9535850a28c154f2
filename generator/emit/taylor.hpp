// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A C++ file with the Taylor coefficients of a motion, from straight-line code.
///
///     const Source source = emit_taylor(program);       // double_pendulum_taylor.cpp
///
/// The file has one function, `series`, a template over the number type (double, __float128), with the order as an
/// argument; the table at its end is lib/alembert/series.hpp. Shape in templates/taylor.cpp.mustache, mathematics
/// in program/recurrence.hpp. Eight Cauchy products are computed side by side, whatever nodes they belong to:
/// their factors stand in lanes of two columns, [order][lane]. Where there are few, the first and the last term of
/// each sum are added as scalars, so that no order waits for what the one before it has just written. Nodes of one
/// shape (distances of many bodies) are vectors from end to end.
///
/// Throws ModelError for a program without accelerations (a singular system) and for functions without a power
/// series.

#include "emit/emit.hpp"

namespace alembert {

/// `with_work`: the power of loads is integrated as one more component.
Source emit_taylor(const Program& program, bool with_work = false);

}  // namespace alembert
