// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The Taylor coefficients of eight motions side by side by machine code in memory.
///
///     if (const std::shared_ptr<const PackSeries> packs = memory_series_packs(program))
///         packs->expand(t, state, par, order, out, work);
///
/// Null where memory_solver.hpp returns nothing.

#include <memory>
#include <optional>

#include "alembert/batch/pack_series.hpp"
#include "program/program.hpp"

namespace alembert {

/// `with_work`: the power of loads is integrated as one more component; `lanes`: as in memory_solver. Throws
/// ModelError as emit_taylor does.
std::shared_ptr<const PackSeries> memory_series_packs(const Program& program, bool with_work = false,
                                                      std::optional<int> lanes = {});

}  // namespace alembert
