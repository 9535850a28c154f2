// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A C++ file with the Taylor coefficients of a motion, from straight-line code.
///
///     const Source source = emit_taylor(program);       // double_pendulum_taylor.cpp
///
/// The file has one function, `series`, a template over the number type (double, __float128), with the order as an
/// argument; the table at its end is lib/alembert/ode/series.hpp. The template is templates/taylor.cpp.mustache,
/// the mathematics is in program/recurrence.hpp. Eight Cauchy products are computed side by side, whatever nodes
/// they belong to; their factors are in lanes of two columns, [order][lane]. If there are few products, the first
/// and the last term of each sum are added as scalars, so that no order waits until the memory writes of the order
/// before are finished. Nodes of the same shape (distances of many bodies) are computed as vectors throughout.
///
/// Throws ModelError for a program without accelerations (a singular system) and for functions without a power
/// series.

#include "codegen/emit/emit.hpp"

namespace alembert {

/// `with_work`: the power of loads is integrated as one more component.
Source emit_taylor(const Program& program, bool with_work = false);

/// What a series of order p costs, order·p + product·p², in units of the other work of a step (series.hpp).
struct SeriesCost {
    double order = 0, product = 0;
};
SeriesCost series_cost(const Program& program);

}  // namespace alembert
