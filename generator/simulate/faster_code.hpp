// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Which of two codes of the same functions takes less time here: the least of several short runs of each, in
/// turn.
///
///     if (is_faster(compiled.module, in_memory, {t, state, parameters})) in_memory_code.go_over(compiled.module);
///
/// It takes some tenths of a millisecond. Where the two are alike, the answer may be another one next time.

#include <span>

#include "alembert/native/module.hpp"
#include "alembert/ode/series.hpp"

namespace alembert {

struct TimedPlace {
    double t;
    std::span<const double> state;  ///< at least the coordinates and speeds
    const std::vector<double>& parameters;
};

/// Whether a right-hand side of `one` takes less time than one of `other`.
bool is_faster(const Module& one, const Module& other, const TimedPlace& place);

/// Whether a power series of order 20 does.
bool is_faster(const SeriesModule& one, const SeriesModule& other, const TimedPlace& place);

}  // namespace alembert
