// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The Taylor coefficients of a motion by machine code in memory, ready in milliseconds and without a compiler.
///
///     if (const std::optional<MemorySeries> series = memory_series(program)) {
///         const Series coefficients = make_series(series->module);
///         coefficients(t, state, order, out, work);
///     }
///
/// The coefficients are those of the file that `emit_taylor` writes, up to rounding; the constants in `par` are
/// others. There is no series in quad precision.
///
/// Nothing is returned where memory_solver.hpp returns nothing.

#include <functional>
#include <optional>

#include "alembert/ode/series.hpp"
#include "program/program.hpp"

namespace alembert {

struct MemorySeries {
    SeriesModule module;
    /// From now on, `module` evaluates a compiled series of the same program; by one thread at a time.
    std::function<void(const SeriesModule& compiled)> go_over;
};

/// `with_work`: the power of loads is integrated as one more component. Throws ModelError as emit_taylor does.
std::optional<MemorySeries> memory_series(const Program& program, bool with_work = false);

}  // namespace alembert
