// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The times at which each Taylor coefficient is ready, order after order, so that sums can add late terms last.

#include <map>

#include "codegen/emit/scheduled_sum.hpp"
#include "codegen/emit/series_lanes.hpp"

namespace alembert {

/// The node of the rate of component i of the state: q, then u, then the integral of the power.
int rate_node(const Recurrences& recurrences, int i);

/// The times in cycles for each node and then for a row of lanes. `sums` are those of nodes outside packs, if the
/// ends of sums are added one by one.
Times series_times(const Recurrences& recurrences, const SeriesLanes& lanes,
                   const std::map<int, ScheduledSum>& sums);

}  // namespace alembert
